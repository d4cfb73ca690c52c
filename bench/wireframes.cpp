// Wireframes: plexway against Boost.Graph's Dijkstra, the call that Boost documents and the fastest
// of its variants, on a square grid, a lattice of struts and a graph whose lengths differ by twelve
// powers of ten. All three take turns in one process.

#ifdef PLEXWAY_HAS_BOOST_GRAPH

#include <cmath>

#include <plexway/boost_graph/dijkstra.hpp>

#include "scenes.hpp"
#include "solver.hpp"

namespace bench::wireframes {

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
  const auto place = shuffled(wires.positions.size(), noise);
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
Row measure(const Wires& wires, const Effort& effort) {
  const double vertices = static_cast<double>(wires.positions.size());
  Row row;
  std::unique_ptr<plexway::Wireframe<Real>> wireframe;
  row["build_ns_per_vertex"] =
      1e9 / vertices * seconds([&] {
        wireframe = std::make_unique<plexway::Wireframe<Real>>(wireframe_of<Real>(wires));
      });
  Solver solver(*wireframe);
  plexway::boost_graph::EdgeDijkstra<Real> dijkstra{plexway::boost_graph::EdgeGraph(*wireframe)};
  const auto sources = spread_numbers(effort.sources, wires.positions.size());
  const auto solve = [&](Index v) { solver(v); };
  const Times documented = take_turns(
      sources, effort, [&](Index v) { dijkstra.run(v); }, solve);
  const Times fastest = take_turns(
      sources, effort, [&](Index v) { dijkstra.run_without_colours(v); }, solve);
  row["ns_per_vertex"] = 1e9 * documented.second / vertices;
  row["documented_ns_per_vertex"] = 1e9 * documented.first / vertices;
  row["ratio"] = documented.ratio;
  row["fastest_ns_per_vertex"] = 1e9 * fastest.first / vertices;
  row["fastest_ratio"] = fastest.ratio;

  std::size_t different = 0;
  dijkstra.run(sources[0]);
  solve(sources[0]);
  for (std::size_t v = 0; v < solver.distance().size(); ++v)
    different += solver.distance()[v] != dijkstra.distance()[v];
  if (different > 0) row["note"] = std::to_string(different) + " distances differ";
  row["expansions_per_vertex"] = static_cast<double>(solver.statistics().expansions) / vertices;
  row["bytes_per_vertex"] = static_cast<double>(wireframe->bytes() + solver.workspace().bytes() +
                                                solver.distance().capacity() * sizeof(Real)) /
                            vertices;
  return row;
}

void run(Arguments& arguments) {
  Effort effort{8, 2, 20};
  double size = 1;
  effort.add_options(arguments);
  arguments.option("--size", &size, "Points along each side, in proportion");
  arguments.add_limit();
  Table& table = arguments.table(
      "wireframe; vertices; edges; build_ns_per_vertex: build ns/V %.0f;"
      "ns_per_vertex: solve ns/V %.1f; documented_ns_per_vertex: Dijkstra ns/V %.1f; ratio %.2f;"
      "fastest_ns_per_vertex: fastest variant ns/V %.1f; fastest_ratio: ratio to it %.2f;"
      "expansions_per_vertex: expansions/V %.2f; bytes_per_vertex: bytes/V %.0f; note");
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
  for (const auto& make : all) {
    const Wires wires = make();
    table.measure({{"wireframe", wires.name},
                   {"vertices", wires.positions.size()},
                   {"edges", wires.edges.size()}},
                  arguments.limit, [&] { return measure<float>(wires, effort); });
  }
}
const Command command("wireframes", "wireframes against Boost's Dijkstra", run);

}  // namespace bench::wireframes

#endif
