#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <plexway/source/point_source.hpp>

#include <plexway/shape/shape.hpp>

namespace plexway {

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

/// "X,Y,Z" as finite numbers.
std::optional<std::array<double, 3>> parse_point(std::string_view text);

/// The source in `domain`. Throws InputError for a vertex that is not there, and for a point where
/// the domain has no positions.
PointSource locate_source(const AnyShape& domain, const SourceArgument& argument);
std::vector<PointSource> locate_sources(const AnyShape& domain,
                                        const std::vector<SourceArgument>& arguments);

/// How far a point that was asked for is from where it is in the domain; nothing for a vertex.
std::optional<double> distance_from(const AnyShape& domain, const SourceArgument& argument,
                                    const PointSource& source);

/// A note of each that is farther from the domain than 1 % of its diagonal.
std::vector<std::string> far_notes(const AnyShape& domain,
                                   const std::vector<SourceArgument>& arguments,
                                   std::span<const PointSource> found);

/// For people: "vertex 12", or "point:1,2,3 (triangle 7, 0.01 away)".
std::string describe_source(const AnyShape& domain, const SourceArgument& argument,
                            const PointSource& source);

}  // namespace plexway
