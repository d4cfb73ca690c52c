#pragma once

#include <string>
#include <string_view>

#include <plexway/shape/field.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "shape/info/report.hpp"

namespace plexway {

/// What a report says of it: "input", "delaunay" or "refined"; and a sentence for people.
[[nodiscard]] std::string_view name_of(const TriangulationReport& report);
[[nodiscard]] std::string describe(const TriangulationReport& report);

/// What `info` says of the triangles: their shape, and what `auto` makes of it.
void add_shape(const TriangulationShape& shape, Json& json, Table& table);

}  // namespace plexway
