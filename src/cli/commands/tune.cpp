#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <plexway/apps/tuning.hpp>
#include <plexway/error.hpp>
#include <plexway/version.hpp>

#include "cli/commands/commands.hpp"
#include "cli/report/console.hpp"
#include "cli/report/distance_output.hpp"
#include "cli/report/progress.hpp"
#include "cli/report/report.hpp"
#include "cli/report/table_file.hpp"
#include "cli/report/tune_files.hpp"

namespace plexway::cli {
namespace {

struct TuneCommand {
  std::vector<std::string> inputs;
  std::string truth_folder;
  std::string what = "table";
  std::string from = "random";
  std::string step_rule = "fifth";
  std::string fitness = "mean";
  std::string triangulation = "input";
  EvolutionOptions evolution;
  std::size_t threads = 0;
  std::size_t stop_after = std::numeric_limits<std::size_t>::max();
  std::string out, cpp, checkpoint;
  bool resume = false;
  bool json = false;
  bool quiet = false;
};

// Six digits: a result that can be printed, and is what was measured.
double rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::stod(text);
}
std::vector<double> rounded(std::vector<double> values) {
  for (double& x : values) x = rounded(x);
  return values;
}

// What is tuned: how its numbers make a mean error, and a file.
class Subject {
 public:
  Subject(bool table, bool relative, TuningSet& set) : table_(table), set_(set) {
    if (relative) {
      PropagateOptions reference;
      if (table) reference.visibility = Visibility::centroid;
      reference_ = set.errors(reference);
    }
    if (table) options_.visibility = Visibility::tuned;
  }

  // What evolution makes small: the mean error, or the geometric mean of each field's beside what
  // it was at first: then surfaces where all policies are good count as much as those where none
  // is.
  double score(const std::vector<double>& values) {
    if (reference_.empty()) return error(values);
    take(values);
    const std::vector<double> errors = set_.errors(options_);
    constexpr double rounding = 1e-6;  // less is not worth anything
    double sum = 0;
    for (std::size_t i = 0; i < errors.size(); ++i)
      sum += std::log(std::max(errors[i], rounding) / std::max(reference_[i], rounding));
    return std::exp(sum / static_cast<double>(errors.size()));
  }

  double error(const std::vector<double>& values) {
    take(values);
    return set_.mean_error(options_);
  }
  [[nodiscard]] Json json(const std::vector<double>& values) const {
    return table_ ? to_json(probe_table_of(values)) : to_json(saddle_thresholds_of(values));
  }
  [[nodiscard]] std::string cpp(const std::vector<double>& values) const {
    return table_ ? to_cpp(probe_table_of(values)) : to_cpp(saddle_thresholds_of(values));
  }
  // What the outcome is to be compared with.
  Json baselines() {
    Json errors;
    if (table_) {
      PropagateOptions centroid;
      centroid.visibility = Visibility::centroid;
      errors["centroid"] = set_.mean_error(centroid);
      errors["published"] = error(values_of(ProbeTable::published()));
      errors["learned"] = error(values_of(ProbeTable::learned()));
    } else {
      errors["standard"] = error(values_of(SaddleThresholds::standard()));
    }
    return errors;
  }

 private:
  void take(const std::vector<double>& values) {
    if (table_)
      options_.probe = probe_table_of(values);
    else
      set_.rebuild(saddle_thresholds_of(values));
  }

  bool table_;
  TuningSet& set_;
  std::vector<double> reference_;
  PropagateOptions options_;
};

void check(const TuneCommand& command) {
  const auto choose = [](const char* option, const std::string& typed, const std::string& a,
                         const std::string& b) {
    if (typed != a && typed != b)
      throw UsageError(std::string(option) + " '" + typed + "': choose one of " + a + ", " + b);
  };
  choose("--what", command.what, "table", "saddles");
  choose("--fitness", command.fitness, "mean", "relative");
  choose("--step-rule", command.step_rule, "fifth", "constant");
  choose("--triangulation", command.triangulation, "input", "auto");
  if (command.resume && command.checkpoint.empty())
    throw UsageError("--resume goes with --checkpoint FILE");
  check_outputs_differ({command.out, command.cpp, command.checkpoint});
}

std::vector<double> start_of(const TuneCommand& command) {
  const bool table = command.what == "table";
  if (command.from == "random") return {};
  if (table && command.from == "centroid") return {5, 4, 0.5, 1, 1, 1, 1, 1, 1};
  if (table && command.from == "published") return values_of(ProbeTable::published());
  if (table && command.from == "learned") return values_of(ProbeTable::learned());
  if (!table && command.from == "standard") return values_of(SaddleThresholds::standard());
  if (command.from.find('.') == std::string::npos)
    throw UsageError("--from '" + command.from + "': choose one of random, " +
                     (table ? "centroid, published, learned" : "standard") +
                     ", or a .json file of 'plexway tune'");
  return table ? values_of(read_probe_table(command.from))
               : values_of(read_saddle_thresholds(command.from));
}

std::string hexadecimal(std::uint64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

// All that the outcome depends on.
Json settings_of(const TuneCommand& command, const TuningSet& set) {
  return {{"what", command.what},
          {"seed", command.evolution.seed},
          {"evaluations", command.evolution.evaluations},
          {"restarts", command.evolution.restarts},
          {"from", command.from},
          {"start", command.evolution.start},
          {"mutation", command.evolution.step},
          {"step-rule", command.step_rule},
          {"fitness", command.fitness},
          {"triangulation", command.triangulation},
          {"surfaces", command.inputs.size()},
          {"fields", set.fields()},
          {"digest", hexadecimal(set.digest())}};
}

// Evaluations until all are done or this run has had enough.
void evolve(const TuneCommand& command, const Json& settings, Subject& subject,
            Evolution& evolution, ProgressLine& progress) {
  const double all =
      static_cast<double>(command.evolution.evaluations * command.evolution.restarts);
  Stopwatch since_saved;
  const auto save = [&] {
    if (!command.checkpoint.empty())
      write_checkpoint(command.checkpoint, settings, evolution.state());
    since_saved = Stopwatch();
  };
  const auto describe = [&] {
    return "start " + std::to_string(evolution.state().restart + 1) + ", best " +
           short_number(-evolution.best_fitness());
  };
  progress.phase("tuning");
  for (std::size_t i = 0; i < command.stop_after && !evolution.done(); ++i) {
    const std::size_t start = evolution.state().restart;
    if (evolution.tell(-subject.score(rounded(evolution.propose()))))
      progress.phase("tuning: " + describe());
    progress.done(static_cast<double>(evolution.evaluations()) / all);
    if (since_saved.seconds() > 2) save();
    if (evolution.state().restart > start)
      progress.note("start " + std::to_string(start + 1) + " of " +
                    std::to_string(command.evolution.restarts) + ": the best so far is " +
                    short_number(-evolution.best_fitness()));
  }
  save();
}

std::string comment(const TuneCommand& command, const Json& settings, double error) {
  std::string text = "// plexway " + std::string(version_string) + " tune --what " + command.what +
                     " --from " + command.from + " --seed " +
                     std::to_string(command.evolution.seed) + " --evaluations " +
                     std::to_string(command.evolution.evaluations) + " --restarts " +
                     std::to_string(command.evolution.restarts) + " --fitness " + command.fitness +
                     " --triangulation " + command.triangulation + "\n";
  return text + "// on " + counted(command.inputs.size(), "surfaces") + ", " +
         counted(settings["fields"].get<std::size_t>(), "fields") + ", digest " +
         settings["digest"].get<std::string>() + "; mean error " + short_number(error) + "\n";
}

void run_tune(TuneCommand command) {
  check(command);
  command.evolution.adapt = command.step_rule == "fifth";
  command.evolution.start = start_of(command);
  const bool table = command.what == "table";

  ProgressLine progress(command.quiet);
  progress.phase("reading " + counted(command.inputs.size(), "surfaces"));
  const Stopwatch loading;
  TuningInput input = read_tuning_surfaces(command.inputs, command.truth_folder);
  // Hours lie between here and the result: what cannot be written is told now.
  check_output_place(command.out, input.files, "--out");
  check_output_place(command.cpp, input.files, "--cpp");
  check_output_place(command.checkpoint, input.files, "--checkpoint");
  TuningSet set(std::move(input.surfaces), command.triangulation == "auto", command.threads);
  const double load = loading.seconds();

  const Json settings = settings_of(command, set);
  const auto parameters = table ? probe_parameters() : saddle_parameters();
  Evolution evolution = [&] {
    if (!command.resume) return Evolution(parameters, command.evolution);
    EvolutionState state = read_checkpoint(command.checkpoint, settings);
    try {
      return Evolution(parameters, command.evolution, std::move(state));
    } catch (const UsageError&) {
      throw InputError(command.checkpoint +
                       ": is a damaged checkpoint; start again without --resume");
    }
  }();
  Subject subject(table, command.fitness == "relative", set);
  const Json baselines = subject.baselines();
  const Stopwatch tuning;
  evolve(command, settings, subject, evolution, progress);
  progress.clear();

  const std::vector<double> best = rounded(evolution.best());
  const double error = subject.error(best);
  Json found = subject.json(best);
  found["provenance"] = settings;
  found["provenance"]["plexway"] = version_string;
  found["provenance"]["mean_error"] = error;
  found["provenance"]["baselines"] = baselines;
  found["provenance"]["complete"] = evolution.done();
  if (!command.out.empty()) write_whole(command.out, json_text(found));
  if (!command.cpp.empty())
    write_whole(command.cpp, comment(command, settings, error) + subject.cpp(best));

  const double reference = baselines[table ? "centroid" : "standard"].get<double>();
  Json json = settings;
  json["evaluated"] = evolution.evaluations();
  json["complete"] = evolution.done();
  json["baselines"] = baselines;
  json["mean_error"] = error;
  json["improvement"] = json_number(1 - error / reference);
  json["found"] = subject.json(best);
  json["seconds"] = {{"load", load}, {"tune", tuning.seconds()}};
  if (command.json) {
    write_output(json_text(json));
  } else if (!command.quiet) {
    Table text;
    text.add("set",
             counted(command.inputs.size(), "surfaces") + ", " + counted(set.fields(), "fields"));
    text.add("evaluations", std::to_string(evolution.evaluations()) +
                                (evolution.done() ? "" : ", not all: go on with --resume"));
    for (const auto& [name, value] : baselines.items())
      text.add(name, "mean error " + short_number(value.get<double>()));
    text.add("found", "mean error " + short_number(error) + ", " +
                          short_number(100 * std::abs(1 - error / reference)) + " % " +
                          (error > reference ? "more" : "less") + " than " +
                          (table ? "centroid" : "standard"));
    for (std::size_t i = 0; i < best.size(); ++i)
      text.add(parameters[i].name, short_number(best[i]));
    text.add("time", short_time(tuning.seconds()));
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
  app.add_option("INPUT", command->inputs,
                 "surfaces, each with the exact answers NAME.vID.txt beside it:\n"
                 "distances from vertex ID, one a line in vertex order")
      ->type_name("FILE")
      ->required();
  app.add_option("--truth-dir", command->truth_folder, "the exact answers are in this folder")
      ->type_name("DIR");
  app.add_option("--what", command->what,
                 "table (default): thresholds and shares of --visibility tuned;\n"
                 "saddles: which vertices the default policy bends paths at")
      ->type_name("NAME");
  app.add_option("--from", command->from,
                 "where the first start begins: random (default); of a table centroid,\n"
                 "published, learned; of saddles standard; or a .json of this command")
      ->type_name("NAME");
  app.add_option("--seed", command->evolution.seed, "another number, another result (default 1)")
      ->check(CLI::NonNegativeNumber)
      ->type_name("S");
  app.add_option("--evaluations", command->evolution.evaluations, "of each start (default 300)")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N");
  app.add_option("--restarts", command->evolution.restarts,
                 "so many starts, all but the first at random; the best counts (default 1)")
      ->check(CLI::Range(1, 10'000))
      ->type_name("N");
  app.add_option("--mutation", command->evolution.step,
                 "first standard deviation, as a share of each range (default 0.2)")
      ->type_name("X");
  app.add_option("--fitness", command->fitness,
                 "what is made small: mean (default), the mean error of all fields; or\n"
                 "relative: the geometric mean of each beside what centroid (standard)\n"
                 "has there")
      ->type_name("NAME");
  app.add_option("--step-rule", command->step_rule,
                 "fifth (default): the deviation follows the one-fifth rule; or constant")
      ->type_name("NAME");
  app.add_option("--triangulation", command->triangulation,
                 "input (default), or auto: the triangles that 'distance' would choose")
      ->type_name("NAME");
  app.add_option("--threads", command->threads,
                 "fields at once (default: all cores); the result does not depend on it")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  app.add_option("--out,-o", command->out, "write what was found as JSON")->type_name("FILE");
  app.add_option("--cpp", command->cpp, "write it as C++")->type_name("FILE");
  app.add_option("--checkpoint", command->checkpoint,
                 "keep here where it is, every few seconds and at the end")
      ->type_name("FILE");
  app.add_flag("--resume", command->resume, "go on from the checkpoint");
  app.add_option("--stop-after", command->stop_after,
                 "stop after so many evaluations in this run, to be resumed")
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("N");
  app.add_flag("--json", command->json, "print one JSON object");
  app.add_flag("--quiet,-q", command->quiet, "no summary, no notes, no progress");
  app.footer(
      "Examples:\n"
      "  plexway tune training/*.obj --out table.json --restarts 4 --checkpoint tune.ckpt\n"
      "  plexway tune training/*.obj --out table.json --restarts 4 --checkpoint tune.ckpt "
      "--resume\n"
      "  plexway tune scan.ply --from learned --evaluations 100 --cpp table.inc\n"
      "  plexway tune training/*.obj --what saddles --from standard --triangulation auto\n"
      "  plexway distance scan.ply --source vertex:0 --visibility tuned --table table.json");
  app.callback([command, &action] { action = [command] { run_tune(*command); }; });
}

}  // namespace plexway::cli
