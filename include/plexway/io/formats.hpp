#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/domain/concept.hpp>

namespace plexway::io {

/// How a file is read.
enum class FileReader {
  cells,      ///< read_cells
  points,     ///< read_points
  edges,      ///< read_edges
  simplices,  ///< read_simplices
  boundary,   ///< by TetGen: component tetgen
  level_set,  ///< by OpenVDB: component openvdb
  cloud,      ///< by PCL: component pcl
  prepared,   ///< by AnyShape::read
};

/// A format that is read. Help, messages and docs/reference/formats.md follow the one table of
/// them.
struct Format {
  std::string_view extensions;   ///< with the dot, in lower case, blanks between them
  std::string_view name;         ///< what it is called
  FileReader reader;             ///< what reads it
  unsigned kinds;                ///< what it may hold, a bit each: see may_hold
  std::string_view taken;        ///< what of it is read
  std::string_view passed_over;  ///< what is not

  /// Whether it may hold a domain of this kind.
  [[nodiscard]] constexpr bool may_hold(DomainKind kind) const {
    return (kinds >> static_cast<unsigned>(kind) & 1U) != 0;
  }
};

/// All of them.
[[nodiscard]] std::vector<Format> formats();

/// The format of a file: by its extension, or by its first bytes where that is unknown. Throws
/// InputError for one that is not known, with what to do about it where that is.
[[nodiscard]] Format format_of(const std::filesystem::path& file);

/// The extensions of formats that may hold this kind: ".obj .off .ply".
[[nodiscard]] std::string extensions_of(DomainKind kind);
/// "surfaces .obj .off ..., solids ..., wireframes ..., clouds ..., simplices ..., prepared ...".
[[nodiscard]] std::string known_formats();

}  // namespace plexway::io
