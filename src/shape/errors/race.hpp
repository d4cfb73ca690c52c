#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway {

/// Boost.Graph's Dijkstra on the edges of a domain, to measure against; of a cloud, those to the
/// neighbours.
class EdgeDijkstra {
 public:
  virtual ~EdgeDijkstra() = default;
  EdgeDijkstra() = default;
  EdgeDijkstra(const EdgeDijkstra&) = delete;
  EdgeDijkstra& operator=(const EdgeDijkstra&) = delete;

  virtual void run(Index source) = 0;
};

/// Builds its graph; null where this build has no Boost.Graph.
std::unique_ptr<EdgeDijkstra> make_edge_dijkstra(const AnyShape& domain, Precision precision);

/// Times of single runs, in ns a vertex.
struct RaceTimes {
  std::vector<double> plexway, dijkstra;
};

/// Of any order; NaN of none.
[[nodiscard]] double median(std::vector<double> values);

/// Adds `count` vertices, always the same ones, that a path from the first source leads to: times
/// of empty fields mean nothing. `distance` is from the first source.
void add_random_sources(std::vector<PointSource>& sources, std::size_t count,
                        std::span<const double> distance);

/// Solves, and has Dijkstra do it unless that is null: every source in turn, the two in turn. One
/// source again and again would train the branch predictor, and blocks of one solver would see
/// another clock than blocks of the other. Throws as AnyDomain::solve.
[[nodiscard]] RaceTimes race(const AnyDomain& domain, AnyField& field, EdgeDijkstra* dijkstra,
                             std::span<const PointSource> sources, const AnyExecutor& executor,
                             const PropagateOptions& options, std::size_t repeats,
                             const std::function<void(double share)>& progress);

}  // namespace plexway
