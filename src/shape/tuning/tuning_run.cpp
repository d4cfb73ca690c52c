#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/fields/tuning.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/version.hpp>

#include "io/names.hpp"
#include "io/output_file.hpp"
#include "shape/errors/measures.hpp"
#include "shape/info/report.hpp"
#include "shape/stopwatch.hpp"
#include "shape/tuning/tuning.hpp"

namespace plexway::detail {
namespace {

namespace fs = std::filesystem;
constexpr const char* checkpoint_kind = "plexway tune checkpoint";

/// Surfaces with exact answers, and all files that were read for them.
struct TuningInput {
  std::vector<TuningSurface> surfaces;
  std::vector<std::string> files;
};

// The ID of NAME.vID.txt, or `none`.
Index source_of(const std::string& file, const std::string& name) {
  const std::string prefix = name + ".v", suffix = ".txt";
  if (file.size() <= prefix.size() + suffix.size() || !file.starts_with(prefix) ||
      !file.ends_with(suffix))
    return none;
  Index id = none;
  const char* const end = file.data() + file.size() - suffix.size();
  const auto [rest, error] = std::from_chars(file.data() + prefix.size(), end, id);
  return error == std::errc{} && rest == end ? id : none;
}

double or_worst(const Json& number) {
  return number.is_null() ? -std::numeric_limits<double>::infinity() : number.get<double>();
}

/// Surfaces and the exact answers NAME.vID.txt beside them, or in `truth_folder` if that is not
/// empty, in the order of ID.
TuningInput read_tuning_surfaces(const std::vector<std::string>& files,
                                 const fs::path& truth_folder) {
  TuningInput input;
  input.files = files;
  for (const fs::path file : files) {
    io::Triangles read = io::read_triangles(file);
    TuningSurface surface;
    surface.name = file.stem().string();
    surface.positions = std::move(read.positions);
    surface.faces = std::move(read.triangles);
    fs::path folder = truth_folder.empty() ? file.parent_path() : truth_folder;
    if (folder.empty()) folder = ".";
    std::error_code error;
    std::vector<std::pair<Index, std::string>> truths;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const Index id = source_of(entry.path().filename().string(), surface.name);
      if (id != none) truths.emplace_back(id, entry.path().string());
    }
    if (error) throw InputError(folder.string() + ": cannot be read: " + error.message());
    if (truths.empty())
      throw InputError(file.string() + ": no exact distances " + surface.name + ".vID.txt in " +
                       folder.string());
    std::sort(truths.begin(), truths.end());
    for (const auto& [id, truth] : truths) {
      if (id >= surface.positions.size())
        throw InputError(truth + ": " + file.string() + " has no vertex " + std::to_string(id));
      surface.truths.push_back({id, read_truth(truth, surface.positions.size())});
      input.files.push_back(truth);
    }
    input.surfaces.push_back(std::move(surface));
  }
  return input;
}

/// The file appears whole or not at all.
void write_whole(const std::string& file, const std::string& text) {
  io::OutputFile out(file);
  out.write(text);
  out.commit();
}

/// Where an evolution is, with the `settings` that it depends on.
void write_checkpoint(const std::string& file, const Json& settings, const EvolutionState& s) {
  Json json;
  json["kind"] = checkpoint_kind;
  json["settings"] = settings;
  json["state"] = {{"random", s.random},
                   {"restart", s.restart},
                   {"trials", s.trials},
                   {"step", s.step},
                   {"parent_fitness", json_number(s.parent_fitness)},
                   {"best_fitness", json_number(s.best_fitness)},
                   {"parent", s.parent},
                   {"best", s.best}};
  write_whole(file, json_text(json));
}

EvolutionState read_checkpoint(const std::string& file, const Json& settings) {
  const Json json = read_json(file);
  if (!json.is_object() || !json.contains("kind") || json["kind"] != checkpoint_kind)
    throw InputError(file + ": is no checkpoint of 'plexway tune'");
  try {
    const Json& there = json.at("settings");
    for (const auto& [key, value] : settings.items())
      if (there.at(key) != value)
        throw InputError(file + ": was made with another " + key + ": " + there.at(key).dump() +
                         ", not " + value.dump());
    const Json& s = json.at("state");
    EvolutionState state;
    state.random = s.at("random").get<std::uint64_t>();
    state.restart = s.at("restart").get<std::size_t>();
    state.trials = s.at("trials").get<std::size_t>();
    state.step = s.at("step").get<double>();
    state.parent_fitness = or_worst(s.at("parent_fitness"));
    state.best_fitness = or_worst(s.at("best_fitness"));
    state.parent = s.at("parent").get<std::vector<double>>();
    state.best = s.at("best").get<std::vector<double>>();
    return state;
  } catch (const Json::exception&) {
    throw InputError(file + ": is a damaged checkpoint; start again without --resume");
  }
}

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

std::vector<double> start_of(const TuningRequest& command) {
  const bool table = command.table;
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

const char* what(const TuningRequest& command) { return command.table ? "table" : "saddles"; }

// All that the outcome depends on.
Json settings_of(const TuningRequest& command, const TuningSet& set) {
  return {{"what", what(command)},
          {"seed", command.evolution.seed},
          {"evaluations", command.evolution.evaluations},
          {"restarts", command.evolution.restarts},
          {"from", command.from},
          {"start", command.evolution.start},
          {"mutation", command.evolution.step},
          {"step-rule", command.evolution.adapt ? "fifth" : "constant"},
          {"fitness", command.relative ? "relative" : "mean"},
          {"triangulation", command.automatic ? "auto" : "input"},
          {"surfaces", command.inputs.size()},
          {"fields", set.fields()},
          {"digest", hexadecimal(set.digest())}};
}

// Evaluations until all are done or this run has had enough.
void evolve(const TuningRequest& command, const Json& settings, Subject& subject,
            Evolution& evolution, const ReadProgress& progress) {
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
  progress.stage("tuning");
  for (std::size_t i = 0; i < command.stop_after && !evolution.done(); ++i) {
    const std::size_t start = evolution.state().restart;
    if (evolution.tell(-subject.score(rounded(evolution.propose()))))
      progress.stage("tuning: " + describe());
    progress.share(static_cast<double>(evolution.evaluations()) / all);
    if (since_saved.seconds() > 2) save();
    if (evolution.state().restart > start)
      progress.note("start " + std::to_string(start + 1) + " of " +
                    std::to_string(command.evolution.restarts) + ": the best so far is " +
                    short_number(-evolution.best_fitness()));
  }
  save();
}

std::string comment(const TuningRequest& command, const Json& settings, double error) {
  std::string text = "// plexway " + std::string(version_string) + " tune --what " + what(command) +
                     " --from " + command.from + " --seed " +
                     std::to_string(command.evolution.seed) + " --evaluations " +
                     std::to_string(command.evolution.evaluations) + " --restarts " +
                     std::to_string(command.evolution.restarts) + " --fitness " +
                     (command.relative ? "relative" : "mean") + " --triangulation " +
                     (command.automatic ? "auto" : "input") + "\n";
  return text + "// on " + counted(command.inputs.size(), "surfaces") + ", " +
         counted(settings["fields"].get<std::size_t>(), "fields") + ", digest " +
         settings["digest"].get<std::string>() + "; mean error " + short_number(error) + "\n";
}

}  // namespace

TuningOutcome run_tuning(TuningRequest command, const ReadProgress& progress) {
  command.evolution.start = start_of(command);
  progress.stage("reading " + counted(command.inputs.size(), "surfaces"));
  TuningOutcome outcome;
  const Stopwatch loading;
  TuningInput input = read_tuning_surfaces(command.inputs, command.truth_folder);
  // Hours lie between here and the result: what cannot be written is reported now.
  io::check_output_place(command.out, input.files, "--out");
  io::check_output_place(command.cpp, input.files, "--cpp");
  io::check_output_place(command.checkpoint, input.files, "--checkpoint");
  TuningSet set(std::move(input.surfaces), command.automatic, command.threads);
  outcome.load_seconds = loading.seconds();

  outcome.settings = settings_of(command, set);
  outcome.fields = set.fields();
  outcome.parameters = command.table ? probe_parameters() : saddle_parameters();
  Evolution evolution = [&] {
    if (!command.resume) return Evolution(outcome.parameters, command.evolution);
    EvolutionState state = read_checkpoint(command.checkpoint, outcome.settings);
    try {
      return Evolution(outcome.parameters, command.evolution, std::move(state));
    } catch (const UsageError&) {
      throw InputError(command.checkpoint +
                       ": is a damaged checkpoint; start again without --resume");
    }
  }();
  Subject subject(command.table, command.relative, set);
  outcome.baselines = subject.baselines();
  const Stopwatch tuning;
  evolve(command, outcome.settings, subject, evolution, progress);

  outcome.best = rounded(evolution.best());
  outcome.mean_error = subject.error(outcome.best);
  outcome.found = subject.json(outcome.best);
  outcome.evaluated = evolution.evaluations();
  outcome.complete = evolution.done();
  Json written = outcome.found;
  written["provenance"] = outcome.settings;
  written["provenance"]["plexway"] = version_string;
  written["provenance"]["mean_error"] = outcome.mean_error;
  written["provenance"]["baselines"] = outcome.baselines;
  written["provenance"]["complete"] = outcome.complete;
  if (!command.out.empty()) write_whole(command.out, json_text(written));
  if (!command.cpp.empty())
    write_whole(command.cpp,
                comment(command, outcome.settings, outcome.mean_error) + subject.cpp(outcome.best));
  outcome.tune_seconds = tuning.seconds();
  return outcome;
}

}  // namespace plexway::detail
