#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "measure.hpp"

namespace bench {

/// Something that finds distances on a surface, made ready for one surface. A solve includes the
/// read-out to vertices in the caller's order.
class Peer {
 public:
  Peer() = default;
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  virtual void solve(Index source) = 0;
  /// What the last solve found, one a vertex.
  [[nodiscard]] virtual std::vector<double> distance() const = 0;
  /// Bytes held; 0 if not known.
  [[nodiscard]] virtual std::size_t bytes() const { return 0; }
};

struct PeerKind {
  std::string name;
  bool single_precision;
  /// Makes it ready for a surface; throws where it cannot take it.
  std::function<std::unique_ptr<Peer>(const Surface&)> build;
  bool exact = false;  ///< and so slow that it is left out on large meshes
};

/// Those of the program: what needs nothing but this project (and Boost, where its provider is
/// built), and what else its files have added.
std::vector<PeerKind>& peer_kinds();

/// Boost's Dijkstra, which the others are measured against; null if this build lacks it.
std::unique_ptr<Peer> reference_peer(const Surface& surface, bool single_precision);

}  // namespace bench
