#include "field_formats.hpp"

namespace plexway::io {

void write_csv(OutputFile& out, const Field& field) {
  out.write(field.positions.empty() ? "vertex,distance" : "vertex,x,y,z,distance");
  if (!field.label.empty()) out.write(",label");
  if (!field.original.empty()) out.write(",original");
  out.write(field.error.empty() ? "\n" : ",error\n");
  for (std::size_t i = 0; i < field.distance.size(); ++i) {
    out.write_text(i);
    if (!field.positions.empty()) {
      for (const double c : field.positions[i]) {
        out.write(",");
        out.write_text(c);
      }
    }
    out.write(",");
    out.write_text(field.distance[i]);
    if (!field.label.empty()) {
      out.write(",");
      out.write_text(field.label[i]);
    }
    if (!field.original.empty()) {
      out.write(",");
      out.write_text(field.original[i]);
    }
    if (!field.error.empty()) {
      out.write(",");
      out.write_text(field.error[i]);
    }
    out.write("\n");
  }
}

}  // namespace plexway::io
