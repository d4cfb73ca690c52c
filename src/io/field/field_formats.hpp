#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <tuple>

#include "io/output_file.hpp"

namespace plexway::io {

/// Cells of one kind: cell c has the vertices connectivity[corners * c] and on.
struct Cells {
  std::size_t corners;  ///< 1 vertex, 2 edge, 3 triangle, 4 tetrahedron
  std::span<const std::uint32_t> connectivity;

  std::size_t count() const { return connectivity.size() / corners; }
  std::uint8_t vtk_type() const {
    constexpr std::uint8_t types[] = {0, 1, 3, 5, 10};
    return types[corners];
  }
};

/// The corners of cells that lie one after the other, as one list.
template <class List>
Cells cells_of(const List& list) {
  constexpr std::size_t corners = std::tuple_size_v<typename List::value_type>;
  static_assert(sizeof(typename List::value_type) == corners * sizeof(std::uint32_t));
  return {corners, {reinterpret_cast<const std::uint32_t*>(list.data()), corners * list.size()}};
}

/// What a format has to write: any number of kinds of cells over the same vertices.
struct Field {
  std::size_t vertices;
  std::span<const std::array<double, 3>> positions;  ///< one a vertex; empty: there are none
  std::span<const Cells> cells;
  std::span<const double> distance;     ///< one a vertex; empty: the mesh alone
  std::span<const std::int32_t> label;  ///< one a vertex, or empty
  /// The number that each vertex had in the input, or empty: the same.
  std::span<const std::uint32_t> original = {};
  std::span<const double> error = {};  ///< of each distance, or empty

  std::size_t cell_count() const {
    std::size_t count = 0;
    for (const Cells& kind : cells) count += kind.count();
    return count;
  }
  std::size_t corner_count() const {
    std::size_t count = 0;
    for (const Cells& kind : cells) count += kind.connectivity.size();
    return count;
  }
  /// Calls use(name, numbers) for each array beside the distances that is there.
  template <class Use>
  void each_more(const Use& use) const {
    if (!label.empty()) use("label", label);
    if (!original.empty()) use("original", original);
    if (!error.empty()) use("error", error);
  }
};

/// These three need no positions.
void write_csv(OutputFile& out, const Field& field);
void write_npy(OutputFile& out, const Field& field);
/// In single precision, as the format asks for.
void write_gifti(OutputFile& out, const Field& field);
/// Triangles become faces, edges edges; tetrahedra have no place in it.
void write_ply(OutputFile& out, const Field& field);
/// Throws Error when there are more vertices than its 32 bits count.
void write_vtk(OutputFile& out, const Field& field);
void write_vtu(OutputFile& out, const Field& field);
/// Of tetrahedra the boundary, with its vertices alone. Throws Error beyond 4 GB.
void write_glb(OutputFile& out, const Field& field);
void write_gltf(OutputFile& out, const Field& field);

/// Writes `field` in the format that the extension names. Checks lengths and throws as
/// `write_field` does for every kind of domain.
void write_field_of(const std::filesystem::path& file, const Field& field);

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
