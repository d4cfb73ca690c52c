#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/shape/field.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway::detail {

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

/// Reads the right answers: one number a line in vertex order, NaN where there is none ("nan"
/// lines), +inf where unreachable ("inf"). Empty lines at the end do not count.
/// Throws InputError "FILE:LINE: cause", also when there are not `vertices` of them.
std::vector<double> read_truth(const std::string& file, std::size_t vertices);

/// Relative errors of distances, gathered over several fields.
class ErrorGauge {
 public:
  /// Vertices whose truth is 0 (the source) or NaN do not count.
  void add(std::span<const double> distance, std::span<const double> truth);

  [[nodiscard]] std::size_t compared() const { return relative_.size(); }
  /// Vertices that only one of the two reaches.
  [[nodiscard]] std::size_t mismatched_unreached() const { return mismatched_; }

  // Of |distance - truth| / truth; NaN where nothing was compared.
  [[nodiscard]] double mean() const;
  /// Linear between the two nearest ranks.
  [[nodiscard]] double percentile(double percent) const;
  [[nodiscard]] double max() const;
  /// The most negative signed error; 0 where no distance is too short.
  [[nodiscard]] double most_below() const;

 private:
  std::vector<double> relative_;  // signed
  std::size_t mismatched_ = 0;
};

}  // namespace plexway::detail
