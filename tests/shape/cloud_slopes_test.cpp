#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "complexes/common/point3.hpp"
#include "shape/scene.hpp"

namespace plexway::cloud_slopes_test {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// The k nearest of each point, by looking at all.
Neighbours nearest(const std::vector<Point3>& points, std::size_t k) {
  Neighbours found;
  found.begin = {0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    const auto far = [&](Index n) {
      const Point3 to = minus(points[n], points[i]);
      return dot(to, to);
    };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return far(a) < far(b); });
    std::erase(order, static_cast<Index>(i));
    order.resize(std::min(k, order.size()));
    found.of.insert(found.of.end(), order.begin(), order.end());
    found.begin.push_back(static_cast<Index>(found.of.size()));
  }
  return found;
}

}  // namespace

TEST_CASE("slopes of a cloud: a linear function has its gradient, across a tilted plane") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  const Point3 normal = unit(Point3{.3, -.5, .8}), x = some_perpendicular(normal),
               y = cross(normal, x);
  std::vector<Point3> points;
  std::vector<double> value;
  for (int n = 0; n < 200; ++n) {
    const double a = number(random), b = number(random);
    Point3 p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = 7 + a * x[k] + b * y[k];
    points.push_back(p);
    value.push_back(2 * a - 3 * b + 1);
  }
  // Of any length.
  const std::vector<Point3> normals(points.size(), {.6, -1, 1.6});
  const Neighbours neighbours = nearest(points, 8);
  // A neighbour that is not reached counts for nothing.
  value[17] = inf;
  const auto found = cloud_slopes(points, normals, neighbours, value);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CAPTURE(i);
    CHECK(dot(found[i], normal) == Approx(0).margin(1e-12));
    const double along = dot(found[i], x), across = dot(found[i], y);
    CHECK(along == Approx(i == 17 ? 0 : 2).margin(1e-9));
    CHECK(across == Approx(i == 17 ? 0 : -3).margin(1e-9));
  }
}

TEST_CASE("slopes of a cloud: nothing to go by is no slope") {
  const std::vector<Point3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  const std::vector<double> value = {0, 1, 2, inf};
  const Neighbours all = nearest(points, 3);
  // In a line, no direction across is known; a normal of no length faces nowhere.
  for (const Point3& normal : {Point3{0, 0, 1}, Point3{}})
    for (const Point3& slope : cloud_slopes(points, std::vector<Point3>(4, normal), all, value)) {
      CHECK(slope == Point3{});
    }
}

}  // namespace plexway::cloud_slopes_test
