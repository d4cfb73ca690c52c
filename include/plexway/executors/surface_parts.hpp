#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors.hpp>
#include <plexway/solve/accuracy.hpp>
#include <plexway/solve/distance_field.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

// A surface that no process has as a whole.

namespace plexway {

/// What a surface in parts is read from, range by range. Each process has one of the same content.
class SurfaceRows {
 public:
  virtual ~SurfaceRows() = default;
  /// Below 2^32 - 1.
  [[nodiscard]] virtual std::size_t vertex_count() const = 0;
  /// Below 2^32 - 1.
  [[nodiscard]] virtual std::size_t face_count() const = 0;
  /// The positions of vertices `first`, `first` + 1, ... Throws what reading throws.
  virtual void read_vertices(std::size_t first,
                             std::span<std::array<double, 3>> positions) const = 0;
  /// The corners of faces `first`, `first` + 1, ... Throws what reading throws.
  virtual void read_faces(std::size_t first, std::span<std::array<Index, 3>> corners) const = 0;
};

/// The counts of a surface in parts.
struct SurfacePartsSummary {
  ///@{
  /// Of the whole surface.
  std::size_t vertices = 0, faces = 0;
  /// In no triangle.
  std::size_t unreferenced_vertices = 0;
  std::size_t pieces = 0;
  /// Triangles that pieces have of others, in all.
  std::size_t ghosts = 0;
  /// In the input's unit.
  double mean_edge = 0;
  ///@}
  ///@{
  /// Of this process.
  std::size_t own_faces = 0, own_pieces = 0;
  ///@}
};

/// A point of a surface in parts.
struct PartPoint {
  PointSource source;   ///< by the surface's numbers
  double distance = 0;  ///< from the given point, in the input's unit
};

/// What a process has of a surface, as it was read: the triangles of its pieces and their vertices,
/// and of vertices of no triangle those that it read.
struct SurfacePart {
  /// The surface's numbers, ascending. A vertex at a cut is in several parts.
  std::vector<Index> vertex;
  /// Where each of them lies.
  std::vector<std::array<double, 3>> position;
  /// Their corners by place in `vertex`.
  std::vector<std::array<Index, 3>> triangle;
};

/// Distances at the vertices of a SurfacePart, in its order and the input's unit; and what is known
/// of all parts.
template <class Real>
struct PartField : DistanceField<Real> {
  ///@{
  /// Of the whole surface: vertices reached (each once), how far they are in the mean and at most,
  /// and the farthest of them, the first of several.
  std::size_t reached = 0;
  double mean_distance = 0, max_distance = 0;
  Index farthest = none;
  ///@}
  /// Reached vertices that are no source.
  std::size_t beside_source = 0;
};

/// A triangle surface in parts, of which each of several processes has its own and nobody all.
///
/// A space-filling curve is cut so that about `OpenMP::piece` triangles (0: 16384, at most 65536
/// pieces) have their middles between two cuts. A triangle goes to the first of the pieces that its
/// corners are in, and piece p is that of process p modulo their number (`OpenMP::ranks`, which
/// must outlive this). A piece also has the triangles of others that share a vertex with it. The
/// cut depends on the surface alone; so do the distances, which are the same to the last bit with
/// any number of processes and threads. They are as accurate as those of a TriangleMesh.
///
/// All processes must call everything here, in the same order, with the same arguments; of what
/// throws on one only, the others must be ended.
template <class Real>
class SurfaceParts {
 public:
  /// Reads this process's ranges of vertices and faces, and exchanges what the others need. Throws
  /// InputError naming the vertex or face, as the constructor of TriangleMesh does, PrecisionError
  /// for a triangle too small, and what `rows` and a team throw. Cost: linear; memory falls with
  /// the number of processes.
  SurfaceParts(const OpenMP& executor, const SurfaceRows& rows);
  ~SurfaceParts();
  SurfaceParts(SurfaceParts&&) noexcept;             ///< Leaves nothing that may be used.
  SurfaceParts& operator=(SurfaceParts&&) noexcept;  ///< Leaves nothing that may be used.

  /// Its counts.
  [[nodiscard]] const SurfacePartsSummary& summary() const;
  /// The nearest point of the surface: a vertex where rounding makes no difference, as AnyShape
  /// does; of several, which rounding does not distinguish, that of the lowest face. Throws
  /// UsageError for coordinates that are not finite. Cost: two looks at each triangle.
  [[nodiscard]] PartPoint nearest(const std::array<double, 3>& point) const;
  /// The distance of every vertex of this part from the nearest of `sources`, which have the
  /// surface's numbers. Options, and what it throws, are those of plexway::solve; windows go in
  /// their own order (Schedule::dual_queue). Where windows become too many, labels do it, as there
  /// (`fast`; statistics.windows_gave_up).
  [[nodiscard]] PartField<Real> solve(std::span<const PointSource> sources,
                                      const PropagateOptions& options = {});
  /// The part of this process. Reads positions anew.
  [[nodiscard]] SurfacePart part(const SurfaceRows& rows) const;
  /// Bytes held.
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class SurfaceParts<float>;
extern template class SurfaceParts<double>;

}  // namespace plexway
