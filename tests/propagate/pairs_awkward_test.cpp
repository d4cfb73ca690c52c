#include <catch2/catch.hpp>

#include <plexway/error.hpp>

#include "propagate/pairs_solving.hpp"

using namespace plexway;
using namespace plexway::testing;

namespace {

template <class Real = double>
PointPairs<Real> pairs_of(const std::vector<Position>& points, std::size_t k = 16) {
  return PointPairs<Real>(points, all_pairs_neighbours(points, k));
}

}  // namespace

TEMPLATE_TEST_CASE("vertex pairs: points in a row are a path", "", float, double) {
  std::vector<Position> row;
  for (int i = 0; i < 50; ++i) row.push_back({i * 1.0 + (i % 3) * .1, 2.0 * i, 0});
  for (auto& p : row) p[1] = 2 * p[0];
  for (const std::size_t k : {1u, 2u, 5u, 60u}) {
    const auto d = solve(pairs_of<TestType>(row, k), PointSource::at(10));
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double truth = std::sqrt(5) * std::abs(row[i][0] - row[10][0]);
      if (k > 1) REQUIRE(d[i] == Approx(truth).epsilon(1e-5));
      REQUIRE_FALSE(std::isnan(d[i]));
    }
  }
}

TEST_CASE("vertex pairs: one point, two points, equal points") {
  const std::vector<Position> one = {{3, 4, 5}};
  CHECK(solve(pairs_of(one), PointSource::at(0)) == std::vector<double>{0});
  const std::vector<Position> two = {{3, 4, 5}, {3, 4, 7}};
  CHECK(solve(pairs_of(two), PointSource::at(1)) == std::vector<double>{2, 0});
  const std::vector<Position> equal(9, {1, 2, 3});
  const auto pairs = pairs_of(equal);
  CHECK(pairs.summary().distinct == 1);
  CHECK(pairs.summary().duplicates == 8);
  CHECK(pairs.summary().components == 1);
  CHECK(solve(pairs, PointSource::at(4)) == std::vector<double>(9, 0));
}

TEST_CASE("vertex pairs: isolated points and other components are not reached") {
  std::vector<Position> points = plane_cloud(800).points;
  for (std::size_t i = 0; i < 300; ++i) points.push_back({points[i][0] + 50, points[i][1], 0});
  auto neighbours = all_pairs_neighbours(points);
  points.push_back({500, 0, 0});
  neighbours.begin.push_back(neighbours.begin.back());
  const PointPairs<float> pairs(points, neighbours);
  CHECK(pairs.summary().components == 3);
  CHECK(pairs.summary().largest_component == 800);
  CHECK(pairs.summary().isolated_points == 1);
  const PointSource sources[] = {PointSource::at(0), PointSource::at(1)};
  const auto field = propagate(Serial{}, pairs, sources);
  for (std::size_t i = 0; i < points.size(); ++i) {
    REQUIRE(std::isinf(field.distance[i]) == (i >= 800));
    REQUIRE((field.label[i] == none) == (i >= 800));
  }
  const auto alone = solve(pairs, PointSource::at(1100));
  CHECK(alone[1100] == 0);
  CHECK(std::isinf(alone[0]));
}

TEST_CASE("vertex pairs: duplicates are one place, whatever their neighbours say") {
  const SampledCloud cloud = sphere_cloud(1200);
  std::vector<Position> points = cloud.points;
  for (std::size_t i = 0; i < 400; ++i) points.push_back(cloud.points[3 * i]);
  const auto base = solve(pairs_of(cloud.points), PointSource::at(30));
  // Neighbours of the first of each place only; the others lead to it.
  Neighbours lists = all_pairs_neighbours(cloud.points);
  for (Index i = 0; i < 400; ++i) {
    lists.of.push_back(3 * i);
    lists.begin.push_back(static_cast<Index>(lists.of.size()));
  }
  const PointPairs<double> pairs(points, lists);
  CHECK(pairs.summary().distinct == 1200);
  for (const Index source : {30u, 1210u}) {  // the same place
    const auto d = solve(pairs, PointSource::at(source));
    for (std::size_t i = 0; i < points.size(); ++i)
      REQUIRE(d[i] == base[i < 1200 ? i : 3 * (i - 1200)]);
  }
}

TEST_CASE("vertex pairs: finite distances where no surface is, and of very different density") {
  samples::Noise random(3);
  std::vector<Position> filling, dense, far;
  for (int i = 0; i < 2000; ++i) filling.push_back({random(), random(), random()});
  for (int i = 0; i < 3000; ++i) {
    const double x = random(), y = random();
    dense.push_back(i % 2 ? Position{x, y, 0} : Position{x / 100, y / 100, 0});
  }
  for (const Position& p : dense) far.push_back({p[0] + 1e6, p[1] - 1e6, 1e6});
  for (const auto& points : {filling, dense, far}) {
    const auto pairs = pairs_of<float>(points);
    const auto d = solve(pairs, PointSource::at(1));
    for (std::size_t i = 0; i < d.size(); ++i) {
      REQUIRE_FALSE(std::isnan(d[i]));
      REQUIRE((pairs.summary().components > 1 || std::isfinite(d[i])));
      if (&points == &filling || !std::isfinite(d[i])) continue;
      const Position to = samples::operator-(points[i], points[1]);
      REQUIRE(d[i] < 1.7 * std::sqrt(samples::dot(to, to)) + 1e-3);
    }
  }
}

TEST_CASE("vertex pairs: what makes no sense is refused") {
  const SampledCloud cloud = plane_cloud(100);
  const auto pairs = pairs_of(cloud.points);
  CHECK_THROWS_WITH(PointPairs<float>({}, {}), Catch::Contains("no points"));
  CHECK_THROWS_AS(PointPairs<float>(cloud.points, {{0, 1}, {0}}), InputError);
  auto bad = cloud.points;
  bad[7][1] = never;
  CHECK_THROWS_WITH(PointPairs<float>(bad, all_pairs_neighbours(cloud.points)),
                    Catch::Contains("point 7"));
  CHECK_THROWS_AS(solve(pairs, PointSource::at(100)), UsageError);
  CHECK_THROWS_AS(solve(pairs, PointSource::in(0, {1, 0, 0})), UsageError);
  CHECK_THROWS_AS(propagate(Serial{}, pairs, std::span<const PointSource>{}), UsageError);
  PairOptions options;
  options.progress = [](double) { return false; };
  CHECK_THROWS_AS(PointPairs<float>(cloud.points, all_pairs_neighbours(cloud.points), options),
                  Cancelled);
}

TEST_CASE("vertex pairs do not depend on the threads that build them") {
  const SampledCloud cloud = sphere_cloud(6000, .3);
  const auto neighbours = all_pairs_neighbours(cloud.points, 12);
  PairOptions options;
  options.threads = 1;
  const auto one = solve(PointPairs<float>(cloud.points, neighbours, options), PointSource::at(0));
  options.threads = 3;
  CHECK(solve(PointPairs<float>(cloud.points, neighbours, options), PointSource::at(0)) == one);
}
