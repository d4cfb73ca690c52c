#pragma once

#include <memory>

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

}  // namespace plexway
