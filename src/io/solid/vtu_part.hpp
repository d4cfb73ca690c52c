#pragma once

#include <string_view>

#include <plexway/executors/joined_rows.hpp>

namespace plexway::io {

/// A .vtu as a part of a surface; `name` stands for the file in messages.
SurfaceFilePart parse_vtu_part(std::string_view bytes, std::string_view name);

}  // namespace plexway::io
