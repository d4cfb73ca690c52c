// Merged windows on a smooth torus cut finer and finer: do errors go on falling, and does a vertex
// cost the same? The truth are exact windows on the same triangles, as far as one can wait for
// them.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <numbers>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "compare.hpp"

namespace {

using namespace plexway;

/// A torus of about so many vertices, twice as many around as across, each moved along the surface
/// by up to a fifth of an edge.
bench::Surface jittered_torus(std::size_t vertices) {
  const auto across = static_cast<Index>(std::sqrt(static_cast<double>(vertices) / 2));
  const Index around = 2 * across;
  std::mt19937 random(1);
  const auto jitter = [&] { return .4 * (static_cast<double>(random()) / 4294967296. - .5); };
  bench::Surface s;
  s.name = "torus";
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * (i + jitter()) / around;
      const double b = 2 * std::numbers::pi * (j + jitter()) / across;
      const double r = 1 + .4 * std::cos(b);
      s.positions.push_back({r * std::cos(a), r * std::sin(a), .4 * std::sin(b)});
      const Index right = (i + 1) % around, up = (j + 1) % across;
      const Index at[4] = {i * across + j, right * across + j, right * across + up,
                           i * across + up};
      s.faces.push_back({at[0], at[1], at[2]});
      s.faces.push_back({at[0], at[2], at[3]});
    }
  return s;
}

struct Options {
  std::size_t least = 800, most = 819200, exact = 204800;
  bench::Report report;
};

void measure(std::size_t vertices, const Options& options, bench::Table& table) {
  const bench::Surface surface = jittered_torus(vertices);
  const std::size_t count = surface.positions.size();
  const TriangleMesh<float> mesh(surface.positions, surface.faces);
  Workspace<float> workspace;
  DistanceField<float> field;
  const PointSource sources[] = {PointSource::at(0), PointSource::at(static_cast<Index>(count / 3)),
                                 PointSource::at(static_cast<Index>(count / 2 + 7))};
  double best = 1e300, mean = 0, worst = 0;
  const bool compared = count <= options.exact;
  for (const PointSource& source : sources) {
    for (std::size_t k = 0; k < (count < 1000000 ? 3 : 1); ++k) {
      const std::clock_t begin = std::clock();  // processor time: one thread does it
      solve(Serial{}, mesh, std::span(&source, 1), {}, workspace, field);
      best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    if (!compared) continue;
    PropagateOptions exactly;
    exactly.accuracy = Accuracy::exact();
    const auto exact =
        solve(Serial{}, TriangleMesh<double>(surface.positions, surface.faces), source, exactly);
    for (std::size_t v = 0; v < count; ++v) {
      if (!(exact.distance[v] > 0)) continue;
      const double off = std::abs(static_cast<double>(field.distance[v]) / exact.distance[v] - 1);
      mean += off / static_cast<double>(3 * count);
      worst = std::max(worst, off);
    }
  }
  nlohmann::ordered_json row = {
      {"vertices", count},
      {"ns", 1e9 * best / static_cast<double>(count)},
      {"turns", static_cast<double>(field.statistics.expansions) / static_cast<double>(count)},
      {"bytes", static_cast<double>(workspace.bytes()) / static_cast<double>(count)}};
  if (compared) row["mean"] = mean, row["max"] = worst;
  table.add(std::move(row));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Merged windows on a torus cut finer and finer");
  app.add_option("--least", options.least, "vertices of the first")->capture_default_str();
  app.add_option("--most", options.most, "vertices of the last")->capture_default_str();
  app.add_option("--exact", options.exact, "up to so many beside exact windows")
      ->capture_default_str();
  options.report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  bench::Table table({{"vertices", "vertices"},
                      {"ns", "ns/V", "%.0f"},
                      {"turns", "turns/V", "%.2f"},
                      {"bytes", "bytes/V", "%.0f"},
                      {"mean", "error mean", "%.1e"},
                      {"max", "max", "%.1e"}});
  return options.report.write(table, [&] {
    for (std::size_t n = options.least; n <= options.most; n *= 4) {
      std::cerr << n << std::endl;
      measure(n, options, table);
    }
  });
}
