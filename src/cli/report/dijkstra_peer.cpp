#include "dijkstra_peer.hpp"

#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <variant>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/boost_graph/edge_graph.hpp>

#include "simplex_edges.hpp"
#endif

namespace plexway::cli {

#ifdef PLEXWAY_HAS_BOOST_GRAPH
namespace {

template <class Real>
class BoostPeer final : public DijkstraPeer {
 public:
  explicit BoostPeer(const io::Triangles& surface)
      : dijkstra_(surface.positions, surface.triangles) {}
  explicit BoostPeer(const io::Tets& solid) : BoostPeer(edges_of(solid)) {}
  explicit BoostPeer(const Cloud& cloud) : BoostPeer(edges_of(cloud)) {}
  explicit BoostPeer(const io::Edges& wireframe)
      : dijkstra_(
            boost_graph::EdgeGraph(wireframe.vertices, wireframe.edges, lengths_of(wireframe))) {}

  void run(Index source) override { dijkstra_.run(source); }

 private:
  boost_graph::EdgeDijkstra<Real> dijkstra_;
};

}  // namespace

std::unique_ptr<DijkstraPeer> make_dijkstra_peer(const Domain& domain, Precision precision) {
  return with_file_name(domain, [&] {
    return std::visit(
        [&](const auto& shape) -> std::unique_ptr<DijkstraPeer> {
          if (precision == Precision::single) return std::make_unique<BoostPeer<float>>(shape);
          return std::make_unique<BoostPeer<double>>(shape);
        },
        domain.shape());
  });
}
#else
std::unique_ptr<DijkstraPeer> make_dijkstra_peer(const Domain&, Precision) { return nullptr; }
#endif

}  // namespace plexway::cli
