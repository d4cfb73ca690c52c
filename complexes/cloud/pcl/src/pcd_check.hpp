#pragma once

#include <cstddef>
#include <string_view>

namespace plexway::pcl {

/// What a .pcd promises, once it is known that it keeps it.
struct PcdPromise {
  std::size_t points = 0;
  std::size_t point_bytes = 0;
};

/// Looks whether `bytes`, all of a .pcd, are what their header says: fields with x, y and z, sizes,
/// types and counts of each, as many points as width times height, and data for just so many: of
/// ascii a line of numbers for each, of binary the bytes, of binary_compressed the two lengths in
/// front. `name` stands for the file in messages.
///
/// PCL's reader takes a word for 0, a short line for the origin, and crashes on files without a
/// header; so it only gets to see files that pass. Throws InputError "NAME:LINE: cause".
PcdPromise check_pcd(std::string_view bytes, std::string_view name);

}  // namespace plexway::pcl
