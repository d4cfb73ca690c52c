#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include <plexway/executors/joined_rows.hpp>

#include "io/numbers.hpp"

namespace plexway::io {

/// How blocks of arrays are compressed.
enum class VtuPacking { none, zlib, lz4, lzma, unknown };

/// By the name that a file gives it; none for an empty one.
VtuPacking vtu_packing(std::string_view compressor);

/// How the arrays of a VTK XML file are stored.
struct VtuEncoding {
  std::endian order = std::endian::little;
  NumberType header = NumberType::u32;  ///< of the lengths in front of each array
  VtuPacking packing = VtuPacking::none;
};

/// The bytes of the array that starts at the front of `data`, which may go on behind it.
///
/// `base64` tells how `data` is written; otherwise it is raw. `where` starts the messages. Memory
/// is requested only as far as `data` can fill it. Throws InputError, or NotBuiltError if it takes
/// a library that is not there.
///
/// `room` is how many bytes the arrays of the file may still come to: it gets less by this one, and
/// an array that needs more is refused before it is unpacked. Pieces may share an array, and each
/// counts.
std::string decode_vtu_array(std::string_view data, bool base64, const VtuEncoding& encoding,
                             const std::string& where, std::uint64_t& room);

/// A .vtu as a part of a surface; `name` stands for the file in messages.
SurfaceFilePart parse_vtu_part(std::string_view bytes, std::string_view name);

}  // namespace plexway::io
