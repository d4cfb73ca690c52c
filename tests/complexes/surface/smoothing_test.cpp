#include <catch2/catch.hpp>

#include <plexway/error.hpp>
#include <plexway/surface/normals.hpp>
#include <plexway/surface/smoothing.hpp>

#include "complexes/sampled_clouds.hpp"

namespace plexway::testing::smoothing_test {

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

namespace {

double apart(const Position& a, const Position& b) {
  const Position d = samples::operator-(a, b);
  return std::sqrt(samples::dot(d, d));
}

/// Root of the mean square of how far points are off the clean surface along its normal, in
/// spacings.
double roughness(const SampledCloud& cloud, const std::vector<Position>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double off = samples::dot(samples::operator-(points[i], cloud.clean[i]), cloud.normal[i]);
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(points.size())) / cloud.spacing;
}

}  // namespace

TEST_CASE("the noise of a cloud is read off its points") {
  for (const auto make : {sampled_sphere, sampled_plane, sampled_cylinder}) {
    const auto level = [&](double noise) {
      const SampledCloud cloud = make(3000, noise, 5);
      return noise_level(cloud.points, all_pairs_neighbours(cloud.points));
    };
    CHECK(level(0) < 1e-3);
    CHECK(level(.05) == Approx(.05).epsilon(.15));
    CHECK(level(.25) == Approx(.25).epsilon(.15));
    CHECK(level(1) > .4);
  }
}

TEST_CASE("waves of a surface are no noise, and noise on waves is") {
  SampledCloud cloud = sampled_plane(4000);
  samples::Noise random(8);
  const double h = cloud.spacing;
  std::vector<Position> noisy;
  for (Position& p : cloud.points) {  // eight spacings long, one high
    p[2] = h * std::sin(samples::pi * p[0] / (4 * h)) * std::sin(samples::pi * p[1] / (4 * h)) / 2;
    noisy.push_back({p[0], p[1], p[2] + .1 * h * samples::bell(random)});
  }
  const auto neighbours = all_pairs_neighbours(cloud.points);
  CHECK(noise_level(cloud.points, neighbours) < .02);
  CHECK(noise_level(noisy, neighbours) == Approx(.1).margin(.02));
  CHECK(smooth(cloud.points, neighbours) == cloud.points);
}

TEST_CASE("smoothing leaves clean clouds as they are, to the last bit") {
  for (const SampledCloud& cloud :
       {sampled_sphere(2000), sampled_cylinder(2000), sampled_plane(500)})
    CHECK(smooth(cloud.points, all_pairs_neighbours(cloud.points)) == cloud.points);
}

TEST_CASE("smoothing moves no point of a clean surface, even if asked to") {
  SmoothOptions always;
  always.least_noise = 0;
  const SampledCloud plane = sampled_plane(2000);
  const auto flat = smooth(plane.points, all_pairs_neighbours(plane.points), always);
  for (std::size_t i = 0; i < flat.size(); ++i) REQUIRE(apart(flat[i], plane.points[i]) < 1e-12);

  // A sphere leaves its osculating quadric by the fourth power of the distance.
  double mean[2], largest = 0;
  for (const int fine : {0, 1}) {
    const SampledCloud sphere = sampled_sphere(fine ? 4000 : 1000);
    const auto round = smooth(sphere.points, all_pairs_neighbours(sphere.points), always);
    const double scale = sphere.spacing * sphere.spacing;  // over the radius, 1
    mean[fine] = largest = 0;
    for (std::size_t i = 0; i < round.size(); ++i) {
      const double moved = apart(round[i], sphere.points[i]) / scale;
      mean[fine] += moved / static_cast<double>(round.size());
      largest = std::max(largest, moved);
    }
  }
  CAPTURE(mean[0], mean[1], largest);
  CHECK(mean[1] < .05);
  CHECK(largest < .15);
  CHECK(mean[1] < mean[0] / 3);
}

TEST_CASE("smoothing takes most of the noise away, and only along the normal") {
  for (const auto make : {sampled_sphere, sampled_plane, sampled_cylinder})
    for (const double noise : {.25, .5, 1.0}) {
      const SampledCloud cloud = make(4000, noise, 6);
      const auto smoothed = smooth(cloud.points, all_pairs_neighbours(cloud.points));
      CAPTURE(noise, roughness(cloud, cloud.points), roughness(cloud, smoothed));
      CHECK(roughness(cloud, smoothed) < (noise < 1 ? .4 : .5) * roughness(cloud, cloud.points));
      double along = 0;
      for (std::size_t i = 0; i < smoothed.size(); ++i) {
        const Position moved = samples::operator-(smoothed[i], cloud.points[i]);
        const double up = samples::dot(moved, cloud.normal[i]);
        along += std::sqrt(std::max(samples::dot(moved, moved) - up * up, 0.0)) / 4000;
      }
      CHECK(along < .25 * noise * cloud.spacing);
    }
}

TEST_CASE("smoothing does not depend on threads, and follows a change of unit and place") {
  const SampledCloud cloud = sampled_sphere(3000, .4);
  const auto neighbours = all_pairs_neighbours(cloud.points);
  SmoothOptions options;
  options.threads = 1;
  const auto one = smooth(cloud.points, neighbours, options);
  for (const int threads : {2, 3}) {
    options.threads = threads;
    CHECK(smooth(cloud.points, neighbours, options) == one);
  }
  auto larger = cloud.points;
  for (Position& p : larger) p = samples::operator+(samples::operator*(256, p), {1e4, 0, -1e4});
  const auto also = smooth(larger, neighbours, options);
  for (std::size_t i = 0; i < one.size(); ++i)
    REQUIRE(apart(samples::operator+(samples::operator*(256, one[i]), {1e4, 0, -1e4}), also[i]) <
            1e-6);
}

TEST_CASE("smoothing: no surface, no result that is not a number") {
  SmoothOptions always;
  always.least_noise = 0;
  std::vector<Position> line, place(20, {1, 2, 3}), filling;
  samples::Noise random(9);
  for (int i = 0; i < 40; ++i) line.push_back({i * .5, i * .25, 0});
  for (int i = 0; i < 500; ++i) filling.push_back({random(), random(), random()});
  for (const auto& points : {line, place, filling, std::vector<Position>{{1, 1, 1}}, {}}) {
    const auto neighbours = all_pairs_neighbours(points);
    const auto moved = smooth(points, neighbours, always);
    REQUIRE(moved.size() == points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const double x : moved[i]) REQUIRE(std::isfinite(x));
      if (points.size() != filling.size()) CHECK(apart(moved[i], points[i]) < 1e-9);
    }
    CHECK(noise_level(points, neighbours) >= 0);
  }
}

TEST_CASE("smoothing refuses lists of other points and ends when told to") {
  const SampledCloud cloud = sampled_plane(3000, .3);
  const auto neighbours = all_pairs_neighbours(cloud.points);
  CHECK_THROWS_AS(smooth(std::span(cloud.points).first(10), neighbours), InputError);
  SmoothOptions options;
  options.rounds = -1;
  CHECK_THROWS_AS(smooth(cloud.points, neighbours, options), UsageError);
  options.rounds = 2;
  options.progress = [](double) { return false; };
  CHECK_THROWS_AS(smooth(cloud.points, neighbours, options), Cancelled);
  double last = 0;
  options.progress = [&](double share) { return share >= last && (last = share, true); };
  CHECK_NOTHROW(smooth(cloud.points, neighbours, options));
  CHECK(last <= 1);
  CHECK(last > .5);
}

}  // namespace plexway::testing::smoothing_test
