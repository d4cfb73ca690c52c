#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/domain/concept.hpp>

namespace plexway {

/// How to fill a surface with tetrahedra, by TetGen.
struct FillOptions {
  double max_volume = 0;      ///< no tetrahedron is larger; 0: any. Cubed file units
  double quality = 2;         ///< bound on circumradius over shortest edge, > 1; 0: none
  bool keep_surface = false;  ///< add points inside only
  double max_seconds = 0;     ///< stop TetGen after so long; 0: never
  std::vector<std::array<double, 3>> holes = {};  ///< points in cavities that stay empty

  /// Whether any of them differs from its default.
  [[nodiscard]] bool given() const;
};

/// What is asked of level sets, by OpenVDB.
struct VolumeOptions {
  bool repair = false;    ///< take what a surface encloses: closes holes, sorts out overlaps
  std::string grid = {};  ///< which level set of a .vdb; empty: the only one
  /// Side of a voxel, > 0, in the file's unit: for `repair`, to cut a .vdb, to write one. A cloud
  /// is thinned to one point for each cube of this side (PCL).
  std::optional<double> voxel = {};
  bool writes_volume = false;  ///< the field will be written as a .vdb, with that voxel
};

/// How to make a domain of points.
struct CloudPreparation {
  std::optional<std::size_t> k = {};  ///< neighbours of each point; 16, or all within the radius
  std::optional<double> neighbour_radius = {};  ///< no neighbour is farther; file units
  std::optional<double> max_normal_angle = {};  ///< degrees (CloudOptions)
  bool denoise = false;                         ///< drop points that lie alone first (PCL)
  std::optional<double> deviations = {};        ///< with denoise: so many above the mean; 3
  bool smooth = false;                          ///< measure along a smooth surface near the points

  /// Whether any of them was.
  [[nodiscard]] bool given() const;
};

/// What is told while a domain is read, filled and looked through. Any may be empty.
struct ReadProgress {
  std::function<void(std::string_view)> stage = {};  ///< what begins: "reading knot.ply"
  /// How much of it is done, 0 to 1. Returning false stops with Cancelled.
  std::function<bool(double)> share = {};
  /// How many seconds it has taken, where nobody knows how much is done. As above.
  std::function<bool(double)> seconds = {};
  std::function<void(std::string_view)> note = {};  ///< a line for people
};

/// What messages call an option: a field of these structs, or a flag of the command line.
enum class Spelling {
  fields,  ///< max_volume
  flags,   ///< --max-volume
};
/// A field's name in that spelling.
[[nodiscard]] std::string spelled(Spelling spelling, std::string_view field);

/// How to read a domain from a file.
struct ReadOptions {
  /// What to take it as; nothing: what the file says. A surface may be taken as a solid (it is
  /// filled), its edges as a wireframe, its vertices as a cloud; a .msh, .vtu or .vtk as mixed:
  /// with its lines and triangles beside its tetrahedra.
  std::optional<DomainKind> as = {};
  /// How a surface is filled.
  FillOptions fill = {};
  /// How level sets are made and read.
  VolumeOptions volume = {};
  /// How points are made a domain.
  CloudPreparation cloud = {};
  /// Refuse a file of which something would be left out, guessed or mended, such as a face with a
  /// corner twice.
  bool strict = false;
  /// How messages name these options.
  Spelling spelling = Spelling::fields;
  /// What is told meanwhile.
  ReadProgress progress = {};
};

/// Throws UsageError for a value out of range.
void check(const ReadOptions& options);

/// "surface", "solid", "wireframe", "simplices", "cloud" or "mixed".
[[nodiscard]] std::string_view kind_name(DomainKind kind);
/// In a sentence: "surface", but "mixed domain" and "complex of simplices".
[[nodiscard]] std::string_view kind_noun(DomainKind kind);
/// The kind of that name, if there is one.
[[nodiscard]] std::optional<DomainKind> kind_named(std::string_view name);

}  // namespace plexway
