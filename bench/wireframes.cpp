// Wireframes: plexway against Boost.Graph's Dijkstra, the call that Boost documents and the fastest
// of its variants, on a square grid, a lattice of struts and a graph whose lengths differ by twelve
// powers of ten. All three take turns in one process.

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/solve.hpp>

#include "../data/shapes.hpp"
#include "compare.hpp"

namespace {

using bench::Index;

struct Wires {
  std::string name;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> lengths;  // empty: from the positions
};

/// nx by ny by nz points a unit apart, each pushed by up to `push` along each axis that there is.
Wires lattice(std::string name, Index nx, Index ny, Index nz, double push) {
  Wires wires{std::move(name), {}, {}, {}};
  samples::Noise noise(1);
  for (Index k = 0; k < nz; ++k)
    for (Index j = 0; j < ny; ++j)
      for (Index i = 0; i < nx; ++i) {
        const Index v = static_cast<Index>(wires.positions.size());
        const double x = push * noise(), y = push * noise(), z = nz > 1 ? push * noise() : 0;
        wires.positions.push_back({i + x, j + y, k + z});
        if (i > 0) wires.edges.push_back({v - 1, v});
        if (j > 0) wires.edges.push_back({v - nx, v});
        if (k > 0) wires.edges.push_back({v - nx * ny, v});
      }
  return wires;
}

/// A path through all vertices in a row, and twice as many edges between any two of them.
Wires spread_lengths(Index n) {
  Wires wires{"any edges, lengths 1e-6 to 1e6", {}, {}, {}};
  samples::Noise noise(2);
  wires.positions.resize(n, {0, 0, 0});
  const auto any = [&] {
    return std::min(n - 1, static_cast<Index>((noise() + 1) / 2 * static_cast<double>(n)));
  };
  for (Index v = 0; v + 1 < n; ++v) wires.edges.push_back({v, v + 1});
  for (Index e = 0; e < 2 * n; ++e) wires.edges.push_back({any(), any()});
  for (std::size_t e = 0; e < wires.edges.size(); ++e)
    wires.lengths.push_back(std::pow(10, 6 * noise()));
  return wires;
}

/// Vertices in an order that says nothing about where they are.
void shuffle(Wires& wires) {
  samples::Noise noise(3);
  std::vector<Index> place(wires.positions.size());
  std::iota(place.begin(), place.end(), Index{0});
  for (std::size_t i = place.size(); i > 1; --i) {
    const double at = (noise() + 1) / 2 * static_cast<double>(i);
    std::swap(place[i - 1], place[std::min(i - 1, static_cast<std::size_t>(at))]);
  }
  const auto old = wires.positions;
  for (std::size_t v = 0; v < old.size(); ++v) wires.positions[place[v]] = old[v];
  for (auto& edge : wires.edges)
    for (Index& v : edge) v = place[v];
  wires.name += ", shuffled";
}

template <class Real>
plexway::Wireframe<Real> wireframe_of(const Wires& wires) {
  if (wires.lengths.empty()) return {wires.positions, wires.edges};
  return {wires.positions.size(), wires.edges, wires.lengths};
}

template <class Real>
nlohmann::ordered_json measure(const Wires& wires, const bench::Effort& effort) {
  const double vertices = static_cast<double>(wires.positions.size());
  nlohmann::ordered_json row;
  std::unique_ptr<plexway::Wireframe<Real>> wireframe;
  row["build_ns_per_vertex"] =
      1e9 / vertices * bench::seconds([&] {
        wireframe = std::make_unique<plexway::Wireframe<Real>>(wireframe_of<Real>(wires));
      });
  plexway::Workspace<Real> workspace;
  plexway::DistanceField<Real> field;
  plexway::boost_graph::EdgeDijkstra<Real> dijkstra{plexway::boost_graph::EdgeGraph(*wireframe)};

  const auto sources = bench::spread_numbers(effort.sources, wires.positions.size());
  const auto solve = [&](Index v) {
    const auto source = plexway::PointSource::at(v);
    plexway::solve(plexway::Serial{}, *wireframe, std::span(&source, 1), {}, workspace, field);
  };
  const auto documented = bench::take_turns(
      sources, effort, [&](Index v) { dijkstra.run(v); }, solve);
  const auto fastest = bench::take_turns(
      sources, effort, [&](Index v) { dijkstra.run_without_colours(v); }, solve);
  row["ns_per_vertex"] = 1e9 * documented.second / vertices;
  row["documented_ns_per_vertex"] = 1e9 * documented.first / vertices;
  row["ratio"] = documented.ratio;
  row["fastest_ns_per_vertex"] = 1e9 * fastest.first / vertices;
  row["fastest_ratio"] = fastest.ratio;

  std::size_t different = 0;
  dijkstra.run(sources[0]);
  solve(sources[0]);
  for (std::size_t v = 0; v < field.distance.size(); ++v)
    different += field.distance[v] != dijkstra.distance()[v];
  if (different > 0) row["note"] = std::to_string(different) + " distances differ";
  row["expansions_per_vertex"] = static_cast<double>(field.statistics.expansions) / vertices;
  row["bytes_per_vertex"] = static_cast<double>(wireframe->bytes() + workspace.bytes() +
                                                field.distance.capacity() * sizeof(Real)) /
                            vertices;
  return row;
}

bench::Table wireframe_table() {
  return bench::Table({{"wireframe", "wireframe"},
                       {"vertices", "vertices"},
                       {"edges", "edges"},
                       {"build_ns_per_vertex", "build ns/V", "%.0f"},
                       {"ns_per_vertex", "solve ns/V", "%.1f"},
                       {"documented_ns_per_vertex", "Dijkstra ns/V", "%.1f"},
                       {"ratio", "ratio", "%.2f"},
                       {"fastest_ns_per_vertex", "fastest variant ns/V", "%.1f"},
                       {"fastest_ratio", "ratio to it", "%.2f"},
                       {"expansions_per_vertex", "expansions/V", "%.2f"},
                       {"bytes_per_vertex", "bytes/V", "%.0f"},
                       {"note", "note"}});
}

}  // namespace

int main(int argc, char** argv) {
  bench::Effort effort{8, 2, 20};
  double limit = 600;
  double size = 1;
  bench::Report report;
  bool double_precision = false;
  CLI::App app("Wireframes against Boost's Dijkstra: one table");
  bench::add_effort_options(app, effort);
  app.add_option("--size", size, "Points along each side, in proportion")->capture_default_str();
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  app.add_flag("--double", double_precision, "Double instead of float");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  const auto side = [&](double points) { return static_cast<Index>(std::max(2.0, size * points)); };
  const Index n = side(1000), m = side(112);
  const std::vector<std::function<Wires()>> all = {
      [&] { return lattice("grid", n, n, 1, 0); },
      [&] { return lattice("grid, points moved", n, n, 1, 0.3); },
      [&] { return lattice("strut lattice", m, m, m, 0); },
      [&] { return lattice("strut lattice, points moved", m, m, m, 0.3); },
      [&] {
        Wires wires = lattice("strut lattice, points moved", m, m, m, 0.3);
        shuffle(wires);
        return wires;
      },
      [&] { return spread_lengths(n * n / 2); },
  };
  bench::Table table = wireframe_table();
  return report.write(table, [&] {
    for (const auto& make : all) {
      const Wires wires = make();
      std::cerr << wires.name << std::endl;
      nlohmann::ordered_json row = {{"wireframe", wires.name},
                                    {"vertices", wires.positions.size()},
                                    {"edges", wires.edges.size()}};
      row.update(bench::isolated(limit, [&] {
        return double_precision ? measure<double>(wires, effort) : measure<float>(wires, effort);
      }));
      table.add(std::move(row));
    }
  });
}
