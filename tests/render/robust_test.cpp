// What pictures are made of, where the input is not what is usual.

#include <algorithm>
#include <random>

#include "render/cells.hpp"
#include "render/drawing.hpp"
#include "render/skins.hpp"

namespace robust_test {

using namespace render_testing;

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

}  // namespace robust_test
