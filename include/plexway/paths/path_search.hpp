#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include <plexway/common/rows_of.hpp>
#include <plexway/paths/path.hpp>
#include <plexway/solve.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/source_list.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// How a search is led, and when it stops.
struct SearchOptions {
  /// A lower bound of the distance from a vertex (caller's number) to the nearest target, in the
  /// domain's unit. It must change by no more than the distance from vertex to vertex. Empty: the
  /// straight line where the search has positions, else 0.
  std::function<double(Index)> heuristic = {};
  TraceOptions trace = {};  ///< of the paths, in what was searched
  /// Stop after this many expansions (SearchResult::complete).
  std::size_t max_expansions = ~std::size_t{0};
  std::function<bool(const Progress&)> progress = {};  ///< as in PropagateOptions
};

/// The result of a search.
struct SearchResult {
  /// One a target, in their order; empty, of infinite length, where unreachable.
  std::vector<Path> paths;
  std::vector<double> distance;  ///< as labels have it, before paths are pulled straight
  /// False if max_expansions ended the search early.
  bool complete = true;
  /// The work that it took.
  PropagateStatistics statistics;
};

/// Paths to a few targets on a surface without looking at all of it: nearest first, or A* (Hart,
/// Nilsson, Raphael, A formal basis for the heuristic determination of minimum cost paths, 1968).
///
/// *When it stops.* Labels wait in the order of a lower bound of all paths through their triangle
/// T. By the straight line, such a path comes from the label's virtual source, crosses the edge
/// that the label came in by at some point x, and has the distance from there to the target in
/// space to go: the least such sum is that of the straight line once the target is turned into the
/// plane of T about that edge, or over one of its ends. Other bounds h know vertices: the path
/// comes to a point x of T after d(x) at least, and has h(x) at least to go. With r the longest
/// distance from T's centre c to its corners, d(x) >= d(c) - r, else the path by x and straight on
/// to c would be a shorter one to c; and h(x) >= h(c) - r, because a lower bound of distances that
/// changes faster than these can be cut down to one that does not. So the bound is d(c) + h(c) - 2
/// r. Once it is no less than what a target has for the first label that waits, no label that waits
/// can lead to a shorter path there: the target is settled. The search stops when all are.
///
/// *Only one thread* takes labels in that order: there is no search for other executors.
template <class Real>
class PathSearch {
 public:
  /// Nearest first, unless a search brings a heuristic. Refers to the surface.
  /// Throws UsageError for a surface with refracting edges.
  explicit PathSearch(const TriangleMesh<Real>& mesh);
  /// A* by the straight line in space, times `scale`. Throws UsageError, naming the triangle and
  /// the greatest scale that would do, where a path on the surface may be shorter than that:
  /// surfaces with another metric than that of their positions. Cost: linear, once. Refers to the
  /// surface, and to positions unless they would be gone after the line (Given).
  PathSearch(const TriangleMesh<Real>& mesh, GivenPoints positions, double scale = 1);
  ///@{
  /// The surface would be gone after this line.
  explicit PathSearch(const TriangleMesh<Real>&& mesh) = delete;
  PathSearch(const TriangleMesh<Real>&& mesh, GivenPoints positions, double scale = 1) = delete;
  ///@}
  ~PathSearch();
  /// Moves what it holds; what is left may be assigned to or destroyed, no more.
  PathSearch(PathSearch&&) noexcept;
  /// Likewise.
  PathSearch& operator=(PathSearch&&) noexcept;

  /// Paths from the targets back to the nearest of `sources`, all of them points. Throws UsageError
  /// for no target or one that is not in the surface, else as `solve`. Cost: about 0.3 us an
  /// expansion, and what the paths cost.
  [[nodiscard]] SearchResult find(Serial, const SourceList& sources, const SourceList& targets,
                                  const SearchOptions& options = {});

  /// Bytes held, without those of the surface and the positions.
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class PathSearch<float>;
extern template class PathSearch<double>;

}  // namespace plexway
