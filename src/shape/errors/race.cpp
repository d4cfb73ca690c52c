#include "shape/errors/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <variant>

#include <plexway/error.hpp>

#include "shape/boundary.hpp"
#include "shape/shape_state.hpp"

#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/boost_graph/edge_graph.hpp>
#endif

namespace plexway::detail {
namespace {

// A graph search starts at a vertex: for a point of a simplex at the nearest corner, nearly.
Index vertex_near(const AnyShape& shape, const PointSource& source) {
  if (source.vertex != none) return source.vertex;
  const auto& weight = source.barycentric;
  const auto corner = std::max_element(weight.begin(), weight.end()) - weight.begin();
  return shape.corners(source.simplex)[static_cast<std::size_t>(corner)];
}

}  // namespace

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void add_random_sources(std::vector<PointSource>& sources, std::size_t count,
                        std::span<const double> distance) {
  std::vector<Index> reached;
  for (std::size_t v = 0; v < distance.size(); ++v)
    if (std::isfinite(distance[v])) reached.push_back(static_cast<Index>(v));
  if (reached.empty()) return;
  std::mt19937_64 random(20210712);
  for (std::size_t i = 0; i < count; ++i)
    sources.push_back(PointSource::at(reached[random() % reached.size()]));
}

RaceTimes race(const AnyDomain& domain, AnyField& field, EdgeDijkstra* dijkstra,
               std::span<const PointSource> sources, const AnyExecutor& executor,
               const PropagateOptions& options, std::size_t repeats,
               const std::function<void(double share)>& progress) {
  RaceTimes times;
  const double to_ns_a_vertex = 1e9 / static_cast<double>(domain.vertices());
  for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
    const PointSource& source = sources[repeat % sources.size()];
    if (dijkstra != nullptr) {
      const Index start = vertex_near(domain.shape(), source);
      const Stopwatch running;
      dijkstra->run(start);
      times.dijkstra.push_back(running.seconds() * to_ns_a_vertex);
    }
    const Stopwatch solving;
    domain.solve(executor, source, options, field);
    times.plexway.push_back(solving.seconds() * to_ns_a_vertex);
    progress(static_cast<double>(repeat + 1) / static_cast<double>(repeats));
  }
  return times;
}

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
    if (precision == Precision::float32) return std::make_unique<BoostDijkstra<float>>(shape);
    return std::make_unique<BoostDijkstra<double>>(shape);
  };
  return with_file_name(domain, [&] {
    const auto* surface = std::get_if<io::Triangles>(&domain.data());
    return surface != nullptr ? peer_of(*surface) : peer_of(edges_of(domain));
  });
}
#else
std::unique_ptr<EdgeDijkstra> make_edge_dijkstra(const AnyShape&, Precision) { return nullptr; }
#endif

}  // namespace plexway::detail
