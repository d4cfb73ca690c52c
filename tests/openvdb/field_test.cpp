// Fields as volumes, read back by OpenVDB itself and sampled at known places.

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include <chrono>
#include <limits>

#include <plexway/openvdb/field.hpp>

#include "volumes.hpp"

namespace field_test {

using namespace volume_testing;

namespace {

/// A cube of side 2 at 10, -5, 3 in six tetrahedra around its diagonal.
plexway::openvdb::Solid cube() {
  plexway::openvdb::Solid solid;
  for (int i = 0; i < 8; ++i)
    solid.positions.push_back({10.0 + 2 * (i & 1), -5.0 + 2 * (i >> 1 & 1), 3.0 + 2 * (i >> 2)});
  solid.tets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
  return solid;
}

/// Linear in space, so exact everywhere inside.
double linear(const Point& p) { return 3 + 0.5 * (p[0] - 10) + 0.25 * (p[1] + 5) + (p[2] - 3); }

}  // namespace

TEST_CASE("a field reads back in place: values, transform, name, class, outside") {
  const auto solid = cube();
  std::vector<double> distance;
  for (const Point& p : solid.positions) distance.push_back(linear(p));
  const Folder folder;
  const auto file = folder.path() / "field.vdb";
  const std::size_t active = plexway::openvdb::write_field(file, solid.positions, solid.tets,
                                                           distance, {}, {.voxel = 0.1});
  CHECK(folder.files() == 1);
  CHECK(active == 21 * 21 * 21);

  ::openvdb::initialize();
  ::openvdb::io::File in(file.string());
  in.open();
  REQUIRE(in.getGrids()->size() == 1);
  const auto grid = ::openvdb::gridPtrCast<::openvdb::FloatGrid>(in.readGrid("distance"));
  CHECK(grid->getGridClass() == ::openvdb::GRID_UNKNOWN);
  CHECK(grid->getCreator() == "plexway");
  CHECK(grid->background() == -1.0f);
  CHECK(grid->activeVoxelCount() == active);
  CHECK(grid->transform().voxelSize().x() == Approx(0.1));
  // Sparse: the box of leaves around the active voxels, no more.
  CHECK(grid->tree().leafCount() <= 4 * 4 * 4);
  const ::openvdb::tools::GridSampler<::openvdb::FloatGrid, ::openvdb::tools::BoxSampler> sample(
      *grid);
  for (const Point& p :
       {Point{10.3, -4.2, 3.9}, {11.9, -3.15, 4.87}, {10.05, -4.95, 3.05}, {11, -4, 4}})
    CHECK(sample.wsSample({p[0], p[1], p[2]}) == Approx(linear(p)).epsilon(1e-5));
  for (const Point& p : {Point{9.5, -4.2, 3.9}, {0, 0, 0}, {11, -4, 5.5}})
    CHECK(sample.wsSample({p[0], p[1], p[2]}) == -1.0f);
}

TEST_CASE("labels are a second grid, and what is not reached is outside") {
  auto solid = cube();
  for (const Point& p : cube().positions) solid.positions.push_back(p + Point{10, 0, 0});
  for (auto tet : cube().tets) {
    for (Index& v : tet) v += 8;
    solid.tets.push_back(tet);
  }
  std::vector<double> distance(16, std::numeric_limits<double>::infinity());
  std::vector<std::int32_t> label(16, -1);
  for (std::size_t v = 0; v < 8; ++v) {
    distance[v] = 2;
    label[v] = v < 4 ? 7 : 9;
  }
  const Folder folder;
  const auto file = folder.path() / "field.vdb";
  CHECK(plexway::openvdb::write_field(file, solid.positions, solid.tets, distance, label,
                                      {.voxel = 0.2}) == 11 * 11 * 11);
  ::openvdb::io::File in(file.string());
  in.open();
  const auto labels = ::openvdb::gridPtrCast<::openvdb::Int32Grid>(in.readGrid("label"));
  const auto at = [&](double x, double y, double z) {
    return labels->tree().getValue(labels->transform().worldToIndexNodeCentered({x, y, z}));
  };
  CHECK(at(10.4, -4.6, 3.2) == 7);
  CHECK(at(11.4, -3.6, 4.8) == 9);
  CHECK(at(20.4, -4.6, 3.2) == -1);
}

TEST_CASE("a voxel is chosen where none is given, and what makes no sense is refused") {
  const auto solid = plexway::openvdb::fill(ball(1, 0.1));
  std::vector<double> distance;
  for (const Point& p : solid.positions) distance.push_back(std::sqrt(dot(p, p)));
  const Folder folder;
  const std::size_t active =
      plexway::openvdb::write_field(folder.path() / "a.vdb", solid.positions, solid.tets, distance);
  CHECK(static_cast<double>(active) == Approx(4 * pi / 3 * 8000 * 1.27).epsilon(0.3));
  const auto write = [&](std::span<const double> field, double voxel) {
    (void)plexway::openvdb::write_field(folder.path() / "b.vdb", solid.positions, solid.tets, field,
                                        {}, {.voxel = voxel});
  };
  CHECK_THROWS_AS(write(std::span(distance).first(5), 0), plexway::UsageError);
  CHECK_THROWS_AS(write(distance, -1), plexway::UsageError);
  CHECK_THROWS_AS(write(distance, 1e-5), plexway::UsageError);
  for (const double side : {1e300, 4.0})
    CHECK_THAT(message_of<plexway::UsageError>([&] { write(distance, side); }),
               Catch::Contains("is larger than the whole solid"));
  CHECK(folder.files() == 1);
}

namespace {

/// Voxels whose centre lies in a tetrahedron, by looking at each of its box.
std::size_t voxels_inside(const std::array<Point, 4>& corners, double voxel) {
  Point low = corners[0], high = corners[0];
  for (const Point& c : corners)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c[k]);
      high[k] = std::max(high[k], c[k]);
    }
  const auto six = [](const Point& a, const Point& b, const Point& c, const Point& d) {
    return dot(cross(b - a, c - a), d - a);
  };
  const double all = six(corners[0], corners[1], corners[2], corners[3]);
  std::size_t count = 0;
  for (double x = std::floor(low[0] / voxel); x <= high[0] / voxel + 1; ++x)
    for (double y = std::floor(low[1] / voxel); y <= high[1] / voxel + 1; ++y)
      for (double z = std::floor(low[2] / voxel); z <= high[2] / voxel + 1; ++z) {
        bool inside = true;
        for (std::size_t i = 0; i < 4; ++i) {
          auto c = corners;
          c[i] = {voxel * x, voxel * y, voxel * z};
          inside = inside && six(c[0], c[1], c[2], c[3]) / all >= -1e-9;
        }
        count += inside;
      }
  return count;
}

}  // namespace

TEST_CASE("the voxels of a tetrahedron are those whose centre it holds") {
  const Folder folder;
  const auto file = folder.path() / "one.vdb";
  std::mt19937 random(11);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int i = 0; i < 60; ++i) {
    std::array<Point, 4> corners;
    for (Point& c : corners)
      for (double& x : c) x = anywhere(random) + 3;
    // Needles and blades as well, and sides along the lattice but for rounding.
    if (i % 4 == 1)
      for (std::size_t c = 1; c < 4; ++c)
        corners[c] = corners[0] + 0.04 * (corners[c] - corners[0]);
    if (i % 4 == 1) corners[3] = corners[0] + Point{1.1, 1.2, -0.9};
    if (i % 4 == 2) corners[3] = (1.0 / 3) * (corners[0] + corners[1] + 1.02 * corners[2]);
    if (i % 4 == 3)
      corners = {Point{2.1, 2.1, 2.1}, {2.1 + 4e-16, 3.7, 2.1}, {2.1, 2.1, 3.5}, {3.3, 2.1, 2.1}};
    if (i % 8 == 7)
      for (Point& c : corners) c = {c[1], c[2], c[0]};
    const std::size_t expected = voxels_inside(corners, 0.05);
    INFO(i << ": " << expected);
    const std::vector<Point> positions(corners.begin(), corners.end());
    const std::vector<std::array<Index, 4>> tets = {{0, 1, 2, 3}};
    const std::vector<double> distance(4, 1.0);
    CHECK(plexway::openvdb::write_field(file, positions, tets, distance, {}, {.voxel = 0.05}) ==
          expected);
  }
}

TEST_CASE("a needle along a diagonal costs its voxels and not its box") {
  const Folder folder;
  // Its box has 8 10^12 voxels, which would be hours.
  const double length = 20000;
  const std::vector<Point> positions = {
      {0, 0, 0}, {length, length, length}, {1, 0, 0.5}, {0, 1.5, 0}};
  const std::vector<std::array<Index, 4>> tets = {{0, 1, 2, 3}};
  const std::vector<double> distance = {0, 1, 0, 0};
  const auto start = std::chrono::steady_clock::now();
  const std::size_t active = plexway::openvdb::write_field(folder.path() / "needle.vdb", positions,
                                                           tets, distance, {}, {.voxel = 1});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  // On the diagonal itself, and beside it where it is wide enough.
  CHECK(active > 20000);
  CHECK(active < 60000);
  CHECK(took.count() < 20);
}

}  // namespace field_test
