// VTK's partitioned unstructured grid: a file that names others.

#include <plexway/io/pvtu.hpp>

#include <plexway/error.hpp>

#if PLEXWAY_IO_PUGIXML
#include <algorithm>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#endif

#include "io/file_bytes.hpp"
#include "io/quote.hpp"
#include "vtu_part.hpp"

namespace plexway::io {

#if PLEXWAY_IO_PUGIXML

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

#else

std::vector<std::filesystem::path> read_pvtu(const std::filesystem::path&) {
  (void)parse_vtu_part({}, {});
  return {};
}

#endif

SurfaceFilePart read_surface_part(const std::filesystem::path& file, std::size_t number) {
  SurfaceFilePart part = parse_vtu_part(FileBytes(file).view(), file.string());
  part.number = number;
  return part;
}

}  // namespace plexway::io
