// VTK's XML unstructured grid and polygons (.vtp). The XML is pugixml's work; but raw appended data
// is not XML, so it is cut off first.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html

#include <plexway/error.hpp>
#include <plexway/io/pvtu.hpp>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/readers.hpp"
#include "io/solid/cells.hpp"
#include "io/solid/vtu_data.hpp"

#if PLEXWAY_IO_PUGIXML

#include <algorithm>
#include <charconv>
#include <pugixml.hpp>
#include <set>
#include <string>

namespace plexway::io {
namespace {

class VtuReader {
 public:
  /// `regions`: where those of the cells go, if they are wanted.
  VtuReader(std::string_view bytes, std::string_view name, Regions* regions = nullptr)
      : bytes_(bytes),
        name_(name),
        regions_(regions),
        room_(least_room + most_packed * bytes.size()) {}

  /// As a part of several files: what numbers its points have in the whole comes along, and its
  /// ghosts, which are another's, do not. It may be empty.
  Mixed read_part(SurfaceFilePart& part) {
    ids_ = &part.ids;
    ids_name_ = &part.ids_name;
    return read();
  }
  Mixed read() {
    load();
    const pugi::xml_node root = document_.child("VTKFile");
    if (!root) fail(1, "expected the element VTKFile");
    const std::string_view type = root.attribute("type").value();
    const bool polygons = type == "PolyData";
    if (type.starts_with('P') && !polygons)
      fail(root, "a file in parts is read by ranks: mpirun -n 4 plexway-mpi distance " +
                     std::string(name_) + " --in-parts ...");
    if (type != "UnstructuredGrid" && !polygons)
      fail(root, "the file is of type " + quote(type) + "; read are UnstructuredGrid and PolyData");
    read_encoding(root);
    const pugi::xml_node appended = root.child("AppendedData");
    appended_base64_ = std::string_view(appended.attribute("encoding").value()) == "base64";
    for (const pugi::xml_node piece :
         root.child(polygons ? "PolyData" : "UnstructuredGrid").children("Piece"))
      read_piece(piece, polygons);
    taker_.finish(name_);
    return std::move(solid_);
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& cause) const {
    throw InputError(std::string(name_) + ":" + std::to_string(line) + ": " + cause);
  }
  [[noreturn]] void fail(pugi::xml_node node, const std::string& cause) const {
    fail(line_of(node), cause);
  }

  /// Counts from the place requested last, which is never far away.
  std::size_t line_of_byte(std::size_t at) const {
    at = std::min(at, bytes_.size());
    const auto [from, to] = std::minmax(at, counted_);
    const std::string_view between = bytes_.substr(from, to - from);
    const auto lines = static_cast<std::size_t>(std::count(between.begin(), between.end(), '\n'));
    counted_line_ = at < counted_ ? counted_line_ - lines : counted_line_ + lines;
    counted_ = at;
    return counted_line_;
  }
  std::size_t line_of(pugi::xml_node node) const {
    const std::ptrdiff_t at = node.offset_debug();
    return at < 0 ? 1 : line_of_byte(static_cast<std::size_t>(at));
  }

  /// Parses what is XML; `appended_` is what follows the tag AppendedData and its '_'.
  void load() {
    std::string xml;
    const auto tag = bytes_.find("<AppendedData");
    const auto end = tag == std::string_view::npos ? tag : bytes_.find('>', tag);
    if (end == std::string_view::npos || bytes_[end - 1] == '/') {
      xml = bytes_;
    } else {
      xml = bytes_.substr(0, end + 1);
      xml += "</AppendedData></VTKFile>";
      const auto mark = bytes_.find('_', end);
      if (mark != std::string_view::npos) appended_ = bytes_.substr(mark + 1);
    }
    const auto result =
        document_.load_buffer(xml.data(), xml.size(), pugi::parse_minimal, pugi::encoding_utf8);
    if (!result)
      fail(line_of_byte(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0))),
           std::string("the XML is broken: ") + result.description());
  }

  void read_encoding(pugi::xml_node root) {
    const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian")
      fail(root, "the byte order is " + quote(order));
    encoding_.order = order == "BigEndian" ? std::endian::big : std::endian::little;
    const std::string_view header = root.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64") fail(root, "the header type is " + quote(header));
    encoding_.header = header == "UInt64" ? NumberType::u64 : NumberType::u32;
    compressor_ = root.attribute("compressor").value();
    encoding_.packing = vtu_packing(compressor_);
  }

  std::uint64_t number(pugi::xml_node node, const char* name) const {
    const std::string_view text = node.attribute(name).value();
    std::uint64_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size())
      fail(node, std::string(name) + " is not a whole number: " + quote(text));
    return value;
  }

  void read_piece(pugi::xml_node piece, bool polygons) {
    const std::uint64_t points = number(piece, "NumberOfPoints");
    const std::size_t base = solid_.positions.size();
    if (points != 0) {
      const pugi::xml_node array = piece.child("Points").child("DataArray");
      if (!array) fail(piece, "the piece has no array of points");
      if (std::string_view(array.attribute("NumberOfComponents").value()) != "3")
        fail(array, "points need NumberOfComponents=\"3\"");
      values(array, "points", points, 3,
             [&](auto& in, NumberType type) { read_vtk_points(in, type, points, solid_); });
      if (ids_ != nullptr) read_ids(piece, points);
    }
    if (polygons) {
      if (regions_ != nullptr) no_regions(name_);
      read_polygons(piece, "Lines", "NumberOfLines", 4, points, base);
      read_polygons(piece, "Polys", "NumberOfPolys", 7, points, base);
      read_polygons(piece, "Strips", "NumberOfStrips", 6, points, base);
    } else if (const std::uint64_t cells = number(piece, "NumberOfCells"); cells != 0) {
      read_cells(piece, points, cells, base);
    }
  }

  void read_ids(pugi::xml_node piece, std::uint64_t points) {
    const pugi::xml_node data = piece.child("PointData");
    pugi::xml_node array;
    for (const char* const known :
         {data.attribute("GlobalIds").value(), "GlobalPointIds", "original"})
      if (!array) array = data.find_child_by_attribute("DataArray", "Name", known);
    if (!array) {
      if (!ids_->empty()) fail(piece, "this piece does not number its points, others do");
      return;
    }
    if (ids_->size() + points != solid_.positions.size())
      fail(array, "this piece numbers its points, others do not");
    *ids_name_ = array.attribute("Name").value();
    values(array, "numbers of points", points, 1, [&](auto& in, NumberType type) {
      for (std::uint64_t i = 0; i < points; ++i) {
        const std::int64_t id = in.whole(type, "the number of a point");
        if (id < 0) in.fail("the number of a point is " + std::to_string(id));
        ids_->push_back(static_cast<std::uint64_t>(id));
      }
    });
  }

  /// Which cells of a piece are another's.
  std::vector<bool> ghosts_of(pugi::xml_node piece, std::uint64_t cells) {
    std::vector<bool> ghosts(cells, false);
    if (ids_ == nullptr) return ghosts;
    const pugi::xml_node data = piece.child("CellData");
    // Formerly levels, from 1 on.
    for (const char* const name : {"vtkGhostType", "vtkGhostLevels"}) {
      const pugi::xml_node array = data.find_child_by_attribute("DataArray", "Name", name);
      if (!array) continue;
      const bool levels = std::string_view(name) == "vtkGhostLevels";
      values(array, "ghosts of cells", cells, 1, [&](auto& in, NumberType type) {
        for (std::uint64_t c = 0; c < cells; ++c) {
          const std::int64_t mark = in.whole(type, "the ghost type of a cell");
          if (levels ? mark > 0 : (mark & 1) != 0) ghosts[c] = true;
        }
      });
    }
    return ghosts;
  }

  /// What PolyData has of one kind, whose cells all have this type. A kind that is not counted is
  /// not there.
  void read_polygons(pugi::xml_node piece, const char* kind, const char* count, std::int64_t type,
                     std::uint64_t points, std::size_t base) {
    const std::uint64_t cells = piece.attribute(count) ? number(piece, count) : 0;
    if (cells == 0) return;
    const VtkCells list = read_list(piece, kind, points, cells, base);
    for (std::uint64_t c = 0; c < cells; ++c)
      if (const auto wrong = add_vtk_cell(taker_, list, c, type)) fail(piece.child(kind), *wrong);
  }

  void read_cells(pugi::xml_node piece, std::uint64_t points, std::uint64_t cells,
                  std::size_t base) {
    const VtkCells list = read_list(piece, "Cells", points, cells, base);
    const std::vector<bool> ghosts = ghosts_of(piece, cells);
    values(cell_array(piece, "Cells", "types"), "types of cells", cells, 1,
           [&](auto& in, NumberType type) {
             for (std::uint64_t c = 0; c < cells; ++c) {
               const std::int64_t kind = in.whole(type, "the type of a cell");
               if (ghosts[c]) continue;
               if (const auto wrong = add_vtk_cell(taker_, list, c, kind)) in.fail(*wrong);
               if (regions_ != nullptr) owners_.take(solid_, regions_of_cells_.size() + c);
             }
           });
    if (regions_ != nullptr) read_regions(piece, cells);
  }

  VtkCells read_list(pugi::xml_node piece, const char* kind, std::uint64_t points,
                     std::uint64_t cells, std::size_t base) {
    VtkCells list;
    values(cell_array(piece, kind, "offsets"), "offsets", cells, 1, [&](auto& in, NumberType type) {
      list.ends.reserve(cells);
      std::int64_t before = 0;
      for (std::uint64_t c = 0; c < cells; ++c) {
        const std::int64_t end = in.whole(type, "the offset of a cell");
        if (end < before)
          in.fail("offset " + std::to_string(end) + " follows " + std::to_string(before));
        before = end;
        list.ends.push_back(static_cast<std::uint64_t>(end));
      }
    });
    const std::uint64_t corners = list.ends.back();
    values(cell_array(piece, kind, "connectivity"), "points of cells", corners, 1,
           [&](auto& in, NumberType type) {
             list.connectivity.reserve(corners);
             for (std::uint64_t i = 0; i < corners; ++i)
               list.connectivity.push_back(static_cast<std::uint32_t>(
                   base + read_vtk_corner(in, type, static_cast<std::size_t>(points))));
           });
    return list;
  }

  void read_regions(pugi::xml_node piece, std::uint64_t cells) {
    pugi::xml_node best;
    std::size_t rank = region_names.size();
    for (const pugi::xml_node array : piece.child("CellData").children("DataArray")) {
      const std::size_t found = region_rank(array.attribute("Name").value());
      if (found < rank) rank = found, best = array;
    }
    if (!best) no_regions(name_);
    values(best, "regions of cells", cells, 1, [&](auto& in, NumberType type) {
      for (std::uint64_t c = 0; c < cells; ++c) regions_of_cells_.push_back(read_region(in, type));
    });
    *regions_ = owners_.regions(regions_of_cells_);
  }

  pugi::xml_node cell_array(pugi::xml_node piece, const char* kind, const char* name) const {
    const pugi::xml_node array =
        piece.child(kind).find_child_by_attribute("DataArray", "Name", name);
    if (!array) fail(piece, "the piece has no array " + quote(name));
    return array;
  }

  /// Calls `read` with a source of the array's values, which must be `count` times `components`.
  template <class Read>
  void values(pugi::xml_node array, std::string_view what, std::uint64_t count,
              std::uint64_t components, Read read) {
    const std::string_view type_name = array.attribute("type").value();
    const auto type = vtk_number_type(type_name);
    if (!type) fail(array, "numbers of type " + quote(type_name) + " are not read");
    const std::string_view format = array.attribute("format").as_string("ascii");
    const std::string where = std::string(name_) + ":" + std::to_string(line_of(array)) +
                              ": array " + quote(array.attribute("Name").value());
    if (count > static_cast<std::uint64_t>(INT64_MAX) / components)
      throw InputError(where + " cannot hold " + std::to_string(count) + " " + std::string(what));

    if (format == "ascii") {
      const pugi::xml_node text = text_of(array);
      TextValues in(TextScanner(text.value(), name_, TextScanner::Backslash::ordinary,
                                line_of(text ? text : array)));
      checked_count(in, static_cast<std::int64_t>(count), what, *type, components);
      read(in, *type);
      in.finish(what);
      return;
    }
    if (encoding_.packing == VtuPacking::unknown)
      fail(array, "data packed by " + quote(compressor_) +
                      " are not read; save the file with zlib or without compression");
    std::string bytes;
    if (format == "binary") {
      bytes = decode_vtu_array(text_of(array).value(), true, encoding_, where, room_);
    } else if (format == "appended") {
      const std::uint64_t offset = number(array, "offset");
      if (offset > appended_.size())
        throw InputError(where + " starts at byte " + std::to_string(offset) + " of " +
                         std::to_string(appended_.size()) + " that are appended");
      bytes = decode_vtu_array(appended_.substr(offset), appended_base64_, encoding_, where, room_);
    } else {
      fail(array, "the format is " + quote(format) + "; known are ascii, binary and appended");
    }
    ByteValues in(bytes, where, encoding_.order);
    checked_count(in, static_cast<std::int64_t>(count), what, *type, components);
    read(in, *type);
    in.finish(what);
  }

  /// The text of an element, which may follow elements that it holds.
  static pugi::xml_node text_of(pugi::xml_node node) {
    for (const pugi::xml_node child : node.children())
      if (child.type() == pugi::node_pcdata) return child;
    return {};
  }

  // Meshes pack to a fifth or a tenth; what packs to a hundredth is no mesh.
  static constexpr std::uint64_t least_room = std::uint64_t{1} << 26, most_packed = 100;

  std::string_view bytes_;
  std::string_view name_;
  Regions* regions_;
  CellOwners owners_;
  std::vector<std::int64_t> regions_of_cells_;
  std::uint64_t room_;
  mutable std::size_t counted_ = 0;
  mutable std::size_t counted_line_ = 1;
  pugi::xml_document document_;
  std::string_view appended_;
  bool appended_base64_ = false;
  VtuEncoding encoding_;
  std::string_view compressor_;
  Mixed solid_;
  CellTaker taker_{solid_};
  std::vector<std::uint64_t>* ids_ = nullptr;
  std::string* ids_name_ = nullptr;  ///< where ids_ is
};

}  // namespace

Mixed parse_vtu(std::string_view bytes, std::string_view name) {
  return VtuReader(bytes, name).read();
}

SurfaceFilePart parse_vtu_part(std::string_view bytes, std::string_view name) {
  SurfaceFilePart part;
  part.name = name;
  Mixed cells = VtuReader(bytes, name).read_part(part);
  if (!cells.edges.empty() || !cells.tets.empty())
    throw InputError(part.name + ": has cells besides polygons, of which a part is made");
  part.positions = std::move(cells.positions);
  part.triangles = std::move(cells.triangles);
  return part;
}

Regions parse_vtu_regions(std::string_view bytes, std::string_view name) {
  Regions regions;
  (void)VtuReader(bytes, name, &regions).read();
  return regions;
}

// VTK's partitioned unstructured grid: a file that names others.
std::vector<std::filesystem::path> read_pvtu(const std::filesystem::path& file) {
  const FileBytes bytes(file);
  const auto line_of = [&](std::ptrdiff_t at) {
    const std::string_view before =
        bytes.view().substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(at, 0)));
    return std::to_string(1 + std::count(before.begin(), before.end(), '\n'));
  };
  pugi::xml_document document;
  const auto parsed = document.load_buffer(bytes.view().data(), bytes.view().size(),
                                           pugi::parse_default, pugi::encoding_utf8);
  if (!parsed)
    throw InputError(file.string() + ":" + line_of(parsed.offset) +
                     ": the XML is broken: " + parsed.description());
  const pugi::xml_node root = document.child("VTKFile");
  const std::string_view type = root.attribute("type").value();
  if (type != "PUnstructuredGrid")
    throw InputError(file.string() + ": the file is of type " + quote(type) +
                     "; a .pvtu is a PUnstructuredGrid");
  std::vector<std::filesystem::path> files;
  std::set<std::filesystem::path> seen;
  for (const pugi::xml_node piece : root.child("PUnstructuredGrid").children("Piece")) {
    const std::string_view source = piece.attribute("Source").value();
    if (source.empty())
      throw InputError(file.string() + ":" + line_of(piece.offset_debug()) +
                       ": a piece has no Source");
    if (!seen.insert(std::filesystem::path(source).lexically_normal()).second)
      throw InputError(file.string() + ":" + line_of(piece.offset_debug()) + ": names " +
                       quote(source) + " a second time");
    files.push_back(file.parent_path() / std::filesystem::path(source));
  }
  if (files.empty()) throw InputError(file.string() + ": names no pieces");
  return files;
}

}  // namespace plexway::io

#else

namespace plexway::io {

SurfaceFilePart parse_vtu_part(std::string_view bytes, std::string_view name) {
  (void)parse_vtu(bytes, name);
  return {};
}

std::vector<std::filesystem::path> read_pvtu(const std::filesystem::path&) {
  (void)parse_vtu({}, {});
  return {};
}

Mixed parse_vtu(std::string_view, std::string_view) {
  throw NotBuiltError(
      "this plexway reads no .vtu: install libpugixml-dev and build it again, or save the file as "
      "legacy .vtk");
}

Regions parse_vtu_regions(std::string_view bytes, std::string_view name) {
  (void)parse_vtu(bytes, name);
  return {};
}

}  // namespace plexway::io

#endif

namespace plexway::io {

SurfaceFilePart read_surface_part(const std::filesystem::path& file, std::size_t number) {
  SurfaceFilePart part = parse_vtu_part(FileBytes(file).view(), file.string());
  part.number = number;
  return part;
}

}  // namespace plexway::io
