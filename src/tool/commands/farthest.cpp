#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/sampling/farthest_points.hpp>

#include "shape/arguments/arguments.hpp"
#include "shape/files/files.hpp"
#include "tool/app.hpp"
#include "tool/commands/sampling_command.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

struct FarthestCommand : SamplingCommand {
  std::size_t count = 0;
  double radius = 0;
  std::vector<std::string> sources;
};

void run_farthest(const FarthestCommand& command) {
  const Precision precision = precision_of(command);
  if (command.count == 0 && !(command.radius > 0))
    throw UsageError("give --count, --radius or both, > 0");
  if (!(command.radius >= 0)) throw UsageError("--radius must be >= 0");
  check_outputs(command);
  const auto arguments = parse_sources(
      command.sources.empty() ? std::vector<std::string>{"vertex:0"} : command.sources);
  ProgressLine progress(command.quiet);
  Phases phases;
  const Domain domain = load_domain(command, progress);
  phases.end("load");
  const auto start = locate_sources(domain, arguments);
  FarthestOptions options;
  options.count = command.count == 0 ? std::numeric_limits<std::size_t>::max() : command.count;
  options.radius = command.radius;
  options.progress = progress.share_callback();
  progress.phase("looking for the farthest points");
  FarthestPoints found;
  std::vector<double> nearest;  // to the points found, where a picture shows it
  Notes notes = with_sampled(domain, precision, [&](const auto& complex, const auto& numbers) {
    phases.end("build");
    found = farthest_points(Serial{}, complex, numbers.inside(start), options);
    phases.end("search");
    if (command.picture.wanted()) {
      const auto field = solve(Serial{}, complex, std::span<const PointSource>(found.points));
      nearest.assign(field.distance.begin(), field.distance.end());
      numbers.spread(nearest);
    }
    numbers.outside(found.points);
  });
  if (!command.out.empty())
    write_points(command.out, domain, found.points, "distance", found.distance);
  SceneContent content;
  content.distance = nearest;
  draw_points(command, domain, found.points, content);
  phases.end("write");
  progress.clear();

  Summary summary = points_summary(command, domain, "points", found.points.size());
  summary.add("covering", json_number(found.covering),
              "no vertex is farther than " + short_number(found.covering));
  report_picture(command.picture, domain, summary);
  notes.add(far_notes(domain, arguments, start));
  add_parts_without(notes, domain, found.points, "points");
  finish(summary, command, found.statistics, phases, notes);
}

}  // namespace

void add_farthest_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<FarthestCommand>();
  CLI::App& app = *tool.add_subcommand(
      "farthest", "Vertices one after the other, each the farthest from those before");
  const OptionGroup add(app);
  add_sampling_options(app, *command, "write the points and how far each was: .csv .npy .obj .ply");
  add_verbose_option(app, *command);
  add_picture_options(app, command->picture);
  add("--count,-n", command->count, "N", "so many points, the first ones included")
      ->check(CLI::NonNegativeNumber);
  add("--radius,-r", command->radius, "R", "or stop when no vertex is farther than this");
  add("--source,-s", command->sources, "WHERE",
      "where to start: vertex:ID or point:X,Y,Z (default vertex:0); repeatable")
      ->allow_extra_args(false);
  app.footer(
      "Examples:\n"
      "  plexway farthest knot.ply --count 100 --out landmarks.ply\n"
      "  plexway farthest knot.ply --count 50 --picture landmarks.png\n"
      "  plexway farthest elbow.mesh --radius 0.5 --source vertex:3 --out cover.csv");
  app.callback([command, &action] { action = [command] { run_farthest(*command); }; });
}

}  // namespace plexway::detail::cli
