#include "dijkstra_peer.hpp"

#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <plexway/boost_graph/dijkstra.hpp>
#endif

namespace plexway::cli {

#ifdef PLEXWAY_HAS_BOOST_GRAPH
namespace {

template <class Real>
class BoostPeer final : public DijkstraPeer {
 public:
  explicit BoostPeer(const io::Triangles& surface)
      : dijkstra_(surface.positions, surface.triangles) {}

  void run(Index source) override { dijkstra_.run(source); }

 private:
  boost_graph::EdgeDijkstra<Real> dijkstra_;
};

}  // namespace

std::unique_ptr<DijkstraPeer> make_dijkstra_peer(const Domain& domain, Precision precision) {
  return with_file_name(domain, [&]() -> std::unique_ptr<DijkstraPeer> {
    if (precision == Precision::single) return std::make_unique<BoostPeer<float>>(domain.surface());
    return std::make_unique<BoostPeer<double>>(domain.surface());
  });
}
#else
std::unique_ptr<DijkstraPeer> make_dijkstra_peer(const Domain&, Precision) { return nullptr; }
#endif

}  // namespace plexway::cli
