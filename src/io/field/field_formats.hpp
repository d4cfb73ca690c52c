#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/output_file.hpp"

namespace plexway::io {

/// Cells of one kind: cell c has the vertices connectivity[corners * c] and on.
struct Cells {
  std::uint8_t vtk_type;  ///< 1 vertex, 3 edge, 5 triangle, 10 tetrahedron
  std::size_t corners;
  std::span<const std::uint32_t> connectivity;

  std::size_t count() const { return connectivity.size() / corners; }
};

/// The corners of cells that lie one after the other, as one list.
template <std::size_t Corners>
Cells cells_of(std::uint8_t vtk_type, std::span<const std::array<std::uint32_t, Corners>> cells) {
  static_assert(sizeof(cells[0]) == Corners * sizeof(std::uint32_t));
  return {vtk_type,
          Corners,
          {reinterpret_cast<const std::uint32_t*>(cells.data()), Corners * cells.size()}};
}

/// What a format has to write: any number of kinds of cells over the same vertices.
struct Field {
  std::size_t vertices;
  std::span<const std::array<double, 3>> positions;  ///< one a vertex; empty: there are none
  std::span<const Cells> cells;
  std::span<const double> distance;     ///< one a vertex; empty (.vtu .vtk .glb): the mesh alone
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
};

/// These two need no positions.
void write_csv(OutputFile& out, const Field& field);
void write_npy(OutputFile& out, const Field& field);
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

}  // namespace plexway::io
