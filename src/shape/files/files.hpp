#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/executors/surface_parts.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/shape/read_options.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway::detail {

/// Throws NotBuiltError, naming the package, where this build has no TetGen; `what` starts the
/// message.
void require_tetgen(const std::string& what);

/// Whether the extension of `file` is one of TetGen's boundaries, .poly and .smesh; and whether it
/// is OpenVDB's.
bool is_poly(const std::string& file);
bool is_vdb(const std::string& file);

/// The solid inside a surface, or inside what a `.poly` or `.smesh` describes. Throws InputError
/// "FILE: cause", NotBuiltError as `require_tetgen`, and Error at the time limit.
io::Tets fill_surface(const std::string& file, const io::Triangles& surface,
                      const ReadOptions& options);
io::Tets fill_poly(const std::string& file, const ReadOptions& options);

/// What was written.
struct Converted {
  std::string kind;          ///< as kind_name, or "the solid's surface"
  std::string simplex_name;  ///< in the plural; empty for clouds
  std::string note;          ///< how a level set came in or out, or empty
  std::size_t vertices = 0, simplices = 0;
  double load_seconds = 0, write_seconds = 0;
};

/// Extensions that something can be written as, with the dot.
[[nodiscard]] std::vector<std::string_view> conversion_extensions();

/// Reads a domain and writes it in the format of `out`: a surface is filled where only solids fit,
/// of a solid the boundary is taken where only surfaces fit. `options.cloud` is not looked at.
/// Throws as AnyShape::read and the writers, and UsageError for what does not go into that format.
Converted convert(const std::string& input, const std::string& out, const ReadOptions& options);

/// Points of a domain, and one value each where `value` is not empty (`value_name` is its column).
/// The extension picks the format: .csv (x, y, z, where it is), .npy (n x 3), .obj and .ply
/// (vertices alone). Throws UsageError for another one, and as io::OutputFile.
void write_points(const std::filesystem::path& out, const AnyShape& domain,
                  std::span<const PointSource> points, std::string_view value_name = {},
                  std::span<const double> value = {});
std::span<const std::string_view> point_file_extensions();

/// n x n numbers as .csv or .npy.
void write_matrix(const std::filesystem::path& out, std::size_t n, std::span<const double> values);
std::span<const std::string_view> matrix_file_extensions();

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

}  // namespace plexway::detail
