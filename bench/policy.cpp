// What each choice inside the library costs: the default against itself without vectorised steps,
// against the policies that run the literal K = 1 hinge kernel, and against other schedules. All of
// them take turns with the default in one process, so the ratios hold whatever the machine does.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "compare.hpp"

namespace {

struct Variant {
  std::string name;
  plexway::PropagateOptions options;
};

std::vector<Variant> variants() {
  using plexway::Schedule;
  using plexway::Visibility;
  std::vector<Variant> all(1, {"saddles (default)", bench::one_label()});
  const auto add = [&](const char* name) -> plexway::PropagateOptions& {
    return all.emplace_back(Variant{name, bench::one_label()}).options;
  };
  add("saddles, plain step").vectorised = false;
  add("centroid (hinge kernel)").visibility = Visibility::centroid;
  add("tuned (hinge kernel)").visibility = Visibility::tuned;
  add("upper_bound (hinge kernel)").visibility = Visibility::upper_bound;
  add("saddles, step 2").step = 2;
  add("saddles, first in first out").schedule = Schedule::fifo;
  add("saddles, nearest first").schedule = Schedule::priority;
  return all;
}

template <class Real>
nlohmann::ordered_json measure(const bench::Surface& surface, const Variant& variant,
                               const std::vector<bench::Truth>& truths,
                               const bench::Effort& effort) {
  bench::PlexwayPeer<Real> peer(surface, variant.options);
  const auto sources = bench::rotating_sources(surface, effort.sources);
  const double vertices = static_cast<double>(surface.positions.size());
  const auto times = bench::take_turns(
      sources, effort, [&](bench::Index v) { peer.solve(v, bench::one_label()); },
      [&](bench::Index v) { peer.solve(v); });
  double expansions = 0;
  double updates = 0;
  double reached = 0;
  for (const bench::Index v : sources) {
    peer.solve(v);
    expansions += static_cast<double>(peer.statistics().expansions);
    updates += static_cast<double>(peer.statistics().updates);
    reached += static_cast<double>(peer.statistics().reached_simplices);
  }
  nlohmann::ordered_json row = {
      {"ns_per_vertex", 1e9 * times.second / vertices},
      {"default_ns_per_vertex", 1e9 * times.first / vertices},
      {"ratio", times.ratio},
      {"expansions_per_face", expansions / reached},
      {"updates_per_face", updates / reached},
      {"ns_per_expansion", 1e9 * times.second * static_cast<double>(sources.size()) / expansions}};
  bench::Errors errors;
  for (const auto& truth : truths) {
    peer.solve(truth.source);
    errors.add(truth, peer.distance());
  }
  if (const auto summary = errors.summary()) {
    row["mean"] = summary->mean;
    row["max"] = summary->max;
  }
  return row;
}

bench::Table policy_table() {
  return bench::Table({{"mesh", "mesh"},
                       {"vertices", "vertices"},
                       {"variant", "variant"},
                       {"ns_per_vertex", "ns/V", "%.1f"},
                       {"default_ns_per_vertex", "default ns/V", "%.1f"},
                       {"ratio", "ratio to default", "%.2f"},
                       {"ns_per_expansion", "ns/expansion", "%.1f"},
                       {"expansions_per_face", "expansions/face", "%.2f"},
                       {"updates_per_face", "updates/face", "%.2f"},
                       {"mean", "error mean", "%.1e"},
                       {"max", "max", "%.1e"},
                       {"note", "note"}});
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::filesystem::path truth_folder;
  bench::Effort effort;
  double limit = 600;
  bench::Report report;
  bool double_precision = false;
  CLI::App app("Policies and schedules against the default: one table");
  app.add_option("MESH", meshes, "Surfaces (.obj .off .ply .stl); none: a bumpy sphere");
  app.add_option("--truth-dir", truth_folder,
                 "Folder of the exact answers NAME.vID.txt (default: beside each mesh)");
  bench::add_effort_options(app, effort);
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  app.add_flag("--double", double_precision, "Double instead of float");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table = policy_table();
  const auto measure_on = [&](const bench::Surface& surface, const std::filesystem::path& folder) {
    const auto truths = bench::read_truths(folder, surface);
    for (const Variant& variant : variants()) {
      std::cerr << surface.name << ": " << variant.name << std::endl;
      nlohmann::ordered_json row = {{"mesh", surface.name},
                                    {"vertices", surface.positions.size()},
                                    {"variant", variant.name}};
      row.update(bench::isolated(limit, [&] {
        return double_precision ? measure<double>(surface, variant, truths, effort)
                                : measure<float>(surface, variant, truths, effort);
      }));
      table.add(std::move(row));
    }
  };
  return report.write(table, [&] {
    if (meshes.empty()) measure_on(bench::bumpy_surface(50000), truth_folder);
    for (const std::filesystem::path mesh : meshes)
      measure_on(bench::read_surface(mesh),
                 truth_folder.empty() ? mesh.parent_path() : truth_folder);
  });
}
