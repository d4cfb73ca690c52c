// Level sets cut into tetrahedra: time and memory as the voxels get smaller, and distances inside
// beside those in TetGen's solid of the same surface.

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include <plexway/solve.hpp>
#ifdef PLEXWAY_HAS_OPENVDB
#include <plexway/openvdb/level_set.hpp>
#include <plexway/openvdb/solid.hpp>
#endif
#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/tetrahedralize.hpp>
#endif

#include "isolate.hpp"

#ifdef PLEXWAY_HAS_OPENVDB
namespace {

using Point = std::array<double, 3>;
using plexway::Index;
using plexway::openvdb::LevelSet;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Peak, in bytes.
double memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

LevelSet ball(double voxel) {
  const double r = 1 + 4 * voxel;
  return plexway::openvdb::level_set_of(
      [](const Point& p) { return std::hypot(p[0], p[1], p[2]) - 1; }, {-r, -r, -r}, {r, r, r},
      voxel);
}

LevelSet gyroid(double voxel) {
  const auto function = [](const Point& p) {
    const double k = 2 * 3.14159265358979323846;
    const double g = std::sin(k * p[0]) * std::cos(k * p[1]) +
                     std::sin(k * p[1]) * std::cos(k * p[2]) +
                     std::sin(k * p[2]) * std::cos(k * p[0]);
    const double box =
        std::max({std::abs(p[0] - 0.5), std::abs(p[1] - 0.5), std::abs(p[2] - 0.5)}) - 0.5;
    return std::max((g - 0.2) / (1.5 * k), box);
  };
  const double r = 4 * voxel;
  return plexway::openvdb::level_set_of(function, {-r, -r, -r}, {1 + r, 1 + r, 1 + r}, voxel);
}

void grow(const char* name, const std::function<LevelSet(double)>& make, double voxel) {
  const auto row = bench::isolated(600, [&] {
    const LevelSet level_set = make(voxel);
    const double before = memory();
    plexway::openvdb::Solid solid;
    const double time = seconds([&] { solid = plexway::openvdb::fill(level_set); });
    return nlohmann::ordered_json{{"active", level_set.active_voxels()},
                                  {"inside", level_set.inside_voxels()},
                                  {"tets", solid.tets.size()},
                                  {"seconds", time},
                                  {"bytes", memory() - before}};
  });
  if (row.contains("note")) {
    std::printf("%-8s %8.4f  %s\n", name, voxel, row["note"].get<std::string>().c_str());
    return;
  }
  const double inside = row["inside"];
  std::printf("%-8s %8.4f %10.0f %10.0f %10.0f %8.2f %14.0f %14.0f\n", name, voxel,
              row["active"].get<double>(), inside, row["tets"].get<double>(),
              row["seconds"].get<double>(), row["seconds"].get<double>() / inside * 1e9,
              row["bytes"].get<double>() / inside);
}

#ifdef PLEXWAY_HAS_TETGEN
void compare(const char* name, const LevelSet& level_set, double share) {
  const auto cut = plexway::openvdb::fill(level_set);
  const auto surface = plexway::openvdb::surface_of(level_set);
  const plexway::TetMesh<double> own(cut.positions, cut.tets);
  const double edge = own.summary().mean_edge;
  const double bound = share * edge * edge * edge / (6 * std::sqrt(2.0));
  const auto solid = plexway::tetgen::tetrahedralize(surface.positions, surface.triangles, {},
                                                     {.max_volume = bound, .keep_surface = true});
  const plexway::TetMesh<double> peer(solid.positions, solid.tets);
  std::map<Point, Index> at;
  for (Index v = 0; v < cut.positions.size(); ++v) at[cut.positions[v]] = v;
  const auto from =
      static_cast<Index>(std::min_element(surface.positions.begin(), surface.positions.end()) -
                         surface.positions.begin());
  using plexway::PointSource;
  const auto mine =
      plexway::solve(plexway::Serial{}, own, PointSource::at(at[surface.positions[from]]));
  const auto theirs = plexway::solve(plexway::Serial{}, peer, PointSource::at(from));
  double sum = 0, most = 0;
  std::size_t count = 0;
  for (Index v = 0; v < surface.positions.size(); ++v) {
    const double a = mine.distance[at[surface.positions[v]]], b = theirs.distance[v];
    if (v == from || !std::isfinite(a) || !std::isfinite(b)) continue;
    sum += std::abs(a / b - 1);
    most = std::max(most, std::abs(a / b - 1));
    ++count;
  }
  std::printf("%-8s %10zu %10zu %10.4f %10.4f %10.2e %10.2e\n", name, cut.tets.size(),
              solid.tets.size(), edge, peer.summary().mean_edge, sum / static_cast<double>(count),
              most);
}
#endif

}  // namespace
#endif

int main() {
#ifdef PLEXWAY_HAS_OPENVDB
  std::printf("level sets cut into tetrahedra\n%-8s %8s %10s %10s %10s %8s %14s %14s\n", "shape",
              "voxel", "active", "inside", "tets", "s", "ns a voxel in", "bytes a v. in");
  for (const double voxel : {0.08, 0.04, 0.02, 0.01}) grow("ball", ball, voxel);
  for (const double voxel : {0.04, 0.02, 0.01, 0.005}) grow("gyroid", gyroid, voxel);
#ifdef PLEXWAY_HAS_TETGEN
  std::printf(
      "\ndistances beside those in TetGen's solid of the same surface\n"
      "%-8s %10s %10s %10s %10s %10s %10s\n",
      "shape", "tets", "TetGen's", "edge", "TetGen's", "mean", "largest");
  compare("ball", ball(0.08), 2.4);
  compare("gyroid", gyroid(0.04), 2.4);
#endif
#else
  std::puts("this build has no OpenVDB: install libopenvdb-dev");
#endif
}
