#include <algorithm>
#include <array>
#include <cstdlib>

#include <plexway/error.hpp>
#include <plexway/io/formats.hpp>
#include <plexway/io/labels.hpp>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"

namespace plexway::io {
namespace {

using View = std::string_view;
constexpr char gifti_tag[] = "<GIFTI", vtk_tag[] = "<VTKFile", freesurfer_magic[] = "\xFF\xFF\xFE",
               freesurfer_text[] = "#!ascii", medit_word[] = "MeshVersionFormatted",
               gmsh_sign[] = "$", vtk_line[] = "# vtk DataFile", gltf_magic[] = "glTF",
               las_magic[] = "LASF", zip_magic[] = "PK\x03\x04", draco_magic[] = "DRACO";
template <const char* with>
bool begins(View bytes) {
  return bytes.starts_with(with);
}
template <const char* what>
bool has_early(View bytes) {
  return bytes.substr(0, 1024).find(what) != View::npos;
}
bool begins_off(View bytes) {
  return bytes.substr(0, bytes.find_first_of("\r\n ")).ends_with("OFF");
}
bool begins_ply(View bytes) { return bytes.starts_with("ply\n") || bytes.starts_with("ply\r"); }
bool begins_stl(View bytes) { return bytes.starts_with("solid ") || bytes.starts_with("solid\n"); }

Mixed mixed_of(Mixed cells) { return cells; }
Mixed mixed_of(Points points) {
  return {std::move(points.positions), {}, {}, {}, std::move(points.report)};
}
template <auto parse>
Mixed cells_of(const OpenedFile& file) {
  return mixed_of(parse(file.bytes(), file.name()));
}

Mixed draco_of(const OpenedFile& file) { return parse_draco(file.bytes(), file.name()); }

Mixed gltf_of(const OpenedFile& file) {
  // Nothing lies beside bytes that are in memory.
  if (file.is_in_memory()) return parse_gltf(file.bytes(), file.name());
  return parse_gltf(file.bytes(), file.name(), [&](const std::string& uri) {
    // Beside it, as exporters write them, with nothing but letters to decode.
    std::string other;
    for (std::size_t i = 0; i < uri.size(); ++i) {
      const bool coded = uri[i] == '%' && i + 2 < uri.size();
      other += coded ? static_cast<char>(std::strtol(uri.substr(i + 1, 2).c_str(), nullptr, 16))
                     : uri[i];
      if (coded) i += 2;
    }
    if (other.find(':') != other.npos || other.starts_with('/') || other.find("..") != other.npos)
      throw InputError(file.name() + ": has its numbers in " + quote(uri) +
                       ", which does not lie beside it");
    const auto path = std::filesystem::path(file.name()).parent_path() / other;
    return std::string(FileBytes(path).view());
  });
}

Mixed pair_of(const OpenedFile& file) {
  if (file.is_in_memory())
    throw InputError(file.name() +
                     ": is one of two files, .node and .ele: give their name instead of bytes, "
                     "or save them as one, such as .mesh or .vtu");
  Tets both = read_node_ele(file.name());
  return {std::move(both.positions), {}, {}, std::move(both.tets)};
}

constexpr unsigned bit(DomainKind kind) { return 1U << static_cast<unsigned>(kind); }
constexpr unsigned surface = bit(DomainKind::surface), solid = bit(DomainKind::solid),
                   wires = bit(DomainKind::wireframe), cloud = bit(DomainKind::cloud),
                   any = surface | solid | wires | cloud;

struct Row : Format {
  Mixed (*cells)(const OpenedFile& file) = nullptr;
  Points (*points)(View bytes, View name) = nullptr;  ///< with normals and numbers
  bool (*is_this)(View bytes) = nullptr;              ///< by its first bytes
};

constexpr Row table[] = {
    {{".obj", "Wavefront OBJ", FileReader::cells, surface | wires | cloud,
      "`v`; `f` and `l` as `v`, `v/vt`, `v//vn`, `v/vt/vn`; negative indices; faces and lines "
      "before "
      "their vertices; a backslash joins a line to the next",
      "every other statement; a fourth coordinate, colours"},
     cells_of<parse_obj>},
    {{".off", "Object File Format", FileReader::cells, surface,
      "ascii; `OFF` and its variants with `ST`, `C`, `N` in front, or no keyword at all; counts on "
      "the keyword's line or the next; the edge count may be missing",
      "normals, colours, edge count; binary OFF is refused"},
     cells_of<parse_off>,
     nullptr,
     begins_off},
    {{".ply", "Stanford PLY", FileReader::cells, surface | wires | cloud,
      "ascii, binary of either byte order, version 1.0; any scalar types; properties and elements "
      "in "
      "any order; `face` and `tristrips` (-1 between strips) with `vertex_indices` or "
      "`vertex_index`, `edge` with `vertex1` and `vertex2`; of clouds `nx ny nz`",
      "all other elements and properties, lists too"},
     cells_of<parse_ply>,
     parse_ply_points,
     begins_ply},
    {{".stl", "STL", FileReader::cells, surface,
      "ascii and binary, several solids, polygons in ascii",
      "normals, attributes, names; bytes "
      "behind the last facet, with a note"},
     cells_of<parse_stl>,
     nullptr,
     begins_stl},
    {{".gii", "GIfTI (`.surf.gii`)", FileReader::cells, surface,
      "the first arrays of points and of triangles; ascii, base64, base64 of zlib; rows or columns "
      "first",
      "metadata, transforms to other spaces; data in other files is refused"},
     cells_of<parse_gifti>,
     nullptr,
     has_early<gifti_tag>},
    {{".white .pial .inflated .sphere .orig .smoothwm", "FreeSurfer's triangles", FileReader::cells,
      surface, "binary, as behind `lh.` and `rh.`; files of any other name by their first bytes",
      "what stands behind the triangles"},
     cells_of<parse_freesurfer>,
     nullptr,
     begins<freesurfer_magic>},
    {{"", "FreeSurfer's triangles as text", FileReader::cells, surface,
      "files that begin with `#!ascii`, such as `lh.pial.asc`", "the patch of each"},
     cells_of<parse_freesurfer_ascii>,
     nullptr,
     begins<freesurfer_text>},
    {{".node .ele", "TetGen's pair", FileReader::cells, solid,
      "from either name; numbered from 0 or 1; 4 or 10 nodes a tetrahedron",
      "attributes, markers, comments"},
     pair_of},
    {{".mesh", "MEDIT", FileReader::cells, any,
      "ascii, of dimension 2 or 3; sections in any order; cells of first and second order",
      "references, normals, tangents, marks; `.meshb` is refused"},
     cells_of<parse_medit>,
     nullptr,
     begins<medit_word>},
    {{".msh", "Gmsh", FileReader::cells, any,
      "2.0 to 2.2 and 4.1, ascii and binary of either byte order; any node tags; entity blocks; "
      "comments and other sections anywhere",
      "all other sections; versions 1 and 4.0, and `$ParametricNodes`, are refused"},
     cells_of<parse_gmsh>,
     nullptr,
     begins<gmsh_sign>},
    {{".vtu .vtp", "VTK's XML, grids and polygons", FileReader::cells, any,
      "ascii, base64, appended raw and base64; either byte order; any number types; several "
      "pieces; compressed by zlib, LZ4 or LZMA; cells of any order",
      "fields"},
     cells_of<parse_vtu>,
     nullptr,
     has_early<vtk_tag>},
    {{".vtk", "VTK's legacy files", FileReader::cells, any,
      "ascii and binary, up to 5.1, `UNSTRUCTURED_GRID` and `POLYDATA`; cells of any order",
      "fields"},
     cells_of<parse_vtk>,
     nullptr,
     begins<vtk_line>},
    {{".glb .gltf", "glTF 2.0", FileReader::cells, surface | wires | cloud,
      "all meshes of the scene where its nodes put them: points, lines, triangles, strips, fans; "
      "numbers in the file or in one beside it, quantized, sparse or packed by Draco too",
      "all attributes but `POSITION`; cameras, skins, morph targets; meshopt is refused"},
     gltf_of,
     nullptr,
     begins<gltf_magic>},
    {{".3mf", "3MF", FileReader::cells, surface,
      "all objects of the build with their components, where transforms put them, from all models "
      "in the archive; coordinates stay in the file's unit",
      "materials, textures, metadata; beams, slices and supports, which are counted"},
     cells_of<parse_three_mf>,
     nullptr,
     begins<zip_magic>},
    {{".drc", "Draco", FileReader::cells, surface | cloud,
      "bitstream 2.2 and 2.3: meshes (edgebreaker, sequential) and points (sequential, kd-tree); "
      "corners at one place are one vertex",
      "all other attributes, metadata"},
     draco_of,
     nullptr,
     begins<draco_magic>},
    {{".edges", "list of edges", FileReader::edges, wires,
      "text, an edge a line: `a b` or `a b length`, vertices counted from 0; `vertices N` before",
      "blank lines, `#` and what follows it, lines that start with `%`"}},
    {{".xyz .csv .txt .pts .asc", "points as text", FileReader::points, cloud,
      "a point a line, between blanks, commas, semicolons or tabs; a header (behind `#` or `//` "
      "too) names the columns `x`, `y`, `z` and maybe `nx`, `ny`, `nz`, in any order; without one "
      "there are three, or six with normals; a first line may say how many follow",
      "other columns; colours and intensities, with a note; blank lines, `#`, `%` and `//`"},
     cells_of<parse_point_table>,
     parse_point_table},
    {{".las", "LAS", FileReader::points, cloud, "1.0 to 1.4, points of formats 0 to 10",
      "all but the coordinates; withheld points, so that `original` tells which are left; `.laz` "
      "is "
      "refused"},
     cells_of<parse_las>,
     parse_las,
     begins<las_magic>},
    {{".pcd", "PCD, through PCL", FileReader::cloud, cloud, "ascii, binary, compressed",
      "all fields but `x y z` and `normal_x normal_y normal_z`"}},
    {{".poly .smesh", "surfaces to fill, through TetGen", FileReader::boundary, solid,
      "points, facets, holes, regions", "attributes"}},
    {{".vdb", "level sets, through OpenVDB", FileReader::level_set, solid, "one grid",
      "other grids"}},
    {{".simplices", "simplices of dimension 1 to 4", FileReader::simplices,
      bit(DomainKind::simplices), "text: coordinates or lengths, and corners",
      "`#` and what follows it"}},
    {{".plexway", "what `plexway prepare` built", FileReader::prepared, 0, "all", "nothing"}},
};

bool has_extension(const Format& format, View extension) {
  for (View list = format.extensions; !list.empty() && !extension.empty();) {
    const View one = list.substr(0, list.find(' '));
    if (one == extension) return true;
    list.remove_prefix(std::min(one.size() + 1, list.size()));
  }
  return false;
}

// What others read, and how it gets here.
constexpr std::array<std::array<View, 2>, 9> others = {{
    {".meshb", "save it as ascii .mesh, with 'transmesh' of libMeshb"},
    {".laz", "unpack it, with 'pdal translate' or laszip"},
    {".nii", "it holds voxels: save a surface of them as .gii, with FreeSurfer or 3D Slicer"},
    {".mgz", "it holds voxels: save a surface of them as .gii, with FreeSurfer or 3D Slicer"},
    {".dae", "save the surface as .stl, .ply or .glb, with Blender"},
    {".fbx", "save the surface as .stl, .ply or .glb, with Blender"},
    {".step", "save the surface as .stl, with FreeCAD, or mesh it with Gmsh"},
    {".iges", "save the surface as .stl, with FreeCAD, or mesh it with Gmsh"},
    {".e57", "save the points as .ply or .las, with CloudCompare or PDAL"},
}};

// None where it cannot be read, which is said only if its name says nothing.
View first_bytes(const OpenedFile& file) {
  try {
    return file.bytes();
  } catch (const InputError&) {
    return {};
  }
}

[[noreturn]] void refuse(const OpenedFile& file) {
  const std::string &name = file.name(), &extension = file.extension();
  if (extension.empty() && file.is_standard_input())
    throw InputError(name + ": standard input has no extension: say what it is, as in ply:-");
  for (const auto& [other, cure] : others)
    if (extension == other)
      throw InputError(name + ": a " + std::string(other) + " is not read; " + std::string(cure));
  std::vector<View> known;
  for (const Format& format : table)
    for (View list = format.extensions; !list.empty();) {
      known.push_back(list.substr(0, list.find(' ')));
      list.remove_prefix(std::min(known.back().size() + 1, list.size()));
    }
  const std::string hint = did_you_mean(extension, known);
  if (hint.empty()) static_cast<void>(file.bytes());
  throw InputError(name + ": " +
                   (extension.empty() ? "no extension" : "unknown extension " + quote(extension)) +
                   ", and its first bytes do not tell what it is" + hint +
                   (hint.empty() ? ";" : "") + " read are " + known_formats());
}

// By its name, but an .asc is either of two; then by its first bytes.
const Row& row_of(const OpenedFile& file) {
  const bool tells = file.extension() != ".asc";
  for (const bool by_name : {tells, !tells})
    for (const Row& row : table)
      if (by_name ? has_extension(row, file.extension())
                  : row.is_this != nullptr && row.is_this(first_bytes(file)))
        return row;
  refuse(file);
}

Mixed cells_in(const OpenedFile& file) {
  const Row& row = row_of(file);
  if (row.cells == nullptr)
    throw InputError(file.name() + ": holds no lines, polygons or tetrahedra with coordinates");
  return row.cells(file);
}

}  // namespace

std::vector<Format> formats() { return {std::begin(table), std::end(table)}; }

Format format_of(const std::filesystem::path& file) { return row_of(OpenedFile(file)); }

std::string extensions_of(DomainKind kind) {
  std::string list;
  for (const Format& format : table)
    if (format.may_hold(kind) && !format.extensions.empty())
      list.append(list.empty() ? "" : " ").append(format.extensions);
  return list;
}

std::string known_formats() {
  return "surfaces " + extensions_of(DomainKind::surface) + ", solids " +
         extensions_of(DomainKind::solid) + ", wireframes " + extensions_of(DomainKind::wireframe) +
         ", clouds " + extensions_of(DomainKind::cloud) + ", simplices " +
         extensions_of(DomainKind::simplices) + ", and .plexway, what is prepared";
}

Mixed read_cells(const std::filesystem::path& path) { return cells_in(OpenedFile(path)); }

Mixed parse_cells(std::string_view bytes, const std::filesystem::path& name) {
  return cells_in(OpenedFile(name, bytes));
}

namespace {

Points points_of(const OpenedFile& file) {
  refuse_pcd(file.extension(), file.name());
  if (auto* const parse = row_of(file).points) return parse(file.bytes(), file.name());
  Mixed cells = cells_in(file);
  if (cells.positions.empty()) throw InputError(file.name() + ": has no points");
  return {std::move(cells.positions), {}, {}, std::move(cells.report)};
}

}  // namespace

Points read_points(const std::filesystem::path& path) { return points_of(OpenedFile(path)); }

Points parse_points(std::string_view bytes, const std::filesystem::path& name) {
  return points_of(OpenedFile(name, bytes));
}

Triangles read_triangles(const std::filesystem::path& file) {
  return triangles_of(read_cells(file), file.string());
}

Tets read_tets(const std::filesystem::path& file) {
  return tets_of(read_cells(file), file.string());
}

Edges read_edges(const std::filesystem::path& path) {
  const OpenedFile file(path);
  return row_of(file).reader == FileReader::edges ? parse_edge_list(file.bytes(), file.name())
                                                  : edges_of(cells_in(file), file.name());
}

Regions read_regions(const std::filesystem::path& path) {
  const OpenedFile file(path);
  const std::string& extension = file.extension();
  const auto parse = extension == ".msh"   ? parse_gmsh_regions
                     : extension == ".vtu" ? parse_vtu_regions
                     : extension == ".vtk" ? parse_vtk_regions
                                           : nullptr;
  if (parse == nullptr)
    throw InputError(file.name() + ": regions are read from .msh, .vtu and .vtk");
  return parse(file.bytes(), file.name());
}

}  // namespace plexway::io
