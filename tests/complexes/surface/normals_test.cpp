#include <plexway/surface/normals.hpp>

#include <catch2/catch.hpp>

#include <plexway/error.hpp>

#include "complexes/sampled_clouds.hpp"

namespace plexway::testing::normals_test {

namespace {

double length(const Position& a) { return std::sqrt(samples::dot(a, a)); }

/// At least three spacings from the boundary of a sheet.
bool inside(const SampledCloud& cloud, std::size_t i) {
  if (cloud.chart.empty()) return true;
  const double edge = 3 * cloud.spacing;
  const auto [s, y] = cloud.chart[i];
  return s > edge && s < 1.5 * samples::pi - edge && y > edge && y < 3 - edge;
}

/// The sine of the largest, and of the mean, angle between lines.
struct Angles {
  double largest = 0, mean = 0;
};

Angles angles(const std::vector<Position>& found, const std::vector<Position>& truth) {
  Angles a;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double sine = length(samples::cross(found[i], truth[i]));
    a.largest = std::max(a.largest, sine);
    a.mean += sine / static_cast<double>(truth.size());
  }
  return a;
}

}  // namespace

TEST_CASE("normals of a plane are exact, wherever and however large it is") {
  const SampledCloud cloud = sampled_plane(600);
  const auto neighbours = all_pairs_neighbours(cloud.points);
  const Position u = samples::unit({1, 2, 2}), v = samples::unit({2, 1, -2});
  const Position n = samples::cross(u, v);
  for (const double scale : {1.0, 1e-9, 1e9}) {
    std::vector<Position> turned;
    for (const Position& p : cloud.points)
      turned.push_back(samples::operator*(
          scale, samples::operator+(samples::operator*(p[0], u), samples::operator*(p[1], v))));
    const TangentPlanes planes = fit_planes(turned, neighbours);
    CAPTURE(scale);
    CHECK(angles(planes.normal, std::vector<Position>(turned.size(), n)).largest < 1e-6);
    CHECK(*std::max_element(planes.variation.begin(), planes.variation.end()) < 1e-12);
  }
}

TEST_CASE("normals of curved surfaces are off by a fraction of the spacing over the radius") {
  const SampledCloud sphere = sampled_sphere(4000), cylinder = sampled_cylinder(4000);
  for (const SampledCloud* cloud : {&sphere, &cylinder}) {
    const auto neighbours = all_pairs_neighbours(cloud->points);
    const TangentPlanes planes = fit_planes(cloud->points, neighbours);
    const Angles a = angles(planes.normal, cloud->normal);
    CAPTURE(cloud == &sphere, a.mean / cloud->spacing, a.largest / cloud->spacing);
    CHECK(a.mean < .3 * cloud->spacing);
    for (std::size_t i = 0; i < cloud->points.size(); ++i)
      if (inside(*cloud, i))
        REQUIRE(length(samples::cross(planes.normal[i], cloud->normal[i])) < 1.5 * cloud->spacing);
    for (const Position& n : planes.normal) REQUIRE(length(n) == Approx(1).epsilon(1e-9));
    for (const double flat : planes.variation) REQUIRE((flat >= 0 && flat < .02));
    CHECK(estimate_normals(cloud->points, neighbours) == planes.normal);
  }
}

TEST_CASE("normals do not depend on the number of threads") {
  const SampledCloud cloud = sampled_sphere(9000, .3);
  Neighbours ring;  // any neighbours will do
  ring.begin.push_back(0);
  for (Index i = 0; i < 9000; ++i) {
    for (Index k = 1; k < 9; ++k) ring.of.push_back((i + k * k) % 9000);
    ring.begin.push_back(static_cast<Index>(ring.of.size()));
  }
  const auto one = fit_planes(cloud.points, ring, 1);
  for (const int threads : {0, 2, 5}) {
    const auto several = fit_planes(cloud.points, ring, threads);
    CHECK(several.normal == one.normal);
    CHECK(several.variation == one.variation);
  }
}

TEST_CASE("normals are unit vectors where there is no plane to be found") {
  const std::vector<Position> line = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {4, 4, 0}, {5, 5, 0}};
  const std::vector<Position> one_place(5, {3, 1, 4});
  const std::vector<Position> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  for (const auto& points : {line, one_place, corners}) {
    const auto planes = fit_planes(points, all_pairs_neighbours(points));
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK(length(planes.normal[i]) == Approx(1));
      CHECK((planes.variation[i] >= 0 && planes.variation[i] <= 1 / 3.0));
    }
  }
  const Position along = samples::unit({1, 1, 0});
  for (const Position& n : estimate_normals(line, all_pairs_neighbours(line)))
    CHECK(std::abs(samples::dot(n, along)) < 1e-7);
  // Without neighbours.
  CHECK(estimate_normals(line, {std::vector<Index>(6, 0), {}})[2] == Position{0, 0, 1});
  CHECK(estimate_normals({}, {}).empty());
}

TEST_CASE("normals: lists that are not of these points are refused") {
  const std::vector<Position> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK_THROWS_AS(fit_planes(points, {{0, 1, 2}, {1, 0}}), InputError);
  CHECK_THROWS_AS(fit_planes(points, {{0, 1, 2, 3}, {1, 0, 7}}), InputError);
  auto bad = points;
  bad[1][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(fit_planes(bad, {{0, 1, 2, 3}, {1, 0, 0}}), Catch::Contains("point 1"));
}

}  // namespace plexway::testing::normals_test
