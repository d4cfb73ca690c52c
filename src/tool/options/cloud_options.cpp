#include "tool/options/cloud_options.hpp"

#include <CLI/CLI.hpp>

namespace plexway::cli {

void add_cloud_options(CLI::App& command, CloudPreparation& options) {
  const std::string group = "How to make a complex of points";
  command
      .add_option("--k", options.k,
                  "neighbours of each point (default 16); with --neighbour-radius at most so\n"
                  "many, and without --k all within it")
      ->check(CLI::Range(1, 1000))
      ->type_name("K")
      ->group(group);
  command
      .add_option("--neighbour-radius", options.neighbour_radius,
                  "no neighbour is farther away (default: any)")
      ->type_name("R")
      ->group(group);
  command
      .add_option("--max-normal-angle", options.max_normal_angle,
                  "refuse neighbours whose normals differ by more degrees (default 60), such as\n"
                  "those across a thin gap")
      ->type_name("DEGREES")
      ->group(group);
  command
      .add_flag("--denoise", options.denoise,
                "first drop points that lie alone, by the distance to their neighbours\n"
                "(through PCL)")
      ->group(group);
  command
      .add_option("--deviations", options.deviations,
                  "with --denoise: how many standard deviations above the mean are too many\n"
                  "(default 3; fewer drop more)")
      ->type_name("X")
      ->group(group);
  command
      .add_flag("--smooth", options.smooth,
                "measure along a smooth surface near the points: noise makes paths longer")
      ->group(group);
}

}  // namespace plexway::cli
