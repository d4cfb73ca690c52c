#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include <plexway/any/shape.hpp>

namespace plexway {

/// The field of a surface, a solid or a cloud in several files and one that names them
/// (io/field_part.hpp), of which each of several processes writes one.
class PartitionedField {
 public:
  /// Writes the part of this process, but not yet to its place. Arguments as AnyShape::write_field
  /// has them, and must outlive this. Throws UsageError for other shapes, Error "cannot write FILE:
  /// reason".
  PartitionedField(const AnyShape& shape, const std::filesystem::path& file,
                   std::span<const double> distance, std::span<const std::int32_t> label,
                   std::span<const double> error, std::size_t part, std::size_t parts);
  ~PartitionedField();
  PartitionedField(const PartitionedField&) = delete;
  PartitionedField& operator=(const PartitionedField&) = delete;

  /// For one process, before any calls `put_part`: parts are not named until all are new.
  /// Throws as above.
  void remove_whole() const;
  /// Puts the part of this process in its place. Throws as above.
  void put_part();
  /// For one process, when all parts are in place. Throws as above.
  void write_whole() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Throws UsageError unless the shape can be written so.
void check_partitioned(const AnyShape& shape, const std::filesystem::path& file);

}  // namespace plexway
