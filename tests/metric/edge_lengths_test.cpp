#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "complexes/test_meshes.hpp"
#include "data/two_speeds.hpp"
#include "with_accuracy.hpp"

namespace plexway::edge_lengths_test {

using metric::Point;
using metric::Tensor;

namespace {

using Triangles = std::vector<std::array<Index, 3>>;
using Tets = std::vector<std::array<Index, 4>>;
using Edges = std::vector<std::array<Index, 2>>;

const std::vector<Point> square = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}};
const Triangles halves = {{0, 1, 2}, {0, 2, 3}};

// By brute force: the sum over many short steps along the edge.
template <class At>
double integral(const Point& a, const Point& b, const At& tensor_at) {
  constexpr int steps = 20000;
  double sum = 0;
  const Point d = {(b[0] - a[0]) / steps, (b[1] - a[1]) / steps, (b[2] - a[2]) / steps};
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps;
    const Tensor m = tensor_at(t);
    double squared = 0;
    const double rows[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) squared += d[r] * rows[r][c] * d[c];
    sum += std::sqrt(squared);
  }
  return sum;
}

}  // namespace

TEST_CASE("edges come in the order that each complex takes") {
  const std::vector<Point> corners = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 4}};
  const Triangles triangle = {{0, 1, 2}};
  const auto three = metric::triangle_lengths(corners, triangle, metric::SimplexSpeeds{{1}});
  REQUIRE(three.size() == 1);
  CHECK(three[0] == std::array<double, 3>{1, std::sqrt(5.0), 2});
  const Tets tet = {{0, 1, 2, 3}};
  const auto six = metric::tet_lengths(corners, tet, metric::SimplexSpeeds{{0.5}});
  REQUIRE(six.size() == 1);
  const double expected[6] = {
      2, 4, 2 * std::sqrt(5.0), 8, 2 * std::sqrt(17.0), 2 * std::sqrt(20.0)};
  for (std::size_t e = 0; e < 6; ++e) CHECK(six[0][e] == Approx(expected[e]));
  const Edges edges = {{0, 3}, {3, 0}, {1, 1}};
  CHECK(metric::edge_lengths(corners, edges, metric::SimplexSpeeds{{2, 4, 1}}) ==
        std::vector<double>{2, 1, 0});
}

TEST_CASE("a tensor measures steps in world coordinates") {
  const std::vector<Point> points = {{1, 2, 3}, {2, 4, 6}};
  const Edges edge = {{0, 1}};
  const Tensor m = {2, 0.5, -0.25, 3, 0.125, 1};
  // d = (1, 2, 3): 2 + 12 + 9 + 2 (0.5 * 2 - 0.25 * 3 + 0.125 * 6).
  CHECK(metric::edge_lengths(points, edge, metric::SimplexTensors{{m}})[0] ==
        Approx(std::sqrt(23.0 + 2 * (1 - 0.75 + 0.75))));
  CHECK(metric::edge_lengths(points, edge, metric::SimplexTensors{{Tensor::planar(4, 0, 9)}})[0] ==
        Approx(std::sqrt(4.0 + 36 + 9)));
  CHECK(metric::edge_lengths(points, edge, metric::SimplexTensors{{Tensor::of_speed(4)}})[0] ==
        Approx(std::sqrt(14.0) / 4));
}

TEST_CASE("tensors of vertices are integrated along the edge") {
  const std::vector<Point> points = {{0, 0, 0}, {1, 2, -1}};
  const Edges edge = {{0, 1}};
  const Tensor a = {1, 0.2, 0, 2, -0.3, 5}, b = {30, 1, 2, 8, 0, 3};
  const auto between = [&](double t) {
    const auto mix = [t](double x, double y) { return x + t * (y - x); };
    return Tensor{mix(a.xx, b.xx), mix(a.xy, b.xy), mix(a.xz, b.xz),
                  mix(a.yy, b.yy), mix(a.yz, b.yz), mix(a.zz, b.zz)};
  };
  CHECK(metric::edge_lengths(points, edge, metric::VertexTensors{{a, b}})[0] ==
        Approx(integral(points[0], points[1], between)).epsilon(1e-7));
}

TEST_CASE("a tensor at any point is integrated to high order") {
  const std::vector<Point> points = {{0.5, 0, 0}, {1.5, 1, 0.5}};
  const Edges edge = {{1, 0}};
  const auto at = [](const Point& p) {
    return Tensor{1 + p[0] * p[0], 0.1 * p[1], 0, 2 + std::sin(p[1]), 0, std::exp(p[2])};
  };
  const auto along = [&](double t) {
    Point p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = points[0][i] + t * (points[1][i] - points[0][i]);
    return at(p);
  };
  CHECK(metric::edge_lengths(points, edge, metric::TensorFunction{at})[0] ==
        Approx(integral(points[0], points[1], along)).epsilon(1e-5));
}

TEST_CASE("a function of two points is asked the same way from all sides") {
  std::vector<std::pair<double, double>> asked;
  const auto lengths = metric::triangle_lengths(
      square, halves, metric::LengthFunction{[&](const Point& a, const Point& b) {
        asked.emplace_back(a[0] + 10 * a[1], b[0] + 10 * b[1]);
        return std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]);
      }});
  CHECK(lengths[0] == std::array<double, 3>{3, 4, 7});
  CHECK(lengths[1] == std::array<double, 3>{7, 3, 4});
  REQUIRE(asked.size() == 6);
  CHECK(asked[2] == asked[3]);  // the diagonal, once from each side
  CHECK(asked[2] == std::pair<double, double>{0, 43});
}

TEST_CASE("an edge between two speeds is agreed on as asked") {
  metric::SimplexSpeeds speeds{{1, 2}};
  const auto diagonal = [&] {
    const auto lengths = metric::triangle_lengths(square, halves, speeds);
    CHECK(lengths[0][0] == 3);  // edges of one triangle are its own in any case
    CHECK(lengths[1][1] == 1.5);
    return std::pair{lengths[0][2], lengths[1][0]};
  };
  CHECK(diagonal() == std::pair{3.75, 3.75});
  speeds.agreement.sides = metric::Sides::least;
  CHECK(diagonal() == std::pair{2.5, 2.5});
  speeds.agreement.sides = metric::Sides::own;
  CHECK(diagonal() == std::pair{5.0, 2.5});
  speeds.agreement.jump = 0.6;
  CHECK(diagonal() == std::pair{3.75, 3.75});
}

TEST_CASE("given lengths are found in any order and direction") {
  metric::GivenLengths given{{{2, 1, 4}, {0, 1, 9}, {0, 1, 3}, {2, 0, 5}, {3, 0, 4}, {2, 3, 3}}};
  const std::vector<Point> nowhere(4);
  const auto lengths = metric::triangle_lengths(nowhere, halves, given);
  CHECK(lengths[0] == std::array<double, 3>{3, 4, 5});
  CHECK(lengths[1] == std::array<double, 3>{5, 3, 4});
  given.edges.pop_back();
  CHECK_THROWS_WITH(metric::triangle_lengths(nowhere, halves, given),
                    "no length is given for the edge 2 - 3 of triangle 1");
}

TEST_CASE("what measures nothing is refused by name") {
  const auto refused = [](const metric::Metric& metric, const char* part) {
    CHECK_THROWS_AS(metric::triangle_lengths(square, halves, metric), InputError);
    CHECK_THROWS_WITH(metric::triangle_lengths(square, halves, metric), Catch::Contains(part));
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  refused(metric::SimplexSpeeds{{1}}, "1 speeds for 2 simplices");
  refused(metric::SimplexSpeeds{{1, 0}}, "triangle 1: its speed is not a positive number");
  refused(metric::SimplexSpeeds{{-1, 1}}, "triangle 0");
  refused(metric::SimplexSpeeds{{nan, 1}}, "triangle 0");
  refused(metric::SimplexTensors{{{}, Tensor::planar(1, -3, 1)}}, "triangle 1: its tensor");
  refused(metric::SimplexTensors{{{}, Tensor::planar(-1, 0, 1)}}, "triangle 1: its tensor");
  refused(metric::SimplexTensors{{{}, Tensor::planar(nan, 0, 1)}}, "triangle 1");
  refused(metric::VertexTensors{{{}, {}}}, "2 tensors for 4 vertices");
  refused(metric::VertexTensors{{{}, {}, {}, Tensor::planar(1, 0, 0)}}, "vertex 3: its tensor");
  refused(metric::LengthFunction{[](const Point&, const Point&) { return -1.0; }}, "edge 0 - 1");
  const std::vector<Point> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<Index, 4>> tet = {{0, 1, 2, 3}};
  CHECK_THROWS_AS(
      metric::tet_lengths(corners, tet, metric::SimplexSpeeds{{1}, {metric::Sides::own}}),
      UsageError);
  const Triangles wrong = {{0, 1, 7}};
  CHECK_THROWS_WITH(metric::triangle_lengths(square, wrong, metric::SimplexSpeeds{{1}}),
                    "triangle 0: vertex 7 is out of range, there are 4");
}

TEST_CASE("violations are found in triangles and in space") {
  const std::vector<std::array<double, 3>> triangles = {
      {3, 4, 5}, {1, 1, 2.01}, {1, 1, 2}, {0, 0, 0}, {9, 1, 2}};
  const auto flat = metric::find_violations(std::span<const std::array<double, 3>>(triangles));
  CHECK(flat.count == 2);
  CHECK(flat.first == 1);
  // A regular tetrahedron; one whose faces close and which does not: the sixth edge is at most
  // sqrt(3) where the others are 1; one with a bad face.
  const std::vector<std::array<double, 6>> tets = {
      {1, 1, 1, 1, 1, 1}, {1, 1, 1, 1, 1, 1.73}, {1, 1, 1, 1, 1, 1.74}, {1, 1, 2.1, 1, 1, 1}};
  const auto solid = metric::find_violations(std::span<const std::array<double, 6>>(tets));
  CHECK(solid.count == 2);
  CHECK(solid.first == 2);
}

namespace {

// `ratio` times as long across the direction `degrees` as along it.
Tensor stretched(double ratio, double degrees) {
  const double a = degrees * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
  const double across = ratio * ratio;
  return Tensor::planar(c * c + across * s * s, (1 - across) * c * s, s * s + across * c * c);
}

double length(const Tensor& m, const Point& a, const Point& b) {
  const double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
  return std::sqrt(m.xx * x * x + 2 * m.xy * x * y + m.yy * y * y + m.zz * z * z);
}

struct Named {
  std::string name;
  std::vector<Point> points;
  std::vector<std::array<Index, 3>> faces;
};

std::vector<Named> flat_meshes() {
  const samples::HalvedSquare grid(20, 0), shaken(30, 0.4);
  const auto polygon = plexway::testing::random_polygon(9, 400, 300, 7);
  return {{"grid", grid.points, grid.faces},
          {"shaken", shaken.points, shaken.faces},
          {"polygon", polygon.positions, polygon.faces}};
}

template <class Real, class Executor>
double worst_error(const Executor& executor, const Named& flat, const Tensor& tensor,
                   const PropagateOptions& options) {
  const auto lengths = metric::triangle_lengths(
      flat.points, flat.faces,
      metric::SimplexTensors{std::vector<Tensor>(flat.faces.size(), tensor)});
  CHECK(metric::find_violations(std::span<const std::array<double, 3>>(lengths)).count == 0);
  // Lengths are the metric in double: flips lose nothing.
  const TriangleMesh<double> input(flat.points.size(), flat.faces, lengths);
  const TriangleMesh<Real> mesh = IntrinsicDelaunay(input).template mesh<Real>();
  double worst = 0;
  for (const Index source : {Index{0}, static_cast<Index>(flat.points.size() / 2)}) {
    const auto at = PointSource::at(source);
    const auto field = solve(executor, mesh, std::span(&at, 1), options);
    for (std::size_t v = 0; v < flat.points.size(); ++v) {
      const double exact = length(tensor, flat.points[source], flat.points[v]);
      if (v != source)
        worst = std::max(worst, std::abs(static_cast<double>(field.distance[v]) / exact - 1));
    }
  }
  return worst;
}

}  // namespace

// 1e-4 was asked for.
TEST_CASE("a constant metric on a plane is exact on its intrinsic Delaunay triangulation") {
  for (const Named& flat : flat_meshes())
    for (const double ratio : {2.0, 5.0, 10.0})
      for (const double degrees : {0.0, 30.0, 77.0}) {
        INFO(flat.name << ", 1 to " << ratio << ", " << degrees << " degrees");
        const Tensor tensor = stretched(ratio, degrees);
        for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::exact()})
          CHECK(worst_error<double>(Serial{}, flat, tensor, testing::at(accuracy)) < 1e-9);
        CHECK(worst_error<float>(Serial{}, flat, tensor, testing::by_labels()) < 2e-6);
        CHECK(worst_error<float>(OpenMP{2}, flat, tensor, testing::by_labels()) < 2e-6);
        CHECK(worst_error<double>(Serial{}, flat, tensor, {}) < 3e-4);
        CHECK(worst_error<float>(Serial{}, flat, tensor, {}) < 3e-4);
      }
}

TEST_CASE("a constant metric fills a box as straight lines do") {
  std::vector<Point> points;
  std::vector<std::array<Index, 4>> tets;
  constexpr Index n = 6, m = n + 1;
  for (Index k = 0; k < m; ++k)
    for (Index j = 0; j < m; ++j)
      for (Index i = 0; i < m; ++i) points.push_back({i / 6., j / 6., k / 6.});
  // Each cell into six tetrahedra about its diagonal.
  constexpr Index steps[6][3] = {{1, m, m * m}, {1, m * m, m}, {m, 1, m * m},
                                 {m, m * m, 1}, {m * m, 1, m}, {m * m, m, 1}};
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i)
        for (const auto& s : steps) {
          const Index a = (k * m + j) * m + i;
          tets.push_back({a, a + s[0], a + s[0] + s[1], a + s[0] + s[1] + s[2]});
        }
  // The plain rule, which is all that lengths allow, bends paths too often: the box without a
  // metric is as far off.
  for (const Tensor& tensor : {Tensor{}, stretched(3, 25)}) {
    const auto lengths = metric::tet_lengths(
        points, tets, metric::SimplexTensors{std::vector<Tensor>(tets.size(), tensor)});
    CHECK(metric::find_violations(std::span<const std::array<double, 6>>(lengths)).count == 0);
    const TetMesh<double> mesh(points.size(), tets, lengths);
    const auto field = solve(Serial{}, mesh, PointSource::at(0));
    double worst = 0, mean = 0;
    for (std::size_t v = 1; v < points.size(); ++v) {
      const double error = field.distance[v] / length(tensor, points[0], points[v]) - 1;
      worst = std::max(worst, std::abs(error));
      mean += std::abs(error) / static_cast<double>(points.size());
    }
    INFO("worst " << worst << ", mean " << mean);
    CHECK(mean < 3.5e-3);
    CHECK(worst < 4e-2);
  }
}

TEST_CASE("a speed on each edge of a wireframe adds up to travel time") {
  const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<std::array<Index, 2>> edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
  const auto lengths =
      metric::edge_lengths(points, edges, metric::SimplexSpeeds{{10, 10, 10, 1, 1}});
  const Wireframe<double> wireframe(points.size(), edges, lengths);
  const auto at = PointSource::at(0);
  const auto field = solve(Serial{}, wireframe, std::span(&at, 1), PropagateOptions{});
  CHECK(field.distance[2] == Approx(0.2));
  CHECK(field.distance[3] == Approx(0.3));
}

}  // namespace plexway::edge_lengths_test
