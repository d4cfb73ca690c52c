#include <cmath>
#include <memory>
#include <string>

#include <plexway/error.hpp>

#include "shape/tuning/tuning.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/report/console.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
namespace {

// The request, and what is typed otherwise than it is meant.
struct TuneCommand : TuningRequest {
  std::string what = "table";
  std::string step_rule = "fifth";
  std::string fitness = "mean";
  std::string triangulation = "input";
  bool json = false;
  bool quiet = false;
};

void run_tune(const TuneCommand& command) {
  TuningRequest request = command;
  request.table = choose<bool>("--what", command.what, {{"table", true}, {"saddles", false}});
  request.relative =
      choose<bool>("--fitness", command.fitness, {{"mean", false}, {"relative", true}});
  request.evolution.adapt =
      choose<bool>("--step-rule", command.step_rule, {{"fifth", true}, {"constant", false}});
  request.automatic =
      choose<bool>("--triangulation", command.triangulation, {{"input", false}, {"auto", true}});
  if (command.resume && command.checkpoint.empty())
    throw UsageError("--resume goes with --checkpoint FILE");
  check_outputs_differ({command.out, command.cpp, command.checkpoint});
  ProgressLine progress(command.quiet);
  const TuningOutcome outcome = run_tuning(request, read_progress(progress));
  progress.clear();

  const double error = outcome.mean_error;
  const char* const usual = request.table ? "centroid" : "standard";
  const double reference = outcome.baselines[usual].get<double>();
  Json json = outcome.settings;
  json["evaluated"] = outcome.evaluated;
  json["complete"] = outcome.complete;
  json["baselines"] = outcome.baselines;
  json["mean_error"] = error;
  json["improvement"] = json_number(1 - error / reference);
  json["found"] = outcome.found;
  json["seconds"] = {{"load", outcome.load_seconds}, {"tune", outcome.tune_seconds}};
  if (command.json) {
    write_output(json_text(json));
  } else if (!command.quiet) {
    Table text;
    text.add("set",
             counted(command.inputs.size(), "surfaces") + ", " + counted(outcome.fields, "fields"));
    text.add("evaluations", std::to_string(outcome.evaluated) +
                                (outcome.complete ? "" : ", not all: go on with --resume"));
    for (const auto& [name, value] : outcome.baselines.items())
      text.add(name, "mean error " + short_number(value.get<double>()));
    text.add("found", "mean error " + short_number(error) + ", " +
                          short_number(100 * std::abs(1 - error / reference)) + " % " +
                          (error > reference ? "more" : "less") + " than " + usual);
    for (std::size_t i = 0; i < outcome.best.size(); ++i)
      text.add(outcome.parameters[i].name, short_number(outcome.best[i]));
    text.add("time", short_time(outcome.tune_seconds));
    add_written(text, {command.out, command.cpp, command.checkpoint});
    write_output(text.text());
  }
  flush_output();
}

}  // namespace

void add_tune_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<TuneCommand>();
  CLI::App& app = *tool.add_subcommand(
      "tune", "Fit a policy to surfaces with exact answers, by a (1+1) evolution strategy");
  const OptionGroup add(app);
  add("INPUT", command->inputs, "FILE",
      "surfaces, each with the exact answers NAME.vID.txt beside it:\n"
      "distances from vertex ID, one a line in vertex order")
      ->required();
  add("--truth-dir", command->truth_folder, "DIR", "the exact answers are in this folder");
  add("--what", command->what, "NAME",
      "table (default): thresholds and shares of --visibility tuned;\n"
      "saddles: which vertices the default policy bends paths at");
  add("--from", command->from, "NAME",
      "where the first start begins: random (default); of a table centroid,\n"
      "published, learned; of saddles standard; or a .json of this command");
  add("--seed", command->evolution.seed, "S", "another number, another result (default 1)")
      ->check(CLI::NonNegativeNumber);
  add("--evaluations", command->evolution.evaluations, "N", "of each start (default 300)")
      ->check(CLI::Range(1, 1'000'000));
  add("--restarts", command->evolution.restarts, "N",
      "so many starts, all but the first at random; the best counts (default 1)")
      ->check(CLI::Range(1, 10'000));
  add("--mutation", command->evolution.step, "X",
      "first standard deviation, as a share of each range (default 0.2)");
  add("--fitness", command->fitness, "NAME",
      "what is made small: mean (default), the mean error of all fields; or\n"
      "relative: the geometric mean of each beside what centroid (standard)\n"
      "has there");
  add("--step-rule", command->step_rule, "NAME",
      "fifth (default): the deviation follows the one-fifth rule; or constant");
  add("--triangulation", command->triangulation, "NAME",
      "input (default), or auto: the triangles that 'distance' would choose");
  add("--threads", command->threads, "N",
      "fields at once (default: all cores); the result does not depend on it")
      ->check(CLI::Range(1, 4096));
  add("--out,-o", command->out, "FILE", "write what was found as JSON");
  add("--cpp", command->cpp, "FILE", "write it as C++");
  add("--checkpoint", command->checkpoint, "FILE",
      "keep here where it is, every few seconds and at the end");
  app.add_flag("--resume", command->resume, "go on from the checkpoint");
  add("--stop-after", command->stop_after, "N",
      "stop after so many evaluations in this run, to be resumed")
      ->check(CLI::Range(1, 1'000'000'000));
  app.add_flag("--json", command->json, "print one JSON object");
  app.add_flag("--quiet,-q", command->quiet, "no summary, no notes, no progress");
  app.footer(
      "Examples:\n"
      "  plexway tune *.obj --out table.json --restarts 4 --checkpoint tune.ckpt\n"
      "  plexway tune *.obj --out table.json --restarts 4 --checkpoint tune.ckpt --resume\n"
      "  plexway tune scan.ply --from learned --evaluations 100 --cpp table.inc\n"
      "  plexway tune *.obj --what saddles --from standard --triangulation auto\n"
      "  plexway distance scan.ply --source vertex:0 --visibility tuned --table table.json");
  app.callback([command, &action] { action = [command] { run_tune(*command); }; });
}

}  // namespace plexway::detail::cli
