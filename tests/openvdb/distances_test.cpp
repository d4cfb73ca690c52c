// Distances inside a cut level set, against exact ones and against those in TetGen's solid of the
// same surface with edges as long.

#include <plexway/solve.hpp>

#include "volumes.hpp"

#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/tetrahedralize.hpp>
#endif

namespace distances_test {

using namespace volume_testing;
using plexway::PointSource;

namespace {

double mean_edge(const plexway::TetMesh<double>& mesh) { return mesh.summary().mean_edge; }

}  // namespace

TEST_CASE("distances in a ball cut from a level set are straight") {
  const auto solid = plexway::openvdb::fill(ball(1, 0.1));
  const plexway::TetMesh<double> mesh(solid.positions, solid.tets);
  const auto field = plexway::solve(plexway::Serial{}, mesh, PointSource::at(0));
  double sum = 0;
  for (std::size_t v = 1; v < solid.positions.size(); ++v) {
    const Point way = solid.positions[v] - solid.positions[0];
    const double exact = std::sqrt(dot(way, way));
    // The boundary's facets are a little inside the sphere, and never bend a path by more.
    CHECK(field.distance[v] >= exact * (1 - 1e-9));
    sum += field.distance[v] / exact - 1;
  }
  CHECK(sum / static_cast<double>(solid.positions.size() - 1) < 1e-9);
}

#ifdef PLEXWAY_HAS_TETGEN
TEST_CASE("distances agree with those in the solid that TetGen makes of the same surface") {
  struct Case {
    const char* name;
    LevelSet level_set;
  };
  for (const Case& one : {Case{"sphere", ball(1, 0.12)}, Case{"gyroid", gyroid(1, 0.05)}}) {
    INFO(one.name);
    const auto cut = plexway::openvdb::fill(one.level_set);
    const auto surface = plexway::openvdb::surface_of(one.level_set);
    const plexway::TetMesh<double> own(cut.positions, cut.tets);

    // A regular tetrahedron of the edge e has the volume e^3 / (6 sqrt 2); TetGen's are smaller.
    double bound = 2.4 * std::pow(mean_edge(own), 3) / (6 * std::sqrt(2.0));
    const auto solid = plexway::tetgen::tetrahedralize(surface.positions, surface.triangles, {},
                                                       {.max_volume = bound, .keep_surface = true});
    const plexway::TetMesh<double> peer(solid.positions, solid.tets);
    CHECK(mean_edge(peer) == Approx(mean_edge(own)).epsilon(0.1));

    std::map<Point, Index> at;
    for (Index v = 0; v < cut.positions.size(); ++v) at[cut.positions[v]] = v;
    const auto from =
        static_cast<Index>(std::min_element(surface.positions.begin(), surface.positions.end()) -
                           surface.positions.begin());
    REQUIRE(at.count(surface.positions[from]) == 1);
    const auto mine =
        plexway::solve(plexway::Serial{}, own, PointSource::at(at[surface.positions[from]]));
    const auto theirs = plexway::solve(plexway::Serial{}, peer, PointSource::at(from));
    double sum = 0, most = 0;
    std::size_t compared = 0;
    for (Index v = 0; v < surface.positions.size(); ++v) {
      if (v == from) continue;
      REQUIRE(at.count(surface.positions[v]) == 1);
      const double a = mine.distance[at[surface.positions[v]]], b = theirs.distance[v];
      REQUIRE(std::isfinite(a) == std::isfinite(b));
      if (!std::isfinite(a)) continue;
      sum += std::abs(a / b - 1);
      most = std::max(most, std::abs(a / b - 1));
      ++compared;
    }
    CHECK(compared > surface.positions.size() / 2);
    const double mean = sum / static_cast<double>(compared);
    INFO("mean difference " << mean << ", largest " << most << ", mean edges " << mean_edge(own)
                            << " and " << mean_edge(peer) << ", " << cut.tets.size() << " and "
                            << solid.tets.size() << " tetrahedra");
    CHECK(mean < 2.5e-3);
  }
}
#endif

}  // namespace distances_test
