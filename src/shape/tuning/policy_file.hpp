#pragma once

#include <string>

#include <plexway/solve/probe_table.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "shape/info/report.hpp"

namespace plexway {

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

}  // namespace plexway
