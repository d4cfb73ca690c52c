#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include <plexway/apps/distance_matrix.hpp>
#include <plexway/error.hpp>

#include "cli/commands/commands.hpp"
#include "cli/commands/sampling_command.hpp"
#include "cli/options/source_argument.hpp"
#include "cli/report/console.hpp"
#include "cli/report/distance_output.hpp"
#include "cli/report/point_output.hpp"
#include "cli/report/progress.hpp"

namespace plexway::cli {
namespace {

struct PairsCommand : SamplingCommand {
  std::vector<std::string> sources;
};

void run_pairs(const PairsCommand& command) {
  const Precision precision = precision_of(command);
  check_output_name(command.out, command.input, matrix_file_extensions());
  const auto arguments = parse_sources(command.sources);
  ProgressLine progress(command.quiet);
  const Domain domain =
      load_domain(command.input, command.as, command.fill, command.cloud, progress);
  const auto points = locate_sources(domain, arguments);
  progress.phase("solving");
  DistanceMatrix matrix;
  double seconds = 0;
  with_sampled(domain, precision, [&](const auto& complex) {
    const Stopwatch solving;
    matrix = distance_matrix(Serial{}, complex, points, [&](double share) {
      progress.done(share);
      return true;
    });
    seconds = solving.seconds();
  });
  if (!command.out.empty()) write_matrix(command.out, matrix.size, matrix.distance);
  progress.clear();

  PointSummary summary(command, domain, points.size());
  summary.json["asymmetry"] = matrix.asymmetry;
  summary.table.add("two ways",
                    "differ by " + short_number(matrix.asymmetry) + " of the shorter at most");
  summary.finish(command, matrix.statistics, seconds);
  if (matrix.asymmetry > 0.01 && !command.quiet)
    say_note("the two ways between some points, there and back, differ by " +
             short_number(100 * matrix.asymmetry) +
             " %, so one of them is off by half of that or more: 'plexway path' is more exact");
}

}  // namespace

void add_pairs_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<PairsCommand>();
  CLI::App& app =
      *tool.add_subcommand("pairs", "The matrix of distances between chosen points, symmetric");
  add_sampling_options(app, *command, "write the matrix: .csv or .npy");
  app.add_option("--source,-s", command->sources, "a point: vertex:ID or point:X,Y,Z; repeat it")
      ->required()
      ->type_name("WHERE")
      ->allow_extra_args(false);
  app.footer(
      "Example:\n"
      "  plexway pairs knot.ply -s vertex:0 -s vertex:50 -s point:1,0,0.5 --out matrix.csv");
  app.callback([command, &action] { action = [command] { run_pairs(*command); }; });
}

}  // namespace plexway::cli
