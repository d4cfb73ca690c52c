#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/bytes.hpp"

namespace plexway::io {

/// What a NumPy array file, version 1.0, starts with: a magic word, the length of the header, the
/// header (a Python literal, padded so that the data starts at a multiple of 64). `descr` is quoted
/// or a list, `shape` what stands between the brackets: "3," or "3, 4".
inline std::string npy_header(std::string_view descr, std::string_view shape) {
  using namespace std::string_view_literals;
  constexpr auto magic = "\x93NUMPY\x01\x00"sv;
  std::string header = "{'descr': " + std::string(descr) + ", 'fortran_order': False, 'shape': (" +
                       std::string(shape) + "), }";
  while ((magic.size() + sizeof(std::uint16_t) + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  const auto length = little_endian(static_cast<std::uint16_t>(header.size()));
  return std::string(magic) + std::string(length.data(), length.size()) + header;
}

}  // namespace plexway::io
