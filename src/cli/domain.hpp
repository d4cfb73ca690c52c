#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/source/point_source.hpp>

#include "cloud.hpp"
#include "fill_options.hpp"
#include "progress.hpp"

namespace plexway::cli {

/// What a user may hand to the tool, as it stands in the file.
///
/// The commands know domains through this class; what differs from kind to kind is in solver.cpp,
/// dijkstra_peer.cpp and the info_*.cpp.
class Domain {
 public:
  using Shape = std::variant<io::Triangles, io::Tets, io::Edges, Cloud>;

  /// Reads `file`, and fills or unravels it where `as` (a kind's name) asks for that; else the
  /// extension tells the kind, an .obj without faces but with lines is a wireframe, and a .ply
  /// without faces a cloud.
  /// Throws InputError as the readers do, UsageError for a kind that does not exist or for `fill`
  /// or `cloud` where nothing is filled or there is no cloud, NotBuiltError for what this build
  /// lacks.
  static Domain load(const std::string& file, const std::string& as, const FillOptions& fill,
                     const CloudArguments& cloud, ProgressLine& progress);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const Shape& shape() const { return shape_; }
  /// The cloud if it is one, else null.
  [[nodiscard]] const Cloud* cloud() const { return std::get_if<Cloud>(&shape_); }
  /// "surface", "solid", "wireframe" or "cloud".
  [[nodiscard]] std::string_view kind() const;
  /// What its simplices are called, in the plural.
  [[nodiscard]] std::string_view simplex_name() const;
  [[nodiscard]] std::size_t vertices() const;
  /// As given: a cloud has none.
  [[nodiscard]] std::size_t simplices() const;
  /// Corners of a simplex.
  [[nodiscard]] std::span<const std::uint32_t> corners(std::size_t simplex) const;
  /// One a vertex; none at all in a wireframe that has only lengths.
  [[nodiscard]] std::span<const std::array<double, 3>> positions() const;

  /// How a level set came in: the grid and its voxels, or what was repaired; empty where none did.
  [[nodiscard]] const std::string& level_set_note() const { return level_set_note_; }

  /// Seconds that reading took, and those that filling a surface and finding the neighbours of a
  /// cloud took, if that was done.
  [[nodiscard]] double load_seconds() const { return load_seconds_; }
  [[nodiscard]] std::optional<double> mesh_seconds() const { return mesh_seconds_; }
  [[nodiscard]] std::optional<double> neighbour_seconds() const { return neighbour_seconds_; }

  /// The point of the domain closest to `point`; a vertex where it is that vertex. Among several,
  /// the one in the simplex with the lowest number. Of a cloud, the nearest point. Needs positions.
  /// Cost: linear.
  [[nodiscard]] PointSource closest(const std::array<double, 3>& point) const;
  /// Where a source is. Needs positions.
  [[nodiscard]] std::array<double, 3> position(const PointSource& source) const;

  /// Writes one distance a vertex; the extension of `out` picks the format. Throws as
  /// io::write_field; a cloud fits a .pcd as well, a solid a .vdb.
  void write_field(const std::filesystem::path& out, std::span<const double> distance,
                   std::span<const std::int32_t> label) const;
  /// The extensions that its fields may have.
  [[nodiscard]] std::span<const std::string_view> field_extensions() const;

 private:
  Domain() = default;

  void load_level_set(const std::string& file, bool surface, const VolumeOptions& volume,
                      ProgressLine& progress);

  std::filesystem::path file_;
  double voxel_ = 0;  ///< of a .vdb to write; 0: to be chosen
  std::string level_set_note_;
  Shape shape_;
  double load_seconds_ = 0;
  std::optional<double> mesh_seconds_;
  std::optional<double> neighbour_seconds_;
};

/// What INPUT may be, for the help of the commands.
inline constexpr const char* input_help =
    "a surface: .obj .off .ply .stl, GIfTI .gii, FreeSurfer's .white .pial and so on;\n"
    "a solid: .node .ele .mesh .msh .vtu .vtk,\n"
    ".poly .smesh through TetGen, and a level set .vdb through OpenVDB; a wireframe: .edges, or "
    ".obj with lines only;\n"
    "a cloud of points: .xyz, .ply without faces, and .pcd through PCL";
inline constexpr const char* as_help =
    "what to take it as: surface, solid (fills a surface with tetrahedra),\n"
    "wireframe (the edges alone) or cloud (the vertices of a surface alone);\n"
    "default: what the extension says";

/// What `build` makes of `domain`, with the file's name put in front of what is wrong with it: a
/// complex knows vertices and faces, but not where they came from.
template <class Build>
auto with_file_name(const Domain& domain, Build build) {
  try {
    return build();
  } catch (const InputError& error) {
    throw InputError(domain.file().string() + ": " + error.what());
  }
}

}  // namespace plexway::cli
