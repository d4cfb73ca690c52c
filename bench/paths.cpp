// Paths, searches for a target and bounded searches.
//
//   bench_paths MESH...   A* and paths on each; then bounded searches on a surface of a million
//                         triangles (none of them with MESH alone: --bounded for those only)
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <plexway/apps/bounded_search.hpp>
#include <plexway/apps/path_field.hpp>
#include <plexway/apps/path_search.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/error.hpp>
#include <plexway/executors/serial.hpp>
#include <plexway/io/triangles.hpp>

using namespace plexway;

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// A* against the full solve, for random pairs at half the diameter (as far as one vertex sees) or
// nearer.
void searches(const std::string& file) {
  const io::Triangles surface = io::read_triangles(file);
  const TriangleMesh<float> mesh(surface.positions, surface.triangles);
  PathField field(mesh, surface.positions);
  PathSearch<float> search(mesh, surface.positions), nearest_first(mesh);
  std::mt19937 random(1);
  std::vector<double> shares, plain_shares, gaps, trace_us, search_ms, solve_ms;
  double mean_share = 0;
  for (int k = 0; k < 10; ++k) {
    const Index source = static_cast<Index>(random() % surface.positions.size());
    const double begin = now();
    field.solve(Serial{}, PointSource::at(source));
    solve_ms.push_back((now() - begin) * 1e3);
    double farthest = 0;
    for (const float d : field.distances().distance)
      if (d < std::numeric_limits<float>::infinity()) farthest = std::max(farthest, double(d));
    const auto all = static_cast<double>(field.distances().statistics.expansions);
    for (int i = 0; i < 10;) {
      const Index target = static_cast<Index>(random() % surface.positions.size());
      const double d = static_cast<double>(field.distances().distance[target]);
      if (!(d > 0) || !(d <= farthest / 2)) continue;
      ++i;
      const double traced = now();
      const Path path = field.trace(target);
      trace_us.push_back((now() - traced) * 1e6);
      const double searched = now();
      const auto found = search.find(Serial{}, PointSource::at(source), PointSource::at(target));
      search_ms.push_back((now() - searched) * 1e3);
      const auto plain =
          nearest_first.find(Serial{}, PointSource::at(source), PointSource::at(target));
      shares.push_back(static_cast<double>(found.statistics.expansions) / all);
      plain_shares.push_back(static_cast<double>(plain.statistics.expansions) / all);
      mean_share += shares.back() / 100;
      gaps.push_back(std::abs(found.paths[0].length / path.length - 1));
    }
  }
  std::sort(shares.begin(), shares.end());
  std::printf(
      "%-28s %8zu triangles  A* share of expansions: median %.3f mean %.3f most %.3f (nearest "
      "first: %.3f)  length off: median %.1e most %.1e  solve %.2f ms, A* with path %.2f ms, path "
      "%.0f us\n",
      file.substr(file.rfind('/') + 1).c_str(), surface.triangles.size(), median(shares),
      mean_share, shares.back(), median(plain_shares), median(gaps),
      *std::max_element(gaps.begin(), gaps.end()), median(solve_ms), median(search_ms),
      median(trace_us));
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
    double begin = now();
    propagate(Serial{}, mesh, std::span<const PointSource>(&source, 1), PropagateOptions{},
              workspace, field);
    solves.push_back(now() - begin);
    begin = now();
    triangles = 0;
    for (int k = 0; k < 1000; ++k)
      triangles += static_cast<double>(
          search
              .find(Serial{}, PointSource::at(static_cast<Index>(random() % positions.size())),
                    radius)
              .statistics.reached_simplices);
    rounds.push_back(now() - begin);
  }
  std::printf(
      "%zu triangles: a full solve %.1f ms; 1000 bounded searches of %.0f triangles %.1f ms = %.2f "
      "solves\n",
      faces.size(), median(solves) * 1e3, triangles / 1000, median(rounds) * 1e3,
      median(rounds) / median(solves));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (int i = 1; i < argc; ++i)
      if (std::strcmp(argv[i], "--bounded") != 0) searches(argv[i]);
    bounded();
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "bench_paths: %s\n", error.what());
    return 1;
  }
}
