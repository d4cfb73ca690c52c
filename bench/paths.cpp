// Paths, searches for a target and bounded searches.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <plexway/apps/bounded_search.hpp>
#include <plexway/apps/path_field.hpp>
#include <plexway/apps/path_search.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>

#include "harness.hpp"

using namespace plexway;
using bench::median;
using bench::seconds;

namespace {

// A* against the full solve, for random pairs at half the diameter (as far as one vertex sees) or
// nearer.
void searches(const std::string& file) {
  const io::Triangles surface = io::read_triangles(file);
  const TriangleMesh<float> mesh(surface.positions, surface.triangles);
  PathField field(mesh, surface.positions);
  PathSearch<float> search(mesh, surface.positions), nearest_first(mesh);
  std::mt19937 random(1);
  std::vector<double> shares, plain_shares, gaps, trace_us, search_ms, solve_ms;
  double mean_share = 0, windows = 0;
  int apart = 0;
  for (int k = 0; k < 10; ++k) {
    const Index source = static_cast<Index>(random() % surface.positions.size());
    solve_ms.push_back(1e3 * seconds([&] { field.solve(Serial{}, PointSource::at(source)); }));
    double farthest = 0;
    for (const float d : field.distances().distance)
      if (d < std::numeric_limits<float>::infinity()) farthest = std::max(farthest, double(d));
    const auto all = static_cast<double>(field.distances().statistics.expansions);
    for (int i = 0; i < 10;) {
      const Index target = static_cast<Index>(random() % surface.positions.size());
      const double d = static_cast<double>(field.distances().distance[target]);
      if (!(d > 0) || !(d <= farthest / 2)) continue;
      ++i;
      Path path;
      trace_us.push_back(1e6 * seconds([&] { path = field.trace(target); }));
      SearchResult found;
      search_ms.push_back(1e3 * seconds([&] {
                            found = search.find(Serial{}, PointSource::at(source),
                                                PointSource::at(target));
                          }));
      const auto plain =
          nearest_first.find(Serial{}, PointSource::at(source), PointSource::at(target));
      shares.push_back(static_cast<double>(found.statistics.expansions) / all);
      plain_shares.push_back(static_cast<double>(plain.statistics.expansions) / all);
      mean_share += shares.back() / 100;
      gaps.push_back(std::abs(found.paths[0].length / path.length - 1));
      apart += gaps.back() > 1e-4;
      windows += static_cast<double>(found.paths[0].windows) / 100;
    }
  }
  std::sort(shares.begin(), shares.end());
  std::printf(
      "%-28s %8zu triangles  A* share of expansions: median %.3f mean %.3f most %.3f (nearest "
      "first: %.3f)  length off: median %.1e most %.1e, %d of 100 by more than 1e-4  windows %.0f  "
      "solve %.2f ms, A* with path %.2f ms, path "
      "%.0f us\n",
      file.substr(file.rfind('/') + 1).c_str(), surface.triangles.size(), median(shares),
      mean_share, shares.back(), median(plain_shares), median(gaps),
      *std::max_element(gaps.begin(), gaps.end()), apart, windows, median(solve_ms),
      median(search_ms), median(trace_us));
}

// Paths against exact distances from one vertex: 200 a source.
void lengths(const std::filesystem::path& folder, const TraceOptions& trace) {
  std::set<std::string> names;  // of NAME.vID.txt
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path stem = entry.path().stem();
    if (entry.path().extension() == ".txt" && stem.extension().string().starts_with(".v"))
      names.insert(stem.stem().string());
  }
  double below = 0, all = 0;
  std::size_t count = 0;
  for (const std::string& name : names) {
    const bench::Surface surface = bench::read_surface(folder / (name + ".obj"));
    const TriangleMesh<float> mesh(surface.positions, surface.faces);
    PathField field(mesh, surface.positions);
    std::vector<double> errors, times, solves;
    for (const bench::Truth& truth : bench::read_truths(folder, surface)) {
      const std::vector<double>& exact = truth.distance;
      if (std::none_of(exact.begin(), exact.end(), [](double d) { return d > 0 && d < 1e300; }))
        continue;
      solves.push_back(
          1e3 * bench::seconds([&] { field.solve(Serial{}, PointSource::at(truth.source)); }));
      std::mt19937 random(1);
      for (int k = 0; k < 200;) {
        const Index v = static_cast<Index>(random() % exact.size());
        if (!(exact[v] > 0) || std::isinf(exact[v])) continue;
        ++k;
        const std::clock_t traced = std::clock();  // others on the machine do not count
        const Path path = field.trace(v, trace);
        times.push_back(static_cast<double>(std::clock() - traced) / CLOCKS_PER_SEC * 1e6);
        errors.push_back(path.length / exact[v] - 1);
        below = std::min(below, errors.back());
      }
    }
    if (errors.empty()) continue;
    double sum = 0, time = 0;
    for (const double e : errors) sum += e;
    for (const double t : times) time += t / static_cast<double>(times.size());
    all += sum, count += errors.size();
    std::printf(
        "%-14s paths over exact: mean %.1e most %.1e  %.0f us a path (most %.0f)  solve "
        "%.2f ms\n",
        surface.name.c_str(), sum / static_cast<double>(errors.size()),
        *std::max_element(errors.begin(), errors.end()), time,
        *std::max_element(times.begin(), times.end()), bench::median(solves));
  }
  if (count == 0) throw InputError(folder.string() + ": no NAME.obj with NAME.vID.txt in it");
  std::printf("all: mean %.2e, lowest %.1e\n", all / static_cast<double>(count), below);
}

// 1,000 searches that reach about 500 triangles each, against full solves.
void bounded() {
  constexpr Index n = 708;  // squares a side
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i)
      positions.push_back(
          {i / double(n), j / double(n), 0.02 * std::sin(40. * i / n) * std::cos(30. * j / n)});
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      faces.push_back({a, b, d});
      faces.push_back({a, d, c});
    }
  const TriangleMesh<float> mesh(positions, faces);
  BoundedSearch<float> search(mesh);
  Workspace<float> workspace;
  DistanceField<float> field;
  std::mt19937 random(1);
  const double radius = 8.3 / n;
  std::vector<double> solves, rounds;
  double triangles = 0;
  for (int round = 0; round < 5; ++round) {
    const PointSource source = PointSource::at(static_cast<Index>(random() % positions.size()));
    solves.push_back(seconds([&] {
      plexway::solve(Serial{}, mesh, std::span<const PointSource>(&source, 1), bench::one_label(),
                     workspace, field);
    }));
    triangles = 0;
    rounds.push_back(seconds([&] {
      for (int k = 0; k < 1000; ++k)
        triangles += static_cast<double>(
            search
                .find(Serial{}, PointSource::at(static_cast<Index>(random() % positions.size())),
                      radius)
                .statistics.reached_simplices);
    }));
  }
  std::printf(
      "%zu triangles: a full solve %.1f ms; 1000 bounded searches of %.0f triangles %.1f ms = %.2f "
      "solves\n",
      faces.size(), median(solves) * 1e3, triangles / 1000, median(rounds) * 1e3,
      median(rounds) / median(solves));
}

}  // namespace

int main(int argc, char** argv) {
  std::string truth;
  std::vector<std::string> meshes;
  bool only_bounded = false;
  CLI::App app("Paths, searches for a target and bounded searches");
  app.add_option("MESH", meshes,
                 "Surfaces (.obj .off .ply .stl) for A* and paths, before bounded searches");
  app.add_option("--truth", truth,
                 "Only this: lengths of paths against the exact distances in a folder of NAME.obj\n"
                 "and NAME.vID.txt");
  TraceOptions trace;
  app.add_option("--margin", trace.margin, "With --truth: as of plexway path");
  app.add_flag("--bounded", only_bounded,
               "Only this: bounded searches on a surface of a million triangles");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!truth.empty()) {
      lengths(truth, trace);
      return 0;
    }
    if (!only_bounded)
      for (const std::string& mesh : meshes) searches(mesh);
    bounded();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_paths: %s\n", error.what());
    return 1;
  }
}
