#include "tool/options/triangulation_option.hpp"

#include <CLI/CLI.hpp>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "shape/arguments/require.hpp"

namespace plexway::cli {

void add_triangulation_option(CLI::App& command, TriangulationArgument& argument) {
  command
      .add_option("--triangulation", argument.name,
                  "surfaces: which triangles to solve on: input, delaunay (the intrinsic\n"
                  "Delaunay triangulation of the vertices), refined (that, with a quarter more\n"
                  "vertices inside), or auto (default: what the shape of the input's triangles\n"
                  "calls for; 'plexway info' tells). Results are for the input's vertices")
      ->type_name("NAME")
      ->group("How to solve");
}

Triangulation triangulation_of(const TriangulationArgument& argument) {
  if (argument.name == "input") return Triangulation::input;
  if (argument.name == "delaunay") return Triangulation::delaunay;
  if (argument.name == "refined") return Triangulation::refined;
  if (argument.name == "auto") return Triangulation::automatic;
  throw UsageError("--triangulation '" + argument.name +
                   "': choose one of input, delaunay, refined, auto");
}

void check_triangulation(Triangulation wanted, const Domain& domain) {
  if (on_other_triangles(wanted))
    require("--triangulation", support(Purpose::triangulations, domain.kind()));
}

}  // namespace plexway::cli
