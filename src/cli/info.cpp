#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/error.hpp>

#include "commands.hpp"
#include "console.hpp"
#include "domain.hpp"
#include "progress.hpp"
#include "report.hpp"
#include "solve_options.hpp"
#include "surface_survey.hpp"

namespace plexway::cli {
namespace {

struct InfoCommand {
  std::string input;
  std::string as;
  bool devices = false;
  bool json = false;
  bool quiet = false;
};

void print_devices(bool json) {
  Json names = Json::array();
  std::string text;
  for (const char* const name : built_executors) {
    names.push_back(name);
    text += std::string(name) + "\n";
  }
  write_output(json ? json_text(Json{{"executors", names}}) : text);
}

SurfaceSummary summary_of(const Domain& domain) {
  return with_file_name(domain, [&] {
    const io::Triangles& surface = domain.surface();
    return TriangleMesh<double>(surface.positions, surface.triangles).summary();
  });
}

Json to_json(const InfoCommand& command, const Domain& domain, const SurfaceSummary& summary,
             const SurfaceSurvey& survey) {
  Json json;
  json["input"] = command.input;
  json["kind"] = domain.kind();
  json["vertices"] = summary.vertices;
  json["simplices"] = summary.faces;
  json["edges"] = summary.edges;
  json["components"] = summary.components;
  json["boundary_edges"] = summary.boundary_edges;
  json["non_manifold_edges"] = summary.non_manifold_edges;
  json["pinched_vertices"] = summary.pinched_vertices;
  json["unreferenced_vertices"] = summary.unreferenced_vertices;
  json["coincident_vertices"] = survey.coincident_vertices;
  json["degenerate_simplices"] = summary.degenerate_faces;
  json["slender_share"] = survey.slender_share;
  json["orientable"] = summary.orientable;
  json["bounding_box"] = {{"min", survey.low}, {"max", survey.high}};
  json["edge_length"] = {{"min", survey.shortest_edge},
                         {"mean", json_number(survey.mean_edge)},
                         {"max", json_number(survey.longest_edge)}};
  json["warnings"] = surface_warnings(summary, survey);
  return json;
}

std::string point_text(const std::array<double, 3>& point) {
  return "(" + short_number(point[0]) + ", " + short_number(point[1]) + ", " +
         short_number(point[2]) + ")";
}

std::string to_text(const InfoCommand& command, const Domain& domain, const SurfaceSummary& summary,
                    const SurfaceSurvey& survey) {
  Table table;
  table.add("input", command.input);
  table.add(std::string(domain.kind()), counted(summary.vertices, "vertices") + ", " +
                                            counted(summary.edges, "edges") + ", " +
                                            counted(summary.faces, domain.simplex_name()) + ", " +
                                            counted(summary.components, "components"));
  table.add("bounding box", point_text(survey.low) + " to " + point_text(survey.high));
  table.add("edge length", "min " + short_number(survey.shortest_edge) + ", mean " +
                               short_number(survey.mean_edge) + ", max " +
                               short_number(survey.longest_edge));
  table.add("slender", short_number(100 * survey.slender_share) +
                           " % of the triangles have an aspect ratio above 10");
  for (const std::string& warning : surface_warnings(summary, survey)) table.add("note", warning);
  return table.text();
}

void run_info(const InfoCommand& command) {
  if (command.devices) {
    if (!command.input.empty()) throw UsageError("--devices takes no INPUT");
    print_devices(command.json);
    flush_output();
    return;
  }
  if (command.input.empty()) throw UsageError("INPUT is required; try 'plexway info --help'");
  ProgressLine progress(command.quiet);
  progress.phase("reading " + command.input);
  const Domain domain = Domain::load(command.input, command.as);
  progress.phase("measuring");
  const SurfaceSummary summary = summary_of(domain);
  const SurfaceSurvey survey = survey_surface(domain.surface());
  progress.clear();
  write_output(command.json ? json_text(to_json(command, domain, summary, survey))
                            : to_text(command, domain, summary, survey));
  flush_output();
}

}  // namespace

void add_info_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App& app = *tool.add_subcommand("info", "What a domain is made of, and what may surprise");
  app.add_option("INPUT", command->input, "a surface: .obj .off .ply .stl")->type_name("FILE");
  app.add_option("--as", command->as, "what the input is: surface (default)")->type_name("KIND");
  app.add_flag("--devices", command->devices, "list the executors of this build instead");
  app.add_flag("--json", command->json, "print one JSON object");
  app.add_flag("--quiet,-q", command->quiet, "no progress");
  app.footer(
      "Examples:\n"
      "  plexway info knot.ply\n"
      "  plexway info knot.ply --json\n"
      "  plexway info --devices");
  app.callback([command, &action] { action = [command] { run_info(*command); }; });
}

}  // namespace plexway::cli
