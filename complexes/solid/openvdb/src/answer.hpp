#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

namespace plexway::openvdb {

/// The name of the program that reads files with OpenVDB.
constexpr const char* helper_name = "plexway-openvdb";

/// What the helper says, each followed by what it announces.
enum class Word : std::uint32_t {
  ready = 1,  ///< it runs; what happens from here on is the file's doing
  head,       ///< frame, background, active voxels (64 bits), name
  brick,      ///< its corner, 512 values
  inside,     ///< the corner of a brick that lies inside as a whole
  end,
  complaint,  ///< a text: the file is to blame
  no_memory   ///< less than the helper would have allowed itself
};

/// What a whole file of that size can need, by far; a damaged one may ask for anything.
constexpr std::uint64_t bytes_needed(std::uintmax_t file_bytes) {
  return (std::uint64_t{2} << 30) + 400 * static_cast<std::uint64_t>(file_bytes);
}

/// Seconds of a processor that it may take.
constexpr std::uint64_t seconds_needed(std::uintmax_t file_bytes) {
  return 20 + static_cast<std::uint64_t>(file_bytes) / (1 << 20);
}

/// As messages show numbers: of any size, six digits.
inline std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

}  // namespace plexway::openvdb
