#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "complexes/common/arrays.hpp"
#include "complexes/common/disjoint_sets.hpp"
#include "complexes/common/number_range.hpp"
#include "complexes/common/simplex_order.hpp"

namespace plexway {
using namespace detail;
namespace {

using Edges = std::span<const std::array<Index, 2>>;

// Vertices along a space-filling (Morton) curve. Positions are finite.
std::vector<Index> vertices_along_curve(std::span<const std::array<double, 3>> positions) {
  std::vector<std::array<Index, 1>> points(positions.size());
  for (Index v = 0; v < positions.size(); ++v) points[v] = {v};
  return along_curve<1>(positions, points);
}

// Vertices in blocks of so many that lie together: breadth first, but each block begins where the
// oldest neighbour that is left is, or in the next component at its lowest number.
std::vector<Index> vertices_in_blocks(std::size_t vertices, Edges edges, std::size_t block) {
  std::vector<Index> begin, neighbour;
  fill_rows(vertices, begin, neighbour, [&](const auto& add) {
    for (const auto& [a, b] : edges) {
      add(a, b);
      add(b, a);
    }
  });
  std::vector<char> seen(vertices, 0);
  std::vector<Index> order;
  order.reserve(vertices);
  const auto visit = [&](Index v) {
    if (seen[v] == 0) order.push_back(v);
    seen[v] = 1;
  };
  // The one visited first that may have neighbours left: the next ones begin there, so that no gaps
  // stay behind.
  std::size_t oldest = 0;
  Index lowest = 0;
  const auto next = [&] {
    for (; oldest < order.size(); ++oldest)
      for (Index k = begin[order[oldest]]; k < begin[order[oldest] + 1]; ++k)
        if (seen[neighbour[k]] == 0) return neighbour[k];
    while (seen[lowest] != 0) ++lowest;
    return lowest;
  };
  while (order.size() < vertices) {
    const std::size_t end = std::min(vertices, order.size() + block);
    while (order.size() < end) {
      std::size_t i = order.size();
      visit(next());
      for (; i < order.size() && order.size() < end; ++i)
        for (Index k = begin[order[i]]; k < begin[order[i] + 1] && order.size() < end; ++k)
          visit(neighbour[k]);
    }
  }
  return order;
}

void check_edges(std::size_t vertices, Edges edges) {
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  if (edges.size() > none / 2)
    throw InputError(std::to_string(edges.size()) + " edges: at most " + std::to_string(none / 2) +
                     " fit the index");
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const Index v : edges[e])
      if (v >= vertices)
        throw InputError("edge " + std::to_string(e) + ": vertex " + std::to_string(v) +
                         " is out of range, there are " + std::to_string(vertices));
}

std::vector<Index> inverse(std::span<const Index> order) {
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<Index>(i);
  return place;
}

double mean_of(std::span<const double> lengths) {
  const double longest = lengths.empty() ? 0 : *std::max_element(lengths.begin(), lengths.end());
  if (!(longest > 0)) return 0;
  double sum = 0;  // in proportion, so that it cannot overflow
  for (const double l : lengths) sum += l / longest;
  return longest * (sum / static_cast<double>(lengths.size()));
}

// See Wireframe::typical_edge; `mean` > 0.
double typical_of(std::span<const double> lengths, double mean) {
  std::vector<double> positive(lengths.begin(), lengths.end());
  std::erase(positive, 0.0);
  const double part = std::min(median(positive) / mean, 1.0);
  return mean * part * (1 + part) / 2;
}

}  // namespace

template <class Real>
Wireframe<Real>::Wireframe(const GivenPoints& positions, const GivenSimplices<2>& edges) {
  check_edges(positions.size(), edges);
  for (std::size_t v = 0; v < positions.size(); ++v)
    for (const double x : positions[v])
      if (!std::isfinite(x))
        throw InputError("vertex " + std::to_string(v) + ": a coordinate is not finite");
  std::vector<double> lengths(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto& a = positions[edges[e][0]];
    const auto& b = positions[edges[e][1]];
    lengths[e] = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    if (!std::isfinite(lengths[e]))
      throw InputError("edge " + std::to_string(e) + ": too long for a number");
  }
  vertex_to_inside_ = inverse(vertices_along_curve(positions));
  assemble(edges, lengths);
}

template <class Real>
Wireframe<Real>::Wireframe(std::size_t vertices, const GivenSimplices<2>& edges,
                           const Given<double>& lengths) {
  check_edges(vertices, edges);
  if (lengths.size() != edges.size())
    throw InputError(std::to_string(edges.size()) + " edges with " +
                     std::to_string(lengths.size()) + " lengths");
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (!std::isfinite(lengths[e]) || lengths[e] < 0)
      throw InputError("edge " + std::to_string(e) + ": its length is negative or not finite");
  const std::size_t block = std::max<std::size_t>(4096, vertices / 64);  // what pieces are by then
  vertex_to_inside_ = inverse(vertices_in_blocks(vertices, edges, block));
  assemble(edges, lengths);
}

template <class Real>
void Wireframe<Real>::assemble(std::span<const std::array<Index, 2>> edges,
                               std::span<const double> lengths) {
  const std::size_t n = vertex_to_inside_.size();
  summary_.vertices = n;
  summary_.edges = edges.size();
  summary_.mean_edge = mean_of(lengths);
  if (summary_.mean_edge > 0) {
    int exponent = 0;
    const double fraction = std::frexp(summary_.mean_edge, &exponent);
    unit_ = std::ldexp(1.0, fraction < std::sqrt(0.5) ? exponent - 1 : exponent);
    // At the ends of double's range: a unit that has no inverse would be no unit.
    if (!std::isfinite(unit_) || !std::isfinite(1 / unit_)) unit_ = summary_.mean_edge;
    typical_edge_ = typical_of(lengths, summary_.mean_edge) / unit_;
  }

  std::vector<Index>& begin = begin_.own();
  begin.assign(n + 1, 0);
  for (const auto& [a, b] : edges) {
    ++begin[vertex_to_inside_[a] + 1];
    if (a != b) ++begin[vertex_to_inside_[b] + 1];
  }
  for (std::size_t v = 0; v < n; ++v) {
    summary_.unreferenced_vertices += begin[v + 1] == 0;
    begin[v + 1] += begin[v];
  }
  std::vector<WireArc<Real>>& arcs = arcs_.own();
  arcs.resize(begin[n]);
  std::vector<Index>& arc_of_edge = arc_of_edge_.own();
  arc_of_edge.resize(edges.size());
  std::vector<Index> end(begin.begin(), begin.end() - 1);  // of the row as filled so far
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Index a = vertex_to_inside_[edges[e][0]], b = vertex_to_inside_[edges[e][1]];
    NumberRange<Real>::check_edge(e, lengths[e] / unit_);
    const Real length = static_cast<Real>(lengths[e] / unit_);
    summary_.zero_length_edges += lengths[e] == 0;
    summary_.loops += a == b;
    arc_of_edge[e] = end[a];
    arcs[end[a]++] = {b, length};
    if (a != b) arcs[end[b]++] = {a, length};
  }
  count_components();
}

template <class Real>
void Wireframe<Real>::count_components() {
  DisjointSets parts(vertex_count());
  std::size_t joins = 0;
  for (Index v = 0; v < vertex_count(); ++v)
    for (Index k = begin_[v]; k < begin_[v + 1]; ++k)
      if (arcs_[k].to < v) joins += parts.unite(v, arcs_[k].to);  // each edge once
  summary_.components = vertex_count() - joins - summary_.unreferenced_vertices;
}

template <class Real>
std::size_t Wireframe<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(begin_) + of(arcs_) + of(vertex_to_inside_) + of(arc_of_edge_);
}

template <class Real>
typename Wireframe<Real>::Ends Wireframe<Real>::inside_edge(Index edge) const {
  const Index arc = arc_of_edge_[edge];
  const auto row = std::upper_bound(begin_.begin(), begin_.end(), arc) - 1;
  return {static_cast<Index>(row - begin_.begin()), arcs_[arc].to, arcs_[arc].length};
}

template class Wireframe<float>;
template class Wireframe<double>;

}  // namespace plexway
