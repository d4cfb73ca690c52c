#include <algorithm>
#include <random>
#include <set>

#include <plexway/render/picture.hpp>

#include "io/field/colours.hpp"
#include "io/io_testing.hpp"
#include "render/composition.hpp"
#include "render/drawing.hpp"
#include "render/png.hpp"
#include "render/skins.hpp"

namespace parts_test {

using namespace render_testing;

TEST_CASE("ticks are round, inside, and written as short as they can be") {
  struct Example {
    double low, high;
    std::vector<std::string> label;
  };
  const std::vector<Example> examples = {
      {0, 12.4, {"0", "2", "4", "6", "8", "10", "12"}},
      {0, 0.92, {"0", "0.2", "0.4", "0.6", "0.8"}},
      {-1, 1, {"-1.0", "-0.5", "0", "0.5", "1.0"}},
      {3.21, 3.31, {"3.22", "3.24", "3.26", "3.28", "3.30"}},
      {0, 3e6, {"0", "5e+05", "1.0e+06", "1.5e+06", "2.0e+06", "2.5e+06", "3.0e+06"}},
      {0, 5e-6, {"0", "1e-06", "2e-06", "3e-06", "4e-06", "5e-06"}}};
  for (const Example& e : examples) {
    const plexway::io::Ticks t = plexway::io::ticks(e.low, e.high, 6);
    CHECK(t.label == e.label);
    REQUIRE(t.at.size() == t.label.size());
    for (std::size_t k = 0; k < t.at.size(); ++k) {
      CHECK(t.at[k] == Approx(std::stod(t.label[k])).margin(1e-12));
      CHECK(t.at[k] >= e.low - 1e-9 * std::abs(e.high));
      CHECK(t.at[k] <= e.high * (1 + 1e-9));
    }
    CHECK(std::abs(std::remainder(t.step, t.fine_step())) < 1e-9 * t.step);
  }
}

TEST_CASE("every printable character has strokes of its own") {
  std::set<std::vector<std::vector<std::array<double, 2>>>> seen;
  for (char c = '!'; c <= '~'; ++c) {
    const StrokeText text = stroke_text(std::string(1, c));
    INFO("character " << c);
    REQUIRE_FALSE(text.strokes.empty());
    CHECK(text.width >= 0);
    CHECK(text.width < 9);
    CHECK(seen.insert(text.strokes).second);
    for (const auto& stroke : text.strokes) {
      REQUIRE_FALSE(stroke.empty());
      for (const auto& p : stroke) CHECK((p[1] > -3 && p[1] < 10 && p[0] > -2 && p[0] < 9));
    }
  }
  CHECK(stroke_text("10").width == stroke_text("11").width);
  CHECK(stroke_text("\xc3\xa9").strokes.size() == 1);  // one frame for one character
}

TEST_CASE("a png comes back as it was, with and without alpha") {
  const io_testing::Folder folder;
  for (const int alpha : {255, 100}) {
    Image image;
    image.width = 7, image.height = 3;
    for (std::size_t k = 0; k < 21; ++k)
      image.pixels.push_back({std::uint8_t(k * 12), std::uint8_t(255 - k), std::uint8_t(k),
                              std::uint8_t(k % 2 == 0 ? 255 : alpha)});
    const auto file = folder.path() / "a.png";
    write_png(file, image);
    const Image back = read_png(file);
    CHECK(back.width == 7);
    CHECK(back.height == 3);
    CHECK(back.pixels == image.pixels);
    write_png(file, image, 21);
    CHECK(read_png(file).pixels == image.pixels);
    write_png(file, image, 2);
    const Image two = read_png(file);
    CHECK(std::set(two.pixels.begin(), two.pixels.end()).size() == 2);
  }
  CHECK_THROWS_AS(write_png(folder.path() / "b.png", Image{}), plexway::UsageError);
  CHECK_THROWS_AS(read_png(folder.write("c.png", "no picture")), plexway::InputError);
}

TEST_CASE("few colours are near those that they stand for") {
  Image image;
  image.width = 256, image.height = 64;
  for (std::size_t y = 0; y < 64; ++y)
    for (std::size_t x = 0; x < 256; ++x)
      image.pixels.push_back({std::uint8_t(x), std::uint8_t(255 - x / 2), std::uint8_t(y), 255});
  const Indexed indexed = with_few_colours(image, 256);
  CHECK(indexed.palette.size() == 256);
  REQUIRE(indexed.index.size() == image.pixels.size());
  double squares = 0;
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      squares += std::pow(indexed.palette[indexed.index[k]][c] - image.pixels[k][c], 2);
  CHECK(std::sqrt(squares / double(image.pixels.size())) < 5);
}

// What pictures are made of, where the input is not what is usual.

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double apart(const Point& p, const Point& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.; }

// By looking at all.
std::vector<double> slow_spacings(const std::vector<Point>& points) {
  std::vector<double> found;
  for (const Point& p : points) {
    std::vector<Point> others = points;
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    std::vector<double> distance;
    for (const Point& q : others)
      if (q != p) distance.push_back(apart(p, q));
    std::sort(distance.begin(), distance.end());
    found.push_back(distance[std::min<std::size_t>(3, distance.size() - 1)]);
  }
  std::vector<double> sorted = found;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  for (double& f : found) f = std::clamp(f, usual / 2, usual * 2);
  return found;
}

std::vector<Point> random_points(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i)
    points.push_back({uniform(random), uniform(random), 0.1 * uniform(random)});
  return points;
}

Part cells_of(const Shape& shape, const std::vector<std::int32_t>& label) {
  Part part = shape.part();
  part.label = label;
  return part;
}

}  // namespace

TEST_CASE("spacings of points are those to the fourth nearest place") {
  for (const std::size_t count : {2u, 3u, 5u, 8u, 9u, 40u, 500u}) {
    std::vector<Point> points = random_points(count, static_cast<unsigned>(count));
    for (int kind = 0; kind < 3; ++kind) {
      const auto found = spacings(points), wanted = slow_spacings(points);
      REQUIRE(found.size() == wanted.size());
      for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i] == Approx(wanted[i]).epsilon(1e-12));
      if (kind == 0) points.push_back({1e6, -3e5, 2});                 // alone
      if (kind == 1) points.insert(points.end(), 30, points.front());  // many at one place
    }
  }
  CHECK(spacings(std::vector<Point>(5, Point{1, 2, 3})) == std::vector<double>(5, 0.1));
}

TEST_CASE("a point far from all others does not make a cloud slow") {
  // Comparing each with each would be 4e10 steps here.
  for (const double far : {1., 1e9}) {
    std::vector<Point> points = random_points(200000, 1);
    points.push_back({far, far, far});
    for (int i = 0; i < 1000; ++i) points.push_back({far, far + 1e-3 * i, far});
    const auto found = spacings(points);
    CHECK(found.size() == points.size());
    CHECK(*std::max_element(found.begin(), found.end()) < 0.05);
  }
}

TEST_CASE("cells of values that are no distances have values nevertheless") {
  // The sources' distances differ by more than the edge is long, and some are not known.
  const Shape shape = square(3);
  const std::size_t n = shape.positions.size();
  std::mt19937 random(3);
  for (const double size : {1., 100., 1e200, 1e308})
    for (int round = 0; round < 20; ++round) {
      std::vector<double> value;
      std::vector<std::int32_t> label;
      for (std::size_t v = 0; v < n; ++v) {
        value.push_back(random() % 5 == 0 ? infinity : size * uniform(random));
        label.push_back(static_cast<std::int32_t>(random() % 4) - 1);
      }
      Part part = cells_of(shape, label);
      part.value = value;
      const Cells cells(part);
      for (const Triangle& t : shape.triangles) {
        std::array<Vertex, 3> corners;
        bool any = false;
        for (const std::uint32_t v : t) any = any || (label[v] >= 0 && std::isfinite(value[v]));
        REQUIRE(cells.paint(t, corners) == any);
        for (const Vertex& corner : corners) CHECK(std::isfinite(corner.value));
      }
    }
}

}  // namespace parts_test
