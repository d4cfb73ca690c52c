#include "field_formats.hpp"

namespace plexway::io {

void write_csv(OutputFile& out, const Field& field) {
  out.write(field.label.empty() ? "vertex,x,y,z,distance\n" : "vertex,x,y,z,distance,label\n");
  for (std::size_t i = 0; i < field.distance.size(); ++i) {
    out.write_text(i);
    for (const double c : field.surface.positions[i]) {
      out.write(",");
      out.write_text(c);
    }
    out.write(",");
    out.write_text(field.distance[i]);
    if (!field.label.empty()) {
      out.write(",");
      out.write_text(field.label[i]);
    }
    out.write("\n");
  }
}

}  // namespace plexway::io
