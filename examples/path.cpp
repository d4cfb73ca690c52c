// Ways over a hilly landscape: back from any point to the nearest of two huts, and a search that
// looks only at what a shortest path may pass. Writes path.obj if given a name for it.

#include <cmath>
#include <cstdio>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/paths.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/paths/path_search.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/triangle_mesh.hpp>

using namespace plexway;

int main(int argc, char** argv) {
  try {
    constexpr Index n = 80;
    std::vector<std::array<double, 3>> positions;
    std::vector<std::array<Index, 3>> faces;
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) {
        const double x = i / double(n), y = j / double(n);
        positions.push_back({x, y, 0.1 * std::sin(11 * x) * std::cos(8 * y)});
      }
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        faces.push_back({a, b, d});
        faces.push_back({a, d, c});
      }
    const TriangleMesh<float> landscape(positions, faces);

    // One solve, then any number of ways back.
    PathField field(landscape, positions);
    const std::vector<PointSource> huts = {PointSource::at(0), PointSource::at(n * (n + 2))};
    field.solve(Serial{}, huts);
    std::vector<Path> paths;
    for (const Index from : {Index{n}, Index{n * (n + 1)}, Index{40 * (n + 1) + 30}}) {
      paths.push_back(field.trace(from));
      std::printf("from vertex %u to hut %u: %.4f, over %zu triangles\n", from, paths.back().source,
                  paths.back().length, paths.back().points.size() - 1);
    }

    // One way only: A* leaves most of the landscape alone.
    PathSearch<float> search(landscape, positions);
    const SearchResult found = search.find(Serial{}, huts[0], PointSource::at(n));
    field.solve(Serial{}, huts[0]);
    const double whole = static_cast<double>(field.distances().statistics.expansions);
    std::printf("search: %.4f after %zu expansions, %.1f %% of a solve's\n", found.paths[0].length,
                found.statistics.expansions,
                100 * static_cast<double>(found.statistics.expansions) / whole);
    if (argc > 1) io::write_paths(argv[1], paths);
    return std::abs(found.paths[0].length / field.trace(n).length - 1) < 1e-4 ? 0 : 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
