#include "any/partitioned_field.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <system_error>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/error.hpp>

#include "any/shape_state.hpp"
#include "file/new_file.hpp"
#include "io/field_part.hpp"

namespace plexway {

struct PartitionedField::Content {
  std::filesystem::path file;
  std::vector<std::uint32_t> points;  // of a cloud, each a cell
  std::optional<io::Cells> cells;
  io::Field field;
  std::size_t parts = 1;
  std::optional<io::FieldPart> part;  // none where there are more processes than cells
};

PartitionedField::~PartitionedField() = default;

PartitionedField::PartitionedField(const AnyShape& shape, const std::filesystem::path& file,
                                   std::span<const double> distance,
                                   std::span<const std::int32_t> label,
                                   std::span<const double> error, std::size_t part,
                                   std::size_t parts)
    : content_(std::make_unique<Content>()) {
  check_partitioned(shape, file);
  Content& content = *content_;
  content.file = file;
  std::span<const std::uint32_t> original;
  std::visit(
      [&](const auto& data) {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, io::Triangles>) {
          content.cells = io::cells_of<3>(5, data.triangles);
        } else if constexpr (std::is_same_v<Kind, io::Tets>) {
          content.cells = io::cells_of<4>(10, data.tets);
        } else if constexpr (std::is_same_v<Kind, CloudShape>) {
          content.points.resize(data.points.positions.size());
          std::iota(content.points.begin(), content.points.end(), 0u);
          content.cells = io::Cells{1, 1, content.points};
          original = data.points.original;
        }
      },
      shape.data());
  content.field = {shape.positions().size(),
                   shape.positions(),
                   {&*content.cells, 1},
                   distance,
                   label,
                   original,
                   error};
  content.parts = std::clamp(content.cells->count(), std::size_t{1}, parts);
  if (part < content.parts) content.part.emplace(file, content.field, part, content.parts);
}

void PartitionedField::remove_whole() const {
  const std::filesystem::path target = file::end_of_links(content_->file);
  std::error_code failed;
  if (!std::filesystem::is_regular_file(target, failed)) return;
  std::filesystem::remove(target, failed);
  if (failed) throw Error("cannot write " + content_->file.string() + ": " + failed.message());
}

void PartitionedField::put_part() {
  if (content_->part) content_->part->commit();
}

void PartitionedField::write_whole() const {
  io::write_pvtu(content_->file, content_->field, content_->parts);
}

void check_partitioned(const AnyShape& shape, const std::filesystem::path& file) {
  const DomainKind kind = shape.kind();
  if ((kind != DomainKind::surface && kind != DomainKind::solid && kind != DomainKind::cloud) ||
      shape.positions().empty())
    throw UsageError(file.string() +
                     ": a .pvtu holds surfaces, solids and clouds with positions; "
                     "the other formats are written by one rank");
}

}  // namespace plexway
