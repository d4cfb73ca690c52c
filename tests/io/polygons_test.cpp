// Polygons into triangles: by hand, and random ones against their area.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>

#include <plexway/io/triangles.hpp>

#include "io/surface/polygons.hpp"

namespace polygons_test {

namespace {

using plexway::io::cut_polygon;
using Points = std::vector<std::array<double, 3>>;
using Corners = std::vector<std::uint32_t>;
using Faces = std::vector<std::array<std::uint32_t, 3>>;

Faces cut(const Points& at, const Corners& corners) {
  Faces faces;
  cut_polygon(at, corners, faces);
  return faces;
}

// Twice the signed area in x and y.
double turn(const Points& at, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  return (at[b][0] - at[a][0]) * (at[c][1] - at[a][1]) -
         (at[b][1] - at[a][1]) * (at[c][0] - at[a][0]);
}

double area(const Points& at, const Corners& corners) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += turn(at, corners[0], corners[i], corners[i + 1]);
  return sum;
}

// All triangles turn as the polygon does, fill its area, and use its edges once, others twice.
void check_fills(const Points& at, const Corners& corners, const Faces& faces) {
  REQUIRE(faces.size() == corners.size() - 2);
  const double whole = area(at, corners);
  double sum = 0;
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [a, b, c] : faces) {
    const double part = turn(at, a, b, c);
    REQUIRE(part * whole > 0);
    sum += part;
    for (const auto& [u, v] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      if (const auto back = edges.find({v, u}); back != edges.end())
        edges.erase(back);
      else
        edges.insert({u, v});
    }
  }
  CHECK(sum == Approx(whole).epsilon(1e-11));
  CHECK(edges.size() == corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    CHECK(edges.count({corners[i], corners[(i + 1) % corners.size()]}) == 1);
}

// A polygon that does not cross itself: of random points, crossings of edges taken out.
Points simple_polygon(std::mt19937& random, std::size_t n) {
  std::uniform_real_distribution<double> place(-1, 1);
  Points at(n);
  for (auto& p : at) p = {place(random), place(random), 0};
  const auto crosses = [&](std::size_t i, std::size_t j) {
    const std::uint32_t a = static_cast<std::uint32_t>(i),
                        b = static_cast<std::uint32_t>((i + 1) % n),
                        c = static_cast<std::uint32_t>(j),
                        d = static_cast<std::uint32_t>((j + 1) % n);
    if (a == c || a == d || b == c || b == d) return false;
    return turn(at, a, b, c) * turn(at, a, b, d) < 0 && turn(at, c, d, a) * turn(at, c, d, b) < 0;
  };
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 2; j < n; ++j)
        if (crosses(i, j)) {
          std::reverse(at.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                       at.begin() + static_cast<std::ptrdiff_t>(j) + 1);
          again = true;
        }
  }
  return at;
}

Corners all_of(const Points& at) {
  Corners corners(at.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) corners[i] = i;
  return corners;
}

}  // namespace

TEST_CASE("A notch is cut out, whatever corner comes first", "[polygons]") {
  const Points ell = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  Corners corners = all_of(ell);
  for (std::size_t turned = 0; turned < corners.size(); ++turned) {
    check_fills(ell, corners, cut(ell, corners));
    Corners back(corners.rbegin(), corners.rend());
    check_fills(ell, back, cut(ell, back));
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

TEST_CASE("Quads are cut along the shorter diagonal that lies inside", "[polygons]") {
  const Points kite = {{0, 0, 0}, {3, -1, 0}, {6, 0, 0}, {3, 1, 0}};
  CHECK(cut(kite, {0, 1, 2, 3}) == Faces{{0, 1, 3}, {1, 2, 3}});
  CHECK(cut(kite, {1, 2, 3, 0}) == Faces{{1, 2, 3}, {1, 3, 0}});
  const Points arrow = {{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}};  // 3 turns in
  CHECK(cut(arrow, {0, 1, 2, 3}) == Faces{{0, 1, 3}, {1, 2, 3}});
  CHECK(cut(arrow, {1, 2, 3, 0}) == Faces{{1, 2, 3}, {1, 3, 0}});
  const Points square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(cut(square, {0, 1, 2, 3}) == Faces{{0, 1, 2}, {0, 2, 3}});
  const Points bent = {{0, 0, 0}, {1, 0, 0}, {1, 1, .3}, {0, 1, 0}};  // 1 and 3 are nearer
  CHECK(cut(bent, {0, 1, 2, 3}) == Faces{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("Convex polygons are fans about their first corner", "[polygons]") {
  Points at;
  for (int i = 0; i < 7; ++i) at.push_back({std::cos(i * .897), std::sin(i * .897), 5});
  CHECK(cut(at, {2, 3, 4, 5, 6, 0, 1}) ==
        Faces{{2, 3, 4}, {2, 4, 5}, {2, 5, 6}, {2, 6, 0}, {2, 0, 1}});
}

TEST_CASE("Corners on a side are kept, and no triangle is flat", "[polygons]") {
  const Points at = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 3, 0}, {1.5, 3, 0}, {0, 3, 0}};
  Corners corners = all_of(at);
  for (std::size_t turned = 0; turned < corners.size(); ++turned) {
    check_fills(at, corners, cut(at, corners));
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

TEST_CASE("Of corners that repeat one counts", "[polygons]") {
  const Points at = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(cut(at, {0, 1, 2, 3, 0}) == Faces{{0, 1, 2}, {0, 2, 3}});
  CHECK(cut(at, {0, 0, 1, 2, 2, 3}) == Faces{{0, 1, 2}, {0, 2, 3}});
  CHECK(cut(at, {0, 1, 2, 2}) == Faces{{0, 1, 2}});
  for (const Corners& none : {Corners{0, 1, 1, 0}, Corners{1, 1, 1, 1}}) {
    const Faces left = cut(at, none);
    REQUIRE(left.size() == 1);
    CHECK(left[0][1] == left[0][2]);
  }
}

TEST_CASE("A hole is joined to the rim by an edge that the polygon runs along twice",
          "[polygons]") {
  const Points at = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},   // the rim
                     {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}};  // the hole, the other way round
  Corners corners = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  for (std::size_t turned = 0; turned < corners.size(); ++turned) {
    const Faces faces = cut(at, corners);
    REQUIRE(faces.size() == 8);
    double sum = 0;
    for (const auto& [a, b, c] : faces) {
      CHECK(turn(at, a, b, c) > 0);
      sum += turn(at, a, b, c) / 2;
      const double x = (at[a][0] + at[b][0] + at[c][0]) / 3,
                   y = (at[a][1] + at[b][1] + at[c][1]) / 3;
      CHECK_FALSE((x > 1 && x < 3 && y > 1 && y < 3));
    }
    CHECK(sum == Approx(12));
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

TEST_CASE("Random simple polygons are filled, turned in space and bent a little too",
          "[polygons]") {
  std::mt19937 random(7);
  for (int trial = 0; trial < 1000; ++trial) {
    const Points flat = simple_polygon(random, 4 + static_cast<std::size_t>(trial) % 60);
    const Corners corners = all_of(flat);
    check_fills(flat, corners, cut(flat, corners));
    // Turned by a rotation about two axes: the same triangles' areas.
    const double s = std::sin(trial), c = std::cos(trial), t = std::sin(.7 * trial),
                 d = std::cos(.7 * trial);
    Points turned = flat;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      const double x = c * flat[i][0] - s * flat[i][1], y = s * flat[i][0] + c * flat[i][1];
      turned[i] = {x, d * y + 1e3, t * y - 1e3 + (trial % 2) * 1e-9 * std::sin(double(i))};
    }
    double sum = 0;
    for (const auto& f : cut(turned, corners)) {
      std::array<double, 3> n{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        n[k] = (turned[f[1]][u] - turned[f[0]][u]) * (turned[f[2]][v] - turned[f[0]][v]) -
               (turned[f[1]][v] - turned[f[0]][v]) * (turned[f[2]][u] - turned[f[0]][u]);
      }
      sum += std::hypot(n[0], n[1], n[2]);
    }
    CHECK(sum == Approx(std::abs(area(flat, corners))).epsilon(1e-6));
  }
}

TEST_CASE("Polygons of many corners take no long time, crossing ones neither", "[polygons]") {
  Points comb;
  constexpr int teeth = 20000;
  for (int i = 0; i < teeth; ++i) comb.push_back({double(i), i % 2 == 0 ? 0.0 : 1.0, 0});
  for (int i = teeth; i-- > 0;) comb.push_back({double(i), i % 2 == 0 ? 0.1 : 1.1, 0});
  const Corners corners = all_of(comb);
  CHECK(cut(comb, corners).size() == corners.size() - 2);
  std::mt19937 random(3);
  Corners wild = corners;
  std::shuffle(wild.begin(), wild.end(), random);
  CHECK(cut(comb, wild).size() == wild.size() - 2);
}

}  // namespace polygons_test
