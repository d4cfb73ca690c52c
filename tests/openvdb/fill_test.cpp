#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>

#include "volumes.hpp"

#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/tetrahedralize.hpp>
#endif

namespace fill_test {

using namespace volume_testing;
using plexway::openvdb::fill;
using plexway::openvdb::surface_of;

TEST_CASE("a ball's level set: volume, boundary on the sphere, one part, no sliver") {
  for (const double spacing : {0.0, 0.05, 0.11, 0.17}) {
    const double h = spacing > 0 ? spacing : 0.05;
    const Point middle = {0.013, -0.3, 2};
    const auto solid = fill(ball(1, 0.05, middle), spacing);
    INFO("spacing " << spacing);
    CHECK(volume(solid) == Approx(4 * pi / 3).epsilon(h * h + 2e-3));
    for (const auto& face : boundary(solid))
      for (const Index v : face) {
        const Point p = solid.positions[v] - middle;
        CHECK(std::sqrt(dot(p, p)) == Approx(1).margin(1e-3));
      }
    const auto [least, most] = dihedral_angles(solid);
    CHECK(least > 17);
    CHECK(most < 150);
    const plexway::TetMesh<double> mesh(solid.positions, solid.tets);
    CHECK(mesh.summary().components == 1);
    CHECK(mesh.summary().degenerate_tets == 0);
    CHECK(mesh.summary().inverted_tets == 0);
    CHECK(mesh.summary().pinched_vertices == 0);
    // Euler: a ball has 1.
    const auto& s = mesh.summary();
    CHECK(s.vertices + s.faces == s.edges + s.tets + 1);
  }
}

TEST_CASE("no sliver whatever the surface: noise") {
  std::mt19937 random(5);
  for (const double offset : {-0.6, -0.2, 0.0, 0.3})
    for (const double spacing : {0.1, 0.13}) {
      std::uniform_real_distribution<double> noise(-0.1, 0.1);
      const auto level_set = level_set_of(
          [&](const Point&) { return noise(random) + offset * 0.1; }, {-1, -1, -1}, {1, 1, 1}, 0.1);
      const auto solid = fill(level_set, spacing);
      INFO(offset << " " << spacing);
      CHECK(solid.tets.size() > 2000);
      const auto [least, most] = dihedral_angles(solid);
      CHECK(least > 10);
      CHECK(most < 165);
      (void)volume(solid);
      const auto surface = surface_of(level_set, spacing);
      CHECK(surface.triangles.size() == boundary(solid).size());
      CHECK(unpaired_edges(surface) == 0);
      CHECK(enclosed(surface) == Approx(volume(solid)).epsilon(1e-9));
    }
}

TEST_CASE("inside, the cut is the lattice itself: angles of 60 and 90 degrees") {
  const auto level_set =
      level_set_of([](const Point&) { return -1.0; }, {-1, -1, -1}, {1, 1, 1}, 0.1);
  const auto solid = fill(level_set);
  std::size_t regular = 0;
  for (const auto& tet : solid.tets) {
    plexway::openvdb::Solid one{{}, {{0, 1, 2, 3}}};
    for (const Index v : tet) one.positions.push_back(solid.positions[v]);
    const auto [least, most] = dihedral_angles(one);
    regular += std::abs(least - 60) < 1e-6 && std::abs(most - 90) < 1e-6;
  }
  CHECK(regular > 12 * 17 * 17 * 17);
}

TEST_CASE("the surface of a level set is closed, looks outward and lies on the sphere") {
  const auto surface = surface_of(ball(1, 0.06));
  CHECK(unpaired_edges(surface) == 0);
  CHECK(enclosed(surface) == Approx(4 * pi / 3).epsilon(5e-3));
  std::vector<char> used(surface.positions.size(), 0);
  for (const auto& t : surface.triangles)
    for (const Index v : t) used[v] = 1;
  CHECK(std::count(used.begin(), used.end(), 0) == 0);
  // Euler: a sphere has 2.
  CHECK(surface.positions.size() + surface.triangles.size() ==
        3 * surface.triangles.size() / 2 + 2);
}

TEST_CASE("a level set of a function: values, voxels, and what makes no sense") {
  const LevelSet it = ball(1, 0.1);
  CHECK(it.voxel() == Approx(0.1));
  CHECK(it({0.95, 0, 0}) == Approx(-0.05).margin(2e-3));
  CHECK(it({0, 0.7, 0.7}) == Approx(std::sqrt(0.98) - 1).margin(2e-3));
  CHECK(it({0, 0, 0}) == Approx(-0.3));
  CHECK(it({50, 0, 0}) == Approx(0.3));
  CHECK(it({1e300, 0, 0}) == Approx(0.3));
  CHECK(static_cast<double>(it.inside_voxels()) == Approx(4 * pi / 3 * 1000).epsilon(0.03));
  CHECK(static_cast<double>(it.active_voxels()) == Approx(4 * pi * 100 * 6).epsilon(0.05));
  const auto outside = [](const Point&) { return 1.0; };
  CHECK_THROWS_AS(level_set_of(outside, {0, 0, 0}, {1, 1, 1}, 0.1), plexway::InputError);
  CHECK_THROWS_AS(level_set_of(outside, {0, 0, 0}, {1, 1, 1}, 0), plexway::UsageError);
  CHECK_THROWS_AS(level_set_of(outside, {0, 0, 0}, {1, 1, -9}, 0.1), plexway::UsageError);
  CHECK_THROWS_AS(level_set_of(outside, {0, 0, 0}, {1, 1, 1}, 1e-9), plexway::UsageError);
  CHECK_THROWS_AS(fill(it, -1), plexway::UsageError);
  CHECK_THROWS_AS(fill(it, 1e-6), plexway::UsageError);
  CHECK_THROWS_AS(fill(it, 50), plexway::UsageError);
}

TEST_CASE("a spacing that cannot be is refused in the unit of positions") {
  const LevelSet it = ball(1, 0.1);
  const auto said = [&](double spacing) {
    return message_of<plexway::UsageError>(
        [&] { (void)plexway::openvdb::surface_of(it, spacing); });
  };
  using Catch::Contains;
  CHECK_THAT(said(2.5e-5), Contains("the spacing 2.5e-05 is too small: more than 2^31 lattice"));
  CHECK_THAT(said(1e-12), Contains("the spacing 1e-12 is too small"));
  CHECK_THAT(said(1e300), Contains("the spacing 1e+300 is wider"));
  CHECK_THAT(said(-1), Contains("the spacing must be 0"));
  // A ball between the lattice's points, which are far apart.
  const LevelSet between = ball(0.5, 0.1, {3, 4, 5});
  CHECK_THAT(message_of<plexway::UsageError>([&] { (void)plexway::openvdb::fill(between, 100); }),
             Contains("as wide as the spacing 100; choose a smaller one"));
}

// Distances inside a cut level set, against exact ones and against those in TetGen's solid of the
// same surface with edges as long.

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

}  // namespace fill_test
