#include <memory>
#include <string>
#include <variant>

#include <plexway/io/tets.hpp>
#include <plexway/shape/support.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/files/files.hpp"
#include "shape/info/info_report.hpp"
#include "shape/info/report.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

struct TetrahedralizeCommand : InputCommand {
  std::string out;
};

void run_tetrahedralize(const TetrahedralizeCommand& command) {
  check_output_name(command.out, command.input, io::tet_extensions());
  (void)filling(command.fill);
  if (!is_vdb(command.input) && !(command.fill.volume.repair && !command.fill.given()))
    require_tetgen("tetrahedralize");
  ProgressLine progress(command.quiet);
  const Domain domain = load_domain(command, progress);
  if (!domain.mesh_seconds())
    require_input(command.input + ": is a solid already",
                  support(Reading::filling, {DomainKind::solid, DomainKind::solid}));
  const auto& solid = std::get<io::Tets>(domain.data());
  progress.phase("writing " + command.out);
  io::write_tets(command.out, solid);
  progress.clear();
  const SolidSurvey survey = survey_solid(domain);
  Summary summary(command.input, domain.kind_name());
  summary.json["out"] = command.out;
  summary.json["vertices"] = domain.vertices();
  summary.json["simplices"] = domain.simplices();
  if (!domain.level_set_note().empty())
    summary.add("voxels", domain.level_set_note(), domain.level_set_note());
  summary.table.add("solid", size_text(domain, domain.simplices()));
  summary.add(
      "volume", json_number(survey.volume),
      short_number(survey.volume) + ", largest tetrahedron " + short_number(survey.largest_volume));
  summary.json["largest_volume"] = json_number(survey.largest_volume);
  summary.took_loading(domain);
  summary.print(command, {command.out});
}

}  // namespace

void add_tetrahedralize_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<TetrahedralizeCommand>();
  command->as = "solid";
  CLI::App& app = *tool.add_subcommand("tetrahedralize",
                                       "Fills a closed surface with tetrahedra, by TetGen (AGPL)");
  add_input(app, *command, "a closed surface, or TetGen's .poly .smesh; a level set: .vdb");
  add_output(app, "--out,-o", command->out,
             "write the solid: .node .ele .mesh .msh .vtu .vtk by extension (- for .mesh on\n"
             "standard output). The vertices of the surface come first, with their numbers",
             "mesh");
  app.get_option("--out")->required();
  add_report_options(app, *command);
  add_fill_options(app, command->fill);
  app.footer(
      "Examples:\n"
      "  plexway tetrahedralize organ.off --out organ.vtu\n"
      "  plexway tetrahedralize organ.off --out organ.mesh --max-volume 1e-3 --quality 1.5\n"
      "  plexway tetrahedralize shell.stl --out shell.ele --hole 0,0,0 --keep-surface --json\n"
      "  plexway tetrahedralize broken.stl --repair --voxel 0.01 --out clean.vtu\n"
      "  plexway tetrahedralize fluid.vdb --grid surface --out fluid.mesh\n"
      "  plexway tetrahedralize part.poly --out part.msh");
  app.callback([command, &action] { action = [command] { run_tetrahedralize(*command); }; });
}

}  // namespace plexway::detail::cli
