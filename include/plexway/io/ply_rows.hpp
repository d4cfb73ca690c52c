#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/executors/surface_parts.hpp>

namespace plexway::io {

/// A surface in a binary .ply whose rows have one size each, for SurfaceParts: its header is read
/// once, and ranges of vertices and faces where they lie. No more than one range is in memory.
class PlyRows final : public SurfaceRows {
 public:
  /// Throws InputError "FILE:LINE: cause" or "FILE: cause" when it is missing, no regular file,
  /// malformed, too short or longer than its header says, has no face, or when its rows have no
  /// fixed size: it is text, or has lists besides the corners of faces.
  explicit PlyRows(const std::filesystem::path& file);
  ~PlyRows() override;
  PlyRows(const PlyRows&) = delete;
  PlyRows& operator=(const PlyRows&) = delete;

  [[nodiscard]] std::size_t vertex_count() const override;
  [[nodiscard]] std::size_t face_count() const override;
  /// Throws InputError for a coordinate that is not finite, and where the file cannot be read.
  void read_vertices(std::size_t first, std::span<std::array<double, 3>> positions) const override;
  /// Throws InputError for a face that has not three corners or names no vertex of the file, and
  /// where the file cannot be read.
  void read_faces(std::size_t first, std::span<std::array<Index, 3>> corners) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace plexway::io
