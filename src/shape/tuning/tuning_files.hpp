#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <plexway/fields/tuning.hpp>

#include "shape/info/report.hpp"

namespace plexway {

/// Surfaces with exact answers, and all files that were read for them.
struct TuningInput {
  std::vector<TuningSurface> surfaces;
  std::vector<std::string> files;
};

/// Reads surfaces and the exact answers NAME.vID.txt beside them, or in `truth_folder` if that is
/// not empty, in the order of ID. Throws InputError "FILE: cause" as the readers do, and for a
/// surface without answers.
TuningInput read_tuning_surfaces(const std::vector<std::string>& files,
                                 const std::filesystem::path& truth_folder);

/// Writes where an evolution is, with the `settings` that it depends on. The file appears whole or
/// not at all. Throws Error when the system refuses.
void write_checkpoint(const std::string& file, const Json& settings, const EvolutionState& state);

/// Reads it. Throws InputError "FILE: cause" for what is no checkpoint, or one with other settings.
EvolutionState read_checkpoint(const std::string& file, const Json& settings);

/// Writes a text; the file appears whole or not at all. Throws Error when the system refuses.
void write_whole(const std::string& file, const std::string& text);

}  // namespace plexway
