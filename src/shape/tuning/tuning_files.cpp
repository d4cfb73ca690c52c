#include "shape/tuning/tuning_files.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>

#include "io/output_file.hpp"
#include "shape/errors/truth_file.hpp"
#include "shape/tuning/policy_file.hpp"

namespace plexway {
namespace {

namespace fs = std::filesystem;
constexpr const char* checkpoint_kind = "plexway tune checkpoint";

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

}  // namespace

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

void write_whole(const std::string& file, const std::string& text) {
  io::OutputFile out(file);
  out.write(text);
  out.commit();
}

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

}  // namespace plexway
