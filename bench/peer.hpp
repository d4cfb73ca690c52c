#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <plexway/solve.hpp>
#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <plexway/boost_graph/dijkstra.hpp>
#endif

#include "harness.hpp"

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

template <class Real>
class PlexwayPeer final : public Peer {
 public:
  PlexwayPeer(const Surface& surface, plexway::PropagateOptions options)
      : mesh_(surface.positions, surface.faces), options_(std::move(options)) {}

  void solve(Index source) override { solve(source, options_); }
  /// The same complex and workspace with other options.
  void solve(Index source, const plexway::PropagateOptions& options) {
    const auto at = plexway::PointSource::at(source);
    plexway::solve(plexway::Serial{}, mesh_, std::span(&at, 1), options, workspace_, field_);
  }
  [[nodiscard]] std::vector<double> distance() const override {
    return {field_.distance.begin(), field_.distance.end()};
  }
  [[nodiscard]] std::size_t bytes() const override {
    return mesh_.bytes() + workspace_.bytes() + field_.distance.capacity() * sizeof(Real) +
           field_.label.capacity() * sizeof(Index);
  }
  [[nodiscard]] const plexway::PropagateStatistics& statistics() const { return field_.statistics; }

 private:
  plexway::TriangleMesh<Real> mesh_;
  plexway::PropagateOptions options_;
  plexway::Workspace<Real> workspace_;
  plexway::DistanceField<Real> field_;
};

template <class Real>
PeerKind plexway_peer(std::string name, plexway::Visibility visibility) {
  return {std::move(name), sizeof(Real) == 4,
          [visibility](const Surface& surface) {
            plexway::PropagateOptions options = one_label();
            options.visibility = visibility;
            return std::make_unique<PlexwayPeer<Real>>(surface, options);
          },
          false};
}

#ifdef PLEXWAY_HAS_BOOST_GRAPH

template <class Real>
class DijkstraPeer final : public Peer {
 public:
  explicit DijkstraPeer(const Surface& surface, bool without_colours = false)
      : dijkstra_(surface.positions, surface.faces), without_colours_(without_colours) {}

  void solve(Index source) override {
    if (without_colours_)
      dijkstra_.run_without_colours(source);
    else
      dijkstra_.run(source);
  }
  [[nodiscard]] std::vector<double> distance() const override {
    return {dijkstra_.distance().begin(), dijkstra_.distance().end()};
  }
  [[nodiscard]] std::size_t bytes() const override { return dijkstra_.bytes(); }

 private:
  plexway::boost_graph::EdgeDijkstra<Real> dijkstra_;
  bool without_colours_;
};

#endif

/// Boost's Dijkstra, which the others are measured against; null if this build lacks it.
inline std::unique_ptr<Peer> reference_peer([[maybe_unused]] const Surface& surface,
                                            [[maybe_unused]] bool single_precision) {
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  if (single_precision) return std::make_unique<DijkstraPeer<float>>(surface);
  return std::make_unique<DijkstraPeer<double>>(surface);
#else
  return nullptr;
#endif
}

}  // namespace bench
