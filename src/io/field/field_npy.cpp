#include <string>

#include "field_formats.hpp"
#include "npy_header.hpp"

namespace plexway::io {

void write_npy(OutputFile& out, const Field& field) {
  const bool records = !field.original.empty();
  out.write(npy_header(records ? "[('distance', '<f8'), ('original', '<u4')]" : "'<f8'",
                       std::to_string(field.distance.size()) + ","));
  for (std::size_t i = 0; i < field.distance.size(); ++i) {
    out.write_binary(field.distance[i]);
    if (records) out.write_binary(field.original[i]);
  }
}

}  // namespace plexway::io
