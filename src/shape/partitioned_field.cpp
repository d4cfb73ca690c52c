#include "shape/partitioned_field.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "file/new_file.hpp"
#include "io/field/field_formats.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/shape_state.hpp"

namespace plexway {
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

}  // namespace plexway
