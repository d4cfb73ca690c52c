#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <variant>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/error.hpp>
#include <plexway/metric/tensor.hpp>

/// How a metric becomes the edge lengths that complexes are built from. Plain data in, plain data
/// out; nothing here knows a complex. docs/how-to/metrics.md says what is accurate and what is not.
namespace plexway::metric {

/// Which corners an edge joins, edge by edge: the order in which lengths stand.
template <std::size_t Edges>
using EdgeOrder = std::array<std::array<std::size_t, 2>, Edges>;

/// Of the triangles of a TriangleMesh: around.
inline constexpr EdgeOrder<3> triangle_edges = {{{0, 1}, {1, 2}, {2, 0}}};

/// Of all other simplices, those of a TetMesh and of a SimplicialComplex, whose triangles are no
/// exception: (0,1) (0,2) (1,2) (0,3) (1,3) (2,3) (0,4) ...
template <std::size_t Corners>
inline constexpr auto simplex_edges = [] {
  EdgeOrder<Corners*(Corners - 1) / 2> order{};
  std::size_t edge = 0;
  for (std::size_t b = 1; b < Corners; ++b)
    for (std::size_t a = 0; a < b; ++a) order[edge++] = {a, b};
  return order;
}();

/// How many corners a simplex with these edges has.
template <std::size_t Edges>
constexpr std::size_t corners_in(const EdgeOrder<Edges>& order) {
  std::size_t last = 0;
  for (const auto& [a, b] : order) last = a > last ? a : b > last ? b : last;
  return last + 1;
}

/// How long the edges of simplices are in space, in the order that is named, of arrays of any kind
/// (rows_of): to start from where lengths of your own are wanted.
///
///   auto lengths = edge_lengths_of<triangle_edges>(positions, triangles);
///   auto lengths = edge_lengths_of<simplex_edges<4>>(positions, tets);
///
/// Throws InputError for a vertex out of range. Cost: linear.
template <auto order, RowsOfNumbers Points, RowsOfNumbers Simplices>
[[nodiscard]] std::vector<std::array<double, order.size()>> edge_lengths_of(
    const Points& positions, const Simplices& simplices) {
  const auto at = rows_of<double, 3>(positions);
  const auto rows = rows_of<Index, corners_in(order)>(simplices);
  std::vector<std::array<double, order.size()>> lengths(rows.size());
  for (std::size_t s = 0; s < rows.size(); ++s) {
    for (const Index v : rows[s])
      if (v >= at.size())
        throw InputError("simplex " + std::to_string(s) + ": there is no vertex " +
                         std::to_string(v));
    for (std::size_t e = 0; e < order.size(); ++e) {
      const Point &a = at[rows[s][order[e][0]]], &b = at[rows[s][order[e][1]]];
      lengths[s][e] = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
  }
  return lengths;
}

/// The length of an edge that several simplices share and that each measures for itself.
enum class Sides {
  own,    ///< each keeps its own where they differ by more than Agreement::jump, else their mean:
          ///< for TriangleMesh with SurfaceHints::refracts, and nothing else
  mean,   ///< right to second order where the simplices are samples of a smooth metric
  least,  ///< of the fastest: never longer than a path along the edge
};

/// How simplices that share an edge agree on its length.
struct Agreement {
  /// The simplex whose length it has.
  Sides sides = Sides::mean;
  double jump = 0.15;  ///< as a share of the longer
};

/// One tensor a simplex, in its order.
struct SimplexTensors {
  /// One a simplex, in the caller's order.
  std::vector<Tensor> tensor;
  /// Where simplices share an edge.
  Agreement agreement = {};
};

/// One speed a simplex: a path of length L in it costs L / speed.
struct SimplexSpeeds {
  /// One a simplex, in the caller's order; > 0.
  std::vector<double> speed;
  /// Where simplices share an edge.
  Agreement agreement = {};
};

/// One tensor a vertex, linear along edges: the length is the integral, in closed form.
struct VertexTensors {
  /// One a vertex, in the caller's order.
  std::vector<Tensor> tensor;
};

/// A tensor at any point, integrated along each edge by three points (Gauss).
struct TensorFunction {
  /// The tensor at a point.
  std::function<Tensor(const Point&)> at;
};

/// The length from one end of an edge to the other, the lower vertex first. Called once an edge of
/// each simplex.
struct LengthFunction {
  /// The length between two points; >= 0 and finite.
  std::function<double(const Point&, const Point&)> between;
};

/// A length for every edge, in any order and direction. Given twice, the last one counts.
struct GivenLengths {
  /// An edge and how long it is.
  struct Edge {
    ///@{
    /// Its vertices.
    Index from, to;
    ///@}
    /// >= 0 and finite.
    double length;
  };
  /// At least every edge of the simplices.
  std::vector<Edge> edges;
};

/// Any of these.
using Metric = std::variant<SimplexTensors, SimplexSpeeds, VertexTensors, TensorFunction,
                            LengthFunction, GivenLengths>;

/// Lengths of the edges of each triangle (triangle_edges), as TriangleMesh takes them.
///
/// Throws InputError naming the simplex or edge: for a count that does not fit, a vertex out of
/// range, a speed that is not positive, a tensor that gives an edge no positive length, a length
/// that is negative, not finite or missing. `positions` are not looked at for GivenLengths, which
/// only need as many as there are vertices. Cost: linear, but for tensors and speeds a simplex and
/// GivenLengths, which sort the edges.
[[nodiscard]] std::vector<std::array<double, 3>> triangle_lengths(
    std::span<const Point> positions, std::span<const std::array<Index, 3>> triangles,
    const Metric& metric);
/// As triangle_lengths by speeds, of triangles that have lengths and no positions.
[[nodiscard]] std::vector<std::array<double, 3>> triangle_times(
    std::span<const std::array<double, 3>> lengths, std::span<const std::array<Index, 3>> triangles,
    const SimplexSpeeds& metric);

/// Lengths of the edges of each tetrahedron (simplex_edges), as TetMesh takes them. Throws as
/// above, and UsageError for Sides::own: a solid whose speeds jump is a mixed domain
/// (AnyShape::measure).
[[nodiscard]] std::vector<std::array<double, 6>> tet_lengths(
    std::span<const Point> positions, std::span<const std::array<Index, 4>> tets,
    const Metric& metric);

/// Lengths of edges, as Wireframe takes them. An edge is a simplex of its own here: two between the
/// same vertices may have two tensors or speeds. Throws as above.
[[nodiscard]] std::vector<double> edge_lengths(std::span<const Point> positions,
                                               std::span<const std::array<Index, 2>> edges,
                                               const Metric& metric);

/// Simplices whose lengths no flat simplex has.
struct Violations {
  /// So many simplices.
  std::size_t count = 0;
  Index first = none;  ///< the lowest of them
};

/// Triangles with an edge longer than the way around by the other two, beyond rounding.
/// Three lengths a triangle, as triangle_lengths has them. Cost: linear.
[[nodiscard]] Violations find_violations(std::span<const std::array<double, 3>> lengths);
/// Tetrahedra with such a face, or whose faces do not close in space.
/// Six lengths a tetrahedron, as tet_lengths has them. Cost: linear.
[[nodiscard]] Violations find_violations(std::span<const std::array<double, 6>> lengths);

}  // namespace plexway::metric
