#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <plexway/fields/tuning.hpp>
#include <plexway/shape/read_options.hpp>
#include <plexway/solve/probe_table.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "shape/info/report.hpp"

namespace plexway::detail {

/// What `plexway tune` finds, as JSON, each number by its name: `kind` tells which of the two.
Json to_json(const ProbeTable& table);
Json to_json(const SaddleThresholds& thresholds);

/// The same as C++, a constant.
std::string to_cpp(const ProbeTable& table);
std::string to_cpp(const SaddleThresholds& thresholds);

/// Reads them. Other keys, such as `provenance`, are skipped. Throws InputError "FILE: cause" for
/// what is no such file, a number that is missing, or one out of range.
ProbeTable read_probe_table(const std::string& file);
SaddleThresholds read_saddle_thresholds(const std::string& file);

/// The JSON object in a file. Throws InputError "FILE: cause", with the line where it is no JSON.
Json read_json(const std::string& file);

/// What is to be fitted to which surfaces, and where it goes.
struct TuningRequest {
  std::vector<std::string> inputs;  ///< surfaces, as read_tuning_surfaces takes them
  std::string truth_folder;
  bool table = true;            ///< the table of Visibility::tuned; else SaddleThresholds
  bool relative = false;        ///< fitness: each field's error beside what it is without
  bool automatic = false;       ///< on the triangles that `distance` would choose
  std::string from = "random";  ///< random, centroid, published, learned, standard or a .json
  EvolutionOptions evolution;
  std::size_t threads = 0;                                           ///< 0: all cores
  std::size_t stop_after = std::numeric_limits<std::size_t>::max();  ///< evaluations of this run
  std::string out, cpp, checkpoint;                                  ///< files, or empty
  bool resume = false;                                               ///< from the checkpoint
};

/// What came of it.
struct TuningOutcome {
  Json settings;   ///< all that it depends on
  Json baselines;  ///< mean errors of what is known
  Json found;      ///< as policy_file.cpp reads it
  std::vector<EvolvedParameter> parameters;
  std::vector<double> best;  ///< one a parameter
  double mean_error = 0;
  std::size_t fields = 0, evaluated = 0;
  bool complete = false;  ///< false after stop_after
  double load_seconds = 0, tune_seconds = 0;
};

/// Fits, and writes what was found and, every few seconds, the checkpoint. Throws UsageError for
/// a start that does not exist, InputError as the readers do and for a checkpoint that does not
/// fit, Error where a file cannot be written. All of `progress` must be there.
/// Cost: a solve of every field an evaluation, on all threads.
TuningOutcome run_tuning(TuningRequest request, const ReadProgress& progress);

}  // namespace plexway::detail
