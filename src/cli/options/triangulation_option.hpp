#pragma once

#include <string>
#include <string_view>

#include <plexway/any/field.hpp>
#include <plexway/complex/intrinsic_delaunay.hpp>

#include "cli/options/input.hpp"
#include "cli/report/report.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// As typed.
struct TriangulationArgument {
  std::string name = "auto";
};

/// Adds --triangulation to a command, in the group of the options that say how to solve.
void add_triangulation_option(CLI::App& command, TriangulationArgument& argument);

/// Throws UsageError for a name that does not exist.
Triangulation triangulation_of(const TriangulationArgument& argument);

/// Throws UsageError where `delaunay` or `refined` is asked of what is no surface.
void check_triangulation(Triangulation wanted, const Domain& domain);

/// What a report says of it: "input", "delaunay" or "refined"; and a sentence for people.
[[nodiscard]] std::string_view name_of(const TriangulationReport& report);
[[nodiscard]] std::string describe(const TriangulationReport& report);

/// What `info` says of the triangles: their shape, and what `auto` makes of it.
void add_shape(const TriangulationShape& shape, Json& json, Table& table);

}  // namespace plexway::cli
