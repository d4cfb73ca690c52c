#include <plexway/solid/tet_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/common/number_range.hpp"
#include "complexes/common/simplex_gluing.hpp"
#include "complexes/common/simplex_order.hpp"
#include "complexes/solid/tet_edges.hpp"
#include "complexes/solid/tet_gluing.hpp"
#include "complexes/solid/tet_layout.hpp"

namespace plexway {
using namespace detail;
namespace {

// Six times the volume, over the product of the three edges from a corner: below this, none.
constexpr double flat = 1e-14;
// So little that coordinates of single precision may say it lies on the wrong side.
constexpr double thin = 1e-6;

Vector3<double> vector(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

// In units of the largest extent and about the middle, so that an offset does no harm and nothing
// overflows. `reach`: the farthest coordinate as given, in the same units.
std::vector<std::array<double, 3>> centred(std::span<const std::array<double, 3>> positions,
                                           std::span<const std::array<Index, 4>> tets,
                                           double& extent, double& reach, int threads) {
  over_blocks(positions.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      for (const double x : positions[v])
        if (!std::isfinite(x))
          throw InputError("vertex " + std::to_string(v) + ": a coordinate is not a finite number");
  });
  Box3 box;
  gather_blocks<Box3>(
      tets.size(), threads,
      [&](std::size_t first, std::size_t last, Box3& own) {
        // A stray vertex must not cost the others their digits.
        for (const auto& tet : tets.subspan(first, last - first))
          for (const Index v : tet) own.take(positions[v]);
      },
      [&](const Box3& own) { box.take(own); });
  const auto &low = box.low, &high = box.high;
  extent = 0;
  for (std::size_t d = 0; d < 3; ++d) extent = std::max(extent, high[d] / 2 - low[d] / 2);
  if (extent > std::numeric_limits<double>::max() / 16)
    throw InputError("the coordinates are too large to take distances: scale them down");
  if (!(extent > 0)) extent = 1;
  reach = 0;
  for (std::size_t d = 0; d < 3; ++d)
    reach = std::max({reach, std::abs(low[d]) / extent, std::abs(high[d]) / extent});
  std::vector<std::array<double, 3>> scaled(positions.size());
  over_blocks(positions.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      for (std::size_t d = 0; d < 3; ++d)
        scaled[v][d] = (positions[v][d] - (low[d] / 2 + high[d] / 2)) / extent;
  });
  return scaled;
}

// A tetrahedron with these edge lengths, as far as there is one.
TetPoints pose(const std::array<double, 6>& length) {
  const auto square = [](double x) { return x * x; };
  TetPoints p{};
  p[1].x = length[0];
  const auto along = [](double to_first, double to_second, double base) {
    return base > 0 ? (to_first - to_second + base * base) / (2 * base) : 0;
  };
  const double l02 = square(length[1]), l12 = square(length[2]), l03 = square(length[3]);
  p[2].x = along(l02, l12, length[0]);
  p[2].y = std::sqrt(std::max(l02 - square(p[2].x), 0.0));
  p[3].x = along(l03, square(length[4]), length[0]);
  if (p[2].y > 0) p[3].y = (l03 - square(length[5]) + l02 - 2 * p[3].x * p[2].x) / (2 * p[2].y);
  p[3].z = std::sqrt(std::max(l03 - square(p[3].x) - square(p[3].y), 0.0));
  return p;
}

double determinant(const TetPoints& p) { return dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]); }

// Its volume beside that of three edges at right angles, by those from the first corner.
double thickness(double a, double b, double c, double six_volumes) {
  const double product = a * b * c;
  return product > 0 ? std::abs(six_volumes) / product : 0;
}
bool has_volume(const TetPoints& p) {
  return thickness(norm(p[1] - p[0]), norm(p[2] - p[0]), norm(p[3] - p[0]), determinant(p)) > flat;
}

// Along a curve. What is not in order as it is glued and turned by its volumes, is settled or
// refused by the numbers that the caller knows.
TetLayout lay_out(std::span<const std::array<double, 3>> scaled, Tets tets,
                  std::span<const signed char> volume, int threads) {
  std::vector<Index> order = along_curve<4>(scaled, tets, threads);
  const auto laid_out = [&](std::span<const char> turn) {
    return TetLayout(scaled.size(), tets, order, turn, threads);
  };
  if (std::find(volume.begin(), volume.end(), 0) == volume.end()) {
    std::vector<char> inverted(tets.size());
    for (std::size_t t = 0; t < tets.size(); ++t) inverted[t] = volume[t] < 0;
    TetLayout layout = laid_out(inverted);
    if (layout.glue(threads)) return layout;
  }
  GluedTets glued = glue_tets(scaled.size(), tets, threads);
  TetLayout layout = laid_out(orient_tets(tets, glued.across, volume, threads));
  layout.take_gluing(std::move(glued), threads);
  return layout;
}

// An edge has one length in all tetrahedra that share a face with it, but for rounding.
void check_edges(Tets tets, std::span<const std::array<double, 6>> lengths,
                 const TetGluing& across) {
  for (Index t = 0; t < tets.size(); ++t)
    for (Index face = 0; face < 4; ++face) {
      if (across[t][face] == none || across[t][face] / 4 < t) continue;
      const Index u = across[t][face] / 4;
      const auto there = [&](Index corner) {
        return static_cast<Index>(std::find(tets[u].begin(), tets[u].end(), tets[t][corner]) -
                                  tets[u].begin());
      };
      const double longest = std::max(longest_of(lengths[t]), longest_of(lengths[u]));
      for (const auto& [i, j] : tet_edge_ends) {
        if (i == face || j == face) continue;
        const double one = lengths[t][tet_edge(i, j)],
                     other = lengths[u][tet_edge(there(i), there(j))];
        if (differ_much(one, other, longest))
          refuse_two_lengths(tets[t][i], tets[t][j], one, other);
      }
    }
}

}  // namespace

template <class Real>
TetMesh<Real>::TetMesh(const GivenPoints& positions, const GivenSimplices<4>& tets, int threads) {
  check_tets(positions.size(), tets, threads);
  double extent = 1, reach = 0;
  auto scaled = centred(positions, tets, extent, reach, threads);
  // An edge longer than this passes the check of its coordinates, as these are off by a rounding of
  // `reach` at most: so that few tetrahedra are checked.
  const double surely =
      4 * (NumberRange<Real>::least_of_extent + 8 * std::numeric_limits<double>::epsilon() * reach);
  std::vector<signed char> volume(tets.size());
  // Not as centred: what an extent leaves no digits for is not without length.
  const auto check_extent = [&](std::size_t t) {
    double longest = 0;
    for (const auto& [i, j] : tet_edge_ends)
      for (std::size_t d = 0; d < 3; ++d)
        longest = std::max(longest, std::abs(positions[tets[t][j]][d] / extent -
                                             positions[tets[t][i]][d] / extent));
    NumberRange<Real>::check_coordinates("tet", t, longest, 1);
  };
  const auto measure = [&](std::size_t t, std::array<double, 6>& lengths) {
    TetPoints p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = vector(scaled[tets[t][i]]);
    double longest = 0;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [i, j] = tet_edge_ends[e];
      lengths[e] = norm(p[j] - p[i]);
      longest = std::max(longest, lengths[e]);
    }
    if (!(longest > surely)) check_extent(t);
    const double six_volumes = determinant(p),
                 thick = thickness(lengths[0], lengths[1], lengths[3], six_volumes);
    volume[t] = static_cast<signed char>(thick <= flat ? 0 : thick < thin ? 1 : 2);
    if (six_volumes < 0) volume[t] = static_cast<signed char>(-volume[t]);
  };
  // The sum is in the order of the tetrahedra: by one thread along with the rest, which hides that
  // each addition waits for the last, by several behind some blocks at a time.
  const std::size_t most = threads_for(threads) == 1 ? 1 : 32 * building_block;
  Unfilled<std::array<double, 6>> lengths(std::min(most, tets.size()));
  double sum = 0;
  const auto add = [&](const std::array<double, 6>& six) {
    for (const double length : six) sum += length;
  };
  try {
    if (most == 1) {
      for (std::size_t t = 0; t < tets.size(); ++t) measure(t, lengths[0]), add(lengths[0]);
    } else {
      for (std::size_t begin = 0; begin < tets.size(); begin += most) {
        const std::size_t count = std::min(most, tets.size() - begin);
        over_blocks(count, threads, [&](std::size_t first, std::size_t last) {
          for (std::size_t k = first; k < last; ++k) measure(begin + k, lengths[k]);
        });
        for (std::size_t k = 0; k < count; ++k) add(lengths[k]);
      }
    }
  } catch (const InputError&) {  // what cannot be glued is told first
    (void)glue_tets(positions.size(), tets, threads);
    throw;
  }
  Unfilled<std::array<double, 6>>().swap(lengths);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (volume[t] == 0 && summary_.degenerate_tets++ == 0)
      summary_.first_degenerate = static_cast<Index>(t);
    if (volume[t] < 0 && summary_.inverted_tets++ == 0)
      summary_.first_inverted = static_cast<Index>(t);
  }
  const double mean = sum > 0 ? sum / (6 * static_cast<double>(tets.size())) : 1;
  over_blocks(scaled.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      for (double& x : scaled[v]) x /= mean;
  });
  summary_.embedded = true;
  summary_.mean_edge = mean * extent;
  assemble(lay_out(scaled, tets, volume, threads), scaled, {}, threads);
}

template <class Real>
TetMesh<Real>::TetMesh(std::size_t vertices, const GivenSimplices<4>& tets,
                       const Given<std::array<double, 6>>& lengths, int threads) {
  check_tets(vertices, tets, threads);
  if (lengths.size() != tets.size())
    throw InputError(std::to_string(tets.size()) + " tets but lengths for " +
                     std::to_string(lengths.size()));
  double longest = 0;
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (const double l : lengths[t]) {
      if (!(l >= 0) || !std::isfinite(l))
        throw InputError("tet " + std::to_string(t) + ": a length is negative or not finite");
      longest = std::max(longest, l);
    }
  double sum = 0;
  for (const auto& tet : lengths)
    for (const double l : tet) sum += longest > 0 ? l / longest : 0;
  const double unit = longest > 0 ? longest * (sum / (6 * static_cast<double>(tets.size()))) : 1;
  std::vector<std::array<double, 6>> scaled(lengths.begin(), lengths.end());
  for (auto& tet : scaled)
    for (double& l : tet) l /= unit;
  for (std::size_t t = 0; t < tets.size(); ++t)
    NumberRange<Real>::check_simplex("tet", t,
                                     *std::max_element(scaled[t].begin(), scaled[t].end()));
  GluedTets glued = glue_tets(vertices, tets, threads);
  check_edges(tets, lengths, glued.across);
  const std::vector<signed char> unknown(tets.size(), 0);
  const auto turn = orient_tets(tets, glued.across, unknown, threads);
  summary_.mean_edge = unit;
  TetLayout layout(vertices, tets, breadth_first<4>(glued.across), turn, threads);
  layout.take_gluing(std::move(glued), threads);
  assemble(std::move(layout), {}, scaled, threads);
}

template <class Real>
void TetMesh<Real>::assemble(TetLayout&& layout, std::span<const std::array<double, 3>> scaled,
                             std::span<const std::array<double, 6>> lengths, int threads) {
  const std::size_t m = layout.tet.size(), vertices = layout.vertex_to_inside.size();
  summary_.vertices = vertices;
  summary_.tets = m;
  summary_.unreferenced_vertices = vertices - layout.named;
  const auto& corner = layout.corner;
  const TetGluing& over = layout.glued.across;
  gather_blocks<std::size_t>(
      m, threads,
      [&](std::size_t first, std::size_t last, std::size_t& on_boundary) {
        for (std::size_t t = first; t < last; ++t)
          for (const Index o : over[t]) on_boundary += o == none;
      },
      [&](std::size_t on_boundary) { summary_.boundary_faces += on_boundary; });
  summary_.faces = (4 * m + summary_.boundary_faces) / 2;

  std::vector<Vector3<double>> at;
  std::vector<TetPoints> points;
  if (summary_.embedded) {
    at.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v) at[layout.vertex_to_inside[v]] = vector(scaled[v]);
  } else {
    points.resize(m);
    for (std::size_t inside = 0; inside < m; ++inside) {
      const Index t = layout.tet[inside];
      const TetPoints posed = pose(lengths[t]);
      for (Index i = 0; i < 4; ++i) points[inside][layout.corner_inside(t, i)] = posed[i];
    }
  }
  TetCorners& rows = layout.rows;
  TetTopology topology = find_tet_topology(corner, over, rows, {at, points}, threads);
  corners_begin_ = std::move(rows.begin);
  corners_ = std::move(rows.corner);
  summary_.edges = layout.glued.edges;
  summary_.reflex_edges = topology.reflex.size();
  summary_.notch_edges = static_cast<std::size_t>(std::count_if(
      topology.reflex.begin(), topology.reflex.end(),
      [](const auto& edge) { return edge.angle > std::numbers::pi + SolidSummary::notch; }));
  summary_.reflex_vertices = topology.reflex_vertices;
  summary_.pinched_vertices = topology.pinched_vertices.size();
  summary_.pinched_edges = topology.pinched_edges.size();
  // Tetrahedra that share a vertex are of one: joined by faces there, or the vertex or an edge at
  // it is pinched.
  summary_.components = layout.glued.components;
  pinched_ = std::move(topology.pinched_vertices);
  for (const auto& e : topology.pinched_edges)
    pinched_edges_.own().push_back({{e.vertex[0], e.vertex[1]}, e.begin, e.end});
  pinched_edge_tets_ = std::move(topology.pinched_edge_tets);

  constexpr auto packed = [](Index tet, Index face) { return tet << TetAcross::tet_shift | face; };
  const Index sentinel = packed(static_cast<Index>(m), 0);
  auto& records = tets_.own();
  records.resize(m + 1);
  over_blocks(m, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto side = [&](std::size_t i) { return over[t][i] == none ? sentinel : over[t][i]; };
      records[t] = {{side(0), side(1), side(2), side(3)},
                    {corner[t][0], corner[t][1], corner[t][2], corner[t][3]}};
    }
  });
  records[m] = {{sentinel, sentinel, sentinel, sentinel}, {0, 0, 0, 0}};

  tet_to_inside_ = std::move(layout.tet_to_inside);
  vertex_to_inside_ = std::move(layout.vertex_to_inside);

  if (summary_.embedded) {
    points_ = std::move(at);
    for (const auto& e : topology.reflex)
      if (e.crack) cracks_.own().push_back(e.vertex);
  } else {
    std::vector<std::array<Real, 6>>& squares = lengths_.own();
    squares.resize(m + 1);
    for (std::size_t t = 0; t < m; ++t) {
      // Through the pose, so that they are those of a tetrahedron.
      if (!has_volume(points[t])) {
        ++summary_.degenerate_tets;
        summary_.first_degenerate = std::min(summary_.first_degenerate, layout.tet[t]);
      }
      for (std::size_t e = 0; e < 6; ++e) {
        const auto d = points[t][tet_edge_ends[e][1]] - points[t][tet_edge_ends[e][0]];
        squares[t][e] = static_cast<Real>(dot(d, d));
      }
    }
  }
}

template <class Real>
std::size_t TetMesh<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(tets_) + of(points_) + of(lengths_) + of(cracks_) +
         of(vertex_to_inside_) + of(tet_to_inside_) + of(corners_begin_) + of(corners_) +
         of(pinched_) + of(pinched_edges_) + of(pinched_edge_tets_) + space_.bytes();
}

template class TetMesh<float>;
template class TetMesh<double>;

}  // namespace plexway
