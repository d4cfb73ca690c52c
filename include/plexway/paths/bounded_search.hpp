#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/solve.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/solve/workspace.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source_list.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// The vertices within a radius, by the caller's numbers.
template <class Real>
struct Surroundings {
  /// A vertex and how far it is.
  struct Vertex {
    /// The caller's number.
    Index vertex;
    /// In the domain's unit.
    Real distance;
    Index label;  ///< nearest source, by its place in the list
  };
  std::vector<Vertex> vertices;  ///< no farther than the radius, each once
  std::vector<Index> simplices;  ///< those that were reached, each once; may reach beyond
  bool complete = true;          ///< false if max_expansions ended the search early
  /// Longest edge of the triangles that were reached. What would have corrected a distance may lie
  /// beyond the radius: on raw scans one in 10^4 is off by some percent, within an edge of the rim.
  double longest_edge = 0;
  /// Of the search.
  PropagateStatistics statistics;
};

/// Distances near sources on a surface: the same as `solve` with a radius, but what it costs
/// follows what it finds and not the size of the surface. Nothing is cleared and nothing is looked
/// at but the triangles that are reached. For many searches on one surface.
///
/// Memory, float: that of a workspace, and 8 bytes a vertex; allocated and touched once, when it is
/// made. (Every 4095 searches the marks are cleared: 2 bytes a triangle.)
template <class Real>
class BoundedSearch {
 public:
  /// Refers to the surface. Throws UsageError for one with refracting edges. Cost: linear.
  explicit BoundedSearch(const TriangleMesh<Real>& mesh);
  /// The surface would be gone after this line.
  explicit BoundedSearch(const TriangleMesh<Real>&& mesh) = delete;

  /// Vertices within options.radius of the nearest of `sources`, all points. The result stays until
  /// the next search; with `simplices`, triangles are listed too. Throws as `solve`, and UsageError
  /// for another visibility than the default, and for an accuracy by windows. Cost: about 0.2 us a
  /// triangle that is reached.
  const Surroundings<Real>& find(Serial, const SourceList& sources, const PropagateOptions& options,
                                 bool simplices = false);
  /// With the options that are the default but for the radius.
  const Surroundings<Real>& find(Serial executor, const SourceList& sources, double radius,
                                 bool simplices = false) {
    return find(executor, sources, PropagateOptions{.radius = radius}, simplices);
  }

  /// Bytes held, without those of the surface.
  [[nodiscard]] std::size_t bytes() const;

 private:
  template <class Queue>
  void find_with(Queue queue, std::span<const PointSource> sources, const PropagateOptions& options,
                 bool simplices);

  const TriangleMesh<Real>* mesh_;
  Workspace<Real> workspace_;
  std::vector<Index> outer_;  // from vertices inside to the caller's
  std::vector<Index> stamp_;  // of the search that last touched a vertex (inside)
  Index search_ = 0;
  std::vector<Index> reached_;  // triangles inside
  std::vector<Index> touched_;  // vertices inside
  Surroundings<Real> found_;
};

extern template class BoundedSearch<float>;
extern template class BoundedSearch<double>;

}  // namespace plexway
