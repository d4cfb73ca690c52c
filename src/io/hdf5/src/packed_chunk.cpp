#include "packed_chunk.hpp"

#include <zlib.h>

#include <new>

namespace plexway::hdf5 {

std::string packed_chunk(const std::string& bytes, std::size_t number_bytes, int level) {
  const std::size_t count = bytes.size() / number_bytes;
  std::string shuffled(bytes.size(), '\0');
  for (std::size_t b = 0; b < number_bytes; ++b)
    for (std::size_t i = 0; i < count; ++i) shuffled[b * count + i] = bytes[i * number_bytes + b];
  uLongf size = ::compressBound(static_cast<uLong>(shuffled.size()));
  std::string packed(size, '\0');
  // With room for the worst case only memory can be missing.
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(shuffled.data()),
                  static_cast<uLong>(shuffled.size()), level) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

}  // namespace plexway::hdf5
