// Level sets cut into tetrahedra: time and memory as the voxels get smaller, and distances inside
// beside those in TetGen's solid of the same surface.

#ifdef PLEXWAY_HAS_OPENVDB

#include <cmath>
#include <map>
#include <numbers>

#include <plexway/openvdb/level_set.hpp>
#include <plexway/openvdb/solid.hpp>
#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/tetrahedralize.hpp>
#endif

#include "solver.hpp"

namespace bench::volumes {

using Point = std::array<double, 3>;
using plexway::openvdb::LevelSet;

LevelSet ball(double voxel) {
  const double r = 1 + 4 * voxel;
  return plexway::openvdb::level_set_of(
      [](const Point& p) { return std::hypot(p[0], p[1], p[2]) - 1; }, {-r, -r, -r}, {r, r, r},
      voxel);
}

LevelSet gyroid(double voxel) {
  const auto function = [](const Point& p) {
    const double k = 2 * std::numbers::pi;
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

Row cut(const LevelSet& level_set) {
  const double before = status_bytes("VmHWM").value_or(0);
  plexway::openvdb::Solid solid;
  const double time = seconds([&] { solid = plexway::openvdb::fill(level_set); });
  const double inside = static_cast<double>(level_set.inside_voxels());
  return {{"active", level_set.active_voxels()},
          {"inside", level_set.inside_voxels()},
          {"tets", solid.tets.size()},
          {"seconds", time},
          {"ns", 1e9 * time / inside},
          {"bytes", (status_bytes("VmHWM").value_or(0) - before) / inside}};
}

#ifdef PLEXWAY_HAS_TETGEN
/// Tetrahedra of TetGen's at most `share` of what regular ones with our mean edge have.
Row compare(const LevelSet& level_set, double share) {
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
  const auto mine = distances(own, plexway::PointSource::at(at[surface.positions[from]]));
  auto theirs = distances(peer, plexway::PointSource::at(from));
  theirs.resize(surface.positions.size());
  std::vector<double> here;
  for (const Point& p : surface.positions) here.push_back(mine[at[p]]);
  Apart apart;
  apart.add(theirs, here);
  return {{"tets", cut.tets.size()},
          {"peer_tets", solid.tets.size()},
          {"edge", edge},
          {"peer_edge", peer.summary().mean_edge},
          {"mean", apart.mean()},
          {"max", apart.most}};
}
#endif

void run(Arguments& arguments) {
  bool quick = false;
  arguments.option("--quick", &quick, "Only the coarsest of each");
  arguments.add_limit();
  Table& table = arguments.table(
      "shape; voxel; active; inside; tets; seconds: s %.2f; ns: ns a voxel inside %.0f;"
      "bytes: bytes a voxel inside %.0f; peer_tets: TetGen's tets; edge %.4f;"
      "peer_edge: TetGen's edge %.4f; mean: distances apart, mean %.1e; max %.1e; note");
  struct Shape {
    const char* name;
    LevelSet (*make)(double);
    double voxel;
  };
  for (const Shape& shape : {Shape{"ball", ball, .08}, Shape{"gyroid", gyroid, .04}})
    for (const double finer : {1., 2., 4., 8.}) {
      if (quick && finer > 1) break;
      const double voxel = shape.voxel / finer;
      table.measure({{"shape", shape.name}, {"voxel", voxel}}, arguments.limit,
                    [&] { return cut(shape.make(voxel)); });
#ifdef PLEXWAY_HAS_TETGEN
      if (finer > 1) continue;
      table.measure({{"shape", std::string(shape.name) + ", beside TetGen's"}, {"voxel", voxel}},
                    arguments.limit, [&] { return compare(shape.make(voxel), 2.4); });
#endif
    }
}
const Command command("volumes", "level sets cut into tetrahedra, beside TetGen's", run);

}  // namespace bench::volumes

#endif
