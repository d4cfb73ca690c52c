#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/number_type.hpp"

namespace plexway::io {

enum class PlyFormat { ascii, little_endian, big_endian };
using PlyType = NumberType;  // all but the 64-bit whole numbers

struct PlyProperty {
  std::string_view name;
  PlyType type;  ///< of the value, or of the list's items
  bool is_list = false;
  PlyType count_type = PlyType::u8;  ///< lists only
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;  ///< as the header says; not yet checked against the data
  std::size_t line = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;  ///< bytes, up to where the data starts
  std::size_t lines = 0;
};

/// Reads the header at the front of `bytes`; the names in it point into `bytes`. Throws InputError.
PlyHeader parse_ply_header(std::string_view bytes, std::string_view name);

}  // namespace plexway::io
