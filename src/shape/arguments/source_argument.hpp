#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <plexway/source/source.hpp>

#include <plexway/shape/shape.hpp>

#include "shape/arguments/point_argument.hpp"

namespace plexway {

/// What `--source` of `plexway distance` says, before the domain is known.
struct SetArgument {
  enum class Kind { point, vertices, boundary, segment, polyline, simplex, circle };
  std::string text;   ///< as typed
  std::string place;  ///< without the offset
  Kind kind = Kind::point;
  std::vector<double> numbers;  ///< of segments and circles
  std::string file;             ///< of vertices and polylines
  Index simplex = none;
  double offset = 0;
};

/// What `--source` may be, for help and errors.
extern const char* const source_set_help;

/// Reads vertex:ID, point:X,Y,Z, vertices:FILE, boundary, segment:X,Y,Z,X,Y,Z, polyline:FILE,
/// triangle:ID (or simplex:ID) and circle:X,Y,Z,R, each with +offset behind it if wanted. Throws
/// UsageError for anything else.
std::vector<SetArgument> parse_source_sets(const std::vector<std::string>& texts);

/// The sources in `domain`. Points of segments and polylines are joined by shortest paths. Throws
/// InputError for what the domain or a file has not, UsageError for what the kind of domain cannot
/// start from. `measured`: by a metric, so boundaries of solids are their vertices alone.
/// Boundaries are those of what a mask leaves open; it may be null.
std::vector<Source> locate_source_sets(const AnyShape& domain,
                                       std::span<const SetArgument> arguments,
                                       bool measured = false, const Mask* mask = nullptr);

/// If all of them are points: as points.
std::vector<PointSource> as_points(std::span<const Source> sources);

/// Are there curves or triangles on a surface? They lie in its triangles as they are.
bool have_shapes(const AnyShape& domain, std::span<const Source> sources);

/// Points of those that are asked for by coordinates, but for polylines, and where they are in the
/// domain.
struct AskedPoints {
  std::vector<SourceArgument> asked;
  std::vector<PointSource> found;
};
AskedPoints asked_points(std::span<const SetArgument> arguments, std::span<const Source> sources);

/// For people.
std::string describe_source_set(const AnyShape& domain, const SetArgument& argument,
                                const Source& source);

}  // namespace plexway
