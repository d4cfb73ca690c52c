#include <plexway/common/mask.hpp>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::mask_test {

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("a wall with a door in a plane sends paths through the door") {
  // The strip 0.4 < x < 0.6 of a unit square is closed but for 0.4 <= y <= 0.5: paths bend at the
  // door's four corners.
  const Index n = 20;
  const Surface s = grid(n, n);
  Mask mask(s.positions.size(), s.faces.size());
  for (Index f = 0; f < s.faces.size(); ++f) {
    double x = 0, y = 0;
    for (const Index v : s.faces[f]) x += s.positions[v][0] / 3, y += s.positions[v][1] / 3;
    if (x > 0.4 && x < 0.6 && (y < 0.4 || y > 0.5)) mask.close_simplex(f);
  }
  const TriangleMesh<double> mesh(s.positions, mask.open(s.faces));
  CHECK(mesh.vertex_count() == s.positions.size());
  const auto numbers = mask.number(std::span<const std::array<Index, 3>>(s.faces));
  CHECK(std::count(numbers.begin(), numbers.end(), none) ==
        static_cast<std::ptrdiff_t>(s.faces.size() - mesh.face_count()));

  // From the left to the right: the shortest of the ways over corners on either side, each of which
  // is straight where it stays within the door.
  const auto exact = [&](const Position& a, const Position& b) {
    const double corner_y[2] = {0.4, 0.5};
    const auto length = [](double x0, double y0, double x1, double y1) {
      return std::hypot(x1 - x0, y1 - y0);
    };
    const auto at = [&](double x) {  // of the straight line
      return a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
    };
    const auto inside = [](double y) { return y >= 0.4 - 1e-12 && y <= 0.5 + 1e-12; };
    if (inside(at(0.4)) && inside(at(0.6))) return length(a[0], a[1], b[0], b[1]);
    double best = 1e9;
    for (const double y : corner_y) {
      for (const double x : {0.4, 0.6}) {  // one bend
        const double before = a[1] + (y - a[1]) * (0.4 - a[0]) / (x - a[0]);
        const double behind = y + (b[1] - y) * (0.6 - x) / (b[0] - x);
        if ((x == 0.4 || inside(before)) && (x == 0.6 || inside(behind)))
          best = std::min(best, length(a[0], a[1], x, y) + length(x, y, b[0], b[1]));
      }
      for (const double z : corner_y)  // two
        best = std::min(
            best, length(a[0], a[1], 0.4, y) + length(0.4, y, 0.6, z) + length(0.6, z, b[0], b[1]));
    }
    return best;
  };
  double worst = 0, worst_of_labels = 0;
  for (Index source = 0; source < s.positions.size(); source += 13) {
    const Position& a = s.positions[source];
    if (a[0] > 0.35) continue;
    const PointSource from = PointSource::at(source);
    const auto field = solve(Serial{}, mesh, from, testing::at(Accuracy::exact()));
    const auto labels = solve(Serial{}, mesh, from);
    for (std::size_t v = 0; v < s.positions.size(); ++v) {
      if (s.positions[v][0] < 0.65) continue;
      const double truth = exact(a, s.positions[v]);
      worst = std::max(worst, std::abs(field.distance[v] / truth - 1));
      worst_of_labels = std::max(worst_of_labels, std::abs(labels.distance[v] / truth - 1));
    }
  }
  CHECK(worst < 1e-14);
  CHECK(worst_of_labels < 2e-3);
  // Inside the wall nobody comes.
  const auto outside = solve(Serial{}, mesh, PointSource::at(0));
  CHECK(std::isinf(outside.distance[10]));  // (0.5, 0)
  CHECK(std::isfinite(outside.distance[8]));
  const auto stuck = solve(Serial{}, mesh, PointSource::at(10));
  CHECK(stuck.distance[10] == 0);
  CHECK(std::count_if(stuck.distance.begin(), stuck.distance.end(),
                      [](double d) { return std::isfinite(d); }) == 1);
}

TEST_CASE("a sphere without its cap sends paths along the cap's rim") {
  // Rings of latitude, so that the rim is one of them; vertices on it are masked from above.
  const Index rings = 96, around = 192;
  const double cap = pi / 4;  // from the pole, colatitude: ring 24
  Surface s;
  s.positions.push_back({0, 0, 1});
  for (Index r = 1; r < rings; ++r)
    for (Index k = 0; k < around; ++k) {
      const double t = pi * r / rings, p = 2 * pi * k / around;
      s.positions.push_back({std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)});
    }
  s.positions.push_back({0, 0, -1});
  const Index last = static_cast<Index>(s.positions.size() - 1);
  const auto at = [&](Index r, Index k) { return 1 + (r - 1) * around + k % around; };
  for (Index k = 0; k < around; ++k) {
    s.faces.push_back({0, at(1, k), at(1, k + 1)});
    for (Index r = 1; r + 1 < rings; ++r) {
      s.faces.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
      s.faces.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
    }
    s.faces.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
  }
  Mask mask(s.positions.size(), s.faces.size());
  for (Index v = 0; v < s.positions.size(); ++v)
    if (s.positions[v][2] > std::cos(cap) + 1e-9) mask.close_vertex(v);
  const TriangleMesh<double> mesh(s.positions, mask.open(s.faces));

  const auto angle = [](const Position& a, const Position& b) {
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return std::acos(std::clamp(dot, -1., 1.));
  };
  // The great circle where it stays out of the cap, else tangents to the rim and an arc of it.
  const auto exact = [&](const Position& a, const Position& b) {
    const double ta = std::acos(a[2]), tb = std::acos(b[2]);
    double turn = std::abs(std::atan2(a[1], a[0]) - std::atan2(b[1], b[0]));
    turn = std::min(turn, 2 * pi - turn);
    // Longitude between a point and where its tangent touches the rim.
    const auto to_rim = [&](double t) {
      return std::acos(std::clamp(std::tan(cap) / std::tan(t), -1., 1.));
    };
    const double arc = turn - to_rim(ta) - to_rim(tb);
    if (arc <= 0 || std::tan(ta) < 0 || std::tan(tb) < 0) return angle(a, b);
    const auto leg = [&](double t) {
      return std::acos(std::clamp(std::cos(t) / std::cos(cap), -1., 1.));
    };
    return leg(ta) + leg(tb) + arc * std::sin(cap);
  };
  const Index source = at(rings * 3 / 8, 0);
  const PointSource from = PointSource::at(source);
  const auto field = solve(Serial{}, mesh, from, testing::at(Accuracy::exact()));
  double worst = 0, sum = 0;
  std::size_t count = 0, behind = 0;
  for (Index v = 0; v < s.positions.size(); ++v) {
    if (s.positions[v][2] > std::cos(cap) + 1e-9) {
      REQUIRE(std::isinf(field.distance[v]));
      continue;
    }
    if (v == source || s.positions[v][2] < 0.05) continue;  // in the cap's hemisphere
    const double truth = exact(s.positions[source], s.positions[v]);
    const double error = std::abs(field.distance[v] / truth - 1);
    behind += truth > angle(s.positions[source], s.positions[v]) * 1.01;
    worst = std::max(worst, error);
    sum += error, ++count;
  }
  INFO("mean " << sum / static_cast<double>(count) << ", worst " << worst);
  CHECK(behind > 500);
  CHECK(sum / static_cast<double>(count) < 2e-4);
  CHECK(worst < 3e-4);
}

TEST_CASE("masks close tetrahedra and edges") {
  // A cube without the quarter x > 1/2, y > 1/2, cut by a mask and by hand.
  const Index n = 8;
  const Solid whole = cubes(n, n, n, 1.0 / n, 0, [](Index, Index, Index) { return true; });
  Mask mask(whole.positions.size(), whole.tets.size());
  std::vector<std::array<Index, 4>> kept;
  for (Index t = 0; t < whole.tets.size(); ++t) {
    double x = 0, y = 0;
    for (const Index v : whole.tets[t])
      x += whole.positions[v][0] / 4, y += whole.positions[v][1] / 4;
    if (x > 0.5 && y > 0.5)
      mask.close_simplex(t);
    else
      kept.push_back(whole.tets[t]);
  }
  const TetMesh<double> mesh(whole.positions, mask.open(whole.tets)), cut(whole.positions, kept);
  Index from = none, to = none;
  for (Index v = 0; v < whole.positions.size(); ++v) {
    if (whole.positions[v] == Position{1, 0.5, 0.5}) from = v;
    if (whole.positions[v] == Position{0.5, 1, 0.5}) to = v;
  }
  REQUIRE((from != none && to != none));
  const auto field = solve(Serial{}, mesh, PointSource::at(from));
  CHECK(field.distance == solve(Serial{}, cut, PointSource::at(from)).distance);
  CHECK(field.distance[to] == Approx(1).epsilon(1e-6));  // over the edge, not across

  const std::vector<std::array<double, 3>> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::array<Index, 2>> edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  Mask ring(4, 4);
  ring.close_simplex(0);
  const Wireframe<double> wire(points, ring.open(edges));
  CHECK(solve(Serial{}, wire, PointSource::at(0)).distance == std::vector<double>{0, 3, 2, 1});
  ring.close_vertex(3);
  const Wireframe<double> opened(points, ring.open(edges));
  CHECK(std::isinf(solve(Serial{}, opened, PointSource::at(0)).distance[1]));

  CHECK_THROWS_AS(ring.close_vertex(4), UsageError);
  CHECK_THROWS_AS(ring.close_simplex(4), UsageError);
  CHECK_THROWS_AS(ring.open(std::vector<std::array<Index, 2>>{{0, 1}}), UsageError);
  CHECK_THROWS_AS(Mask(2, 1).open(std::vector<std::array<Index, 2>>{{0, 2}}), UsageError);
  const std::vector<std::array<Index, 2>> beyond = {{0, 2}}, two = {{0, 1}, {1, 0}};
  const std::span<const std::array<Index, 2>> beyond_rows(beyond), two_rows(two);
  CHECK_THROWS_AS(Mask(2, 1).number(beyond_rows), UsageError);
  CHECK_THROWS_AS(Mask(2, 1).number(two_rows), UsageError);
  CHECK_THROWS_AS(Mask(2, 2).open_rows(two_rows, std::vector<double>{1}), UsageError);
  CHECK(Mask(2, 2).open_rows(two_rows, std::vector<double>{1, 2}) == std::vector<double>{1, 2});
}

}  // namespace plexway::testing::mask_test
