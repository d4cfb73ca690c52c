#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "io/field/field_formats.hpp"
#include "io/output_file.hpp"

namespace plexway::io {

/// One of several files that hold a field together, which a .pvtu names (VTK's partitioned
/// unstructured grid). FILE.pvtu has the parts FILE_0.vtu, FILE_1.vtu, ... beside it: each a range
/// of the cells of each kind and the vertices that these have, with the numbers that they have in
/// the whole as `original`. Vertices of no cell are in the first.
class FieldPart {
 public:
  /// Writes part `part` of `parts`, but not yet to its place. Throws Error "cannot write FILE:
  /// reason".
  FieldPart(const std::filesystem::path& file, const Field& whole, std::size_t part,
            std::size_t parts);
  /// The same of what a process has by itself, with its `original` numbers.
  FieldPart(const std::filesystem::path& file, const Field& own, std::size_t part);
  /// Puts it in its place. Throws as above.
  void commit() { out_->commit(); }

 private:
  std::unique_ptr<OutputFile> out_;
};

/// Does a name end in .pvtu, in any case?
[[nodiscard]] bool is_partitioned(const std::filesystem::path& file);

/// Where the part of a number lies.
[[nodiscard]] std::filesystem::path part_of(const std::filesystem::path& file, std::size_t part);

/// The file that names the parts of these numbers. Write it when they are all in place. Throws as
/// above.
void write_pvtu(const std::filesystem::path& file, const Field& whole,
                std::span<const std::size_t> parts);

}  // namespace plexway::io
