// What sampling costs, in propagations from a single source on the same surface; and how good it
// is.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <plexway/apps/centroidal_voronoi.hpp>
#include <plexway/apps/distance_matrix.hpp>
#include <plexway/apps/farthest_points.hpp>
#include <plexway/apps/poisson_disk.hpp>
#include <plexway/error.hpp>

#include "../data/shapes.hpp"
#include "harness.hpp"
#include "isolate.hpp"

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

// ---- Memory ----

/// What a sample takes at its peak beyond its domain, in a process of its own.
template <class Domain>
void measure_memory(const char* name, const std::function<Domain()>& make,
                    const std::vector<double>& radii) {
  double before_peak = 0, before_darts = 0;
  for (const double radius : radii) {
    const auto result = bench::isolated(600, [&] {
      const Domain domain = make();
      bench::return_free_memory();
      const double start = bench::status_bytes("VmHWM").value_or(0);
      const PoissonDisks disks = poisson_disks(Serial{}, domain, {.radius = radius});
      return nlohmann::ordered_json{{"darts", disks.darts.size()},
                                    {"start", start},
                                    {"peak", bench::status_bytes("VmHWM").value_or(0)}};
    });
    if (result.contains("note")) {
      std::printf("%s: %s\n", name, result["note"].template get<std::string>().c_str());
      return;
    }
    const double darts = result["darts"], peak = result["peak"];
    std::printf("%-22s radius %-8.4g %9.0f darts, peak %7.1f MB (domain %.1f MB)", name, radius,
                darts, peak / 1e6, result["start"].template get<double>() / 1e6);
    if (before_darts > 0)
      std::printf(", %.0f bytes more a dart", (peak - before_peak) / (darts - before_darts));
    std::printf("\n");
    std::fflush(stdout);
    before_peak = peak, before_darts = darts;
  }
}

void measure_memory() {
  std::vector<std::array<double, 3>> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? 1. : 0., i & 2 ? 1. : 0., i & 4 ? 1. : 0.});
  const std::vector<std::array<Index, 4>> kuhn = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                                  {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  measure_memory<TetMesh<float>>("cube of 6 tetrahedra",
                                 [&] { return TetMesh<float>(corners, kuhn); },
                                 {0.2, 0.06, 0.045, 0.036});
  const std::vector<std::array<Index, 3>> halves = {{0, 1, 3}, {0, 3, 2}};
  measure_memory<TriangleMesh<float>>(
      "square of 2 triangles",
      [&] { return TriangleMesh<float>(std::span(corners).first(4), halves); },
      {0.05, 0.008, 0.004, 0.002});
  const samples::Shape sphere = samples::geodesic_sphere(200);
  const double edge = 1. / 200;
  measure_memory<TriangleMesh<float>>(
      "sphere, 800k triangles", [&] { return TriangleMesh<float>(sphere.points, sphere.faces); },
      {0.2, 8 * edge, 4 * edge});
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t count = 1000;
  bool memory = false;
  std::vector<std::string> meshes;
  CLI::App app("What sampling costs, in solves from one source on the same surface");
  app.add_option("MESH", meshes,
                 "Surfaces (.obj .off .ply .stl); none: two of 200 thousand triangles");
  app.add_option("--count", count, "Points")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_flag("--memory", memory, "Only bytes a dart: the peak over samples of several radii");
  CLI11_PARSE(app, argc, argv);
  try {
    if (memory) {
      measure_memory();
      return 0;
    }
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
