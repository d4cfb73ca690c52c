#include <plexway/solve.hpp>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include <plexway/error.hpp>

#include "complexes/test_clouds.hpp"

namespace serial_cloud_test {

using plexway::CloudOptions;
using plexway::Index;
using plexway::PointCloud;
using plexway::PointSource;
using plexway::Serial;
using Points = std::vector<std::array<double, 3>>;

namespace {

struct Errors {
  double mean = 0, beyond = 0;  // the largest farther than three spacings from the source
  std::size_t unreached = 0;
};

template <class Real>
Errors errors_of(const samples::Cloud& cloud, const std::vector<Real>& found, std::size_t source) {
  Errors errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double exact = cloud.distance(source, i);
    if (!std::isfinite(found[i])) ++errors.unreached;
    if (!(exact > 0)) continue;
    const double error = std::abs(static_cast<double>(found[i]) / exact - 1);
    errors.mean += error / static_cast<double>(found.size());
    if (exact > 3 * cloud.spacing()) errors.beyond = std::max(errors.beyond, error);
  }
  return errors;
}

template <class Real>
Errors solve(const samples::Cloud& cloud, const CloudOptions& options = {}) {
  const PointCloud<Real> domain(cloud.points, test_clouds::near_pairs(cloud.points), options);
  return errors_of(cloud, plexway::solve(Serial{}, domain, PointSource::at(0)).distance, 0);
}

template <class Real = double>
std::vector<Real> distances(const Points& points, std::size_t k = 16, Index source = 0) {
  const PointCloud<Real> cloud(points, test_clouds::near_pairs(points, k));
  return plexway::solve(Serial{}, cloud, PointSource::at(source)).distance;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("distances on a flat cloud are exact but at its rim") {
  const Errors errors = solve<double>(samples::plane_cloud(3000));
  CHECK(errors.unreached == 0);
  CHECK(errors.mean < 4e-6);
  CHECK(errors.beyond < 0.01);
}

TEST_CASE("distances on clouds of curved surfaces") {
  const Errors sphere = solve<double>(samples::sphere_cloud(3000));
  CHECK(sphere.mean < 1e-3);
  CHECK(sphere.beyond < 0.006);
  const Errors cylinder = solve<double>(samples::cylinder_cloud(3000));
  CHECK(cylinder.mean < 1e-3);
  CHECK(cylinder.beyond < 0.05);
  const Errors roll = solve<double>(samples::swiss_cloud(4000));
  CHECK(roll.mean < 1.5e-3);
  CHECK(roll.beyond < 0.05);
  CHECK(sphere.unreached + cylinder.unreached + roll.unreached == 0);
}

TEST_CASE("paths on a cloud bend round a wall") {
  // How well depends on where points happen to lie at the corners.
  double mean = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    const Errors errors = solve<double>(samples::wall_cloud(3000, seed));
    CHECK(errors.unreached == 0);
    mean += errors.mean / 6;
  }
  CHECK(mean < 6e-3);
}

TEST_CASE("errors on clouds fall at least as fast as the spacing") {
  const Errors coarse = solve<double>(samples::sphere_cloud(800));
  const Errors fine = solve<double>(samples::sphere_cloud(3200));
  CHECK(fine.mean < coarse.mean / 2);
}

TEST_CASE("noise on a cloud makes no distances long") {
  // A tenth of the spacing; lengths in space are 1 per cent too long.
  const auto noisy = samples::sphere_cloud(3000, 1, 0.0065);
  CloudOptions in_space;
  in_space.lengths = plexway::EdgeLengths::in_space;
  const double automatic = solve<double>(noisy).mean, space = solve<double>(noisy, in_space).mean;
  CHECK(automatic < 3e-3);
  CHECK(space > 2 * automatic);
}

TEST_CASE("a folded cloud is walked along, not across") {
  for (const double gap : {0.08, 0.12, 0.2}) {  // points are 0.027 apart
    const auto hairpin = samples::hairpin_cloud(3000, 1, gap);
    const PointCloud<double> domain(hairpin.points, test_clouds::near_pairs(hairpin.points));
    const auto& mesh = domain.surface();
    std::vector<Index> point(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) point[mesh.inside_vertex(v)] = v;
    for (const auto& t : mesh.triangles().first(mesh.face_count()))
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = point[t.corner[i]], b = point[t.corner[(i + 1) % 3]];
        CHECK(hairpin.distance(a, b) <
              1.5 * samples::between(hairpin.points[a], hairpin.points[b]));
      }
    const auto d = plexway::solve(Serial{}, domain, PointSource::at(0)).distance;
    const Errors errors = errors_of(hairpin, d, 0);
    CHECK(errors.unreached == 0);
    for (std::size_t i = 0; i < d.size(); ++i) CHECK(d[i] > 0.9 * hairpin.distance(0, i) - 1e-9);
    if (gap > 0.1) CHECK(errors.mean < 4e-3);  // below, the bend is three points long
  }
}

TEST_CASE("a cloud across a gap is not reached") {
  Points points = samples::plane_cloud(900, 1).points;
  for (std::array<double, 3> p : samples::plane_cloud(900, 2).points) {
    p[2] = 0.05;
    points.push_back(p);
  }
  const auto d = distances(points);
  for (std::size_t i = 0; i < points.size(); ++i) CHECK(std::isfinite(d[i]) == (i < 900));
}

TEST_CASE("duplicates get one distance, as sources too") {
  auto cloud = samples::plane_cloud(800);
  Points points = cloud.points;
  for (std::size_t i = 0; i < 100; ++i) points.push_back(points[i]);
  const PointCloud<double> domain(points, test_clouds::near_pairs(points));
  const auto from_first = plexway::solve(Serial{}, domain, PointSource::at(5));
  const auto from_twin = plexway::solve(Serial{}, domain, PointSource::at(805));
  REQUIRE(from_first.distance.size() == 900);
  CHECK(from_first.distance == from_twin.distance);
  CHECK(from_first.distance[805] == 0);
  for (std::size_t i = 0; i < 100; ++i)
    CHECK(from_first.distance[800 + i] == from_first.distance[i]);

  const std::vector<PointSource> sources = {PointSource::at(807), PointSource::at(400)};
  const auto both = plexway::solve(Serial{}, domain, sources);
  REQUIRE(both.label.size() == 900);
  CHECK(both.label[7] == 0);
  CHECK(both.label[807] == 0);
  CHECK(both.label[400] == 1);
}

TEST_CASE("clouds of a few points") {
  CHECK(distances(Points{{1, 2, 3}}) == std::vector<double>{0});
  CHECK(distances(Points{{0, 0, 0}, {3, 4, 0}}) == std::vector<double>{0, 5});
  const auto three = distances(Points{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}});
  CHECK(three[1] == Approx(1));
  CHECK(three[2] == Approx(2));
  // Four, in a square: straight across, or along two sides if it was taken for a line.
  const auto four = distances(Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  CHECK(four[1] == Approx(1));
  CHECK(four[3] == Approx(1));
  CHECK(four[2] >= std::sqrt(2.0) - 1e-12);
  CHECK(four[2] <= 2 + 1e-12);
  const Points all_there(20, {7, 7, 7});
  CHECK(distances(all_there) == std::vector<double>(20, 0));
}

TEST_CASE("points on a line are walked along") {
  for (const std::array<double, 3> way : {std::array<double, 3>{1, 0, 0}, {0.3, -0.5, 0.8}}) {
    Points points;
    for (int i = 0; i < 60; ++i) {
      const double s = i + 0.3 * std::sin(5.0 * i);
      points.push_back({s * way[0], s * way[1], s * way[2]});
    }
    for (const std::size_t k : {2u, 4u, 16u}) {
      const auto d = distances(points, k);
      for (std::size_t i = 0; i < 60; ++i)
        CHECK(d[i] == Approx(samples::between(points[0], points[i])).epsilon(1e-9));
    }
  }
}

TEST_CASE("points along a wire in space are all reached") {
  Points points;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.05 * i;
    points.push_back({std::cos(a), std::sin(a), 0.1 * a});
  }
  for (const std::size_t k : {2u, 3u, 8u}) {
    const auto d = distances(points, k);
    const double length = 0.05 * 199 * std::sqrt(1.01);
    for (const double x : d) CHECK(std::isfinite(x));
    CHECK(d[199] > 0.9 * length);
    CHECK(d[199] < 1.01 * length);
  }
}

TEST_CASE("a cloud that fills space still gives finite distances no shorter than straight ones") {
  samples::Uniform u(4);
  Points points(700);
  for (auto& p : points) p = {u(), u(), u()};
  const PointCloud<double> cloud(points, test_clouds::near_pairs(points));
  const auto d = plexway::solve(Serial{}, cloud, PointSource::at(0)).distance;
  std::size_t reached = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    CHECK(!std::isnan(d[i]));
    reached += std::isfinite(d[i]);
  }
  CHECK(reached == cloud.summary().largest_component);
}

TEST_CASE("every point of a connected cloud is reached") {
  // Thin, with dense and sparse parts: densities from 1 to 100.
  samples::Uniform u(9);
  Points points;
  for (int i = 0; i < 2500; ++i) {
    const double x = u(), y = u();
    points.push_back({std::pow(10, x) - 1, std::pow(10, x) * (y - 0.5), 0.3 * std::sin(3 * x)});
  }
  const PointCloud<double> cloud(points, test_clouds::near_pairs(points));
  CHECK(cloud.summary().components == 1);
  const auto d = plexway::solve(Serial{}, cloud, PointSource::at(0)).distance;
  for (std::size_t i = 0; i < d.size(); ++i) {
    CHECK(std::isfinite(d[i]));
    CHECK(d[i] >= samples::between(points[0], points[i]) * (1 - 2e-2));
  }
}

TEST_CASE("clouds joined by a single pair are reached over it") {
  Points points = samples::plane_cloud(300, 1).points;
  points[1] = {1.0, 0.5, 0};
  for (std::array<double, 3> p : samples::plane_cloud(300, 2).points) {
    p[0] += 2;
    points.push_back(p);
  }
  points[301] = {2.0, 0.5, 0};
  plexway::Neighbours near = test_clouds::near_pairs(points, 12);
  // One more pair: 1 and 301, a unit apart.
  plexway::Neighbours joined;
  joined.begin.push_back(0);
  for (Index i = 0; i < 600; ++i) {
    for (const Index j : near.around(i)) joined.of.push_back(j);
    if (i == 1) joined.of.push_back(301);
    if (i == 301) joined.of.push_back(1);
    joined.begin.push_back(static_cast<Index>(joined.of.size()));
  }
  const PointCloud<double> cloud(points, joined);
  CHECK(cloud.summary().components == 1);
  CHECK(cloud.summary().bridges == 1);
  const auto d = plexway::solve(Serial{}, cloud, PointSource::at(0)).distance;
  for (std::size_t i = 300; i < 600; ++i) {
    const double exact =
        samples::between(points[0], points[1]) + 1 + samples::between(points[301], points[i]);
    CHECK(d[i] < exact * 1.02);  // the pair's triangles are about a spacing wide
    CHECK(d[i] > exact - 2 / std::sqrt(300.0));
  }
}

TEST_CASE("clouds do not care about order, scale, rotation and place") {
  const auto cloud = samples::swiss_cloud(1500);
  const auto d = distances(cloud.points);

  std::vector<std::size_t> order(cloud.points.size());
  std::iota(order.begin(), order.end(), 0);
  samples::Uniform u(8);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(u() * static_cast<double>(i))]);
  Points shuffled;
  Index source = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.push_back(cloud.points[order[i]]);
    if (order[i] == 0) source = static_cast<Index>(i);
  }
  const auto of_shuffled = distances(shuffled, 16, source);
  for (std::size_t i = 0; i < order.size(); ++i)
    CHECK(of_shuffled[i] == Approx(d[order[i]]).epsilon(1e-12));

  for (const double scale : {0x1p-300, 0x1p300}) {
    Points scaled = cloud.points;
    for (auto& p : scaled)
      for (double& x : p) x *= scale;
    const auto of_scaled = distances(scaled);
    for (std::size_t i = 0; i < d.size(); ++i)
      CHECK(of_scaled[i] == Approx(d[i] * scale).epsilon(1e-9));
  }

  Points moved = cloud.points;
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (auto& [x, y, z] : moved) {
    const double turned = c * x - s * y;
    y = s * x + c * y - 3e5;
    x = turned + 1e6;
    z += 2e5;
  }
  const auto of_moved = distances(moved);
  double difference = 0;
  for (std::size_t i = 1; i < d.size(); ++i)
    difference += std::abs(of_moved[i] / d[i] - 1) / static_cast<double>(d.size());
  CHECK(difference < 1e-3);  // other ties, another order of work
}

TEST_CASE("a second solve on a cloud gives the same bits, and float agrees with double") {
  const auto cloud = samples::sphere_cloud(1500);
  const auto near = test_clouds::near_pairs(cloud.points);
  const PointCloud<float> domain(cloud.points, near);
  plexway::Workspace<float> workspace;
  plexway::DistanceField<float> field;
  const PointSource source = PointSource::at(77);
  plexway::solve(Serial{}, domain, std::span(&source, 1), {}, workspace, field);
  const auto first = field.distance;
  plexway::solve(Serial{}, domain, std::span(&source, 1), {}, workspace, field);
  CHECK(field.distance == first);
  const auto exact = plexway::solve(Serial{}, PointCloud<double>(cloud.points, near), source);
  for (std::size_t i = 0; i < first.size(); ++i)
    CHECK(double(first[i]) == Approx(exact.distance[i]).epsilon(2e-3));
}

TEST_CASE("radius and sources on clouds are as on surfaces") {
  const auto cloud = samples::plane_cloud(1500);
  const PointCloud<double> domain(cloud.points, test_clouds::near_pairs(cloud.points));
  const auto near = plexway::solve(Serial{}, domain, PointSource::at(0), {.radius = 0.2});
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const double exact = cloud.distance(0, i);
    if (exact < 0.19) CHECK(near.distance[i] == Approx(exact).epsilon(0.02));
    if (exact > 0.4) CHECK(near.distance[i] == infinity);
  }
  CHECK_THROWS_AS(plexway::solve(Serial{}, domain, PointSource::at(1500)), plexway::UsageError);
  CHECK_THROWS_AS(plexway::solve(Serial{}, domain, PointSource::in(0, {1.0, 0.0, 0.0})),
                  plexway::UsageError);
}

}  // namespace serial_cloud_test
