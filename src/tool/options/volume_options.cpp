#include "tool/options/volume_options.hpp"

#include <CLI/CLI.hpp>

namespace plexway::cli {

void add_volume_options(CLI::App& command, VolumeOptions& options) {
  const std::string group = "Voxels";
  command
      .add_flag("--repair", options.repair,
                "take what a surface encloses, by a level set (OpenVDB): closes holes, and\n"
                "triangles may cross, overlap and look either way")
      ->group(group);
  command
      .add_option("--voxel", options.voxel,
                  "side of a voxel, in the file's unit: for --repair (default: chosen), to cut a\n"
                  ".vdb into tetrahedra (default: its own), for --out of a .vdb; a cloud is\n"
                  "thinned first, to one point for each cube of this side (PCL)")
      ->type_name("SIZE")
      ->group(group);
  command.add_option("--grid", options.grid, "which level set of a .vdb (default: the only one)")
      ->type_name("NAME")
      ->group(group);
}

}  // namespace plexway::cli
