#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/sampling/poisson_disk.hpp>

#include "io/number_rows.hpp"
#include "shape/files/files.hpp"
#include "tool/app.hpp"
#include "tool/commands/sampling_command.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

struct PoissonCommand : SamplingCommand {
  std::optional<double> radius;
  std::optional<std::size_t> count;
  std::uint64_t seed = 1;
  std::string order = "uniform", spacing;
  bool vertices = false;
};

// One number a line.
std::vector<double> read_spacing(const std::string& file) {
  std::vector<double> spacing;
  for (const io::NumberRow& row :
       io::read_number_rows(file, 1, 1, "a number > 0 a line, for each vertex")) {
    if (!(row.numbers[0] > 0))
      throw InputError(file + ":" + std::to_string(row.line) + ": expected a number > 0");
    spacing.push_back(row.numbers[0]);
  }
  return spacing;
}

void run_poisson(const PoissonCommand& command) {
  const Precision precision = precision_of(command);
  if (command.radius.has_value() == command.count.has_value())
    throw UsageError("give one of --radius and --count");
  if (command.radius && (!(*command.radius > 0) || std::isinf(*command.radius)))
    throw UsageError("--radius must be a number > 0");
  if (command.count && *command.count == 0) throw UsageError("--count must be > 0");
  const auto order =
      choose<DartOrder>("--order", command.order,
                        {{"uniform", DartOrder::uniform}, {"simplices", DartOrder::simplices}});
  check_outputs(command);
  check_output_place(command.out, {&command.spacing, 1}, "--out");
  const std::vector<double> spacing =
      command.spacing.empty() ? std::vector<double>{} : read_spacing(command.spacing);

  ProgressLine progress(command.quiet);
  Phases phases;
  const Domain domain = load_domain(command, progress);
  phases.end("load");
  if (!spacing.empty() && spacing.size() != domain.vertices())
    throw InputError(command.spacing + ": " + counted(spacing.size(), "numbers") + " for " +
                     counted(domain.vertices(), "vertices"));
  PoissonOptions options;
  options.radius = command.radius.value_or(0);
  options.count = command.count.value_or(0);
  options.seed = command.seed;
  options.order = order;
  options.at_vertices = command.vertices;
  options.spacing = spacing;
  options.progress = progress.share_callback();
  progress.phase("throwing darts");
  PoissonDisks disks;
  Notes notes = with_sampled(domain, precision, [&](const auto& complex, const auto& numbers) {
    phases.end("build");
    disks = poisson_disks(Serial{}, complex, options);
    numbers.outside(disks.darts);
    phases.end("throw");
  });
  if (!command.out.empty()) write_points(command.out, domain, disks.darts);
  SceneContent content;
  content.look_inside = true;
  draw_points(command, domain, disks.darts, content);
  phases.end("write");
  progress.clear();

  Summary summary = points_summary(command, domain, "darts", disks.darts.size(),
                                   ", radius " + short_number(disks.radius) +
                                       (disks.maximal ? "" : "; a few more would find room"));
  summary.json["radius"] = disks.radius;
  summary.json["maximal"] = disks.maximal;
  summary.json["thrown"] = disks.thrown;
  summary.json["taken_back"] = disks.taken_back;
  if (command.verbose) summary.table.add("thrown", counted(disks.thrown, "darts"));
  report_picture(command.picture, domain, summary);
  add_parts_without(notes, domain, disks.darts, "darts");
  finish(summary, command, disks.statistics, phases, notes);
}

}  // namespace

void add_poisson_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<PoissonCommand>();
  CLI::App& app = *tool.add_subcommand(
      "poisson", "Points no nearer to each other than a radius, and none missing (Poisson disks)");
  const OptionGroup add(app);
  add_sampling_options(app, *command, "write the points: .csv .npy .obj .ply by extension");
  add_verbose_option(app, *command);
  add_picture_options(app, command->picture);
  add("--radius,-r", command->radius, "R",
      "no two points are nearer, no point of the domain is farther");
  add("--count,-n", command->count, "N", "or so many points; the radius is searched for")
      ->check(CLI::NonNegativeNumber);
  add("--seed", command->seed, "S", "another number, another sample (default 1)")
      ->check(CLI::NonNegativeNumber);
  add("--order", command->order, "NAME",
      "where darts go: uniform (default), or simplices: one after the other in\n"
      "random order, denser where they are small");
  add("--spacing", command->spacing, "FILE",
      "a number a line for each vertex: the radius there is R times that");
  app.add_flag("--vertices", command->vertices, "only vertices are chosen, and only they covered");
  app.footer(
      "Examples:\n"
      "  plexway poisson knot.ply --radius 0.1 --out darts.ply\n"
      "  plexway poisson knot.ply --count 1000 --seed 7 --out darts.csv --json\n"
      "  plexway poisson knot.ply --count 1000 --picture darts.png --view top\n"
      "  plexway poisson elbow.mesh --radius 0.2 --out darts.obj");
  app.callback([command, &action] { action = [command] { run_poisson(*command); }; });
}

}  // namespace plexway::detail::cli
