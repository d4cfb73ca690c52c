#pragma once

#include <cstddef>
#include <string>

namespace plexway::hdf5 {

/// What HDF5's filters shuffle and deflate make of the bytes of a chunk: all first bytes of its
/// numbers, all second bytes and so on, as a stream of zlib's.
[[nodiscard]] std::string packed_chunk(const std::string& bytes, std::size_t number_bytes,
                                       int level);

}  // namespace plexway::hdf5
