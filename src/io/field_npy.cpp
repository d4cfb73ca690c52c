// NumPy's array file, version 1.0: a magic word, the length of the header, the header (a Python
// literal, padded so that the data starts at a multiple of 64), the data.

#include <string>

#include "field_formats.hpp"

namespace plexway::io {

void write_npy(OutputFile& out, const Field& field) {
  using namespace std::string_view_literals;
  constexpr auto magic = "\x93NUMPY\x01\x00"sv;
  const bool records = !field.original.empty();
  std::string header =
      "{'descr': " + std::string(records ? "[('distance', '<f8'), ('original', '<u4')]" : "'<f8'") +
      ", 'fortran_order': False, 'shape': (" + std::to_string(field.distance.size()) + ",), }";
  const std::size_t before = magic.size() + sizeof(std::uint16_t);
  while ((before + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  out.write(magic);
  out.write_binary(static_cast<std::uint16_t>(header.size()));
  out.write(header);
  for (std::size_t i = 0; i < field.distance.size(); ++i) {
    out.write_binary(field.distance[i]);
    if (records) out.write_binary(field.original[i]);
  }
}

}  // namespace plexway::io
