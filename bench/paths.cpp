// Paths, searches for a target and bounded searches.

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include <plexway/error.hpp>
#include <plexway/paths/bounded_search.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/paths/path_search.hpp>

#include "scenes.hpp"
#include "solver.hpp"

namespace bench::paths {

using plexway::Path, plexway::PathField, plexway::PointSource, plexway::Serial;
using Mesh = plexway::TriangleMesh<float>;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.) / static_cast<double>(values.size());
}
double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

// A* against the full solve, for random pairs at half the diameter (as far as one vertex sees) or
// nearer.
Row searches(const Surface& surface) {
  const Mesh mesh(surface.positions, surface.faces);
  PathField field(mesh, surface.positions);
  plexway::PathSearch<float> search(mesh, surface.positions), nearest_first(mesh);
  std::mt19937 random(1);
  std::vector<double> shares, plain_shares, gaps, windows, trace_us, search_ms, solve_ms;
  const auto any = [&] { return static_cast<Index>(random() % surface.positions.size()); };
  for (int k = 0; k < 10; ++k) {
    const PointSource source = PointSource::at(any());
    solve_ms.push_back(1e3 * seconds([&] { field.solve(Serial{}, source); }));
    const auto& found = field.distances();
    double farthest = 0;
    for (const float d : found.distance)
      if (std::isfinite(d)) farthest = std::max(farthest, static_cast<double>(d));
    const auto all = static_cast<double>(found.statistics.expansions);
    for (int i = 0; i < 10;) {
      const Index target = any();
      const double d = static_cast<double>(found.distance[target]);
      if (!(d > 0) || !(d <= farthest / 2)) continue;
      ++i;
      Path path;
      trace_us.push_back(1e6 * seconds([&] { path = field.trace(target); }));
      plexway::SearchResult aimed;
      search_ms.push_back(
          1e3 * seconds([&] { aimed = search.find(Serial{}, source, PointSource::at(target)); }));
      const auto plain = nearest_first.find(Serial{}, source, PointSource::at(target));
      shares.push_back(static_cast<double>(aimed.statistics.expansions) / all);
      plain_shares.push_back(static_cast<double>(plain.statistics.expansions) / all);
      gaps.push_back(std::abs(aimed.paths[0].length / path.length - 1));
      windows.push_back(static_cast<double>(aimed.paths[0].windows));
    }
  }
  return {{"what", "A*, " + surface.name},
          {"triangles", surface.faces.size()},
          {"share", median(shares)},
          {"share_mean", mean(shares)},
          {"share_most", most(shares)},
          {"nearest_first", median(plain_shares)},
          {"off", median(gaps)},
          {"max", most(gaps)},
          {"apart", std::count_if(gaps.begin(), gaps.end(), [](double g) { return g > 1e-4; })},
          {"windows", mean(windows)},
          {"solve_ms", median(solve_ms)},
          {"search_ms", median(search_ms)},
          {"us", median(trace_us)}};
}

// Paths against exact distances from one vertex: 200 a source.
void lengths(const std::filesystem::path& folder, const plexway::TraceOptions& trace,
             Table& table) {
  std::set<std::string> names;  // of NAME.vID.txt
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path stem = entry.path().stem();
    if (entry.path().extension() == ".txt" && stem.extension().string().starts_with(".v"))
      names.insert(stem.stem().string());
  }
  std::vector<double> all;
  const auto row = [](const std::string& what, const std::vector<double>& errors) {
    return Row{{"what", what},
               {"off", mean(errors)},
               {"max", most(errors)},
               {"below", std::min(0., *std::min_element(errors.begin(), errors.end()))}};
  };
  for (const std::string& name : names) {
    const Surface surface = read_surface(folder / (name + ".obj"));
    const Mesh mesh(surface.positions, surface.faces);
    PathField field(mesh, surface.positions);
    std::vector<double> errors, times, solves;
    for (const Truth& truth : read_truths(folder, name, surface.positions.size())) {
      const std::vector<double>& exact = truth.distance;
      if (std::none_of(exact.begin(), exact.end(), [](double d) { return d > 0 && d < 1e300; }))
        continue;
      solves.push_back(1e3 *
                       seconds([&] { field.solve(Serial{}, PointSource::at(truth.source)); }));
      std::mt19937 random(1);
      for (int k = 0; k < 200;) {
        const Index v = static_cast<Index>(random() % exact.size());
        if (!(exact[v] > 0) || std::isinf(exact[v])) continue;
        ++k;
        Path path;
        times.push_back(1e6 * processor_seconds([&] { path = field.trace(v, trace); }));
        errors.push_back(path.length / exact[v] - 1);
      }
    }
    if (errors.empty()) continue;
    all.insert(all.end(), errors.begin(), errors.end());
    table.add(row(name, errors)
                  .update({{"triangles", surface.faces.size()},
                           {"us", mean(times)},
                           {"us_most", most(times)},
                           {"solve_ms", median(solves)}}));
  }
  if (all.empty())
    throw plexway::InputError(folder.string() + ": no NAME.obj with NAME.vID.txt in it");
  table.add(row("all", all));
}

// 1,000 searches that reach about 500 triangles each, against full solves.
Row bounded() {
  constexpr Index n = 708;  // squares a side
  const Surface surface = height_field(
      n, [](double x, double y) { return 0.02 * std::sin(40 * x) * std::cos(30 * y); });
  const Mesh mesh(surface.positions, surface.faces);
  plexway::BoundedSearch<float> search(mesh);
  Solver solver(mesh, one_label());
  std::mt19937 random(1);
  const auto any = [&] { return static_cast<Index>(random() % surface.positions.size()); };
  std::vector<double> solves, rounds;
  double reached = 0;
  for (int round = 0; round < 5; ++round) {
    const Index source = any();
    solves.push_back(1e3 * seconds([&] { solver(source); }));
    reached = 0;
    rounds.push_back(1e3 * seconds([&] {
                       for (int k = 0; k < 1000; ++k)
                         reached += static_cast<double>(
                             search.find(Serial{}, PointSource::at(any()), 8.3 / n)
                                 .statistics.reached_simplices);
                     }));
  }
  return {{"what", "1000 bounded searches"}, {"triangles", surface.faces.size()},
          {"reached", reached / 1000},       {"solve_ms", median(solves)},
          {"search_ms", median(rounds)},     {"solves", median(rounds) / median(solves)}};
}

void run(Arguments& arguments) {
  std::string truth;
  std::vector<std::string> meshes;
  bool only_bounded = false;
  std::vector<double> margin;
  plexway::TraceOptions trace;
  arguments.option("MESH", &meshes, "Surfaces for A* and paths, before bounded searches");
  arguments.option("--truth", &truth,
                   "Only this: lengths of paths against the exact distances in a folder of "
                   "NAME.obj and NAME.vID.txt");
  arguments.option("--margin", &margin, "With --truth: as of plexway path");
  arguments.option("--bounded", &only_bounded,
                   "Only this: bounded searches on a surface of a million triangles");
  Table& table = arguments.table(
      "what; triangles; share: share of expansions %.3f; share_mean: mean %.3f;"
      "share_most: most %.3f; nearest_first: nearest first %.3f; off: length off %.2e; max %.1e;"
      "below: most below %.1e; apart: by more than 1e-4; windows %.0f; us: us a path %.0f;"
      "us_most: most %.0f; solve_ms: solve ms %.2f; search_ms: search ms %.2f;"
      "reached: triangles reached %.0f; solves: in solves %.2f");
  if (!margin.empty()) trace.margin = margin.front();
  if (!truth.empty()) return lengths(truth, trace, table);
  if (!only_bounded)
    for (const std::string& mesh : meshes) table.add(searches(read_surface(mesh)));
  table.add(bounded());
}
const Command command("paths", "paths, searches for a target, bounded searches", run);

}  // namespace bench::paths
