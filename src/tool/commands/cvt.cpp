#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/poisson_disk.hpp>
#include <plexway/solve.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/files/files.hpp"
#include "tool/app.hpp"
#include "tool/commands/sampling_command.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

struct CvtCommand : SamplingCommand {
  std::size_t count = 0, iterations = 100;
  std::uint64_t seed = 1;
  double tolerance = 1e-3;
  std::string centre = "centroid", cells, dual;
};

struct CvtResult {
  CentroidalVoronoi voronoi;
  std::vector<double> distance;
  std::vector<Index> label;
};

CellCentre centre_of(const CvtCommand& command) {
  return choose<CellCentre>(
      "--centre", command.centre,
      {{"centroid", CellCentre::centroid}, {"border", CellCentre::farthest_from_border}});
}

template <class Complex>
CvtResult compute(const Complex& complex, const SampledNumbers& numbers, const CvtCommand& command,
                  ProgressLine& progress, Phases& phases) {
  CvtResult result;
  phases.end("build");
  PoissonOptions throwing;
  throwing.count = command.count;
  throwing.seed = command.seed;
  progress.phase("throwing darts");
  const PoissonDisks start = poisson_disks(Serial{}, complex, throwing);
  phases.end("start");
  VoronoiOptions options;
  options.centre = centre_of(command);
  options.max_iterations = command.iterations;
  options.tolerance = command.tolerance;
  progress.phase("moving seeds");
  std::size_t done = 0;
  options.progress = [&](const VoronoiStep& step) {
    progress.phase("iteration " + std::to_string(++done) + ": energy " + short_number(step.energy) +
                   ", movement " + short_number(step.movement));
    return true;
  };
  result.voronoi = centroidal_voronoi(Serial{}, complex, start.darts, options);
  phases.end("move");
  const std::vector<PointSource> seeds = result.voronoi.seeds;
  numbers.outside(result.voronoi.seeds);
  if (command.cells.empty() && command.dual.empty() && !command.picture.wanted()) return result;
  const auto field = solve(Serial{}, complex, std::span<const PointSource>(seeds));
  result.distance.assign(field.distance.begin(), field.distance.end());
  result.label = field.label;
  if (result.label.empty())
    for (const double d : result.distance) result.label.push_back(std::isfinite(d) ? 0 : none);
  numbers.spread(result.distance);
  numbers.spread(result.label);
  phases.end("cells");
  return result;
}

void run_cvt(const CvtCommand& command) {
  const Precision precision = precision_of(command);
  if (command.count == 0) throw UsageError("--count must be > 0");
  if (!(command.tolerance >= 0)) throw UsageError("--tolerance must be >= 0");
  static_cast<void>(centre_of(command));
  check_output_name(command.cells, command.input, io::field_extensions(), "--cells");
  check_output_name(command.dual, command.input, io::triangle_output_extensions(), "--dual");
  check_outputs(command, command.cells, command.dual);

  ProgressLine progress(command.quiet);
  Phases phases;
  const Domain domain = load_domain(command, progress);
  phases.end("load");
  if (!command.dual.empty()) require("--dual", support(Purpose::duals, domain.kind()));
  CvtResult result;
  Notes notes = with_sampled(domain, precision, [&](const auto& complex, const auto& numbers) {
    result = compute(complex, numbers, command, progress, phases);
  });
  const CentroidalVoronoi& voronoi = result.voronoi;
  if (!command.out.empty())
    write_points(command.out, domain, voronoi.seeds, "content", voronoi.cell_content);
  std::vector<std::int32_t> labels;
  for (const Index l : result.label)
    labels.push_back(l == none ? -1 : static_cast<std::int32_t>(l));
  SceneContent content;
  content.distance = result.distance;
  content.label = labels;
  draw_points(command, domain, voronoi.seeds, content);
  if (!command.cells.empty()) domain.write_field(command.cells, result.distance, labels);
  DualTriangulation dual;
  if (!command.dual.empty()) {
    const auto& surface = std::get<io::Triangles>(domain.data());
    dual = dual_triangulation(surface.triangles, result.label, voronoi.seeds.size());
    io::Triangles shown;
    for (const PointSource& seed : voronoi.seeds) shown.positions.push_back(domain.position(seed));
    shown.triangles = dual.triangles;
    io::write_triangles(command.dual, shown);
  }
  phases.end("write");
  progress.clear();

  Summary summary = points_summary(command, domain, "seeds", voronoi.seeds.size(),
                                   ", " + counted(voronoi.steps.size(), "iterations") +
                                       (voronoi.converged ? "" : "; not at rest yet"));
  Json& json = summary.json;
  json["converged"] = voronoi.converged;
  json["energy"] = voronoi.energy;
  json["steps"] = Json::array();
  for (const VoronoiStep& step : voronoi.steps)
    json["steps"].push_back({{"energy", step.energy}, {"movement", step.movement}});
  if (!voronoi.steps.empty())
    summary.table.add("energy", short_number(voronoi.steps.front().energy) + " at first, " +
                                    short_number(voronoi.energy) + " now");
  if (!command.dual.empty()) {
    json["dual"]["triangles"] = dual.triangles.size();
    json["dual"]["manifold"] = dual.manifold;
    json["dual"]["irregular"] = dual.irregular;
    summary.table.add(
        "dual",
        counted(dual.triangles.size(), "triangles") +
            (dual.manifold ? "" : "; no manifold at " + counted(dual.irregular.size(), "seeds")));
  }
  phases.tell(summary);
  report_picture(command.picture, domain, summary);
  add_parts_without(notes, domain, voronoi.seeds, "seeds");
  summary.print(
      command,
      {command.out, command.cells, command.dual, command.picture.file, command.picture.html},
      notes);
  notes.say(command.quiet);
}

}  // namespace

void add_cvt_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<CvtCommand>();
  CLI::App& app = *tool.add_subcommand(
      "cvt", "Points in the middle of their Voronoi cells (centroidal Voronoi tessellation)");
  const OptionGroup add(app);
  add_sampling_options(app, *command, "write the seeds: .csv .npy .obj .ply by extension");
  add_picture_options(app, command->picture);
  add("--count,-n", command->count, "N", "so many seeds")
      ->required()
      ->check(CLI::NonNegativeNumber);
  add("--seed", command->seed, "S", "of the Poisson disks that it starts from (default 1)")
      ->check(CLI::NonNegativeNumber);
  add("--iterations", command->iterations, "N", "at most so many (default 100)")
      ->check(CLI::NonNegativeNumber);
  add("--tolerance", command->tolerance, "T",
      "stop when seeds move by less, in sizes of a cell (default 0.001)");
  add("--centre", command->centre, "NAME",
      "where a seed moves in its cell: centroid (default), or border: where it is\n"
      "farthest from the border");
  add_output(app, "--cells", command->cells,
             "write each vertex's distance and cell: .csv .ply .vtk .vtu", "csv");
  add_output(app, "--dual", command->dual, "write the triangles of seeds: .obj .off .ply", "obj");
  app.footer(
      "Examples:\n"
      "  plexway cvt knot.ply --count 500 --cells cells.vtu --dual remeshed.obj\n"
      "  plexway cvt knot.ply --count 200 --picture cells.png\n"
      "  plexway cvt elbow.mesh --count 50 --iterations 20 --out seeds.csv --json");
  app.callback([command, &action] { action = [command] { run_cvt(*command); }; });
}

}  // namespace plexway::detail::cli
