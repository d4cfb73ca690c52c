#pragma once

#include <functional>
#include <string>

#include "bricks.hpp"

namespace plexway::openvdb {

/// What comes ahead of a grid's bricks.
struct GridHead {
  Frame frame;
  float background = 0;
  std::string name;
  std::size_t active = 0;
};

/// Reads a file with OpenVDB, in this process: `head` is told first, then each brick. Throws
/// InputError without the file's name, whatever OpenVDB throws, or crashes.
void copy_grid(const std::string& file, const std::string& grid,
               const std::function<void(const GridHead&)>& head, const BrickTaker& brick);

}  // namespace plexway::openvdb
