#include "cli/report/dijkstra_peer.hpp"

#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <variant>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/boost_graph/edge_graph.hpp>
#include <plexway/error.hpp>

#include "any/simplex_edges.hpp"
#endif

namespace plexway::cli {

#ifdef PLEXWAY_HAS_BOOST_GRAPH
namespace {

template <class Real>
class BoostPeer final : public DijkstraPeer {
 public:
  // Its triangles need not be sorted out.
  explicit BoostPeer(const io::Triangles& surface)
      : dijkstra_(surface.positions, surface.triangles) {}
  explicit BoostPeer(const io::Edges& wireframe)
      : dijkstra_(
            boost_graph::EdgeGraph(wireframe.vertices, wireframe.edges, lengths_of(wireframe))) {}

  void run(Index source) override { dijkstra_.run(source); }

 private:
  boost_graph::EdgeDijkstra<Real> dijkstra_;
};

}  // namespace

std::unique_ptr<DijkstraPeer> make_dijkstra_peer(const Domain& domain, Precision precision) {
  const auto peer_of = [&](const auto& shape) -> std::unique_ptr<DijkstraPeer> {
    if (precision == Precision::single) return std::make_unique<BoostPeer<float>>(shape);
    return std::make_unique<BoostPeer<double>>(shape);
  };
  try {
    const auto* surface = std::get_if<io::Triangles>(&domain.data());
    return surface != nullptr ? peer_of(*surface) : peer_of(edges_of(domain));
  } catch (const InputError& error) {
    throw InputError(domain.file().string() + ": " + error.what());
  }
}
#else
std::unique_ptr<DijkstraPeer> make_dijkstra_peer(const Domain&, Precision) { return nullptr; }
#endif

}  // namespace plexway::cli
