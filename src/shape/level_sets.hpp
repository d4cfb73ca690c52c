#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/isolines.hpp>

namespace plexway::detail {

/// Is the field of a solve known inside of triangles, so that isolines may be arcs: from points,
/// without a device, unbounded, on all of a surface that lies in space as it is measured?
[[nodiscard]] bool is_known_inside(const AnyDomain& domain, const AnyExecutor& executor,
                                   const SourceList& sources, const PropagateOptions& options);

/// Does a picture show more where the field is known inside? Triangles are large enough in it to
/// see that lines bend in them, and the surface is flat: elsewhere smaller triangles in the same
/// planes would show as facets.
[[nodiscard]] bool shows_inside(const AnyDomain& domain);

/// The field of `shape` as fine as a picture of it shows: within a quarter of a pixel.
[[nodiscard]] FineField field_for_picture(const AnyShape& shape, const AnyPathField& field);

///@{
/// The extensions of files of level sets: lines on surfaces, clouds and mixed domains, surfaces in
/// solids. Of any kind, and of one (UsageError where it has none).
[[nodiscard]] std::vector<std::string_view> level_set_extensions();
[[nodiscard]] std::span<const std::string_view> level_set_extensions(DomainKind kind);
///@}

/// The multiples of a step > 0 that a field reaches. Throws UsageError for more than 10000.
[[nodiscard]] std::vector<double> level_set_values(std::span<const double> distance, double step);

/// Writes where a field that was solved on `domain` has the values: in a solid its surfaces, with
/// the value at each vertex where the format has room for it; elsewhere lines, which are arcs
/// within `tolerance` where `paths` is there, and straight in triangles else. `shown` is what they
/// lie in: the domain's shape, or what is open of it. Throws as isolines (shape/isolines.hpp), and
/// Error "cannot write FILE: reason".
void write_level_sets(const std::filesystem::path& out, const AnyShape& shown,
                      const AnyDomain& domain, const AnyField& field, const AnyPathField* paths,
                      std::span<const double> values, double tolerance);

}  // namespace plexway::detail
