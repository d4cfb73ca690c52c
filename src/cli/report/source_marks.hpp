#pragma once

#include <plexway/source/source.hpp>

#include "cli/options/picture_options.hpp"

namespace plexway::cli {

/// Puts a source into a picture: points as balls, lines and the rims of triangles as tubes, sets of
/// up to 200 vertices as dots. Circles show by themselves: the distance is 0 there. A domain
/// without positions has no place for any.
void add_source_mark(const Domain& domain, const Source& source, PictureContent& content);

}  // namespace plexway::cli
