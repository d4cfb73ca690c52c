#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/fields/evolution.hpp>

namespace plexway::evolution_test {

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

TEST_CASE("the same seed makes the same trials, another one others") {
  Evolution a(plane, options(7, 50, 2)), b(plane, options(7, 50, 2)), c(plane, options(8, 50, 2));
  const Trials first = run(a);
  CHECK(first.size() == 100);
  CHECK(run(b) == first);
  CHECK(run(c) != first);
}

TEST_CASE("an evolution that goes on from a state does as if nothing had happened") {
  Evolution whole(plane, options(3, 40, 3));
  const Trials all = run(whole);
  for (const std::size_t stop : {0u, 1u, 17u, 39u, 40u, 41u, 80u, 119u, 120u}) {
    Evolution begun(plane, options(3, 40, 3));
    Trials trials = run(begun, stop);
    Evolution resumed(plane, options(3, 40, 3), begun.state());
    const Trials rest = run(resumed);
    trials.insert(trials.end(), rest.begin(), rest.end());
    INFO(stop);
    CHECK(trials == all);
    CHECK(resumed.best() == whole.best());
    CHECK(resumed.best_fitness() == whole.best_fitness());
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

TEST_CASE("the step follows the one-fifth rule") {
  Evolution evolution(plane, options(1, 1000));
  double fitness = 0;
  const auto after = [&](bool success) {
    (void)evolution.propose();
    evolution.tell(success ? ++fitness : fitness - 1);
    return evolution.state().step;
  };
  const double begin = after(true);
  CHECK(begin == 0.2);  // the start is no success
  double step = after(true);
  CHECK(step > begin);
  for (int i = 0; i < 4; ++i) step = after(false);
  CHECK(step == Approx(begin));  // one in five: it stays
  CHECK_FALSE(evolution.tell(std::nan("")));
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

}  // namespace plexway::evolution_test
