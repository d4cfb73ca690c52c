#pragma once

#include <plexway/any_domain.hpp>
#include <plexway/shape/isolines.hpp>

namespace plexway {

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

}  // namespace plexway
