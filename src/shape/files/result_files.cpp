#include "shape/files/files.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "file/new_file.hpp"
#include "io/field/field_formats.hpp"
#include "io/matrix/npy.hpp"
#include "io/names.hpp"
#include "io/output_file.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/shape_state.hpp"

namespace plexway::detail {
namespace {

using io::OutputFile;

[[noreturn]] void unknown(const std::filesystem::path& out,
                          std::span<const std::string_view> known) {
  std::string names;
  for (const std::string_view name : known) names.append(" ").append(name);
  throw UsageError("--out " + out.string() + ": unknown extension; those written are" + names);
}

}  // namespace

std::span<const std::string_view> point_file_extensions() {
  static constexpr std::array<std::string_view, 4> known = {".csv", ".npy", ".obj", ".ply"};
  return known;
}

std::span<const std::string_view> matrix_file_extensions() {
  static constexpr std::array<std::string_view, 2> known = {".csv", ".npy"};
  return known;
}

void write_points(const std::filesystem::path& out, const AnyShape& domain,
                  std::span<const PointSource> points, std::string_view value_name,
                  std::span<const double> value) {
  const std::string extension = io::lower_extension(out);
  // Of the points of a cloud of which some were left out.
  const std::span<const std::uint32_t> original = domain.cloud() != nullptr
                                                      ? std::span(domain.cloud()->points.original)
                                                      : std::span<const std::uint32_t>();
  OutputFile file(out);
  if (extension == ".csv") {
    file.write("x,y,z,vertex,simplex,b0,b1,b2,b3");
    if (!value.empty()) file.write(",", value_name);
    if (!original.empty()) file.write(",original");
    file.write("\n");
  } else if (extension == ".npy") {
    file.write(io::npy_header("'<f8'", std::to_string(points.size()) + ", 3"));
  } else if (extension == ".ply") {
    file.write("ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
               "\nproperty double x\nproperty double y\nproperty double z\n");
    if (!value.empty()) file.write("property double ", value_name, "\n");
    if (!original.empty()) file.write("property uint original\n");
    file.write("end_header\n");
  } else if (extension != ".obj") {
    unknown(out, point_file_extensions());
  }
  for (std::size_t n = 0; n < points.size(); ++n) {
    const PointSource& point = points[n];
    const auto at = domain.position(point);
    if (extension == ".npy") {
      for (const double x : at) file.write_binary(x);
      continue;
    }
    const char* const between = extension == ".csv" ? "," : " ";
    if (extension == ".obj") file.write("v ");
    file.write_row(at, between);
    if (extension == ".csv") {
      const bool at_vertex = point.vertex != none;
      for (const Index number : {point.vertex, at_vertex ? none : point.simplex})
        file.write(",", number == none ? std::int64_t{-1} : std::int64_t{number});
      file.write(",");
      file.write_row(point.barycentric, ",");
    }
    if (!value.empty() && extension != ".obj") file.write(between, value[n]);
    if (!original.empty() && extension != ".obj") file.write(between, original[point.vertex]);
    file.write("\n");
  }
  file.commit();
}

void write_matrix(const std::filesystem::path& out, std::size_t n, std::span<const double> values) {
  const std::string extension = io::lower_extension(out);
  OutputFile file(out);
  if (extension == ".npy") {
    file.write(io::npy_header("'<f8'", std::to_string(n) + ", " + std::to_string(n)));
    for (const double x : values) file.write_binary(x);
  } else if (extension == ".csv") {
    for (std::size_t i = 0; i < n; ++i) {
      file.write_row(values.subspan(i * n, n), ",");
      file.write("\n");
    }
  } else {
    unknown(out, matrix_file_extensions());
  }
  file.commit();
}

namespace {

// Parts are new before anything names them.
void remove_whole(const std::filesystem::path& file) {
  const std::filesystem::path target = file::end_of_links(file);
  std::error_code failed;
  if (!std::filesystem::is_regular_file(target, failed)) return;
  std::filesystem::remove(target, failed);
  if (failed) throw Error("cannot write " + file.string() + ": " + failed.message());
}

// All have written theirs.
void put_in_place(const std::filesystem::path& file, const io::Field& field,
                  std::optional<io::FieldPart>& own, std::span<const std::size_t> parts,
                  const PartOf& part) {
  part.all_come();
  if (part.number == 0) remove_whole(file);
  part.all_come();
  if (own) own->commit();
  part.all_come();
  if (part.number == 0) io::write_pvtu(file, field, parts);
}

}  // namespace

void write_partitioned(const AnyShape& shape, const std::filesystem::path& file,
                       std::span<const double> distance, std::span<const std::int32_t> label,
                       std::span<const double> error, const PartOf& part) {
  check_partitioned(shape, file);
  const FieldCells cells(shape);
  const io::Field field = {
      shape.vertices(), shape.positions(), cells.all, distance, label, cells.original, error};
  std::vector<std::size_t> parts(std::clamp(field.cell_count(), std::size_t{1}, part.count));
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  std::optional<io::FieldPart> own;  // none where there are more processes than cells
  if (part.number < parts.size()) own.emplace(file, field, part.number, parts.size());
  put_in_place(file, field, own, parts, part);
}

void write_part(const SurfacePart& surface, const std::filesystem::path& file,
                std::span<const double> distance, std::span<const std::int32_t> label,
                std::span<const double> error, const PartOf& part,
                std::span<const std::size_t> parts) {
  const io::Cells cells = io::cells_of(surface.triangle);
  const io::Field field = {
      surface.vertex.size(), surface.position, {&cells, 1}, distance, label, surface.vertex, error};
  std::optional<io::FieldPart> own;
  if (!surface.vertex.empty()) own.emplace(file, field, part.number);
  put_in_place(file, field, own, parts, part);
}

void check_partitioned(const AnyShape& shape, const std::filesystem::path& file) {
  require(file.string(), support(Purpose::parts, shape));
}

}  // namespace plexway::detail
