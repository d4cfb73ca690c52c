// Merged windows from many random sources beside exact ones: the worst vertex, how much the two
// ways of a pair differ, and what lies below the straight line in space. Labels beside them.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <plexway/solve.hpp>

#include "compare.hpp"

namespace {

using namespace plexway;

struct Options {
  std::vector<std::string> meshes;
  std::size_t sources = 200;
  unsigned seed = 1;
  bench::Report report;
};

/// Fields of one accuracy, judged one after the other.
struct Judged {
  double mean = 0, worst = 0, below = 0;
  std::size_t fields = 0, beyond = 0, vertices = 0;
  std::vector<std::vector<double>> between;  ///< the sources

  template <class Real>
  void add(const std::vector<Real>& found, const std::vector<double>& exact,
           const std::vector<std::array<double, 3>>& places, Index source) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < exact.size(); ++v) {
      if (!(exact[v] > 0) || !std::isfinite(exact[v])) continue;
      const double d = static_cast<double>(found[v]), off = std::abs(d / exact[v] - 1);
      const auto &p = places[v], &q = places[source];
      const double line = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      sum += off;
      worst = std::max(worst, off);
      beyond += off > 5e-3;
      if (line > 0) below = std::min(below, d / line - 1);
      ++count;
    }
    vertices += count;
    mean += sum / static_cast<double>(std::max<std::size_t>(count, 1));
    ++fields;
  }
  [[nodiscard]] double asymmetry() const {
    double most = 0;
    for (std::size_t i = 0; i < between.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double there = between[i][j], back = between[j][i], least = std::min(there, back);
        if (least > 0 && std::isfinite(std::max(there, back)))
          most = std::max(most, std::abs(there - back) / least);
      }
    return most;
  }
};

void measure(const std::string& file, const Options& options, bench::Table& table) {
  const bench::Surface surface = bench::read_surface(file);
  const TriangleMesh<float> mesh(surface.positions, surface.faces);
  const TriangleMesh<double> exact_mesh(surface.positions, surface.faces);
  std::mt19937 random(options.seed);
  std::vector<Index> sources;
  for (std::size_t k = 0; k < options.sources; ++k)
    sources.push_back(surface.faces[random() % surface.faces.size()][random() % 3]);
  Workspace<float> workspace;
  Workspace<double> exact_workspace;
  DistanceField<float> field;
  DistanceField<double> exact;
  PropagateOptions options_of_exact;
  options_of_exact.accuracy = Accuracy::exact();
  Judged judged[2];
  const PropagateOptions accuracies[2] = {PropagateOptions{}, bench::one_label()};
  for (const Index source : sources) {
    const PointSource from = PointSource::at(source);
    solve(Serial{}, exact_mesh, std::span(&from, 1), options_of_exact, exact_workspace, exact);
    for (std::size_t a = 0; a < 2; ++a) {
      solve(Serial{}, mesh, std::span(&from, 1), accuracies[a], workspace, field);
      judged[a].add(field.distance, exact.distance, surface.positions, source);
      std::vector<double>& row = judged[a].between.emplace_back();
      for (const Index other : sources) row.push_back(static_cast<double>(field.distance[other]));
    }
    if (judged[0].fields % 20 == 0)
      std::cerr << surface.name << ": " << judged[0].fields << " sources" << std::endl;
  }
  for (std::size_t a = 0; a < 2; ++a)
    table.add({{"mesh", surface.name},
               {"vertices", surface.positions.size()},
               {"accuracy", a == 0 ? "accurate" : "fast"},
               {"sources", sources.size()},
               {"mean", judged[a].mean / static_cast<double>(judged[a].fields)},
               {"max", judged[a].worst},
               {"beyond", static_cast<double>(judged[a].beyond) /
                              static_cast<double>(std::max<std::size_t>(judged[a].vertices, 1))},
               {"asymmetry", judged[a].asymmetry()},
               {"below", judged[a].below}});
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Windows from random sources beside exact ones");
  app.add_option("MESH", options.meshes, "surfaces")->required();
  app.add_option("--sources", options.sources, "of each (200)")->check(CLI::Range(1, 100000));
  app.add_option("--seed", options.seed, "of the random sources (1)");
  options.report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  bench::Table table({{"mesh", "mesh"},
                      {"vertices", "vertices"},
                      {"accuracy", "accuracy"},
                      {"sources", "sources"},
                      {"mean", "mean", "%.1e"},
                      {"max", "worst vertex", "%.1e"},
                      {"beyond", "share beyond 5e-3", "%.1e"},
                      {"asymmetry", "two ways differ by", "%.1e"},
                      {"below", "below the line", "%.1e"}});
  return options.report.write(table, [&] {
    for (const std::string& mesh : options.meshes) measure(mesh, options, table);
  });
}
