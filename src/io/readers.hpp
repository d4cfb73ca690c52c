#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/io/edges.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/simplices.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

namespace plexway::io {

// The readers of bytes, by format; `name` stands for the file in messages. All throw InputError,
// and NotBuiltError for what needs a library that this build lacks.

/// Vertices, faces (all index forms, negative indices, `\\` at a line's end) and lines.
Mixed parse_obj(std::string_view text, std::string_view name);
/// Vertices, faces, triangle strips and edges.
Mixed parse_ply(std::string_view bytes, std::string_view name);
Mixed parse_medit(std::string_view text, std::string_view name);
/// Node tags may be any numbers.
Mixed parse_gmsh(std::string_view bytes, std::string_view name);
/// Unstructured grids and polygons, as XML and as legacy files.
Mixed parse_vtu(std::string_view bytes, std::string_view name);
Mixed parse_vtk(std::string_view bytes, std::string_view name);
Triangles parse_off(std::string_view text, std::string_view name);
/// A soup of triangles: corners with identical coordinates become one vertex, numbered in order of
/// first appearance.
Triangles parse_stl(std::string_view bytes, std::string_view name);
/// The first arrays of points and of triangles. Transforms to other spaces are not applied.
Triangles parse_gifti(std::string_view bytes, std::string_view name);
/// 3MF: all items of its build, made of objects where transforms put them, in the file's unit.
Triangles parse_three_mf(std::string_view bytes, std::string_view name);
/// Where glTF's vertices are in what Draco packed.
struct DracoPosition {
  std::uint32_t id;  ///< of the attribute
  bool normalized;   ///< whole numbers stand for -1 to 1, even if Draco does not know it
};
/// What Draco packed: triangles or points. Corners at one place become one vertex, which has the
/// number of the first. With `position`, as a part of glTF, points stay as they are.
Mixed parse_draco(std::string_view bytes, std::string_view name,
                  const std::optional<DracoPosition>& position = {});
/// FreeSurfer's binary surfaces of triangles, such as lh.white.
Triangles parse_freesurfer(std::string_view bytes, std::string_view name);
/// FreeSurfer's surfaces as text: "#!ascii", the counts, "x y z patch" and "a b c patch".
Triangles parse_freesurfer_ascii(std::string_view text, std::string_view name);

/// "a b" or "a b length" a line, vertices counted from 0. All edges have a length or none has: then
/// it is 1. There are as many vertices as a first line "vertices N" says, or else one more than the
/// highest index; one so high that it can only be a mistake is refused.
Edges parse_edge_list(std::string_view text, std::string_view name);
/// Colours are told from normals by their range, and normals far from 1 in length (and not 0) are
/// refused.
Points parse_point_table(std::string_view text, std::string_view name);
/// Withheld points are left out.
Points parse_las(std::string_view bytes, std::string_view name);
/// The vertices, with `nx ny nz` as normals.
Points parse_ply_points(std::string_view bytes, std::string_view name);
Simplices parse_simplices(std::string_view text, std::string_view name);

/// The bytes of a file and what it is called in messages.
struct NamedText {
  std::string_view text;  ///< all of the file; referred to
  std::string_view name;  ///< referred to
};
/// TetGen's .node and .ele, numbered from 0 or 1; tetrahedra of 4 or 10 nodes.
Tets parse_node_ele(NamedText node, NamedText ele);

/// Finds the file that a .gltf names: its bytes.
using GltfFiles = std::function<std::string(const std::string& uri)>;
/// All meshes of its scene where its nodes put them. The format cuts surfaces along seams of
/// textures and normals: vertices at one place become one, but in files of plexway, which have
/// none. `beside` may be empty.
Mixed parse_gltf(std::string_view bytes, std::string_view name, const GltfFiles& beside = {});

/// TetGen's pair, from the name of either.
Tets read_node_ele(const std::filesystem::path& file);
/// Throws NotBuiltError for a .pcd, which another component reads and writes.
void refuse_pcd(std::string_view extension, const std::string& name);

/// The numbers in the colour table that an annotation of FreeSurfer (.annot) gives its vertices; -1
/// for a colour that the table has not. Throws InputError "FILE: cause".
[[nodiscard]] std::vector<std::int64_t> read_freesurfer_annotation(
    const std::filesystem::path& file);
/// The same of bytes; `name` is for messages.
[[nodiscard]] std::vector<std::int64_t> parse_freesurfer_annotation(std::string_view bytes,
                                                                    std::string_view name);

}  // namespace plexway::io
