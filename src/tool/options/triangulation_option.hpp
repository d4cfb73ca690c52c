#pragma once

#include <string>

#include <plexway/shape/field.hpp>

#include "shape/info/triangulation_words.hpp"
#include "tool/options/input.hpp"

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

}  // namespace plexway::cli
