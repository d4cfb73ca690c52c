// Windows beside the default, one label a triangle: time in turns, and how far both are off.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <plexway/solve.hpp>

#include "compare.hpp"

namespace {

using namespace plexway;

/// One solver after another on one surface; what all need to be timed and judged.
template <class Real>
class WindowPeer {
 public:
  WindowPeer(const bench::Surface& surface, Accuracy accuracy)
      : mesh_(surface.positions, surface.faces) {
    options_.accuracy = accuracy;
  }

  void solve(Index source) {
    plexway::solve(Serial{}, mesh_, PointSource::at(source), options_, workspace_, field_);
  }
  [[nodiscard]] std::vector<double> distance() const {
    return {field_.distance.begin(), field_.distance.end()};
  }
  [[nodiscard]] const std::vector<Real>& error() const { return field_.error; }
  [[nodiscard]] const PropagateStatistics& statistics() const { return field_.statistics; }
  [[nodiscard]] std::size_t bytes() const { return workspace_.bytes(); }

 private:
  TriangleMesh<Real> mesh_;
  PropagateOptions options_;
  Workspace<Real> workspace_;
  DistanceField<Real> field_;
};

struct Judged {
  bench::Errors errors;
  std::size_t held = 0, compared = 0;  ///< vertices whose estimate is not too small

  template <class Real>
  void add(const bench::Truth& truth, const std::vector<double>& found,
           const std::vector<Real>& estimate) {
    errors.add(truth, found);
    for (std::size_t v = 0; v < estimate.size(); ++v) {
      const double exact = truth.distance[v];
      if (!std::isfinite(exact) || !std::isfinite(found[v])) continue;
      // Single precision alone is off by this much.
      const double rounding = 1e-6 * exact;
      held += std::abs(found[v] - exact) <= static_cast<double>(estimate[v]) + rounding;
      ++compared;
    }
  }

  void write(nlohmann::ordered_json& row) const {
    const auto summary = errors.summary();
    if (!summary) return;
    row["mean"] = summary->mean;
    row["p99"] = summary->p99;
    row["max"] = summary->max;
    row["below"] = summary->most_below;
    row["wrong"] = summary->wrong;
    if (compared > 0) row["held"] = static_cast<double>(held) / static_cast<double>(compared);
  }
};

struct Options {
  std::vector<std::string> meshes;
  std::vector<double> accuracies;
  bool no_exact = false;
  std::size_t compared = 0;
  bench::Effort effort;
  bench::Report report;
};

template <class Real>
nlohmann::ordered_json measure(const bench::Surface& surface,
                               const std::vector<bench::Truth>& truths, Accuracy accuracy,
                               bench::PlexwayPeer<float>& fast, const Options& options) {
  nlohmann::ordered_json row;
  const double vertices = static_cast<double>(surface.positions.size());
  WindowPeer<Real> peer(surface, accuracy);
  const auto sources = bench::rotating_sources(surface, options.effort.sources);
  const bench::Times times = bench::take_turns(
      sources, options.effort, [&](Index source) { fast.solve(source); },
      [&](Index source) { peer.solve(source); });
  row["ns"] = 1e9 * times.second / vertices;
  row["ratio"] = times.ratio;
  row["turns"] = static_cast<double>(peer.statistics().expansions) / vertices;
  row["bytes"] = static_cast<double>(peer.bytes()) / vertices;
  Judged judged;
  for (const bench::Truth& truth : truths) {
    peer.solve(truth.source);
    judged.add(truth, peer.distance(), peer.error());
  }
  judged.write(row);
  return row;
}

void measure_surface(const std::filesystem::path& file, const Options& options,
                     bench::Table& table) {
  const bench::Surface surface = bench::read_surface(file);
  std::vector<bench::Truth> truths = bench::read_truths(file.parent_path(), surface);
  if (options.compared > 0) {  // beside the exact solver's own distances
    truths.clear();
    WindowPeer<double> exact(surface, Accuracy::exact());
    for (const Index source : bench::rotating_sources(surface, options.compared)) {
      exact.solve(source);
      truths.push_back({source, exact.distance()});
    }
  }
  bench::PlexwayPeer<float> fast(surface, bench::one_label());
  const auto add = [&](const std::string& name, const nlohmann::ordered_json& measured) {
    nlohmann::ordered_json row = {
        {"mesh", surface.name}, {"vertices", surface.positions.size()}, {"accuracy", name}};
    row.update(measured);
    table.add(std::move(row));
  };
  {
    nlohmann::ordered_json row;
    Judged judged;
    for (const bench::Truth& truth : truths) {
      fast.solve(truth.source);
      judged.add(truth, fast.distance(), std::vector<float>());
    }
    judged.write(row);
    add("fast", row);
  }
  for (const double error : options.accuracies) {
    char name[32];
    std::snprintf(name, sizeof name, "%g", error);
    std::cerr << surface.name << ": " << name << std::endl;
    add(name, measure<float>(surface, truths, Accuracy(error), fast, options));
  }
  if (options.no_exact) return;
  std::cerr << surface.name << ": exact" << std::endl;
  add("exact", measure<double>(surface, truths, Accuracy::exact(), fast, options));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.accuracies = {Accuracy::accurate().error()};
  CLI::App app("Windows beside the default: time in turns, and errors");
  app.add_option("MESH", options.meshes, "Surfaces, the exact answers NAME.vID.txt beside them")
      ->required();
  app.add_option("--accuracy", options.accuracies, "Mean relative errors to ask for")
      ->capture_default_str();
  app.add_flag("--no-exact", options.no_exact, "Leave exact windows out");
  app.add_option("--compared", options.compared,
                 "Take the exact windows of so many sources for the truth, not the files");
  bench::add_effort_options(app, options.effort);
  options.report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table({{"mesh", "mesh"},
                      {"vertices", "vertices"},
                      {"accuracy", "accuracy"},
                      {"ns", "ns/V", "%.0f"},
                      {"ratio", "time / fast", "%.2f"},
                      {"turns", "turns/V", "%.1f"},
                      {"mean", "error mean", "%.1e"},
                      {"p99", "p99", "%.1e"},
                      {"max", "max", "%.1e"},
                      {"below", "most below", "%.1e"},
                      {"wrong", "wrong"},
                      {"held", "estimate holds", "%.4f"},
                      {"bytes", "bytes/V", "%.0f"}});
  return options.report.write(table, [&] {
    for (const std::filesystem::path mesh : options.meshes) measure_surface(mesh, options, table);
  });
}
