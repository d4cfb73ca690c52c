// What sampling costs, in propagations from a single source on the same surface; and how good it
// is.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include <plexway/apps/centroidal_voronoi.hpp>
#include <plexway/apps/distance_matrix.hpp>
#include <plexway/apps/farthest_points.hpp>
#include <plexway/apps/poisson_disk.hpp>
#include <plexway/error.hpp>

#include "../data/shapes.hpp"
#include "harness.hpp"

using namespace plexway;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double spread(const std::vector<double>& areas) {
  double mean = 0, square = 0;
  for (const double a : areas) mean += a;
  mean /= static_cast<double>(areas.size());
  for (const double a : areas) square += (a - mean) * (a - mean);
  return std::sqrt(square / static_cast<double>(areas.size())) / mean;
}

void measure(const std::string& name, const std::vector<std::array<double, 3>>& positions,
             const std::vector<std::array<Index, 3>>& faces, std::size_t count) {
  const TriangleMesh<float> mesh(positions, faces);
  Workspace<float> workspace, darts_workspace;
  DistanceField<float> field;
  PoissonOptions options;
  options.count = count;
  PoissonDisks darts = poisson_disks(Serial{}, mesh, options, darts_workspace);
  options.count = 0;
  options.radius = darts.radius;
  double solve = infinity, poisson = infinity, farthest = infinity, pairs = infinity;
  double voronoi[2] = {infinity, infinity};
  FarthestPoints far;
  CentroidalVoronoi cells[2];
  // Processor time: others on the machine then count less.
  const auto least = [](double& best, const auto& work) {
    const std::clock_t before = std::clock();
    work();
    best = std::min(best, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
  };
  std::vector<PointSource> chosen;
  for (int turn = 0; turn < 5; ++turn) {
    const PointSource source =
        PointSource::at(static_cast<Index>(positions.size() / 7) * static_cast<Index>(turn));
    least(solve, [&] {
      plexway::solve(Serial{}, mesh, std::span(&source, 1), bench::one_label(), workspace, field);
    });
    least(poisson, [&] { darts = poisson_disks(Serial{}, mesh, options, darts_workspace); });
    if (turn > 2) continue;
    for (const int m : {0, 1}) {
      VoronoiOptions settings;
      settings.centre = m == 0 ? CellCentre::centroid : CellCentre::farthest_from_border;
      settings.max_iterations = 20;
      settings.tolerance = 0;
      least(voronoi[m],
            [&] { cells[m] = centroidal_voronoi(Serial{}, mesh, darts.darts, settings); });
    }
    const PointSource first = PointSource::at(0);
    least(farthest,
          [&] { far = farthest_points(Serial{}, mesh, std::span(&first, 1), {.count = count}); });
    chosen.assign(far.points.begin(), far.points.begin() + 50);
    least(pairs, [&] { (void)distance_matrix(Serial{}, mesh, chosen); });
  }
  std::printf("%s: %zu triangles, one solve %.1f ms\n", name.c_str(), faces.size(), solve * 1e3);
  std::printf(
      "  poisson   %.2f solves (%zu darts, %zu thrown, %zu taken back, %.2f expansions a "
      "triangle)\n",
      poisson / solve, darts.darts.size(), darts.thrown, darts.taken_back,
      static_cast<double>(darts.statistics.expansions) / static_cast<double>(faces.size()));
  for (const int m : {0, 1}) {
    const auto& steps = cells[m].steps;
    std::size_t rises = 0;
    for (std::size_t n = 1; n < steps.size(); ++n) rises += steps[n].energy > steps[n - 1].energy;
    std::printf(
        "  cvt       %.2f solves an iteration, %s: energy %.6g to %.6g, %zu rises; area spread "
        "%.4f; movement %.2g of the radius\n",
        voronoi[m] / 21 / solve, m == 0 ? "centroid" : "from border", steps[0].energy,
        cells[m].energy, rises, spread(cells[m].cell_content),
        steps.back().movement / darts.radius);
  }
  VoronoiOptions none_yet;
  none_yet.max_iterations = 0;
  std::printf("            area spread at the start %.4f\n",
              spread(centroidal_voronoi(Serial{}, mesh, darts.darts, none_yet).cell_content));
  std::printf("  farthest  %.2f solves for %zu points, covering radius %.3g (poisson %.3g)\n",
              farthest / solve, far.points.size(), far.covering, darts.radius);
  std::printf("  pairs     %.3f solves a point of 50\n", pairs / 50 / solve);
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t count = 1000;
  std::vector<std::string> meshes;
  CLI::App app("What sampling costs, in solves from one source on the same surface");
  app.add_option("MESH", meshes,
                 "Surfaces (.obj .off .ply .stl); none: two of 200 thousand triangles");
  app.add_option("--count", count, "Points")->capture_default_str()->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& mesh : meshes) {
      const bench::Surface s = bench::read_surface(mesh);
      measure(s.name, s.positions, s.faces, count);
    }
    if (!meshes.empty()) return 0;
    const samples::Shape sphere = samples::geodesic_sphere(100), bumpy = samples::bumpy(100);
    measure("sphere", sphere.points, sphere.faces, count);
    measure("bumpy", bumpy.points, bumpy.faces, count);
    return 0;
  } catch (const Error& error) {
    std::fprintf(stderr, "bench_sampling: %s\n", error.what());
    return 1;
  }
}
