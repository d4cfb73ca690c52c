#include <plexway/surface/triangle_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <string>
#include <type_traits>

#include <plexway/error.hpp>

#include "complexes/common/arrays.hpp"
#include "complexes/common/building_blocks.hpp"
#include "complexes/common/number_range.hpp"
#include "complexes/common/simplex_gluing.hpp"
#include "complexes/common/simplex_order.hpp"
#include "complexes/surface/face_layout.hpp"
#include "complexes/surface/gluing.hpp"
#include "complexes/surface/shape_blocks.hpp"

namespace plexway {
using namespace detail;

namespace detail {

namespace {

Index next_side(Index i) { return i == 2 ? 0 : i + 1; }

void check_faces(std::size_t vertices, Faces faces, int threads) {
  if (faces.empty()) throw InputError("the surface has no faces");
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  if (faces.size() > Across::limit - 2)
    throw InputError(std::to_string(faces.size()) + " faces: at most " +
                     std::to_string(Across::limit - 2) + " fit the index");
  over_blocks(faces.size(), threads, [&](std::size_t first, std::size_t last) {
    Index largest = 0;
    for (const auto& [a, b, c] : faces.subspan(first, last - first))
      largest = std::max({largest, a, b, c});
    if (largest < vertices) return;
    for (std::size_t f = first; f < last; ++f)
      for (const Index v : faces[f])
        if (v >= vertices)
          throw InputError("face " + std::to_string(f) + ": vertex " + std::to_string(v) +
                           " is out of range, there are " + std::to_string(vertices));
  });
}

// In a surface given by vertices alone a repeated corner leaves nothing to glue by.
void check_corners(Faces faces, int threads) {
  over_blocks(faces.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const auto& [a, b, c] = faces[f];
      if (a != b && b != c && c != a) continue;
      for (Index i = 0; i < 3; ++i)
        if (faces[f][i] == faces[f][next_side(i)])
          throw InputError("face " + std::to_string(f) + ": vertex " + std::to_string(faces[f][i]) +
                           " occurs twice");
    }
  });
}

void check_positions(std::span<const std::array<double, 3>> positions, int threads) {
  over_blocks(positions.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      const auto& [x, y, z] = positions[v];
      if (!(std::isfinite(x) && std::isfinite(y) && std::isfinite(z)))
        throw InputError("vertex " + std::to_string(v) + ": a coordinate is not finite");
    }
  });
}

std::vector<Index> copy_of(std::span<const Index> order) { return {order.begin(), order.end()}; }

using Lengths = std::vector<std::array<double, 3>>;
using GluingView = std::span<const std::array<Index, 3>>;

// Calls visit(halfedge) for each halfedge of the edge of h, h included.
template <class Visit>
void around_edge(GluingView across, Index h, Visit visit) {
  visit(h);
  for (Index o = across[h / 3][h % 3]; o != none && o != h; o = across[o / 3][o % 3]) visit(o);
}

// An edge has one length, up to what rounds numbers of six digits.
void check_sides(Faces faces, std::span<const std::array<double, 3>> lengths, GluingView across) {
  for (Index h = 0; h < faces.size() * 3; ++h) {
    const Index o = across[h / 3][h % 3];
    if (o == none) continue;
    const double one = lengths[h / 3][h % 3], other = lengths[o / 3][o % 3];
    if (differ_much(one, other, std::max(longest_of(lengths[h / 3]), longest_of(lengths[o / 3]))))
      refuse_two_lengths(faces[h / 3][h % 3], faces[h / 3][next_side(h % 3)], one, other);
  }
}

// Both sides of an edge must agree to the last bit: the mean of what they say.
void agree_on_sides(Lengths& lengths, GluingView across) {
  for (Index h = 0; h < lengths.size() * 3; ++h) {
    double sum = 0;
    int count = 0;
    bool equal = true, first = true;
    around_edge(across, h, [&](Index o) {
      sum += lengths[o / 3][o % 3];
      ++count;
      equal = equal && lengths[o / 3][o % 3] == lengths[h / 3][h % 3];
      first = first && o >= h;
    });
    if (!equal && first)
      around_edge(across, h, [&](Index o) { lengths[o / 3][o % 3] = sum / count; });
  }
}

// By how much an edge is longer than the way around by the others, beyond rounding; or 0.
double longest_excess(const std::array<double, 3>& l) {
  const double longest = std::max({l[0], l[1], l[2]});
  const double excess = longest - (l[0] + l[1] + l[2] - longest);
  return excess > 1e-14 * longest ? excess : 0;
}

// An edge longer than the way around takes that length, as in the metric that the lengths span;
// which may break the next triangle, so it goes on until none is left. Unfolding triangles that do
// not close could make a path shorter each time it goes around, without end.
void shorten_to_triangles(Lengths& lengths, GluingView across) {
  std::vector<Index> queue;
  for (Index f = 0; f < lengths.size(); ++f)
    if (longest_excess(lengths[f]) > 0) queue.push_back(f);
  while (!queue.empty()) {
    const std::array<double, 3>& l = lengths[queue.back()];
    const Index f = queue.back();
    queue.pop_back();
    if (longest_excess(l) == 0) continue;
    const Index e = static_cast<Index>(std::max_element(l.begin(), l.end()) - l.begin());
    const double shorter = l[(e + 1) % 3] + l[(e + 2) % 3];
    around_edge(across, 3 * f + e, [&](Index h) {
      lengths[h / 3][h % 3] = shorter;
      if (longest_excess(lengths[h / 3]) > 0) queue.push_back(h / 3);
    });
  }
}

// The same where triangles do not share lengths.
void shorten_each(Lengths& lengths) {
  for (auto& l : lengths)
    if (const double excess = longest_excess(l); excess > 0)
      *std::max_element(l.begin(), l.end()) -= excess;
}

}  // namespace

FaceLayout lay_out(std::span<const std::array<double, 3>> positions, Faces faces,
                   std::span<const Index> order, int threads) {
  check_faces(positions.size(), faces, threads);
  check_corners(faces, threads);
  check_positions(positions, threads);
  return {positions.size(), faces,
          order.empty() ? along_curve(positions, faces, threads) : copy_of(order), threads};
}

}  // namespace detail

SaddleThresholds SaddleThresholds::standard() {
  return {
      .interior = 1e-5, .boundary = 1e-6, .noise_share = 1, .most_noise = 0.02, .agreement = 0.7};
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(const GivenPoints& positions, const GivenSimplices<3>& faces,
                                 const SurfaceHints& hints) {
  assemble(lay_out(positions, faces, hints.order, hints.threads), ShapesInSpace(positions, faces),
           hints);
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(std::size_t vertices, const GivenSimplices<3>& faces,
                                 const Given<std::array<double, 3>>& lengths,
                                 const SurfaceHints& hints) {
  check_faces(vertices, faces, hints.threads);
  check_corners(faces, hints.threads);
  const Gluing across = glue_by_vertices(vertices, faces);
  if (!hints.refracts && lengths.size() == faces.size()) check_sides(faces, lengths, across);
  *this = TriangleMesh(vertices, faces, lengths, across, hints);
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(std::size_t vertices, std::span<const std::array<Index, 3>> faces,
                                 std::span<const std::array<double, 3>> lengths,
                                 std::span<const std::array<Index, 3>> across,
                                 const SurfaceHints& hints) {
  check_faces(vertices, faces, hints.threads);
  if (lengths.size() != faces.size() || across.size() != faces.size())
    throw InputError(std::to_string(faces.size()) + " faces with " +
                     std::to_string(lengths.size()) + " rows of lengths and " +
                     std::to_string(across.size()) + " of gluings");
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const double l : lengths[f])
      if (!std::isfinite(l) || l < 0)
        throw InputError("face " + std::to_string(f) +
                         ": an edge length is negative or not finite");
  check_gluing(faces, across);
  std::vector<std::array<double, 3>> agreed(lengths.begin(), lengths.end());
  if (!hints.refracts) agree_on_sides(agreed, across);
  std::vector<char> violated(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) violated[f] = longest_excess(agreed[f]) > 0;
  if (hints.refracts)
    shorten_each(agreed);
  else
    shorten_to_triangles(agreed, across);
  assemble({vertices, faces, hints.order.empty() ? breadth_first(across) : copy_of(hints.order),
            across, hints.threads},
           ShapesOfLengths(agreed, violated), hints);
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(FaceLayout&& layout, const TriangleShapes& shapes,
                                 const SurfaceHints& hints) {
  assemble(std::move(layout), shapes, hints);
}

template <class Real>
void TriangleMesh<Real>::assemble(FaceLayout layout, const TriangleShapes& shapes,
                                  const SurfaceHints& hints) {
  const std::size_t m = layout.face_count();
  summary_.vertices = layout.vertex_count();
  summary_.faces = m;
  summary_.orientable = layout.orientable;
  summary_.unreferenced_vertices = layout.vertex_count() - layout.named;
  summary_.edges = layout.edges;
  summary_.boundary_edges = layout.boundary_edges;
  summary_.non_manifold_edges = layout.non_manifold_edges;
  if (hints.refracts)
    summary_.refracting_edges =
        layout.mark_refraction(shapes, &NumberRange<Real>::check_refraction, hints.threads);

  VertexFans fans = find_vertex_fans(layout, hints.threads);

  // What the layout says goes into the records, so that it need not be held while they are filled.
  auto& triangles = triangles_.own();
  triangles.resize(m + 1);
  over_blocks(m, hints.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      const auto &o = layout.across[f], &v = layout.corner[f];
      triangles[f] = {{o[0], o[1], o[2]},
                      {},
                      {},
                      {},
                      {v[0], v[1], v[2]},
                      layout.face[f] | (layout.is_turned(f) ? reversed : 0)};
    }
  });
  const Index sentinel = static_cast<Index>(m) << Across::face_shift;
  triangles[m] = {{sentinel, sentinel, sentinel}, {1, 1, 1}, {0, 0, 0}, {1, 1, 1}, {0, 0, 0}, none};
  vertex_to_inside_ = std::move(layout.vertex_to_inside);
  face_to_inside_ = std::move(layout.face_to_inside);
  const std::vector<Index> first_use = std::move(layout.first_use);
  layout = {};

  std::vector<double> angle = take_shapes(shapes, first_use, hints.threads);
  over_blocks(angle.size(), hints.threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)  // from here on what is more than flat
      angle[v] -= (fans.on_boundary[v] ? 1 : 2) * std::numbers::pi;
  });
  mark_saddles<Real>(triangles, fans, first_use, std::move(angle), hints);

  corner_of_vertex_ = std::move(fans.corner);
  irregular_ = std::move(fans.irregular);
  irregular_begin_ = std::move(fans.irregular_begin);
  irregular_corners_ = std::move(fans.irregular_corners);
  pinched_ = std::move(fans.pinched);
  summary_.pinched_vertices = pinched_.size();
  summary_.components = fans.components;
  const auto own = shapes.positions();
  place(own.empty() ? hints.positions : own, hints.threads);
  in_space_ = !own.empty();
  take_chords(hints.chords);
}

// Fills in lengths, cosines and sines. Returns the angle around each vertex.
template <class Real>
std::vector<double> TriangleMesh<Real>::take_shapes(const TriangleShapes& shapes,
                                                    std::span<const Index> first_use, int threads) {
  const std::size_t m = face_count();
  auto& triangles = triangles_.own();
  constexpr std::size_t size = ShapeBlock::size;
  static_assert(building_block % size == 0);
  // Of faces inside, edges as the caller numbers them. Records in double hold them meanwhile.
  constexpr bool in_records = std::is_same_v<Real, double>;
  Unfilled<std::array<double, 3>> apart(in_records ? 0 : m);
  const auto lengths = [&](std::size_t f) -> std::span<double, 3> {
    if constexpr (in_records)
      return triangles[f].length;
    else
      return apart[f];
  };
  std::vector<double> around(vertex_count(), 0);
  double longest = 0;
  std::mutex mutex;
  const auto take = [&](std::size_t begin, std::size_t end, const auto& tell) {
    std::array<Index, size> faces;
    ShapeBlock block{};
    RoundedAngles<Real> rounded;
    std::array<ShapeBlock::Row, 3> angle;
    double most = 0;
    std::size_t degenerate = 0, violated = 0;
    for (std::size_t first = begin; first < end; first += size) {
      const std::size_t count = std::min(size, end - first);
      for (std::size_t k = 0; k < count; ++k) faces[k] = triangles[first + k].face & ~reversed;
      shapes.look_up(std::span(faces).first(count), block);
      round_angles(block, rounded);
      angles_of(block, angle);
      for (std::size_t k = 0; k < count; ++k) {
        TriangleRecord<Real>& t = triangles[first + k];
        degenerate += block.degenerate[k];
        violated += block.violated[k];
        const bool turned = (t.face & reversed) != 0;
        for (std::size_t i = 0; i < 3; ++i) {
          const std::size_t corner = turned && i != 0 ? 3 - i : i;
          const double length = lengths(first + k)[i] = block.length[i][k];
          most = length > most ? length : most;
          t.cosine[i] = rounded.cosine[corner][k];
          t.signed_sine[i] = rounded.sine[corner][k];
          tell(t.corner[i], angle[corner][k]);
        }
        check_length(faces[k], lengths(first + k));
      }
    }
    const std::lock_guard lock(mutex);
    longest = std::max(longest, most);
    summary_.degenerate_faces += degenerate;
    summary_.violated_faces += violated;
  };
  tell_vertices<double>(first_use, m, threads, take, [&](Index v, double a) { around[v] += a; });

  const double unit = shapes.unit() > 0 ? shapes.unit() : mean_edge(m, longest, [&](std::size_t f) {
    const auto l = lengths(f);
    return std::array{l[0], l[1], l[2]};
  });
  summary_.mean_edge = unit;
  over_blocks(m, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t f = first; f < last; ++f) {
      TriangleRecord<Real>& t = triangles[f];
      const auto l = lengths(f);
      NumberRange<Real>::check_simplex("face", t.face & ~reversed,
                                       std::max({l[0], l[1], l[2]}) / unit);
      for (std::size_t i = 0; i < 3; ++i) t.length[i] = static_cast<Real>(l[i] / unit);
      if ((t.face & reversed) != 0) std::swap(t.length[0], t.length[2]);
    }
  });
  return around;
}

// In double: next to a source, single precision would say nothing on a large surface.
template <class Real>
void TriangleMesh<Real>::place(std::span<const std::array<double, 3>> positions, int threads) {
  if (positions.empty()) return;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::array<double, 3>>& at = positions_.own();
  at.assign(vertex_count(), {unknown, unknown, unknown});
  over_blocks(positions.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v)
      for (std::size_t i = 0; i < 3; ++i)
        at[vertex_to_inside_[v]][i] = (positions[v][i] - positions[0][i]) / unit();
  });
}

template <class Real>
void TriangleMesh<Real>::take_chords(std::span<const SurfaceChord> chords) {
  if (chords.empty()) return;
  fill_rows(vertex_count(), chord_begin_.own(), chords_.own(), [&](const auto& add) {
    for (const SurfaceChord& chord : chords) {
      const Index v = vertex_to_inside_[chord.from], w = vertex_to_inside_[chord.to];
      const Real length = static_cast<Real>(chord.length / unit());
      add(v, {w, length});
      add(w, {v, length});
    }
  });
}

template <class Real>
std::size_t TriangleMesh<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(triangles_) + of(vertex_to_inside_) + of(face_to_inside_) +
         of(corner_of_vertex_) + of(irregular_) + of(irregular_begin_) + of(irregular_corners_) +
         of(pinched_) + of(positions_) + of(chord_begin_) + of(chords_);
}

template <class Real>
void TriangleMesh<Real>::corners_at(Index vertex, std::vector<Index>& corners) const {
  corners.clear();
  const Index first = corner_of_vertex_[vertex];
  if (first == none) return;
  const auto found = std::lower_bound(irregular_.begin(), irregular_.end(), vertex);
  if (found != irregular_.end() && *found == vertex) {
    const std::size_t row = static_cast<std::size_t>(found - irregular_.begin());
    corners.assign(irregular_corners_.begin() + irregular_begin_[row],
                   irregular_corners_.begin() + irregular_begin_[row + 1]);
    return;
  }
  walk_fan<Real>(triangles_, first, [&](Index corner) { corners.push_back(corner); });
}

template class TriangleMesh<float>;
template class TriangleMesh<double>;

}  // namespace plexway
