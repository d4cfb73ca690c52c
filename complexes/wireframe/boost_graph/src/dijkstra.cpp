#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/dijkstra_shortest_paths_no_color_map.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/error.hpp>

namespace plexway::boost_graph {
namespace {

using Edge = std::pair<Index, Index>;
using Positions = std::span<const std::array<double, 3>>;
using Faces = std::span<const std::array<Index, 3>>;

std::string edge_name(std::size_t face, Index from, Index to) {
  return "face " + std::to_string(face) + ", edge " + std::to_string(from) + " - " +
         std::to_string(to);
}

template <class Real>
Real edge_length(Positions positions, Index from, Index to) {
  const auto& a = positions[from];
  const auto& b = positions[to];
  // hypot, since squares of the input may leave the range of double.
  return static_cast<Real>(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]));
}

template <class Real>
void check(Positions positions, Faces faces) {
  constexpr std::size_t limit = std::numeric_limits<Index>::max();
  if (positions.size() >= limit || faces.size() >= limit / 6)
    throw InputError("more than 2^32 - 1 vertices or directed edges");
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const Index v : faces[f])
      if (v >= positions.size())
        throw InputError("face " + std::to_string(f) + ": vertex " + std::to_string(v) +
                         " out of range, there are " + std::to_string(positions.size()));
    for (std::size_t i = 0; i < 3; ++i) {
      const Index from = faces[f][i];
      const Index to = faces[f][(i + 1) % 3];
      if (!std::isfinite(edge_length<Real>(positions, from, to)))
        throw InputError(edge_name(f, from, to) + ": length is not finite");
    }
  }
}

// Each edge in both directions, once, ordered by (from, to): a bucket a vertex.
std::vector<Edge> directed_edges(std::size_t vertices, Faces faces) {
  std::vector<Index> end(vertices + 1, 0);  // of the bucket as filled so far
  for (const auto& face : faces)
    for (const Index v : face) end[v + 1] += 2;
  for (std::size_t v = 0; v < vertices; ++v) end[v + 1] += end[v];
  std::vector<Index> target(end.back());
  for (const auto& face : faces)
    for (std::size_t i = 0; i < 3; ++i) {
      target[end[face[i]]++] = face[(i + 1) % 3];
      target[end[face[i]]++] = face[(i + 2) % 3];
    }
  std::vector<Edge> edges;
  edges.reserve(target.size() / 2 + vertices);
  Index begin = 0;
  for (Index v = 0; v < vertices; ++v) {
    const auto first = target.begin() + begin;
    std::sort(first, target.begin() + end[v]);
    const auto last = std::unique(first, target.begin() + end[v]);
    for (auto to = first; to != last; ++to)
      if (*to != v) edges.emplace_back(v, *to);
    begin = end[v];
  }
  return edges;
}

template <class Real>
struct Length {
  Real length;
};

template <class Real>
using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Length<Real>,
                                                 boost::no_property, Index, Index>;

template <class Real>
Graph<Real> make_graph(Positions positions, Faces faces) {
  check<Real>(positions, faces);
  const auto edges = directed_edges(positions.size(), faces);
  std::vector<Length<Real>> lengths;
  lengths.reserve(edges.size());
  for (const auto& [from, to] : edges) lengths.push_back({edge_length<Real>(positions, from, to)});
  return Graph<Real>(boost::edges_are_sorted, edges.begin(), edges.end(), lengths.begin(),
                     static_cast<Index>(positions.size()), static_cast<Index>(edges.size()));
}

template <class Real>
Graph<Real> make_graph(const EdgeGraph& edges) {
  std::vector<Edge> arcs;
  std::vector<Length<Real>> lengths;
  arcs.reserve(edges.arcs().size());
  lengths.reserve(edges.arcs().size());
  for (Index v = 0; v < edges.vertex_count(); ++v)
    for (Index k = edges.begin()[v]; k < edges.begin()[v + 1]; ++k) {
      const auto [to, edge] = edges.arcs()[k];
      const Real length = static_cast<Real>(edges.lengths()[edge]);
      if (!std::isfinite(length))
        throw InputError("edge " + std::to_string(edge) + ": length is not finite");
      arcs.emplace_back(v, to);
      lengths.push_back({length});
    }
  return Graph<Real>(boost::edges_are_sorted, arcs.begin(), arcs.end(), lengths.begin(),
                     static_cast<Index>(edges.vertex_count()), static_cast<Index>(arcs.size()));
}

template <class Real>
constexpr Real infinity = std::numeric_limits<Real>::infinity();

}  // namespace

template <class Real>
struct EdgeDijkstra<Real>::State {
  Graph<Real> graph;
  std::vector<Real> distance;
};

template <class Real>
EdgeDijkstra<Real>::EdgeDijkstra(Positions positions, Faces faces)
    : state_(std::make_unique<State>(State{make_graph<Real>(positions, faces),
                                           std::vector<Real>(positions.size(), infinity<Real>)})) {}

template <class Real>
EdgeDijkstra<Real>::EdgeDijkstra(const EdgeGraph& edges)
    : state_(std::make_unique<State>(State{
          make_graph<Real>(edges), std::vector<Real>(edges.vertex_count(), infinity<Real>)})) {}

template <class Real>
EdgeDijkstra<Real>::~EdgeDijkstra() = default;
template <class Real>
EdgeDijkstra<Real>::EdgeDijkstra(EdgeDijkstra&&) noexcept = default;
template <class Real>
EdgeDijkstra<Real>& EdgeDijkstra<Real>::operator=(EdgeDijkstra&&) noexcept = default;

template <class Real>
void EdgeDijkstra<Real>::run(Index source) {
  const auto& graph = state_->graph;
  check_source(source);
  boost::dijkstra_shortest_paths(
      graph, vertex(source, graph),
      boost::distance_map(boost::make_iterator_property_map(state_->distance.data(),
                                                            get(boost::vertex_index, graph)))
          .weight_map(get(&Length<Real>::length, graph))
          .distance_inf(infinity<Real>));
}

// Of Boost's own ways this is the fastest one found. Bunny, float, ns a vertex, median of sources:
// named parameters with all defaults 97; `no_init` with a two-bit colour map 94, with a map of
// colours 107; `no_color_map` 86, with std::plus instead of closed_plus 84 (sums that reach +inf
// need no care here); lengths in an array of our own rather than in the graph 85; the heap's
// positions kept from run to run, through Boost's inner parts, 101. The order is the same on
// armadillo (109, 108, 109, 91, 88, 92, 109) and fandisk (75, 71, 70, 65, 60, 61, 74). Indices of
// 64 bits cost up to a quarter more.
template <class Real>
void EdgeDijkstra<Real>::run_without_colours(Index source) {
  const auto& graph = state_->graph;
  auto& distance = state_->distance;
  check_source(source);
  std::fill(distance.begin(), distance.end(), infinity<Real>);
  distance[source] = 0;
  const auto index = get(boost::vertex_index, graph);
  boost::dijkstra_shortest_paths_no_color_map_no_init(
      graph, vertex(source, graph), boost::dummy_property_map(),
      boost::make_iterator_property_map(distance.data(), index), get(&Length<Real>::length, graph),
      index, std::less<Real>(), std::plus<Real>(), infinity<Real>, Real(0),
      boost::default_dijkstra_visitor());
}

template <class Real>
void EdgeDijkstra<Real>::check_source(Index source) const {
  if (source >= state_->distance.size())
    throw UsageError("source vertex " + std::to_string(source) + " is out of range, there are " +
                     std::to_string(state_->distance.size()));
}

template <class Real>
std::span<const Real> EdgeDijkstra<Real>::distance() const {
  return state_->distance;
}

template <class Real>
std::size_t EdgeDijkstra<Real>::bytes() const {
  const std::size_t edges = num_edges(state_->graph);
  const std::size_t vertices = state_->distance.size();
  return (vertices + 1) * sizeof(Index) + edges * (sizeof(Index) + sizeof(Real)) +
         vertices * sizeof(Real);
}

template class EdgeDijkstra<float>;
template class EdgeDijkstra<double>;

}  // namespace plexway::boost_graph
