#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solve/accuracy.hpp>

namespace plexway {

/// The work that a solve took.
struct PropagateStatistics {
  std::size_t expansions = 0;  ///< simplices taken from the queue
  std::size_t updates = 0;     ///< labels accepted
  /// Simplices that a label came to.
  std::size_t reached_simplices = 0;
  /// Surfaces, but for Accuracy::exact: vertices that came out farther than a neighbour and the
  /// edge between, and that were set to the length of that path. Many: the field is less accurate
  /// there.
  std::size_t lowered_vertices = 0;
  /// Likewise vertices that came out nearer than the straight line through space by more than
  /// 1e-3 of it. They got its length, a bound that is mostly still too short.
  std::size_t raised_vertices = 0;
  /// Accuracy::usual: fields where windows became too many, so that labels did it, and the accuracy
  /// is `fast`. 0 or 1; more in sums over several fields.
  std::size_t windows_gave_up = 0;
  ///@{
  /// In pieces (OpenMP): how often they exchanged messages, how many of these there were, of how
  /// many bytes, and how many bytes this process sent to others (OpenMP::ranks).
  std::size_t supersteps = 0, messages = 0, message_bytes = 0, sent_bytes = 0;
  ///@}
};

/// Distances at the vertices, in the caller's order and the domain's unit.
///
/// +inf where unreachable (or beyond the radius), exactly the source's offset (0 by default) at a
/// source vertex, never NaN.
template <class Real>
struct DistanceField {
  std::vector<Real> distance;  ///< one a vertex
  std::vector<Index> label;    ///< nearest source of each vertex, by its place in the list of
                               ///< sources; none where unreached. Empty for a single source.
  /// How far off each distance may be, in the domain's unit: an estimate, mostly several times too
  /// large, now and then too small, no bound. 0 where unreached or exact. Empty for Accuracy::fast.
  std::vector<Real> error;
  Accuracy accuracy = Accuracy::fast();  ///< by which it was solved, never `usual`
  bool complete = true;                  ///< false if max_expansions, or limits of ours, ended it
  /// The work that it took.
  PropagateStatistics statistics;

  /// How many vertices.
  [[nodiscard]] std::size_t size() const { return distance.size(); }
  /// How far vertex v is from the nearest source.
  [[nodiscard]] Real operator[](std::size_t v) const { return distance[v]; }
  ///@{
  /// The distances, vertex by vertex.
  [[nodiscard]] auto begin() const { return distance.begin(); }
  [[nodiscard]] auto end() const { return distance.end(); }
  ///@}
  /// Does a path lead to vertex v, within the radius?
  [[nodiscard]] bool reached(std::size_t v) const {
    return distance[v] < std::numeric_limits<Real>::infinity();
  }
  /// The nearest source of vertex v, by its place in the list of sources, also of a single one;
  /// none where unreached.
  [[nodiscard]] Index label_of(std::size_t v) const {
    if (!label.empty()) return label[v];
    return reached(v) ? 0 : none;
  }
};

}  // namespace plexway
