#pragma once

#include <cstdint>
#include <span>

#include <plexway/io/triangles.hpp>

#include "output_file.hpp"

namespace plexway::io {

/// What a format has to write: `distance` has one value a vertex, `label` too or is empty.
struct Field {
  const Triangles& surface;
  std::span<const double> distance;
  std::span<const std::int32_t> label;
};

void write_csv(OutputFile& out, const Field& field);
void write_npy(OutputFile& out, const Field& field);
void write_ply(OutputFile& out, const Field& field);
void write_vtu(OutputFile& out, const Field& field);

}  // namespace plexway::io
