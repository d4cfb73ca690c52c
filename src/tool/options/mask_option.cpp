#include "tool/options/mask_option.hpp"

#include <CLI/CLI.hpp>

namespace plexway::cli {

void add_mask_option(CLI::App& command, MaskArgument& argument) {
  command
      .add_option(
          "--mask", argument.text,
          "where no path may go: vertices:FILE or simplices:FILE, a number (0-based) a\n"
          "line; a vertex closes the simplices about it; FILE:3,7 closes the vertices with\n"
          "these labels (.label.gii, .annot, .label, or one a line); regions:3,7 closes\n"
          "these regions of a .msh, .vtu or .vtk")
      ->type_name("WHAT");
}

}  // namespace plexway::cli
