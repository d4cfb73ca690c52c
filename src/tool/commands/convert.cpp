#include <memory>
#include <string>

#include "shape/files/files.hpp"
#include "shape/info/report.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

struct ConvertCommand : InputCommand {
  std::string out;
};

void run_convert(const ConvertCommand& command) {
  check_output_name(command.out, command.input, conversion_extensions(), "output");
  ProgressLine progress(command.quiet);
  const Converted conversion = convert(command.input, command.out, read_options(command, progress));
  progress.clear();
  Summary summary(command.input, conversion.kind);
  summary.json["out"] = command.out;
  summary.json["vertices"] = conversion.vertices;
  summary.json["simplices"] = conversion.simplices;
  summary.table.add(conversion.kind,
                    counted(conversion.vertices, "vertices") +
                        (conversion.simplex_name.empty()
                             ? std::string()
                             : ", " + counted(conversion.simplices, conversion.simplex_name)));
  if (!conversion.note.empty()) summary.add("voxels", conversion.note, conversion.note);
  summary.took("load", conversion.load_seconds);
  summary.took("write", conversion.write_seconds);
  summary.print(command, {command.out});
}

}  // namespace

void add_convert_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<ConvertCommand>();
  CLI::App& app = *tool.add_subcommand(
      "convert", "Writes a surface, solid, level set, wireframe or cloud in another format");
  const OptionGroup add(app);
  add_input(app, *command);
  add("OUT", command->out, "OUT",
      "by extension: a surface .obj .off .ply .stl .glb .gltf .vtu .vtk, a solid\n"
      ".node .ele .mesh .msh .vtu .vtk, a level set .vdb, a wireframe .obj .edges\n"
      ".vtu .vtk .glb, a cloud .xyz .ply. A surface is filled where only solids fit,\n"
      "and of a solid the boundary is taken where only surfaces fit")
      ->required();
  add("--as", command->as, "KIND", as_help);
  add_merge_option(app, *command);
  add_report_options(app, *command);
  add_fill_options(app, command->fill);
  app.footer(
      "Examples:\n"
      "  plexway convert scan.stl scan.glb\n"
      "  plexway convert broken.stl clean.ply --repair --voxel 0.01\n"
      "  plexway convert organ.off organ.vdb --voxel 0.02\n"
      "  plexway convert fluid.vdb fluid.obj --grid surface\n"
      "  plexway convert fluid.vdb fluid.vtu\n"
      "  plexway convert organ.off organ.mesh --max-volume 1e-3\n"
      "  plexway convert organ.vtu organ.stl");
  app.callback([command, &action] { action = [command] { run_convert(*command); }; });
}

}  // namespace plexway::detail::cli
