#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <plexway/metric/edge_lengths.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "complexes/test_meshes.hpp"
#include "data/two_speeds.hpp"
#include "with_accuracy.hpp"

namespace plexway::flat_test {

using metric::Point;
using metric::Tensor;

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

}  // namespace plexway::flat_test
