#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/executors/surface_parts.hpp>

namespace plexway {

/// A part of a surface as some file has it, with points of its own.
struct SurfaceFilePart {
  std::string name;                              ///< for messages
  std::size_t number = 0;                        ///< among all parts
  std::vector<std::array<double, 3>> positions;  ///< of its points, in the file's order
  /// The number of each point in the whole; empty if the file does not say.
  std::vector<std::uint64_t> ids;
  /// Corners by place in `positions`.
  std::vector<std::array<Index, 3>> triangles;
  std::string ids_name;  ///< of the array that `ids` are from, for messages
};

/// What became of the points of parts, of all processes.
struct JoinedCounts {
  bool by_ids = false;       ///< else points are one by where they lie
  std::uint64_t parts = 0;   ///< that have triangles
  std::uint64_t alone = 0;   ///< of these: those that share no point with another
  std::uint64_t shared = 0;  ///< vertices that are points of several parts
  /// With ids: places where a part has points, others have some too, and none of an id of its own.
  std::uint64_t apart = 0;
};

/// A surface of parts that processes have read, number r of n the parts r, r + n, ...: points of
/// several parts become one vertex where they have the same id, or if no part has ids where they
/// lie in the same place. Vertices are numbered by their ids, those in use one after the other, or
/// without in the order of parts and points; triangles in that of parts. So numbers do not depend
/// on who has read what.
///
/// Afterwards each process has its range of the rows, number r of n those from count * r / n to
/// count * (r + 1) / n, and no others may be read.
class JoinedRows final : public SurfaceRows {
 public:
  /// All processes call it, with what they have read; `ranks` may be null. Throws InputError where
  /// parts have ids and others none, points of one id lie apart, two points of one part have the
  /// same id, or without ids the same place (which of them a neighbour's is would be a guess), or
  /// two parts the same triangle; and for too many. Cost: linear but for sorting; twice the memory
  /// of what it has.
  JoinedRows(PieceRanks* ranks, std::vector<SurfaceFilePart> parts);

  [[nodiscard]] std::size_t vertex_count() const override { return vertices_; }
  [[nodiscard]] std::size_t face_count() const override { return faces_; }
  /// What became of the points, the same in all processes.
  [[nodiscard]] const JoinedCounts& joined() const { return joined_; }
  /// Of this process's range.
  void read_vertices(std::size_t first, std::span<std::array<double, 3>> positions) const override;
  /// Of this process's range.
  void read_faces(std::size_t first, std::span<std::array<Index, 3>> corners) const override;

 private:
  std::size_t vertices_ = 0, faces_ = 0, first_vertex_ = 0, first_face_ = 0;
  std::vector<std::array<double, 3>> positions_;
  std::vector<std::array<Index, 3>> corners_;
  JoinedCounts joined_;
};

}  // namespace plexway
