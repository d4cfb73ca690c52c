#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/fields/evolution.hpp>
#include <plexway/fields/tuning.hpp>

#include "data/shapes.hpp"

namespace plexway::tuning_test {

namespace {

const std::vector<EvolvedParameter> plane = {{"x", -5, 5}, {"y", -5, 5}, {"z", 0.01, 100, true}};

// A bowl, deepest at (1, -2, 3).
double bowl(const std::vector<double>& v) {
  const double x = v[0] - 1, y = v[1] + 2, z = std::log(v[2] / 3);
  return -(x * x + 4 * y * y + z * z);
}

using Trials = std::vector<std::vector<double>>;

Trials run(Evolution& evolution, std::size_t most = std::numeric_limits<std::size_t>::max()) {
  Trials trials;
  while (!evolution.done() && trials.size() < most) {
    trials.push_back(evolution.propose());
    evolution.tell(bowl(trials.back()));
  }
  return trials;
}

EvolutionOptions options(std::uint64_t seed, std::size_t evaluations, std::size_t restarts = 1) {
  EvolutionOptions made;
  made.seed = seed;
  made.evaluations = evaluations;
  made.restarts = restarts;
  return made;
}

}  // namespace

TEST_CASE("an evolution finds the deepest place of a bowl") {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    Evolution evolution(plane, options(seed, 400));
    run(evolution);
    INFO(seed);
    CHECK(evolution.best()[0] == Approx(1).margin(0.02));
    CHECK(evolution.best()[1] == Approx(-2).margin(0.02));
    CHECK(evolution.best()[2] == Approx(3).epsilon(0.02));
    CHECK(evolution.best_fitness() == bowl(evolution.best()));
    CHECK(evolution.evaluations() == 400);
  }
}

TEST_CASE("trials stay in their ranges and the first is where it is told to be") {
  EvolutionOptions wild = options(11, 300);
  wild.step = 3;
  wild.adapt = false;
  wild.start = {4, -7, 10};  // y is outside
  Evolution evolution(plane, wild);
  const Trials trials = run(evolution);
  CHECK(trials[0][0] == Approx(4));
  CHECK(trials[0][1] == -5);
  CHECK(trials[0][2] == Approx(10));
  for (const auto& v : trials)
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(v[i] >= plane[i].low);
      CHECK(v[i] <= plane[i].high);
    }
  CHECK(evolution.state().step == 3);
}

TEST_CASE("an evolution refuses what makes no sense") {
  CHECK_THROWS_AS(Evolution({}, options(1, 10)), UsageError);
  CHECK_THROWS_AS(Evolution({{"x", 1, 1}}, options(1, 10)), UsageError);
  CHECK_THROWS_AS(Evolution({{"x", 0, 1, true}}, options(1, 10)), UsageError);
  CHECK_THROWS_AS(Evolution(plane, options(1, 0)), UsageError);
  CHECK_THROWS_AS(Evolution(plane, options(1, 10, 0)), UsageError);
  EvolutionOptions bad = options(1, 10);
  bad.step = 0;
  CHECK_THROWS_AS(Evolution(plane, bad), UsageError);
  bad = options(1, 10);
  bad.start = {1, 2};
  CHECK_THROWS_AS(Evolution(plane, bad), UsageError);
  Evolution evolution(plane, options(1, 10));
  run(evolution, 3);
  EvolutionState state = evolution.state();
  state.parent.pop_back();
  CHECK_THROWS_AS(Evolution(plane, options(1, 10), state), UsageError);
  state = evolution.state();
  state.best[0] = 1.5;
  CHECK_THROWS_AS(Evolution(plane, options(1, 10), state), UsageError);
  CHECK_THROWS_AS(Evolution(plane, options(1, 3), evolution.state()), UsageError);
}

namespace {

// A unit sphere, where the exact distance to the smooth one is the angle, and a flat square.
TuningSurface ball() {
  const samples::Shape shape = samples::geodesic_sphere(6);
  TuningSurface surface{"ball", shape.points, shape.faces, {}};
  for (const Index source : {Index{0}, Index{200}}) {
    std::vector<double> exact;
    for (const samples::Point& p : shape.points)
      exact.push_back(std::acos(std::clamp(samples::dot(p, shape.points[source]), -1.0, 1.0)));
    surface.truths.push_back({source, exact});
  }
  return surface;
}

TuningSurface square() {  // cells of 1 : 4, so that triangles are no right isosceles ones
  TuningSurface surface;
  surface.name = "square";
  constexpr Index n = 12;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) surface.positions.push_back({4.0 * i, 1.0 * j, 0});
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j, b = a + n + 1;
      surface.faces.push_back({a, b, b + 1});
      surface.faces.push_back({a, b + 1, a + 1});
    }
  TuningSurface::Truth truth{0, {}};
  for (const auto& p : surface.positions) truth.distance.push_back(std::hypot(p[0], p[1]));
  surface.truths.push_back(truth);
  return surface;
}

// A flat L of long triangles, from the ends of one arm: what the corner at (4, 1) hides is seen
// over the corner.
TuningSurface stretched_ell() {
  samples::Shape shape = samples::ell();
  for (samples::Point& p : shape.points) p[0] *= 4;
  TuningSurface surface{"ell", shape.points, shape.faces, {}};
  for (const Index source : {Index{24}, Index{0}}) {  // (0, 2) and (0, 0)
    const samples::Point& s = shape.points[source];
    TuningSurface::Truth truth{source, {}};
    for (const samples::Point& p : shape.points) {
      const bool hidden = s[1] > 1 && p[0] > 4 && (p[0] - s[0]) * (1 - s[1]) < (p[1] - s[1]) * 4;
      truth.distance.push_back(hidden
                                   ? std::hypot(s[0] - 4, s[1] - 1) + std::hypot(p[0] - 4, p[1] - 1)
                                   : std::hypot(p[0] - s[0], p[1] - s[1]));
    }
    surface.truths.push_back(truth);
  }
  return surface;
}

PropagateOptions with(const ProbeTable& table) {
  PropagateOptions options;
  options.visibility = Visibility::tuned;
  options.probe = table;
  return options;
}

}  // namespace

TEST_CASE("a set sums up errors that are known") {
  TuningSet set({square()}, false, 2);
  CHECK(set.fields() == 1);
  CHECK(set.mean_error({}) < 3e-7);  // flat: exact
  TuningSurface longer = square(), half = square(), unreached = square();
  for (double& d : longer.truths[0].distance) d *= 2;
  CHECK(TuningSet({longer}, false).mean_error({}) == Approx(0.5).epsilon(1e-5));
  for (std::size_t v = 0; v < 100; ++v) half.truths[0].distance[v] = std::nan("");
  CHECK(TuningSet({half}, false).mean_error({}) < 4e-7);
  for (double& d : unreached.truths[0].distance) d = std::numeric_limits<double>::infinity();
  CHECK(TuningSet({unreached}, false).mean_error({}) == 1);
  const std::vector<double> errors = TuningSet({longer, square()}, false).errors({});
  CHECK(errors.size() == 2);
  CHECK(TuningSet({longer, square()}, false).mean_error({}) == (errors[0] + errors[1]) / 2);
}

TEST_CASE("errors do not depend on the number of threads") {
  const std::vector<TuningSurface> surfaces = {ball(), square(), ball()};
  TuningSet one(surfaces, true, 1), five(surfaces, true, 5);
  CHECK(one.digest() == five.digest());
  CHECK(one.errors(with(ProbeTable::published())) == five.errors(with(ProbeTable::published())));
  SaddleThresholds other = SaddleThresholds::standard();
  other.interior = 0.1;
  one.rebuild(other), five.rebuild(other);
  CHECK(one.errors({}) == five.errors({}));
}

TEST_CASE("an evolution makes a table better") {
  TuningSet set({stretched_ell()}, false, 2);
  PropagateOptions centroid;
  centroid.visibility = Visibility::centroid;
  CHECK(set.mean_error({}) < 2e-7);  // the default is exact here: so is the truth
  const double before = set.mean_error(centroid);
  EvolutionOptions options;
  options.evaluations = 120;
  Evolution evolution(probe_parameters(), options);
  while (!evolution.done())
    evolution.tell(-set.mean_error(with(probe_table_of(evolution.propose()))));
  CHECK(-evolution.best_fitness() <= 0.1 * before);
}

TEST_CASE("thresholds of saddles are data of a mesh") {
  // Nothing is a saddle any more: paths bend nowhere, and the slit is passed as if it were none.
  const samples::Shape slit = samples::slit();
  std::vector<double> from_corner(slit.points.size(), 1);
  TuningSet set({{"slit", slit.points, slit.faces, {{0, from_corner}}}}, false, 1);
  const double bent = set.mean_error({});
  SaddleThresholds blind = SaddleThresholds::standard();
  blind.boundary = 10;
  set.rebuild(blind);
  CHECK(set.mean_error({}) != bent);
  set.rebuild(SaddleThresholds::standard());
  CHECK(set.mean_error({}) == bent);
}

TEST_CASE("numbers of a table and of thresholds go there and back") {
  const ProbeTable table = ProbeTable::published();
  CHECK(probe_table_of(values_of(table)) == table);
  CHECK(probe_parameters().size() == values_of(table).size());
  const SaddleThresholds saddles = SaddleThresholds::standard();
  CHECK(values_of(saddle_thresholds_of(values_of(saddles))) == values_of(saddles));
  CHECK(saddle_parameters().size() == values_of(saddles).size());
  CHECK_THROWS_AS(probe_table_of(std::vector<double>{1, 2}), UsageError);
  CHECK_THROWS_AS(saddle_thresholds_of(std::vector<double>{1, 2}), UsageError);
}

TEST_CASE("a set refuses what does not fit") {
  CHECK_THROWS_AS(TuningSet({}, false), UsageError);
  TuningSurface bad = square();
  bad.truths[0].distance.pop_back();
  CHECK_THROWS_AS(TuningSet({bad}, false), UsageError);
  bad = square();
  bad.truths[0].source = 10000;
  CHECK_THROWS_AS(TuningSet({bad}, false), UsageError);
  bad = square();
  bad.truths.clear();
  CHECK_THROWS_AS(TuningSet({bad}, false), UsageError);
  bad = square();
  bad.faces[3][1] = 10000;
  CHECK_THROWS_AS(TuningSet({bad}, false), InputError);
}

}  // namespace plexway::tuning_test
