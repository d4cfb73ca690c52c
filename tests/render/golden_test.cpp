// Twelve small pictures beside what they looked like when they were looked at. Drivers differ by a
// little; with PLEXWAY_WRITE_GOLDEN=1 the pictures are made anew.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "render/drawing.hpp"

namespace golden_test {

using namespace render_testing;

namespace {

void compare(const std::string& name, const Scene& scene, PictureOptions options = {}) {
  options.width = 320, options.height = 240;
  const auto image = drawn(scene, options);
  if (!image) return;
  const auto file =
      std::filesystem::path(PLEXWAY_SOURCE_DIR) / "tests/render/golden" / (name + ".png");
  if (std::getenv("PLEXWAY_WRITE_GOLDEN") != nullptr) {
    std::filesystem::create_directories(file.parent_path());
    write_png(file, *image);
  }
  const Image golden = read_png(file);
  REQUIRE(golden.width == image->width);
  REQUIRE(golden.height == image->height);
  double sum = 0;
  std::size_t far = 0;
  for (std::size_t k = 0; k < golden.pixels.size(); ++k) {
    int most = 0;
    for (std::size_t c = 0; c < 4; ++c)
      most = std::max(most, std::abs(golden.pixels[k][c] - image->pixels[k][c]));
    sum += most;
    far += most > 48;
  }
  const auto pixels = double(golden.pixels.size());
  INFO(name);
  CHECK(sum / pixels < 1.0);
  CHECK(double(far) / pixels < 0.004);
}

double along_torus(const Point& p) {
  return std::hypot(std::atan2(p[1], p[0]), 0.4 * std::atan2(p[2], std::hypot(p[0], p[1]) - 1));
}

}  // namespace

TEST_CASE("golden: a surface with isolines, bar, source and path") {
  Shape shape = torus(96, 40);
  shape.with(along_torus);
  Scene scene;
  scene.parts = {shape.part()};
  scene.sources = {{1.4, 0, 0}};
  std::vector<Point> path;
  for (double u = 0; u > -1.6; u -= 0.05) path.push_back({1.4 * std::cos(u), 1.4 * std::sin(u), 0});
  scene.targets = {path.back()};
  scene.paths = {path};
  compare("surface", scene);
  PictureOptions options;
  options.view = View{0, 90};
  options.orthographic = true;
  options.map = "magma";
  options.range = {0, 2.5};
  options.title = "time (s)";
  compare("surface-top", scene, options);
  options = {};
  options.transparent = true;
  options.map = "cividis";
  options.isolines = 8;
  options.up = 'y';
  compare("surface-transparent", scene, options);
}

TEST_CASE("golden: solids, whole, cut, and with isosurfaces") {
  Shape shape = cube(10);
  shape.with([](const Point& p) { return std::hypot(p[0], p[1] - 0.2, p[2] - 1); });
  Scene scene;
  scene.parts = {shape.part()};
  PictureOptions options;
  compare("solid", scene, options);
  options.clip = Clip{{1, -2, 1}, 0.1};
  compare("solid-cut", scene, options);
  options = {};
  options.isosurfaces = {0.4, 0.8, 1.2};
  compare("solid-isosurfaces", scene, options);
}

TEST_CASE("golden: clouds with and without normals") {
  const std::vector<Point> points = ball_points(1500);
  std::vector<double> value;
  for (const Point& p : points) value.push_back(std::acos(p[2]));
  Part cloud;
  cloud.positions = points;
  cloud.value = value;
  Scene scene;
  scene.parts = {cloud};
  compare("cloud", scene);
  scene.parts[0].normals = points;
  compare("cloud-normals", scene);
}

TEST_CASE("golden: a wireframe with a part that is not reached") {
  std::vector<Point> points;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<double> value;
  for (std::uint32_t k = 0; k < 120; ++k) {
    const double t = 0.2 * k;
    points.push_back({std::cos(t), std::sin(t), 0.06 * t});
    value.push_back(k < 90 ? t : std::numeric_limits<double>::infinity());
    if (k > 0) edges.push_back({k - 1, k});
  }
  Part wires;
  wires.positions = points;
  wires.edges = edges;
  wires.value = value;
  Scene scene;
  scene.parts = {wires};
  compare("wireframe", scene);
}

TEST_CASE("golden: cells, dots, and a mixed domain") {
  Shape shape = torus(96, 40);
  const std::vector<Point> seeds = {{1.4, 0, 0}, {0, 1.4, 0}, {-1.4, 0, 0}, {0, -1, 0.4}};
  const auto far = [](const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  std::vector<std::int32_t> label;
  shape.with([&](const Point& p) {
    double least = 1e9;
    for (const Point& s : seeds) least = std::min(least, far(p, s));
    return least;
  });
  for (std::size_t v = 0; v < shape.positions.size(); ++v)
    for (std::size_t s = 0; s < seeds.size(); ++s)
      if (far(shape.positions[v], seeds[s]) == shape.value[v]) {
        label.push_back(static_cast<std::int32_t>(s));
        break;
      }
  Part part = shape.part();
  part.label = label;
  Scene scene;
  scene.parts = {part};
  scene.dots = {Dots{seeds, {}, {35, 40, 50}, 1}};
  compare("cells", scene);

  scene = {};
  Part plain;
  plain.positions = shape.positions;
  plain.triangles = shape.triangles;
  scene.parts = {plain};
  scene.dots = {Dots{shape.positions, shape.value, {}, 0.6}};
  scene.dots[0].positions.resize(900);
  scene.dots[0].value.resize(900);
  compare("dots", scene);

  Shape block = cube(4);
  Part organ = block.part(), vessel;
  organ.ghost = true;
  const std::vector<Point> points = {
      {0, 0, 0.1}, {0.5, 0.5, 0.5}, {0.9, 0.4, 0.9}, {0.3, 0.9, 0.8}};
  const std::vector<std::array<std::uint32_t, 2>> edges = {{0, 1}, {1, 2}, {1, 3}};
  const std::vector<double> value = {0, 0.8, 1.4, 1.3};
  vessel.positions = points;
  vessel.edges = edges;
  vessel.value = value;
  scene = {};
  scene.parts = {organ, vessel};
  compare("mixed", scene);
}

}  // namespace golden_test
