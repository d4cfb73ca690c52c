// One source by pieces (OpenMP::piece) against Serial, on a surface by labels or windows, and on a
// wireframe. Counts are the same on any machine and with any number of threads, and so must be the
// bits: `--repeats` solves with 1, 2, 3 and 8 threads are compared (0 differ). Times are taken in
// turns. The model says what recorded counts come to on more threads: each superstep's runs are
// dealt to the threads longest first, a run costs its expansions and some, a superstep what a
// barrier does.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <plexway/solve.hpp>

#include "../data/shapes.hpp"
#include "compare.hpp"
#include "piece_model.hpp"
#include "propagate/workspace_state.hpp"

namespace {

using namespace plexway;

const std::map<std::string, Accuracy> accuracies = {
    {"fast", Accuracy::fast()}, {"accurate", Accuracy::accurate()}, {"exact", Accuracy::exact()}};

struct Settings {
  std::vector<std::string> meshes;
  std::vector<std::size_t> generated;
  std::vector<std::size_t> sizes = {0, 2048, 8192};  // 0: what OpenMP takes by itself
  int threads = 2;
  std::size_t repeats = 4;  // of solves that must have the same bits
  std::string accuracy = "fast";
};

/// A simplex is what pieces count: a triangle, a vertex of a wireframe.
template <class Domain>
void measure(const std::string& name, const Domain& mesh, std::size_t simplices,
             const std::vector<Index>& sources, const PropagateOptions& options,
             const bench::Effort& effort, const Settings& settings, bench::Table& table) {
  using Real = typename Domain::Number;
  const double faces = static_cast<double>(simplices);
  Workspace<Real> alone;
  DistanceField<Real> field, first;
  const auto solve_by = [&](const auto& executor, Workspace<Real>& workspace) {
    return [&, executor](Index source) {
      const PointSource from[] = {PointSource::at(source)};
      solve(executor, mesh, from, options, workspace, field);
    };
  };
  for (const std::size_t size : settings.sizes) {
    Workspace<Real> workspace;
    SuperstepCounts& counts = workspace.state().pieces.counts();
    counts.keeps_log = true;
    double serial = 0, by_pieces = 0, supersteps = 0, letters = 0, bytes = 0;
    double model[4] = {};
    const auto once = bench::seconds([&] { solve_by(OpenMP{1, 128, size}, workspace)(0); });
    first = field;
    std::size_t others = 0;
    for (std::size_t i = 0; i < settings.repeats; ++i) {
      constexpr int threads[] = {1, 2, 3, 8};
      solve_by(OpenMP{threads[i % 4], 128, size}, workspace)(0);
      others += field.distance != first.distance || field.error != first.error;
    }
    for (const Index source : sources) {
      solve_by(Serial{}, alone)(source);
      const double expansions = static_cast<double>(field.statistics.expansions);
      serial += expansions / faces;
      solve_by(OpenMP{1, 128, size}, workspace)(source);
      by_pieces += static_cast<double>(field.statistics.expansions) / faces;
      supersteps += static_cast<double>(counts.supersteps);
      letters += static_cast<double>(counts.letters) / faces;
      bytes += static_cast<double>(counts.bytes) / faces;
      for (std::size_t i = 0; const std::size_t threads : {2, 4, 8, 64})
        model[i++] += expansions / bench::modelled(counts.log, threads, {});
    }
    counts.keeps_log = false;
    const bench::Times times =
        bench::take_turns(sources, effort, solve_by(Serial{}, alone),
                          solve_by(OpenMP{settings.threads, 128, size}, workspace));
    const double n = static_cast<double>(sources.size());
    table.add({{"mesh", name},
               {"faces", simplices},
               {"size", size},
               {"supersteps", supersteps / n},
               {"serial", serial / n},
               {"expansions", by_pieces / n},
               {"letters", letters / n},
               {"bytes", bytes / n},
               {"others", others},
               {"kept_by_one", static_cast<double>(alone.bytes()) / faces},
               {"kept_by_pieces", static_cast<double>(workspace.bytes()) / faces},
               {"cut_ns", 1e9 * (once - times.second) / faces},
               {"model2", model[0] / n},
               {"model4", model[1] / n},
               {"model8", model[2] / n},
               {"model64", model[3] / n},
               {"serial_ms", 1e3 * times.first},
               {"ms", 1e3 * times.second},
               {"speed", 1 / times.ratio}});
  }
}

template <class Real>
void measure(const bench::Surface& surface, const bench::Effort& effort, const Settings& settings,
             bench::Table& table) {
  const TriangleMesh<Real> mesh(surface.positions, surface.faces);
  PropagateOptions options;
  options.accuracy = accuracies.at(settings.accuracy);
  measure(surface.name, mesh, mesh.face_count(), bench::rotating_sources(surface, effort.sources),
          options, effort, settings, table);
}

/// Points a unit apart, each pushed by up to 0.3, and struts between them; `layers` of n x n.
void measure_wires(std::size_t n, std::size_t layers, const bench::Effort& effort,
                   const Settings& settings, bench::Table& table) {
  samples::Noise noise(1);
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 2>> edges;
  for (std::size_t k = 0; k < layers; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const auto v = positions.size();
        const auto pushed = [&](std::size_t at) { return static_cast<double>(at) + 0.3 * noise(); };
        const double x = pushed(i), y = pushed(j), z = layers > 1 ? pushed(k) : 0;
        positions.push_back({x, y, z});
        for (const auto& [there, to] :
             {std::pair(i > 0, v - 1), {j > 0, v - n}, {k > 0, v - n * n}})
          if (there) edges.push_back({static_cast<Index>(to), static_cast<Index>(v)});
      }
  const Wireframe<float> wires(positions, edges);
  measure(layers > 1 ? "lattice" : "grid", wires, positions.size(),
          bench::spread_numbers(effort.sources, positions.size()), {}, effort, settings, table);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  std::vector<std::size_t> grids, lattices;
  bench::Effort effort;
  effort.sources = 3;
  bench::Report report;
  CLI::App app(
      "Surfaces and wireframes by pieces: counts, a model of more threads, times beside Serial");
  app.add_option("MESH", settings.meshes, "Surfaces");
  app.add_option("--generated", settings.generated, "Bumpy spheres of about so many vertices");
  app.add_option("--grid", grids, "Wireframes: grids of so many points squared");
  app.add_option("--lattice", lattices, "Wireframes: lattices of so many points cubed");
  app.add_option("--sizes", settings.sizes, "Triangles (vertices of wireframes) a piece")
      ->capture_default_str();
  app.add_option("--threads", settings.threads, "Threads of the runs that are timed")
      ->capture_default_str();
  app.add_option("--accuracy", settings.accuracy, "fast, accurate or exact (in double)")
      ->check(CLI::IsMember({"fast", "accurate", "exact"}))
      ->capture_default_str();
  app.add_option("--repeats", settings.repeats, "Solves whose bits are compared")
      ->capture_default_str();
  app.add_option("--sources", effort.sources, "Sources a mesh")->capture_default_str();
  app.add_option("--budget", effort.budget, "Seconds a row")->capture_default_str();
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  bench::Table table({{"mesh", "mesh"},
                      {"faces", "triangles"},
                      {"size", "a piece"},
                      {"supersteps", "supersteps", "%.0f"},
                      {"serial", "expansions a triangle, Serial", "%.3f"},
                      {"expansions", "pieces", "%.3f"},
                      {"letters", "letters a triangle", "%.3f"},
                      {"bytes", "their bytes", "%.1f"},
                      {"others", "other bits"},
                      {"kept_by_one", "bytes kept a triangle, Serial", "%.0f"},
                      {"kept_by_pieces", "pieces", "%.0f"},
                      {"cut_ns", "cutting, ns a triangle", "%.0f"},
                      {"model2", "model, 2 threads", "%.2f"},
                      {"model4", "4", "%.2f"},
                      {"model8", "8", "%.2f"},
                      {"model64", "64", "%.2f"},
                      {"serial_ms", "Serial, ms", "%.1f"},
                      {"ms", "pieces, ms", "%.1f"},
                      {"speed", "speed", "%.2f"}});
  return report.write(table, [&] {
    const auto any = [&](const bench::Surface& surface) {
      if (settings.accuracy == "exact")
        measure<double>(surface, effort, settings, table);
      else
        measure<float>(surface, effort, settings, table);
    };
    for (const std::string& mesh : settings.meshes) any(bench::read_surface(mesh));
    for (const std::size_t vertices : settings.generated) any(bench::bumpy_surface(vertices));
    for (const std::size_t n : grids) measure_wires(n, 1, effort, settings, table);
    for (const std::size_t n : lattices) measure_wires(n, n, effort, settings, table);
  });
}
