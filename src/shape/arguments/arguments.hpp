#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <plexway/common/mask.hpp>
#include <plexway/error.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source.hpp>
#include <plexway/support.hpp>

namespace plexway::detail {

/// Throws UsageError "NAME: sentence" unless it is yes; the name is an option's, or a file's.
inline void require(const std::string& name, Support support) {
  if (!support) throw UsageError(name + ": " + support.sentence());
}

/// The same where a file is to blame: InputError.
inline void require_input(const std::string& name, Support support) {
  if (!support) throw InputError(name + ": " + support.sentence());
}

/// What `--source` says, before the domain is known.
struct SourceArgument {
  std::string text;  ///< as typed
  /// A vertex by its number in the file (`none` for a number that no file can have), or a point.
  std::variant<Index, std::array<double, 3>> where;
  std::string role = "source";  ///< what messages call it, and "--" before it the option
};

/// Reads `vertex:ID` and `point:X,Y,Z`. Throws UsageError for anything else.
SourceArgument parse_source(const std::string& text, const std::string& role = "source");
std::vector<SourceArgument> parse_sources(const std::vector<std::string>& texts,
                                          const std::string& role = "source");

/// "did you mean 'vertex:7'? " for a bare number or a bare point, else empty.
std::string meant_place(std::string_view text);

/// A finite number, and so many between commas (0: any number of them).
std::optional<double> number_of(std::string_view text);
std::optional<std::vector<double>> numbers_of(std::string_view text, std::size_t count);
/// "X,Y,Z" as finite numbers.
std::optional<std::array<double, 3>> parse_point(std::string_view text);

/// The source in `domain`. Throws InputError for a vertex that is not there, and for a point where
/// the domain has no positions.
PointSource locate_source(const AnyShape& domain, const SourceArgument& argument);
std::vector<PointSource> locate_sources(const AnyShape& domain,
                                        const std::vector<SourceArgument>& arguments);

/// How far a point that was requested is from where it is in the domain; nothing for a vertex.
std::optional<double> distance_from(const AnyShape& domain, const SourceArgument& argument,
                                    const PointSource& source);

/// A note of each that is farther from the domain than 1 % of its diagonal.
std::vector<std::string> far_notes(const AnyShape& domain,
                                   const std::vector<SourceArgument>& arguments,
                                   std::span<const PointSource> found);

/// For people: "vertex 12", or "point:1,2,3 (triangle 7, 0.01 away)".
std::string describe_source(const AnyShape& domain, const SourceArgument& argument,
                            const PointSource& source);

/// Points of a domain out of FILE: a vertex (0-based) a line, or the .csv that `farthest`,
/// `poisson` and `cvt` write. `role` is the option it came by. Throws InputError "FILE:LINE:
/// cause".
[[nodiscard]] std::vector<PointSource> read_point_list(const std::string& file,
                                                       const AnyShape& domain);

/// The same where only vertices will do. Throws InputError for another point.
[[nodiscard]] std::vector<Index> read_vertex_list(const std::string& file, const AnyShape& domain,
                                                  const std::string& role);

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

/// Points of those that are requested by coordinates, but for polylines, and where they are in the
/// domain.
struct AskedPoints {
  std::vector<SourceArgument> asked;
  std::vector<PointSource> found;
};
AskedPoints asked_points(std::span<const SetArgument> arguments, std::span<const Source> sources);

/// For people.
std::string describe_source_set(const AnyShape& domain, const SetArgument& argument,
                                const Source& source);

/// As typed, or nothing: vertices:FILE or simplices:FILE, numbers; FILE:3,7, what has these labels
/// in a file of labels of vertices (io::read_vertex_labels); or regions:3,7, what has these in the
/// input's own file (AnyShape::regions).
struct MaskArgument {
  std::string text;
};

/// The file, or nothing. Throws UsageError for what is none of these.
[[nodiscard]] std::string mask_file(const MaskArgument& argument);

/// What is closed of a domain, or null. Throws InputError "FILE:LINE: cause", where nothing stays
/// open, and for a label or region that nothing has; UsageError for a cloud.
[[nodiscard]] std::shared_ptr<const Mask> read_mask(const MaskArgument& argument,
                                                    const AnyShape& domain);

///@{
/// Throws InputError for a place that is closed, or cut off from everything. Null closes nothing.
void require_open(const Mask* mask, const AnyShape& domain, std::span<const PointSource> points);
void require_open(const Mask* mask, const AnyShape& domain, std::span<const Source> sources);
///@}

/// As typed: KIND:FILE, or nothing.
struct MetricArgument {
  std::string text;
};

/// May an edge have two lengths?
enum class Jumps { refract, smooth };

/// The FILE of KIND:FILE, or nothing. Throws UsageError for what is not KIND:FILE.
std::string metric_file(const MetricArgument& argument);

/// Reads the metric's file and measures the domain; null where none is requested. Throws InputError
/// "FILE: cause", UsageError for a cloud, and for a domain that this kind of metric cannot measure.
std::shared_ptr<const MeasuredLengths> measure(const MetricArgument& argument,
                                               const AnyShape& domain, Jumps jumps);

}  // namespace plexway::detail
