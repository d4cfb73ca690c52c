#include <plexway/complex/triangle_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <plexway/error.hpp>

#include "complex/gluing.hpp"
#include "complex/number_range.hpp"
#include "complex/simplex_order.hpp"
#include "complex/triangle_shape.hpp"
#include "complex/vertex_fans.hpp"

namespace plexway {
namespace {

Index next(Index i) { return i == 2 ? 0 : i + 1; }

void check_faces(std::size_t vertices, Faces faces) {
  if (faces.empty()) throw InputError("the surface has no faces");
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  if (faces.size() > Across::limit - 2)
    throw InputError(std::to_string(faces.size()) + " faces: at most " +
                     std::to_string(Across::limit - 2) + " fit the index");
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const Index v : faces[f])
      if (v >= vertices)
        throw InputError("face " + std::to_string(f) + ": vertex " + std::to_string(v) +
                         " is out of range, there are " + std::to_string(vertices));
}

// In a surface given by vertices alone a repeated corner leaves nothing to glue by.
void check_corners(Faces faces) {
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (Index i = 0; i < 3; ++i)
      if (faces[f][i] == faces[f][next(i)])
        throw InputError("face " + std::to_string(f) + ": vertex " + std::to_string(faces[f][i]) +
                         " occurs twice");
}

// Rounds an angle's cosine and sine so that turning by it keeps lengths: cos^2 + sin^2 = 1. Errors
// there would add up hinge by hinge, on regular grids all with one sign.
template <class Real>
void round_angle(double cosine, double sine, Real& c, Real& s) {
  const Real c0 = static_cast<Real>(cosine), s0 = static_cast<Real>(sine);
  c = c0;
  s = s0;
  double best = std::numeric_limits<double>::infinity();
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const auto shifted = [](Real value, int by) {  // by one unit in the last place
        return value + static_cast<Real>(by) * std::abs(value) *
                           std::numeric_limits<Real>::epsilon() * Real(0.75);
      };
      const Real ci = shifted(c0, i), sj = shifted(s0, j);
      const double cd = static_cast<double>(ci), sd = static_cast<double>(sj);
      const double error = std::abs((cd - 1) * (cd + 1) + sd * sd) + (i || j ? 1e-17 : 0);
      if (error < best) best = error, c = ci, s = sj;
    }
}

double aspect(const TriangleShape& shape) {
  const auto [least, most] = std::minmax_element(shape.length.begin(), shape.length.end());
  return *most / *least;
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

// The excess of a vertex and its neighbours together; those on the boundary do not count.
template <class Real>
std::vector<double> excess_around(std::span<const TriangleRecord<Real>> triangles,
                                  std::span<const double> excess, std::span<const char> boundary) {
  std::vector<double> around(excess.begin(), excess.end());
  for (const TriangleRecord<Real>& t : triangles.first(triangles.size() - 1))
    for (std::size_t i = 0; i < 3; ++i) {
      // An edge inside counts from both its triangles. Of one on the boundary both ends are there.
      const Index v = t.corner[i], w = t.corner[edge_after(i)];
      if (!boundary[w]) around[v] += excess[w] / 2;
      if (!boundary[v]) around[w] += excess[v] / 2;
    }
  return around;
}

// `around` is what `excess_around` says. Takes off what chance gives (SaddleThresholds), but not
// where the neighbourhood is a saddle: without that, distances on tubes that wind came out up to 24
// % too short.
template <class Real>
void leave_noise(std::span<const TriangleRecord<Real>> triangles, std::span<const char> boundary,
                 const SaddleThresholds& saddles, std::span<const double> around,
                 std::vector<double>& excess) {
  std::vector<double> lack(excess.size(), 0);
  std::vector<int> neighbours(excess.size(), 0);
  for (const TriangleRecord<Real>& t : triangles.first(triangles.size() - 1))
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = t.corner[i], w = t.corner[edge_after(i)];
      for (const auto& [of, by] : {std::pair{v, w}, std::pair{w, v}}) {
        if (boundary[by]) continue;
        lack[of] += std::max(0.0, -excess[by]);
        ++neighbours[of];
      }
    }
  for (std::size_t v = 0; v < excess.size(); ++v)
    if (!boundary[v] && excess[v] > 0 && neighbours[v] > 0 && around[v] <= saddles.neighbourhood)
      excess[v] -= std::min(saddles.most_noise, saddles.noise_share * lack[v] / neighbours[v]);
}

// Both sides of an edge must agree to the last bit: the mean of what they say.
void agree_on_edges(Lengths& lengths, GluingView across) {
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

void refuse_refraction(const SurfaceSummary& summary, const char* what) {
  if (summary.refracting_edges > 0)
    throw UsageError(std::string(what) + ": not on a surface with " +
                     std::to_string(summary.refracting_edges) +
                     " refracting edges; build it with one length an edge");
}

SaddleThresholds SaddleThresholds::standard() {
  return {.interior = 1e-5,
          .boundary = 1e-6,
          .noise_share = 1,
          .most_noise = 0.02,
          .neighbourhood = 0.01};
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(std::span<const std::array<double, 3>> positions,
                                 std::span<const std::array<Index, 3>> faces,
                                 const SurfaceHints& hints) {
  check_faces(positions.size(), faces);
  check_corners(faces);
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (const double x : positions[v])
      if (!std::isfinite(x))
        throw InputError("vertex " + std::to_string(v) + ": a coordinate is not finite");
  std::vector<TriangleShape> shapes(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    shapes[f] = shape_from_positions(
        {&positions[faces[f][0]], &positions[faces[f][1]], &positions[faces[f][2]]});
  assemble(positions.size(), faces, shapes,
           hints.order.empty() ? along_curve(positions, faces) : copy_of(hints.order),
           glue_by_vertices(positions.size(), faces), hints);
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(std::size_t vertices, std::span<const std::array<Index, 3>> faces,
                                 std::span<const std::array<double, 3>> lengths,
                                 const SurfaceHints& hints) {
  check_faces(vertices, faces);
  check_corners(faces);
  *this = TriangleMesh(vertices, faces, lengths, glue_by_vertices(vertices, faces), hints);
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(std::size_t vertices, std::span<const std::array<Index, 3>> faces,
                                 std::span<const std::array<double, 3>> lengths,
                                 std::span<const std::array<Index, 3>> across,
                                 const SurfaceHints& hints) {
  check_faces(vertices, faces);
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
  if (!hints.refracts) agree_on_edges(agreed, across);
  std::vector<TriangleShape> shapes(faces.size());
  std::vector<char> violated(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f) violated[f] = longest_excess(agreed[f]) > 0;
  if (hints.refracts)
    shorten_each(agreed);
  else
    shorten_to_triangles(agreed, across);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    shapes[f] = shape_from_lengths(agreed[f]);
    shapes[f].violated = violated[f] != 0;
  }
  std::vector<std::array<Index, 3>> gluing(across.begin(), across.end());
  assemble(vertices, faces, shapes,
           hints.order.empty() ? breadth_first(across) : copy_of(hints.order), std::move(gluing),
           hints);
}

template <class Real>
TriangleMesh<Real>::TriangleMesh(std::size_t vertices, std::span<const std::array<Index, 3>> faces,
                                 std::span<const TriangleShape> shapes,
                                 std::vector<std::array<Index, 3>> across,
                                 const SurfaceHints& hints) {
  check_faces(vertices, faces);
  std::vector<Index> order =
      hints.order.empty() ? breadth_first(GluingView(across)) : copy_of(hints.order);
  assemble(vertices, faces, shapes, std::move(order), std::move(across), hints);
}

template <class Real>
void TriangleMesh<Real>::assemble(std::size_t vertices, std::span<const std::array<Index, 3>> faces,
                                  std::span<const TriangleShape> shapes,
                                  std::vector<Index> face_order,
                                  std::vector<std::array<Index, 3>> across,
                                  const SurfaceHints& hints) {
  const SaddleThresholds& saddles = hints.saddles;
  const std::size_t m = faces.size();
  const Orientation orientation = orient(faces, across);
  summary_.vertices = vertices;
  summary_.faces = m;
  summary_.orientable = orientation.orientable;

  double sum = 0, longest = 0;
  for (const Index f : face_order)
    for (const double l : shapes[f].length) {
      if (!std::isfinite(l))
        throw InputError("face " + std::to_string(f) + ": too long for a number");
      longest = std::max(longest, l);
    }
  for (const Index f : face_order)
    for (const double l : shapes[f].length) sum += longest > 0 ? l / longest : 0;
  const double unit = longest > 0 ? longest * (sum / (3 * static_cast<double>(m))) : 1;
  summary_.mean_edge = unit;

  face_to_inside_.resize(m);
  for (std::size_t i = 0; i < m; ++i) face_to_inside_[face_order[i]] = static_cast<Index>(i);
  vertex_to_inside_.assign(vertices, none);
  Index named = 0;
  for (const Index f : face_order)
    for (const Index v : faces[f])
      if (vertex_to_inside_[v] == none) vertex_to_inside_[v] = named++;
  summary_.unreferenced_vertices = vertices - named;
  for (Index& v : vertex_to_inside_)
    if (v == none) v = named++;

  // Corner and edge numbers of a turned face: corners 0 2 1, edges 2 1 0.
  const auto turned = [&](Index f) { return !orientation.turned.empty() && orientation.turned[f]; };
  const auto edge_inside = [&](Index f, Index i) { return turned(f) ? 2 - i : i; };
  const auto corner_outside = [&](Index f, Index i) { return turned(f) && i != 0 ? 3 - i : i; };

  triangles_.resize(m + 1);
  for (std::size_t inside = 0; inside < m; ++inside) {
    const Index f = face_order[inside];
    TriangleRecord<Real>& t = triangles_[inside];
    const TriangleShape& shape = shapes[f];
    t.face = f | (turned(f) ? reversed : 0);
    const auto& l = shape.length;
    NumberRange<Real>::check_simplex("face", f, std::max({l[0], l[1], l[2]}) / unit);
    summary_.degenerate_faces += shape.degenerate;
    summary_.violated_faces += shape.violated;
    for (Index i = 0; i < 3; ++i) {
      const Index e = edge_inside(f, i);
      t.length[e] = static_cast<Real>(shape.length[i] / unit);
      const Index h = across[f][i];
      if (h == none) {
        t.across[e] = static_cast<Index>(m) << Across::face_shift;
        ++summary_.boundary_edges;
        ++summary_.edges;
        continue;
      }
      const Index g = h / 3, j = h % 3;
      const bool fan = across[g][j] != 3 * f + i;
      // Opposite unless the vertices say otherwise, each seen through its own turn.
      const bool loop = faces[f][i] == faces[f][next(i)];
      const bool same_way = !loop && faces[f][i] == faces[g][j];
      const bool flip = same_way != (turned(f) != turned(g));
      const bool refracts =
          hints.refracts && std::abs(shape.length[i] - shapes[g].length[j]) >
                                1e-9 * std::max(shape.length[i], shapes[g].length[j]);
      if (refracts)
        NumberRange<Real>::check_refraction(f, g, shape.length[i], shapes[g].length[j],
                                            std::max(aspect(shape), aspect(shapes[g])));
      summary_.refracting_edges += refracts && (fan || 3 * f + i < h);
      t.across[e] = face_to_inside_[g] << Across::face_shift | edge_inside(g, j) |
                    (flip ? Across::flip : 0) | (fan || refracts ? Across::fan : 0);
      if (!fan) {
        summary_.edges += 3 * f + i < h;
      } else {
        bool lowest = true;
        for (Index k = h; k != 3 * f + i; k = across[k / 3][k % 3]) lowest &= 3 * f + i < k;
        summary_.edges += lowest;
        summary_.non_manifold_edges += lowest;
      }
    }
    for (Index i = 0; i < 3; ++i) {
      const Index c = corner_outside(f, i);
      t.corner[i] = vertex_to_inside_[faces[f][c]];
      round_angle(shape.cosine[c], shape.sine[c], t.cosine[i], t.signed_sine[i]);
    }
  }
  TriangleRecord<Real>& sentinel = triangles_[m];
  for (Index i = 0; i < 3; ++i) {
    sentinel.across[i] = static_cast<Index>(m) << Across::face_shift;
    sentinel.length[i] = 1;
    sentinel.cosine[i] = 0;
    sentinel.signed_sine[i] = 1;
    sentinel.corner[i] = 0;
  }
  sentinel.face = none;

  VertexFans fans = find_vertex_fans<Real>(triangles_, vertices);
  corner_of_vertex_ = std::move(fans.corner);
  irregular_ = std::move(fans.irregular);
  irregular_begin_ = std::move(fans.irregular_begin);
  irregular_corners_ = std::move(fans.irregular_corners);
  pinched_ = std::move(fans.pinched);
  summary_.pinched_vertices = pinched_.size();
  summary_.components = fans.components;

  // Saddles: vertices with so much angle around them that shortest paths bend there.
  std::vector<double> angle(vertices, 0);
  for (std::size_t inside = 0; inside < m; ++inside) {
    const Index f = face_order[inside];
    for (Index i = 0; i < 3; ++i) {
      const Index c = corner_outside(f, i);
      angle[triangles_[inside].corner[i]] += std::atan2(shapes[f].sine[c], shapes[f].cosine[c]);
    }
  }
  for (std::size_t v = 0; v < vertices; ++v)  // from here on what is more than flat
    angle[v] -= fans.on_boundary[v] ? std::numbers::pi + saddles.boundary
                                    : 2 * std::numbers::pi + saddles.interior;
  std::vector<double> around = excess_around<Real>(triangles_, angle, fans.on_boundary);
  if (!hints.samples) leave_noise<Real>(triangles_, fans.on_boundary, saddles, around, angle);
  for (std::size_t r = 0; r < irregular_.size(); ++r) {
    const auto corners =
        std::span<const Index>(irregular_corners_)
            .subspan(irregular_begin_[r], irregular_begin_[r + 1] - irregular_begin_[r]);
    const double bends = is_open_book<Real>(triangles_, corners) ? -1 : 1;
    angle[irregular_[r]] = around[irregular_[r]] = bends;
  }
  for (std::size_t inside = 0; inside < m; ++inside)
    for (Index i = 0; i < 3; ++i) {
      const Index v = triangles_[inside].corner[i];
      const bool saddle = angle[v] > 0 && (!hints.samples || fans.on_boundary[v] || around[v] > 0);
      if (saddle)
        triangles_[inside].signed_sine[i] =
            std::copysign(triangles_[inside].signed_sine[i], Real(-1));
    }
}

template <class Real>
std::size_t TriangleMesh<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(triangles_) + of(vertex_to_inside_) + of(face_to_inside_) +
         of(corner_of_vertex_) + of(irregular_) + of(irregular_begin_) + of(irregular_corners_) +
         of(pinched_);
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
