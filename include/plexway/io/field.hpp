#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include <plexway/io/edges.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway::io {

/// Writes one distance a vertex, and one label where `label` is not empty, in file order; where
/// `error` is not empty, how far off each may be (DistanceField::error) as a column `error` (glTF:
/// `_ERROR`; not in .npy).
///
/// The extension (any case) picks the format: .csv, .npy (distances only), .gii (a .func.gii or
/// .shape.gii, to be shown on a surface of another file), .ply, .vtk, .vtu, .glb and .gltf.
/// Unreached vertices carry +inf in each of them, but -1 in glTF, which knows no
/// infinity. The file appears whole or not at all: it is written beside its place and renamed at
/// the end.
///
/// Throws UsageError for an unknown extension or arrays that are not as long as
/// `surface.positions`, and Error "cannot write FILE: reason" when the system refuses.
void write_field(const std::filesystem::path& file, const Triangles& surface,
                 std::span<const double> distance, std::span<const std::int32_t> label = {},
                 std::span<const double> error = {});

/// The same for a solid. A .ply holds its vertices alone, a .glb its boundary.
void write_field(const std::filesystem::path& file, const Tets& solid,
                 std::span<const double> distance, std::span<const std::int32_t> label = {});

/// The same for a wireframe. If its vertices have no positions, only .csv (without x, y and z),
/// .npy and .gii can hold it; UsageError otherwise.
void write_field(const std::filesystem::path& file, const Edges& wireframe,
                 std::span<const double> distance, std::span<const std::int32_t> label = {});

/// The same for a cloud. In .vtk and .vtu each point is a cell of its own. Where points were left
/// out, `cloud.original` is a column `original` (glTF: `_ORIGINAL`, a float); an .npy then has
/// records of `distance` (f8) and `original` (u4).
void write_field(const std::filesystem::path& file, const Points& cloud,
                 std::span<const double> distance, std::span<const std::int32_t> label = {},
                 std::span<const double> error = {});

/// A part of a mixed domain; empty lists are left out. The parts' vertices follow one another.
struct MixedPart {
  /// n, one a vertex.
  std::span<const std::array<double, 3>> positions;
  /// Of vertices < n, counted from the part's first.
  std::span<const std::array<std::uint32_t, 2>> edges = {};
  /// Likewise.
  std::span<const std::array<std::uint32_t, 3>> triangles = {};
  /// Likewise.
  std::span<const std::array<std::uint32_t, 4>> tets = {};
};

/// The same for a mixed domain: all parts in one file, each with its own kind of cell, in the order
/// in which they were added to the domain. A .ply holds no tetrahedra.
void write_field(const std::filesystem::path& file, std::span<const MixedPart> parts,
                 std::span<const double> distance, std::span<const std::int32_t> label = {});

/// The extensions `write_field` knows, with the dot, in lower case.
std::span<const std::string_view> field_extensions();

}  // namespace plexway::io
