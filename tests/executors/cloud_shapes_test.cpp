// Clouds that k nearest points alone tell little of: sharp edges, points nearly twice, rims.

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/solve.hpp>

#include "complexes/cube_distance.hpp"
#include "complexes/test_clouds.hpp"
#include "with_accuracy.hpp"

namespace cloud_shapes_test {

using plexway::Accuracy;
using plexway::Index;
using plexway::PointCloud;
using plexway::PointSource;
using plexway::PropagateOptions;
using plexway::Serial;
using Points = std::vector<std::array<double, 3>>;
using Distance = std::function<double(std::size_t, std::size_t)>;

namespace {

struct Errors {
  double mean = 0, worst = 0;  // the worst farther than three spacings from the source
  std::size_t unreached = 0;
};

Errors errors_of(const PointCloud<double>& cloud, std::size_t points, const Distance& exact,
                 std::initializer_list<Index> sources, const PropagateOptions& options = {}) {
  Errors errors;
  for (const Index source : sources) {
    const auto found = plexway::solve(Serial{}, cloud, PointSource::at(source), options).distance;
    for (std::size_t v = 0; v < points; ++v) {
      const double wanted = exact(source, v);
      errors.unreached += !std::isfinite(found[v]);
      if (!(wanted > 1e-4)) continue;
      const double error = std::abs(found[v] / wanted - 1);
      errors.mean += error / static_cast<double>(points * sources.size());
      if (wanted > 3 * cloud.summary().mean_spacing) errors.worst = std::max(errors.worst, error);
    }
  }
  return errors;
}

// Two unit squares that meet at an edge, at `degrees` to each other; 180 would be flat.
struct Roof {
  Points points;
  std::vector<std::array<double, 2>> unfolded;

  Roof(std::size_t n, double degrees, std::uint64_t seed) {
    samples::Uniform u(seed);
    const double half = degrees / 360 * std::numbers::pi;
    for (std::size_t i = 0; i < n; ++i) {
      const double across = u(-1, 1), along = u();
      points.push_back({across * std::sin(half), along, -std::abs(across) * std::cos(half)});
      unfolded.push_back({across, along});
    }
  }
  [[nodiscard]] Distance distance() const {
    return [this](std::size_t i, std::size_t j) {
      return std::hypot(unfolded[i][0] - unfolded[j][0], unfolded[i][1] - unfolded[j][1]);
    };
  }
};

// The surface of the unit cube, by chance or on a grid with points on the edges.
Points cube_by_chance(std::size_t n, std::uint64_t seed) {
  samples::Uniform u(seed);
  Points points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t axis = i % 3;
    points[i][axis] = static_cast<double>(i / 3 % 2);
    points[i][(axis + 1) % 3] = u();
    points[i][(axis + 2) % 3] = u();
  }
  return points;
}
Points cube_grid(int n) {
  Points points;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k <= n; ++k)
        if (i % n == 0 || j % n == 0 || k % n == 0)
          points.push_back({double(i) / n, double(j) / n, double(k) / n});
  return points;
}

}  // namespace

TEST_CASE("paths go over the sharp edge of a roof as over the plane that it unfolds to") {
  for (const double degrees : {60., 90., 110.}) {
    const Roof roof(4000, degrees, 7);
    const PointCloud<double> cloud(roof.points, test_clouds::near_pairs(roof.points));
    const Errors errors = errors_of(cloud, 4000, roof.distance(), {0, 1000, 2000});
    INFO(degrees << " degrees: mean " << errors.mean << ", worst " << errors.worst);
    CHECK(cloud.summary().components == 1);
    CHECK(errors.unreached == 0);
    CHECK(errors.mean < 1e-3);
    CHECK(errors.worst < 0.2);  // at the rim
  }
}

TEST_CASE("a cube of points has twelve edges and is closed") {
  const Points grid = cube_grid(16);
  const PointCloud<double> regular(grid, test_clouds::near_pairs(grid));
  CHECK(regular.summary().boundary_points == 0);
  const auto exact = [](const Points& points) {
    return [&points](std::size_t i, std::size_t j) {
      return plexway::testing::cube_distance(points[i], points[j]);
    };
  };
  for (const auto& [accuracy, worst] : {std::pair(Accuracy::fast(), 1e-12),
                                        {Accuracy::exact(), 1e-12},
                                        {Accuracy::usual(), 1e-5}}) {
    const Errors of_grid =
        errors_of(regular, grid.size(), exact(grid), {0, 100, 777}, plexway::testing::at(accuracy));
    CHECK(of_grid.unreached == 0);
    CHECK(of_grid.worst < worst);
  }

  const Points points = cube_by_chance(6000, 3);
  const PointCloud<double> cube(points, test_clouds::near_pairs(points));
  CHECK(cube.summary().components == 1);
  CHECK(cube.summary().triangles == 2 * 6000 - 4);  // Euler: closed
  const Errors errors = errors_of(cube, points.size(), exact(points), {0, 100, 2001});
  INFO("mean " << errors.mean << ", worst " << errors.worst);
  CHECK(errors.mean < 1e-3);
  CHECK(errors.worst < 0.05);
}

TEST_CASE("sheets that meet nowhere stay apart, whatever the angle between them") {
  // A square over the edge of another, at right angles, five spacings off.
  Points points = samples::plane_cloud(1500, 1).points;
  const double spacing = 1 / std::sqrt(1500.);
  for (const auto& p : samples::plane_cloud(1500, 2).points)
    points.push_back({1 + 5 * spacing, p[0], p[1]});
  const PointCloud<double> cloud(points, test_clouds::near_pairs(points));
  CHECK(cloud.summary().components == 2);
}

TEST_CASE("one point far from all others takes nothing from them") {
  Points points;
  for (int i = 0; i <= 14; ++i)
    for (int j = 0; j <= 14; ++j) points.push_back({double(i), double(j), 0});
  points.push_back({1e9, 0, 0});
  const PointCloud<double> cloud(points, test_clouds::near_pairs(points));
  CHECK(cloud.summary().near_duplicates == 0);
  const auto found = plexway::solve(Serial{}, cloud, PointSource::at(0)).distance;
  for (std::size_t v = 0; v + 1 < points.size(); ++v)
    CHECK(found[v] == Approx(samples::between(points[0], points[v])).epsilon(1e-6));
  CHECK(found.back() == Approx(1e9));
}

TEST_CASE("points that are nearly at one place count as one") {
  for (const double apart : {1e-7, 1e-9, 1e-13}) {
    Points points = samples::plane_cloud(2000, 5).points;
    samples::Uniform u(6);
    for (std::size_t i = 0; i < 2000; i += 2)
      points.push_back({points[i][0] + u(-apart, apart), points[i][1] + u(-apart, apart), 0});
    const PointCloud<double> cloud(points, test_clouds::near_pairs(points, 32));
    const auto exact = [&](std::size_t i, std::size_t j) {
      return samples::between(points[i], points[j]);
    };
    const Errors errors = errors_of(cloud, points.size(), exact, {0, 1, 2001});
    INFO(apart << ": mean " << errors.mean << ", worst " << errors.worst);
    CHECK(cloud.summary().near_duplicates >= 990);  // some have another point as near by chance
    CHECK(cloud.summary().duplicates == cloud.summary().near_duplicates);
    CHECK(errors.unreached == 0);
    CHECK(errors.mean < 1e-4);
    CHECK(errors.worst < 0.05);
    CHECK(cloud.of_point(2000) == 0);
    CHECK(cloud.of_point(2001) == 2);
  }
}

}  // namespace cloud_shapes_test
