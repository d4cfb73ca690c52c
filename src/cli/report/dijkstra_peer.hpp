#pragma once

#include <memory>

#include <plexway/complex/ids.hpp>

#include "cli/options/input.hpp"
#include "cli/options/solve_options.hpp"

namespace plexway::cli {

/// Boost.Graph's Dijkstra on the edges of a domain, to measure against; of a cloud, those to the
/// neighbours.
class DijkstraPeer {
 public:
  virtual ~DijkstraPeer() = default;
  DijkstraPeer() = default;
  DijkstraPeer(const DijkstraPeer&) = delete;
  DijkstraPeer& operator=(const DijkstraPeer&) = delete;

  virtual void run(Index source) = 0;
};

/// Builds its graph; null where this build has no Boost.Graph.
std::unique_ptr<DijkstraPeer> make_dijkstra_peer(const Domain& domain, Precision precision);

}  // namespace plexway::cli
