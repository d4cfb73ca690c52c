#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>

#include <plexway/executors/surface_parts.hpp>
#include <plexway/shape/shape.hpp>

namespace plexway {

/// Which of several processes this one is.
struct PartOf {
  std::size_t number = 0, count = 1;
  std::function<void()> all_come;  ///< returns when all have called it
};

/// The field of a surface, a solid or a cloud in several files and one that names them, a .pvtu
/// (io/field/field_formats.hpp): all processes call it, each writes its part, and parts are not
/// named until all are in place. Arguments as AnyShape::write_field has them. Throws UsageError for
/// other shapes, Error "cannot write FILE: reason".
void write_partitioned(const AnyShape& shape, const std::filesystem::path& file,
                       std::span<const double> distance, std::span<const std::int32_t> label,
                       std::span<const double> error, const PartOf& part);

/// The same of a surface that no process has as a whole: each writes what it has. `parts`: the
/// processes that have a vertex, ascending, the first among them; others write nothing. Throws
/// Error as above.
void write_part(const SurfacePart& surface, const std::filesystem::path& file,
                std::span<const double> distance, std::span<const std::int32_t> label,
                std::span<const double> error, const PartOf& part,
                std::span<const std::size_t> parts);

/// Throws UsageError unless the shape can be written so.
void check_partitioned(const AnyShape& shape, const std::filesystem::path& file);

}  // namespace plexway
