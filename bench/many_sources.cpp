// Many sources on a flat grid, spread evenly or a whole side of it: what a vertex costs, and how
// far off the worst one is from the nearest straight line. Time should not grow with their number.

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver.hpp"

namespace bench::many_sources {

struct Grid {
  Index side;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;

  explicit Grid(Index n) : side(n) {
    for (Index v = 0; v < n * n; ++v)
      positions.push_back({static_cast<double>(v % n), static_cast<double>(v / n), 0});
    for (Index v = 0; v + n < n * n; ++v) {
      if (v % n + 1 == n) continue;
      faces.push_back({v, v + 1, v + n + 1});
      faces.push_back({v, v + n + 1, v + n});
    }
  }
};

// So many vertices over the whole grid; 0: its first row.
std::vector<Index> sources_on(const Grid& grid, std::size_t count) {
  std::vector<Index> sources;
  if (count == 0)
    for (Index v = 0; v < grid.side; ++v) sources.push_back(v);
  for (std::size_t k = 0; k < count; ++k)
    sources.push_back(static_cast<Index>((2 * k + 1) * 0x9e3779b9U % (grid.positions.size() | 1)) %
                      static_cast<Index>(grid.positions.size()));
  return sources;
}

std::vector<double> lines_to(const Grid& grid, const std::vector<Index>& sources) {
  std::vector<double> least(grid.positions.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < least.size(); ++v)
    for (const Index s : sources) {
      const double x = grid.positions[v][0] - grid.positions[s][0];
      const double y = grid.positions[v][1] - grid.positions[s][1];
      least[v] = std::min(least[v], x * x + y * y);
    }
  for (double& d : least) d = std::sqrt(d);
  return least;
}

template <class Real>
void measure(const plexway::TriangleMesh<Real>& mesh, const std::vector<Index>& from,
             const std::vector<double>& truth, const std::string& accuracy, std::size_t repeats,
             Row& row) {
  std::vector<plexway::PointSource> sources;
  for (const Index v : from) sources.push_back(plexway::PointSource::at(v));
  Solver solver(mesh);
  double least = std::numeric_limits<double>::infinity(), worst = 0;
  for (std::size_t k = 0; k < repeats; ++k)
    least =
        std::min(least, processor_seconds([&] { solver.solve(sources, by_accuracy(accuracy)); }));
  for (std::size_t v = 0; v < truth.size(); ++v)
    if (truth[v] > 0)
      worst = std::max(worst, std::abs(static_cast<double>(solver.distance()[v]) / truth[v] - 1));
  row[accuracy] = 1e9 * least / static_cast<double>(truth.size());
  row[accuracy + "_max"] = worst;
}

void run(Arguments& arguments) {
  std::vector<Index> sides = {200, 400};
  std::vector<std::size_t> counts = {1, 10, 100, 1000, 0};
  std::size_t repeats = 3;
  arguments.option("--sides", &sides, "Vertices along a side of the grid");
  arguments.option("--counts", &counts, "Sources; 0 is a whole side");
  arguments.positive("--repeats", &repeats, "Of each the least time counts");
  Table& table = arguments.table(
      "side; sources; fast: fast, ns/V %.0f; fast_max: worst %.1e; accurate: accurate, ns/V %.0f;"
      "accurate_max: worst %.1e; exact: exact, ns/V (double) %.0f; exact_max: worst %.1e");
  for (const Index side : sides) {
    const Grid grid(side);
    const plexway::TriangleMesh<float> single(grid.positions, grid.faces);
    const plexway::TriangleMesh<double> twice(grid.positions, grid.faces);
    for (const std::size_t count : counts) {
      const std::vector<Index> from = sources_on(grid, count);
      const std::vector<double> truth = lines_to(grid, from);
      Row row = {{"side", side}};
      row["sources"] = count == 0 ? Value("a side") : Value(count);
      measure(single, from, truth, "fast", repeats, row);
      measure(single, from, truth, "accurate", repeats, row);
      measure(twice, from, truth, "exact", repeats, row);
      table.add(row);
    }
  }
}
const Command command("many_sources", "many sources on flat grids, against straight lines", run);

}  // namespace bench::many_sources
