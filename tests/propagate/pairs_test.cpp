#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <map>

#include "propagate/pairs_solving.hpp"
#include "propagate/solving.hpp"

using namespace plexway;
using namespace plexway::testing;

namespace {

/// Around the obstacle .4 < x < .6, y < .6 in the unit square, in closed form.
struct Walled {
  std::vector<Position> points;
  double spacing = 1;

  explicit Walled(std::size_t n) : spacing(std::sqrt(.88 / static_cast<double>(n))) {
    samples::Noise random(7);
    points.push_back({.15, .2, 0});
    while (points.size() < n) {
      const Position p = {(random() + 1) / 2, (random() + 1) / 2, 0};
      if (!(p[0] > .4 && p[0] < .6 && p[1] < .6)) points.push_back(p);
    }
  }
  static double distance(const Position& p) {
    const auto length = [](double x, double y) { return std::hypot(x, y); };
    const double to_first = length(.25, .4);  // the corner (.4, .6), then (.6, .6)
    const double cross = p[0] - .15, rise = p[1] - .2;
    const bool beyond_first = p[0] > .4 && rise * .25 < .4 * cross;
    if (!beyond_first) return length(cross, rise);
    if (p[1] >= .6 || p[0] <= .6) return to_first + length(p[0] - .4, p[1] - .6);
    return to_first + .2 + length(p[0] - .6, p[1] - .6);
  }
};

}  // namespace

TEMPLATE_TEST_CASE("vertex pairs: plane, sphere, cylinder and roll in closed form", "", float,
                   double) {
  // Edges are straight and up to 5 spacings long: on a circle of this radius they are that much
  // shorter than its arcs.
  const auto check = [](const SampledCloud& cloud, double radius) {
    const double chord = std::pow(5 * cloud.spacing / radius, 2) / 24;
    const PointPairs<TestType> pairs(cloud.points, all_pairs_neighbours(cloud.points));
    CHECK_FALSE(pairs.summary().smoothed);
    for (const Index source : {Index{0}, Index{77}}) {
      const CloudErrors e = compare(solve(pairs, PointSource::at(source)),
                                    cloud.distances_from(source), cloud.spacing);
      CAPTURE(source, chord, e.mean, e.max, e.off);
      CHECK(e.unreached == 0);
      CHECK(e.mean < 6e-4 + chord);
      CHECK(e.max < .15);
      CHECK(e.off < .01);
    }
  };
  check(plane_cloud(4000), never);
  check(sphere_cloud(4000), 1);
  check(cylinder_cloud(4000), 1);
  check(swiss_cloud(8000), 1.5 * samples::pi);
}

TEST_CASE("vertex pairs: distances on a sphere get better with density, faster than the spacing") {
  double mean[2] = {0, 0};
  for (const int fine : {0, 1})
    for (const std::uint64_t seed : {11u, 12u, 13u}) {
      const SampledCloud cloud = sphere_cloud(fine ? 8000 : 2000, 0, seed);
      const PointPairs<float> pairs(cloud.points, all_pairs_neighbours(cloud.points));
      mean[fine] +=
          compare(solve(pairs, PointSource::at(0)), cloud.distances_from(0), cloud.spacing).mean;
    }
  CAPTURE(mean[0], mean[1]);
  CHECK(mean[1] < mean[0] / 2);
}

TEST_CASE("vertex pairs: paths bend around an obstacle") {
  const Walled wall(8000);
  std::vector<double> truth;
  for (const Position& p : wall.points) truth.push_back(Walled::distance(p));
  const PointPairs<float> pairs(wall.points, all_pairs_neighbours(wall.points));
  CHECK(pairs.summary().boundary_points > 100);
  const CloudErrors e = compare(solve(pairs, PointSource::at(0)), truth, wall.spacing);
  CAPTURE(e.mean, e.max);
  CHECK(e.mean < 5e-3);
  CHECK(e.off < .01);
  PropagateOptions bend_everywhere;
  bend_everywhere.visibility = Visibility::upper_bound;
  const CloudErrors u =
      compare(solve(pairs, PointSource::at(0), bend_everywhere), truth, wall.spacing);
  CHECK(u.unreached == 0);
  CHECK(u.mean < 1e-2);
}

TEST_CASE("vertex pairs: noise costs little, and less with smoothing") {
  for (const auto make : {sphere_cloud, plane_cloud})
    for (const double noise : {.25, .5, 1.0}) {
      const SampledCloud cloud = make(5000, noise, 21);
      const auto neighbours = all_pairs_neighbours(cloud.points);
      const PointPairs<float> smoothed(cloud.points, neighbours);
      PairOptions as_they_are;
      as_they_are.least_noise = never;
      const PointPairs<float> rough(cloud.points, neighbours, as_they_are);
      CHECK(smoothed.summary().smoothed);
      CHECK_FALSE(rough.summary().smoothed);
      const auto truth = cloud.distances_from(0);
      const CloudErrors s = compare(solve(smoothed, PointSource::at(0)), truth, cloud.spacing);
      const CloudErrors r = compare(solve(rough, PointSource::at(0)), truth, cloud.spacing);
      CAPTURE(noise, s.mean, r.mean, s.max, r.max);
      CHECK(s.mean < .015 * noise);
      CHECK(s.mean < .5 * r.mean);
    }
}

TEST_CASE("vertex pairs: every source alone against all at once") {
  const SampledCloud cloud = sphere_cloud(1500);
  const PointPairs<double> pairs(cloud.points, all_pairs_neighbours(cloud.points));
  std::vector<PointSource> sources;
  for (const Index s : {5u, 200u, 760u, 1400u, 3u}) sources.push_back(PointSource::at(s));
  sources[1].offset = .3;
  sources.push_back(PointSource::at(200));
  const auto field = propagate(Serial{}, pairs, sources);
  std::vector<std::vector<double>> alone;
  for (const PointSource& s : sources) alone.push_back(solve(pairs, s));
  std::size_t other = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    double best = never;
    for (const auto& d : alone) best = std::min(best, d[i]);
    REQUIRE(field.label[i] < sources.size());
    REQUIRE(field.distance[i] == Approx(best).margin(.3 * cloud.spacing));
    other += alone[field.label[i]][i] > best + .3 * cloud.spacing;
  }
  CHECK(other < 15);
  CHECK(field.distance[5] == 0);
  CHECK(field.label[5] == 0);
  CHECK(field.label[760] == 2);
}

TEST_CASE("vertex pairs: schedules agree, a radius and a budget cut off") {
  const SampledCloud cloud = cylinder_cloud(3000);
  const PointPairs<float> pairs(cloud.points, all_pairs_neighbours(cloud.points));
  const auto whole = solve(pairs, PointSource::at(9));
  for (const Schedule schedule : schedules) {
    PropagateOptions options;
    options.schedule = schedule;
    const CloudErrors e =
        compare(solve(pairs, PointSource::at(9), options), cloud.distances_from(9), cloud.spacing);
    CHECK(e.mean < 3e-3);
    CHECK(e.unreached == 0);
  }
  PropagateOptions options;
  options.radius = .8;
  const auto field = propagate(Serial{}, pairs, PointSource::at(9), options);
  for (std::size_t i = 0; i < whole.size(); ++i)
    REQUIRE(static_cast<double>(field.distance[i]) == (whole[i] <= .8 ? whole[i] : never));
  CHECK(field.statistics.expansions < 1000);
  options = {};
  options.max_expansions = 500;
  const auto some = propagate(Serial{}, pairs, PointSource::at(9), options);
  CHECK_FALSE(some.complete);
  CHECK(some.statistics.expansions == 500);
  options = {};
  options.progress = [](const Progress&) { return false; };
  CHECK_NOTHROW(solve(pairs, PointSource::at(9), options));  // fewer than it asks about
}

TEST_CASE("vertex pairs: a permutation, a turn, a shift and another unit change nothing") {
  const SampledCloud cloud = sphere_cloud(2500);
  const auto base = solve(PointPairs<float>(cloud.points, all_pairs_neighbours(cloud.points)),
                          PointSource::at(0));
  const auto truth = cloud.distances_from(0);
  const auto check = [&](const std::vector<Position>& points, double scale) {
    auto found = solve(PointPairs<float>(points, all_pairs_neighbours(points)), PointSource::at(0));
    for (double& d : found) d /= scale;
    const CloudErrors e = compare(found, truth, cloud.spacing);
    CAPTURE(scale, e.mean);
    CHECK(e.unreached == 0);
    CHECK(e.mean < 1.3 * compare(base, truth, cloud.spacing).mean + 1e-4);
  };
  std::vector<Position> turned = cloud.points, large = cloud.points, small = cloud.points;
  for (Position& p : turned) p = {.6 * p[0] - .8 * p[2] + 7, p[1] - 1e3, .8 * p[0] + .6 * p[2]};
  for (Position& p : large) p = samples::operator*(1e9, p);
  for (Position& p : small) p = samples::operator*(1e-9, p);
  check(turned, 1);
  check(large, 1e9);
  check(small, 1e-9);
  std::vector<Position> doubled = cloud.points;
  for (Position& p : doubled) p = samples::operator*(4, p);
  auto exactly =
      solve(PointPairs<float>(doubled, all_pairs_neighbours(doubled)), PointSource::at(0));
  for (double& d : exactly) d /= 4;
  CHECK(exactly == base);

  std::vector<Position> turned_round(cloud.points.rbegin(), cloud.points.rend());
  const auto back = solve(PointPairs<float>(turned_round, all_pairs_neighbours(turned_round)),
                          PointSource::at(2499));
  for (std::size_t i = 0; i < base.size(); ++i)
    REQUIRE(back[2499 - i] == Approx(base[i]).margin(.3 * cloud.spacing));
}

TEST_CASE("vertex pairs: clouds with exact answers") {
  const std::filesystem::path folder = std::filesystem::path(PLEXWAY_TRUTH_DIR) / "clouds";
  if (std::string(PLEXWAY_TRUTH_DIR).empty() || !std::filesystem::exists(folder)) {
    WARN("skipped: no folder of clouds with exact distances");
    return;
  }
#ifdef PLEXWAY_SANITIZED
  return;
#endif
  const std::map<std::string, double> bounds = {{"plane_20k", 2e-4},
                                                {"sphere_20k", 1.2e-3},
                                                {"swiss_20k", 1.2e-3},
                                                {"wall2d_20k", 1.8e-3},
                                                {"sphn002_20k", 1.3e-3}};
  for (const auto& [what, bound] : bounds) {
    std::vector<Position> points;
    std::ifstream in(folder / (what + ".xyz"));
    for (Position p; in >> p[0] >> p[1] >> p[2];) points.push_back(p);
    std::vector<double> truth;
    std::ifstream answers(folder / (what + ".v0.txt"));
    for (std::string value; answers >> value;) truth.push_back(std::stod(value));
    REQUIRE(truth.size() == points.size());
    const PointPairs<float> pairs(points, all_pairs_neighbours(points));
    const CloudErrors e = compare(solve(pairs, PointSource::at(0)), truth, pairs.unit() / 1.5);
    CAPTURE(what, e.mean, e.max);
    CHECK(e.unreached == 0);
    CHECK(e.mean <= bound);
    CHECK(e.max <= .06);
  }
}
