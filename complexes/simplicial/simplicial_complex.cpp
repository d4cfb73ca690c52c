#include <plexway/simplicial/simplicial_complex.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/arrays.hpp"
#include "complexes/common/disjoint_sets.hpp"
#include "complexes/common/number_range.hpp"
#include "complexes/common/simplex_gluing.hpp"
#include "complexes/simplicial/simplex_flat.hpp"
#include "complexes/simplicial/simplex_shape.hpp"

namespace plexway {
using namespace detail;
namespace {

std::string named(std::size_t simplex) { return "simplex " + std::to_string(simplex); }

template <std::size_t Sides>
void check_simplices(std::size_t vertices, std::span<const std::array<Index, Sides>> simplices) {
  if (simplices.empty()) throw InputError("the complex has no simplices: give at least one");
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  if (simplices.size() >= FacetAcross::limit)
    throw InputError(std::to_string(simplices.size()) + " simplices: at most " +
                     std::to_string(FacetAcross::limit - 1) + " fit the index");
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (std::size_t i = 0; i < Sides; ++i) {
      const Index v = simplices[s][i];
      if (v >= vertices)
        throw InputError(named(s) + ": vertex " + std::to_string(v) +
                         " is out of range, there are " + std::to_string(vertices));
      for (std::size_t j = 0; j < i; ++j)
        if (simplices[s][j] == v)
          throw InputError(named(s) + ": vertex " + std::to_string(v) + " occurs twice");
    }
}

// Two vertices have one edge: the mean of what its simplices say, but for rounding alike.
template <int N>
void agree_on_edges(std::span<const std::array<Index, N + 1>> simplices,
                    std::vector<std::array<double, N*(N + 1) / 2>>& lengths) {
  using Layout = SimplexLayout<N>;
  struct Place {
    std::uint64_t ends;
    std::size_t at;  // edges * simplex + edge
  };
  std::vector<Place> places;
  places.reserve(simplices.size() * Layout::edges);
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (std::size_t b = 1; b <= N; ++b)
      for (std::size_t a = 0; a < b; ++a) {
        const auto [low, high] = std::minmax(simplices[s][a], simplices[s][b]);
        places.push_back({std::uint64_t{low} << 32 | high, s * Layout::edges + Layout::edge(a, b)});
      }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.at < b.at;
  });
  const auto length = [&](const Place& p) -> double& {
    return lengths[p.at / Layout::edges][p.at % Layout::edges];
  };
  for (auto run = places.begin(); run != places.end();) {
    const auto end =
        std::find_if(run, places.end(), [&](const Place& p) { return p.ends != run->ends; });
    const double count = static_cast<double>(end - run);
    double mean = 0;
    bool equal = true;
    const auto longest = [&](const Place& p) { return longest_of(lengths[p.at / Layout::edges]); };
    for (auto p = run; p != end; ++p) {
      if (length(*p) != length(*run) &&
          differ_much(length(*p), length(*run), std::max(longest(*p), longest(*run))))
        refuse_two_lengths(static_cast<Index>(p->ends >> 32), static_cast<Index>(p->ends),
                           length(*run), length(*p));
      mean += length(*p) / count;
      equal = equal && length(*p) == length(*run);
    }
    for (; run != end; ++run)
      if (!equal) length(*run) = mean;
  }
}

// From all simplices over facets, near ones first: neighbours in space are near in memory.
std::vector<Index> breadth_first(const std::vector<Index>& across, std::size_t sides) {
  std::vector<Index> order;
  order.reserve(across.size() / sides);
  std::vector<char> seen(across.size() / sides, 0);
  for (Index seed = 0; seed < seen.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    order.push_back(seed);
    for (std::size_t head = order.size() - 1; head < order.size(); ++head) {
      const std::size_t facet = order[head] * sides;
      for (std::size_t i = 0; i < sides; ++i) {
        if (across[facet + i] == none) continue;
        const Index other = across[facet + i] / static_cast<Index>(sides);
        if (seen[other]) continue;
        seen[other] = 1;
        order.push_back(other);
      }
    }
  }
  return order;
}

}  // namespace

template <class Real, int N>
SimplicialComplex<Real, N>::SimplicialComplex(std::size_t vertices,
                                              std::span<const Corners> simplices,
                                              std::span<const Lengths> lengths) {
  check_simplices(vertices, simplices);
  if (lengths.size() != simplices.size())
    throw InputError(std::to_string(simplices.size()) + " simplices with " +
                     std::to_string(lengths.size()) + " rows of lengths");
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (const double l : lengths[s])
      if (!std::isfinite(l) || l < 0)
        throw InputError(named(s) + ": an edge length is negative or not finite");
  std::vector<Lengths> agreed(lengths.begin(), lengths.end());
  agree_on_edges<N>(simplices, agreed);
  assemble(vertices, simplices, std::move(agreed));
}

template <class Real, int N>
SimplicialComplex<Real, N>::SimplicialComplex(std::span<const double> positions, std::size_t axes,
                                              std::span<const Corners> simplices) {
  if (axes < static_cast<std::size_t>(N) || positions.size() % axes != 0)
    throw InputError(std::to_string(positions.size()) + " coordinates are no points of dimension " +
                     std::to_string(axes) + ", which must be at least " + std::to_string(N));
  check_simplices(positions.size() / axes, simplices);
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!std::isfinite(positions[i]))
      throw InputError("vertex " + std::to_string(i / axes) + ": a coordinate is not finite");
  std::vector<Lengths> lengths(simplices.size());
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (std::size_t b = 1; b <= N; ++b)
      for (std::size_t a = 0; a < b; ++a) {
        const auto p = positions.subspan(simplices[s][a] * axes, axes);
        const auto q = positions.subspan(simplices[s][b] * axes, axes);
        double widest = 0, sum = 0;
        for (std::size_t d = 0; d < axes; ++d) widest = std::fmax(widest, std::abs(p[d] - q[d]));
        if (widest > 0)
          for (std::size_t d = 0; d < axes; ++d)
            sum += (p[d] - q[d]) / widest * ((p[d] - q[d]) / widest);
        double& length = lengths[s][Layout::edge(a, b)];
        length = widest * std::sqrt(sum);
        if (!std::isfinite(length))
          throw InputError(named(s) + ": an edge is too long for a number");
      }
  assemble(positions.size() / axes, simplices, std::move(lengths));
  if constexpr (N > 1)
    if (summary_.fan_facets == 0)
      if (const auto laid = laid_out<N>(positions, axes, simplices)) lay_flat(*laid, simplices);
  if (N > 1 && !summary_.flat) keep_coordinates(positions, axes);
}

template <class Real, int N>
void SimplicialComplex<Real, N>::keep_coordinates(std::span<const double> positions,
                                                  std::size_t axes) {
  axes_ = axes;
  coordinates_.resize(positions.size());
  for (std::size_t v = 0; v < vertex_count(); ++v)
    for (std::size_t d = 0; d < axes; ++d)
      coordinates_[axes * vertex_to_inside_[v] + d] = positions[axes * v + d] / unit();
}

template <class Real, int N>
void SimplicialComplex<Real, N>::lay_flat(std::span<const double> positions,
                                          std::span<const Corners> simplices) {
  if constexpr (N > 1) {
    std::vector<std::array<double, N>> points(vertex_count());
    for (std::size_t v = 0; v < points.size(); ++v)
      for (std::size_t d = 0; d < N; ++d)
        points[vertex_to_inside_[v]][d] = positions[N * v + d] / unit();
    const auto domain = FlatDomainBuilder<Real, N>(records_, std::move(points)).build();
    summary_.flat = domain != nullptr;
    if (!domain) return;
    summary_.bending_faces = static_cast<std::size_t>(std::count_if(
        domain->faces.begin(), domain->faces.end(), [](const auto& face) { return !face.gate; }));
    if constexpr (N == 4) {
      flat_ = domain;
    } else {
      std::vector<std::array<double, 3>> in_space(vertex_count(), {0, 0, 0});
      for (std::size_t v = 0; v < in_space.size(); ++v)
        std::copy_n(&positions[N * v], N, in_space[v].begin());
      flat_ = std::make_shared<FlatForm<N>>(std::span<const std::array<double, 3>>(in_space),
                                            simplices);
    }
  }
}

template <class Real, int N>
void SimplicialComplex<Real, N>::assemble(std::size_t vertices, std::span<const Corners> simplices,
                                          std::vector<Lengths> lengths) {
  constexpr std::size_t sides = N + 1;
  const std::size_t count = simplices.size();
  std::vector<Corners> sorted(simplices.begin(), simplices.end());
  for (Corners& corners : sorted) std::sort(corners.begin(), corners.end());
  const std::vector<Index> across = glue_facets<N>(vertices, sorted);
  const std::vector<Index> order = breadth_first(across, sides);

  vertex_to_inside_.assign(vertices, none);
  Index given = 0;
  for (const Index s : order)
    for (const Index v : simplices[s])
      if (vertex_to_inside_[v] == none) vertex_to_inside_[v] = given++;
  summary_.vertices = vertices;
  summary_.simplices = count;
  summary_.unreferenced_vertices = vertices - given;
  for (Index& v : vertex_to_inside_)
    if (v == none) v = given++;
  std::vector<Index> inside(count);
  for (std::size_t i = 0; i < count; ++i) inside[order[i]] = static_cast<Index>(i);

  double longest = 0, sum = 0;
  for (const Lengths& row : lengths)
    for (const double l : row) longest = std::fmax(longest, l);
  if (longest > 0)
    for (const Index s : order)
      for (const double l : lengths[s]) sum += l / longest;
  const double edges = static_cast<double>(count * Layout::edges);
  const double unit = longest > 0 ? longest * (sum / edges) : 1;
  summary_.mean_edge = unit;

  // Where corners go when they are sorted by the numbers inside.
  const auto rank = [&](const Corners& corners, std::size_t k) {
    std::size_t r = 0;
    for (const Index v : corners) r += vertex_to_inside_[v] < vertex_to_inside_[corners[k]];
    return r;
  };
  records_.resize(count);
  if (N < 4) places_.assign(count, 0);
  for (std::size_t r = 0; r < count; ++r) {
    const Index s = order[r];
    Record& record = records_[r];
    record.number = s;
    NumberRange<Real>::check_simplex(
        "simplex", s, *std::max_element(lengths[s].begin(), lengths[s].end()) / unit);
    for (std::size_t k = 0; k < sides; ++k) {
      const std::size_t place = rank(simplices[s], k);
      record.corner[place] = vertex_to_inside_[simplices[s][k]];
      if (N < 4) places_[r] = static_cast<unsigned char>(places_[r] | place << (2 * k));
      for (std::size_t j = 0; j < k; ++j) {
        const Real length = static_cast<Real>(lengths[s][Layout::edge(j, k)] / unit);
        record.length2[Layout::edge(rank(simplices[s], j), place)] = length * length;
      }
      const std::size_t facet = s * sides + k;  // opposite corner k of `sorted`
      const Index other = across[facet];
      Index& to = record.across[rank(sorted[s], k)];
      to = none;
      if (other == none) {
        ++summary_.boundary_facets;
        ++summary_.facets;
        continue;
      }
      to = static_cast<Index>(inside[other / sides] << FacetAcross::simplex_shift |
                              rank(sorted[other / sides], other % sides));
      if (across[other] == facet) {
        summary_.facets += facet < other;
        continue;
      }
      to |= FacetAcross::fan;
      const bool last = other < facet;  // the cycle ascends but for one step
      summary_.facets += last;
      summary_.fan_facets += last;
    }
    const FlatVerdict shape = simplex_shape<N>(lengths[s]);
    summary_.degenerate_simplices += shape == FlatVerdict::degenerate;
    summary_.violated_simplices += shape == FlatVerdict::violated;
  }
  find_stars(vertices);
}

template <class Real, int N>
void SimplicialComplex<Real, N>::find_stars(std::size_t vertices) {
  constexpr std::size_t sides = N + 1;
  const std::size_t count = records_.size();
  fill_rows(vertices, star_begin_, corners_, [&](const auto& add) {
    for (Index c = 0; c < count * sides; ++c) add(records_[c / sides].corner[c % sides], c);
  });

  // Corners at one vertex that facets join, and simplices that vertices join.
  DisjointSets fans(count * sides), parts(count);
  for (std::size_t s = 0; s < count; ++s)
    for (std::size_t i = 0; i < sides; ++i) {
      const Index to = records_[s].across[i];
      if (to == none) continue;
      const std::size_t t = to >> FacetAcross::simplex_shift, j = to & FacetAcross::facet_mask;
      for (std::size_t k = 0; k < N; ++k)
        fans.unite(static_cast<Index>(s * sides + Layout::corner(i, k)),
                   static_cast<Index>(t * sides + Layout::corner(j, k)));
    }
  for (Index v = 0; v < vertices; ++v) {
    const std::span<const Index> star = corners_at(v);
    bool pinched = false;
    for (const Index c : star) {
      pinched = pinched || fans.find(c) != fans.find(star[0]);
      parts.unite(c / sides, star[0] / sides);
    }
    if (pinched) pinched_.push_back(v);
  }
  summary_.pinched_vertices = pinched_.size();
  for (Index s = 0; s < count; ++s) summary_.components += parts.find(s) == s;
}

template <class Real, int N>
std::size_t SimplicialComplex<Real, N>::bytes() const {
  const auto flat_bytes = [&]() -> std::size_t {
    if constexpr (N > 1)
      if (flat_) return flat_->bytes();
    return 0;
  };
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(records_) + of(vertex_to_inside_) + of(star_begin_) + of(corners_) +
         of(places_) + of(pinched_) + of(coordinates_) + flat_bytes();
}

template <class Real, int N>
Index SimplicialComplex<Real, N>::inside_simplex(Index simplex) const {
  for (std::size_t s = 0; s < records_.size(); ++s)
    if (records_[s].number == simplex) return static_cast<Index>(s);
  return none;
}

template class SimplicialComplex<float, 1>;
template class SimplicialComplex<float, 2>;
template class SimplicialComplex<float, 3>;
template class SimplicialComplex<float, 4>;
template class SimplicialComplex<double, 1>;
template class SimplicialComplex<double, 2>;
template class SimplicialComplex<double, 3>;
template class SimplicialComplex<double, 4>;

}  // namespace plexway
