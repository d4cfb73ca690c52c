#include "shape/errors/edge_dijkstra.hpp"

#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <variant>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/boost_graph/edge_graph.hpp>
#include <plexway/error.hpp>

#include "shape/simplex_edges.hpp"
#endif

namespace plexway {

#ifdef PLEXWAY_HAS_BOOST_GRAPH
namespace {

template <class Real>
class BoostDijkstra final : public EdgeDijkstra {
 public:
  // Its triangles need not be sorted out.
  explicit BoostDijkstra(const io::Triangles& surface)
      : dijkstra_(surface.positions, surface.triangles) {}
  explicit BoostDijkstra(const io::Edges& wireframe)
      : dijkstra_(
            boost_graph::EdgeGraph(wireframe.vertices, wireframe.edges, lengths_of(wireframe))) {}

  void run(Index source) override { dijkstra_.run(source); }

 private:
  boost_graph::EdgeDijkstra<Real> dijkstra_;
};

}  // namespace

std::unique_ptr<EdgeDijkstra> make_edge_dijkstra(const AnyShape& domain, Precision precision) {
  const auto peer_of = [&](const auto& shape) -> std::unique_ptr<EdgeDijkstra> {
    if (precision == Precision::single) return std::make_unique<BoostDijkstra<float>>(shape);
    return std::make_unique<BoostDijkstra<double>>(shape);
  };
  try {
    const auto* surface = std::get_if<io::Triangles>(&domain.data());
    return surface != nullptr ? peer_of(*surface) : peer_of(edges_of(domain));
  } catch (const InputError& error) {
    throw InputError(domain.file().string() + ": " + error.what());
  }
}
#else
std::unique_ptr<EdgeDijkstra> make_edge_dijkstra(const AnyShape&, Precision) { return nullptr; }
#endif

}  // namespace plexway
