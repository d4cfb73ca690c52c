#include <plexway/render/picture.hpp>

#include "io/field/colours.hpp"
#include "render/drawing.hpp"

namespace picture_test {

using namespace render_testing;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

std::array<double, 2> middle_of(const Extent& e) { return e.at(0.5, 0.5); }

bool is_red(const std::array<std::uint8_t, 4>& p) {
  return p[0] > 150 && p[1] < 0.5 * p[0] && p[2] < 0.5 * p[0];
}

int largest_difference(const std::array<std::uint8_t, 4>& p, const Colour& c) {
  int most = 0;
  for (std::size_t k = 0; k < 3; ++k) most = std::max(most, std::abs(p[k] - c[k]));
  return most;
}

}  // namespace

TEST_CASE("from every side a source is where it projects to") {
  struct Side {
    View view;
    Point source;
    double u, v;  // right and up in the square that the cube is seen as
  };
  const std::vector<Side> sides = {
      {{0, 0}, {0.2, 0, 0.7}, 0.2, 0.7},   {{90, 0}, {1, 0.2, 0.7}, 0.2, 0.7},
      {{180, 0}, {0.2, 1, 0.7}, 0.8, 0.7}, {{270, 0}, {0, 0.2, 0.7}, 0.8, 0.7},
      {{0, 90}, {0.2, 0.7, 1}, 0.2, 0.7},  {{0, -90}, {0.2, 0.7, 0}, 0.2, 0.3}};
  const Shape shape = cube(2);
  for (const Side& side : sides) {
    Scene scene;
    scene.parts = {shape.part()};
    scene.sources = {side.source};
    const auto image = drawn(scene, plainly(side.view.azimuth, side.view.elevation));
    if (!image) return;
    const auto expected = extent(*image, is_drawn).at(side.u, side.v);
    const auto found = middle_of(extent(*image, is_red));
    INFO("azimuth " << side.view.azimuth << ", elevation " << side.view.elevation);
    CHECK(std::abs(found[0] - expected[0]) < 1.5);
    CHECK(std::abs(found[1] - expected[1]) < 1.5);
  }
}

TEST_CASE("a source behind something is a ring, one in front a dot") {
  const Shape shape = cube(2);
  for (const double y : {0.0, 1.0}) {  // on the near side, on the far side
    Scene scene;
    scene.parts = {shape.part()};
    scene.sources = {{0.5, y, 0.5}};
    const auto image = drawn(scene, plainly(0, 0));
    if (!image) return;
    const Extent seen = extent(*image, is_red);
    const auto at = middle_of(seen);
    const auto middle = image->at(static_cast<std::size_t>(std::lround(at[0])),
                                  static_cast<std::size_t>(std::lround(at[1])));
    CHECK(is_red(middle) == (y == 0));
    const auto expected = extent(*image, is_drawn).at(0.5, 0.5);
    CHECK(std::abs(at[0] - expected[0]) < 1.5);
    CHECK(std::abs(at[1] - expected[1]) < 1.5);
  }
}

TEST_CASE("in perspective what is nearer is larger, and all fits closely") {
  Shape shape = square(4);
  for (Point& p : shape.positions) p = {p[0], 4 * p[1], 0};
  Scene scene;
  scene.parts = {shape.part()};
  PictureOptions options = plainly(0, 20);
  options.orthographic = false;
  const auto image = drawn(scene, options);
  if (!image) return;
  const Extent all = extent(*image, is_drawn);
  const auto width = [&](double y) {
    double count = 0;
    for (std::size_t x = 0; x < image->width; ++x)
      count += is_drawn(image->at(x, static_cast<std::size_t>(y)));
    return count;
  };
  // The camera looks down from the side of small y, which is nearer and lower.
  CHECK(width(all.bottom - 3) > 1.2 * width(all.top + 3));
  const double margin = 0.045 * 240;
  const double horizontal = std::min(all.left, 240 - all.right),
               vertical = std::min(all.top, 240 - all.bottom);
  CHECK(std::min(horizontal, vertical) == Approx(margin).margin(1.5));
}

TEST_CASE("the picture of a cut shows the field inside, linear in the tetrahedra") {
  Shape shape = cube(3);
  shape.with([](const Point& p) { return p[0] + 2 * p[2]; });
  for (const double offset : {0.5, 1.0 / 3, 0.4}) {
    Scene scene;
    scene.parts = {shape.part()};
    PictureOptions options = plainly(0, 0);
    options.clip = Clip{{0, -1, 0}, -offset};  // what has y < offset goes
    const auto image = drawn(scene, options);
    if (!image) return;
    const auto map = plexway::io::ColourMap("viridis");
    const Extent all = extent(*image, is_drawn);
    for (const double u : {0.1, 0.35, 0.6, 0.9})
      for (const double v : {0.1, 0.4, 0.75, 0.9}) {
        const auto expected = map(u + 2 * v, 3);
        INFO("offset " << offset << " at " << u << ", " << v);
        CHECK(largest_difference(pixel(*image, all.at(u, v)), expected) <= 4);
      }
  }
}

TEST_CASE("a clip plane without an offset takes the half towards the camera") {
  Shape shape = cube(2);
  shape.with([](const Point& p) { return p[1]; });
  for (const double azimuth : {0.0, 180.0}) {
    Scene scene;
    scene.parts = {shape.part()};
    PictureOptions options = plainly(azimuth, 0);
    options.clip = Clip{{0, 1, 0}, {}};
    const auto image = drawn(scene, options);
    if (!image) return;
    const auto p = pixel(*image, extent(*image, is_drawn).at(0.5, 0.5));
    CHECK(largest_difference(p, plexway::io::ColourMap("viridis")(0.5, 1)) <= 4);
  }
}

TEST_CASE("isolines lie where the values are") {
  Shape shape = square(5);
  shape.with([](const Point& p) { return p[0]; });
  Scene scene;
  scene.parts = {shape.part()};
  PictureOptions with = plainly(0, 90), without = with;
  with.isolines = 4;
  const auto lined = drawn(scene, with), bare = drawn(scene, without);
  if (!lined || !bare) return;
  const Extent all = extent(*bare, is_drawn);
  std::vector<double> found;  // middles of runs of pixels that differ
  const auto y = static_cast<std::size_t>(all.at(0.5, 0.53)[1]);
  double sum = 0, weight = 0;
  for (std::size_t x = 0; x < lined->width; ++x) {
    const auto &a = lined->at(x, y), &b = bare->at(x, y);
    const double change = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
    if (change > 8) {
      sum += change * (double(x) + 0.5), weight += change;
    } else if (weight > 0) {
      found.push_back(sum / weight);
      sum = weight = 0;
    }
  }
  REQUIRE(found.size() == 4);
  for (std::size_t k = 0; k < 4; ++k)
    CHECK(found[k] == Approx(all.at(0.2 * double(k + 1), 0)[0]).margin(0.6));
}

TEST_CASE("the border of two cells runs where both sources are equally far") {
  Shape shape = square(7);  // no vertex lies on the border
  const Point left = {0.2, 0.5, 0}, right = {0.7, 0.5, 0};
  const auto far = [](const Point& a, const Point& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]);
  };
  shape.with([&](const Point& p) { return std::min(far(p, left), far(p, right)); });
  std::vector<std::int32_t> label;
  for (const Point& p : shape.positions) label.push_back(far(p, left) < far(p, right) ? 0 : 1);
  Part part = shape.part();
  part.label = label;
  Scene scene;
  scene.parts = {part};
  const auto image = drawn(scene, plainly(0, 90));
  if (!image) return;
  const Extent all = extent(*image, is_drawn);
  // Blue on the left, red on the right: where it turns is at x = 0.45.
  for (const double v : {0.1, 0.3, 0.52, 0.7, 0.9}) {
    double turn = -1;
    for (double x = all.left + 1; x < all.right - 1 && turn < 0; ++x) {
      const auto p = pixel(*image, {x, all.at(0, v)[1]});
      if (p[0] > p[2] + 20) turn = x;
    }
    INFO("at height " << v);
    CHECK(std::abs(turn - all.at(0.45, 0)[0]) < 4);
  }
}

TEST_CASE("what is not reached is grey, and has no part in the range") {
  Shape shape = square(8);
  shape.with([](const Point& p) { return p[0] > 0.55 ? inf : p[0]; });
  Scene scene;
  scene.parts = {shape.part()};
  const auto image = drawn(scene, plainly(0, 90));
  if (!image) return;
  const Extent all = extent(*image, is_drawn);
  const auto grey = pixel(*image, all.at(0.9, 0.5)), yellow = pixel(*image, all.at(0.48, 0.5));
  CHECK(std::abs(grey[0] - grey[1]) < 3);
  CHECK(std::abs(grey[0] - grey[2]) < 3);
  CHECK(yellow[2] + 60 < yellow[1]);
}

TEST_CASE("the isosurface of the distance from a point is a sphere") {
  Shape shape = cube(16);
  shape.with([](const Point& p) { return std::hypot(p[0] - 0.5, p[1] - 0.5, p[2] - 0.5); });
  Scene scene;
  scene.parts = {shape.part()};
  PictureOptions options = plainly(0, 0);
  options.isosurfaces = {0.3};
  const auto image = drawn(scene, options);
  if (!image) return;
  const Extent all = extent(*image, is_drawn);
  const auto coloured = [](const auto& p) {
    return std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 60;
  };
  const Extent ball = extent(*image, coloured);
  CHECK((ball.right - ball.left) / (all.right - all.left) == Approx(0.6).margin(0.015));
  CHECK((ball.bottom - ball.top) / (all.bottom - all.top) == Approx(0.6).margin(0.015));
  CHECK(std::abs(middle_of(ball)[0] - middle_of(all)[0]) < 1.5);
}

TEST_CASE("a cloud whose slope is known has isolines, straight over all its discs") {
  const Shape grid = square(30).with([](const Point& p) { return p[0]; });
  const std::vector<Point> normals(grid.positions.size(), {0, 0, 1}),
      slopes(grid.positions.size(), {1, 0, 0});
  Part cloud;
  cloud.positions = grid.positions;
  cloud.normals = normals;
  cloud.value = grid.value;
  cloud.slope = slopes;
  Scene scene;
  scene.parts = {cloud};
  PictureOptions options;
  options.width = options.height = 400;
  options.view = View{0, 90};
  options.orthographic = true;
  options.legend = false;
  options.isolines = 0;
  const auto without = drawn(scene, options);
  if (!without) return;
  options.isolines = 4;
  const auto with = drawn(scene, options);
  // The middles of the runs of pixels that the lines change, in each row of the inner half.
  std::vector<double> first;
  for (std::size_t y = 100; y < 300; ++y) {
    std::vector<double> middles;
    for (std::size_t x = 0, begin = 0; x <= 400; ++x) {
      const bool line = x < 400 && with->pixels[y * 400 + x] != without->pixels[y * 400 + x];
      const bool before =
          x > 0 && with->pixels[y * 400 + x - 1] != without->pixels[y * 400 + x - 1];
      if (line && !before) begin = x;
      if (!line && before) middles.push_back(.5 * static_cast<double>(begin + x - 1));
    }
    CAPTURE(y);
    REQUIRE(middles.size() == 4);
    if (first.empty()) first = middles;
    for (std::size_t k = 0; k < 4; ++k) CHECK(std::abs(middles[k] - first[k]) <= 1);
  }
  for (std::size_t k = 1; k < 3; ++k)
    CHECK(first[k + 1] - first[k] == Approx(first[k] - first[k - 1]).margin(2));
  // Without slopes each disc has one value, and there is no line.
  scene.parts[0].slope = {};
  CHECK(drawn(scene, options)->pixels == [&] {
    options.isolines = 0;
    return drawn(scene, options)->pixels;
  }());
  scene.parts[0].slope = std::span(slopes).first(3);
  CHECK_THROWS_AS(picture(scene, options), plexway::UsageError);
}

TEST_CASE("wireframes, clouds and paths are there, and a clip plane cuts them") {
  const std::vector<Point> ends = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}};
  const std::vector<std::array<std::uint32_t, 2>> edges = {{0, 1}, {1, 2}};
  const std::vector<Point> points = ball_points(500);
  Part wires, cloud;
  wires.positions = ends;
  wires.edges = edges;
  cloud.positions = points;
  Scene scene;
  scene.parts = {wires};
  auto image = drawn(scene, plainly(0, 0));
  if (!image) return;
  Extent all = extent(*image, is_drawn);
  CHECK(is_drawn(pixel(*image, {middle_of(all)[0], all.bottom - 2})));
  CHECK(is_drawn(pixel(*image, {all.right - 2, middle_of(all)[1]})));
  CHECK_FALSE(is_drawn(pixel(*image, middle_of(all))));
  for (const bool with_normals : {false, true}) {
    if (with_normals) cloud.normals = points;
    scene.parts = {cloud};
    image = drawn(scene, plainly(0, 0));
    all = extent(*image, is_drawn);
    std::size_t count = 0;
    for (const auto& p : image->pixels) count += is_drawn(p);
    const double area = (all.right - all.left) * (all.bottom - all.top);
    CHECK(double(count) / area == Approx(3.14159 / 4).margin(0.06));  // a round thing, closed
  }
  PictureOptions cut = plainly(0, 0);
  cut.clip = Clip{{0, 0, 1}, 0};
  image = drawn(scene, cut);
  all = extent(*image, is_drawn);
  CHECK((all.right - all.left) / (all.bottom - all.top) == Approx(2).margin(0.2));
}

TEST_CASE("a ghost lets through what is inside") {
  const Shape shape = cube(2);
  const std::vector<Point> ends = {{0.2, 0.5, 0.5}, {0.8, 0.5, 0.5}};
  const std::vector<std::array<std::uint32_t, 2>> edges = {{0, 1}};
  Part organ = shape.part(), vessel;
  vessel.positions = ends;
  vessel.edges = edges;
  vessel.colour = Colour{200, 30, 30};
  for (const bool ghost : {false, true}) {
    organ.ghost = ghost;
    Scene scene;
    scene.parts = {organ, vessel};
    const auto image = drawn(scene, plainly(0, 0));
    if (!image) return;
    const auto p = pixel(*image, extent(*image, is_drawn).at(0.5, 0.5));
    CHECK((p[0] > p[1] + 40) == ghost);
  }
}

TEST_CASE("a transparent background has no colour, an opaque one is white") {
  const Shape shape = square(2);
  Scene scene;
  scene.parts = {shape.part()};
  PictureOptions options = plainly(0, 90);
  const auto opaque = drawn(scene, options);
  if (!opaque) return;
  options.transparent = true;
  const auto clear = drawn(scene, options);
  CHECK(opaque->at(1, 1) == std::array<std::uint8_t, 4>{255, 255, 255, 255});
  CHECK(clear->at(1, 1)[3] == 0);
  CHECK(clear->at(120, 120)[3] == 255);
  CHECK(clear->at(120, 120) == opaque->at(120, 120));
}

TEST_CASE("the same picture has the same bits") {
  Shape shape = torus(60, 30);
  shape.with([](const Point& p) { return p[0] + 2; });
  Scene scene;
  scene.parts = {shape.part()};
  scene.sources = {{1.4, 0, 0}};
  scene.paths = {{{1.4, 0, 0}, {1, 1, 0.3}, {-1, 1, 0.2}}};
  PictureOptions options;
  options.width = 200, options.height = 150;
  const auto first = drawn(scene, options), second = drawn(scene, options);
  if (!first) return;
  CHECK(first->pixels == second->pixels);
}

TEST_CASE("pictures that make no sense are refused") {
  const Shape shape = square(1);
  Scene scene;
  scene.parts = {shape.part()};
  const auto refused = [&](const PictureOptions& options) {
    CHECK_THROWS_AS(picture(scene, options), plexway::UsageError);
  };
  PictureOptions options;
  options.width = 0;
  refused(options);
  options = {};
  options.map = "jet";
  refused(options);
  options = {};
  options.range = {1, 1};
  refused(options);
  options = {};
  options.clip = Clip{{0, 0, 0}, {}};
  refused(options);
  options = {};
  const std::vector<double> short_one = {1, 2};
  scene.parts[0].value = short_one;
  refused(options);
  scene.parts.clear();
  refused(options);
  const std::vector<Point> broken = {{0, 0, std::nan("")}};
  Part cloud;
  cloud.positions = broken;
  scene.parts = {cloud};
  refused(options);
}

}  // namespace picture_test
