#include <catch2/catch.hpp>

#include <limits>
#include <vector>

#include "labels/front.hpp"
#include "labels/solving.hpp"
#include "labels/visit_marks.hpp"

namespace plexway::testing::front_test {

namespace {

/// Label correcting on random weights: the front's whole contract. Returns pops.
template <class Front>
std::size_t settle(Front front, const std::vector<std::vector<std::pair<Index, double>>>& edges,
                   std::vector<double>& distance) {
  std::vector<char> waits(edges.size(), 0);
  distance.assign(edges.size(), std::numeric_limits<double>::infinity());
  distance[0] = 0;
  front.push(0, 0);
  waits[0] = 1;
  std::size_t pops = 0;
  Index s = 0;
  while (front.pop(s, [&](Index i) { return distance[i]; })) {
    ++pops;
    waits[s] = 0;
    for (const auto& [to, length] : edges[s]) {
      const double d = distance[s] + length;
      if (!(d < distance[to])) continue;
      distance[to] = d;
      front.push(to, d, !waits[to]);
      waits[to] = 1;
    }
  }
  return pops;
}

std::vector<std::vector<std::pair<Index, double>>> network(Index nodes, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::vector<std::pair<Index, double>>> edges(nodes);
  for (Index v = 0; v < nodes; ++v)
    for (int n = 0; n < 4; ++n) edges[v].emplace_back(below(random, nodes), uniform(random));
  return edges;
}

}  // namespace

TEST_CASE("all fronts settle to the same distances") {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto edges = network(500, seed);
    FrontStorage storage;
    storage.reserve(edges.size());
    std::vector<double> nearest, other;
    const std::size_t least = settle(PriorityQueue<double>(storage), edges, nearest);
    for (const double step : {.05, .3, 5., std::numeric_limits<double>::infinity()}) {
      const std::size_t pops = settle(DualQueue<double>(storage, step), edges, other);
      CHECK(other == nearest);
      CHECK(pops >= least);
    }
    CHECK(least <= edges.size());
  }
}

TEST_CASE("a dual queue goes from near to far in steps") {
  std::mt19937 random(2);
  for (const double step : {.01, .1, 1., 3.}) {
    FrontStorage storage;
    storage.reserve(100);
    DualQueue<double> front(storage, step);
    std::vector<double> distance;
    for (Index i = 0; i < 100; ++i) {
      distance.push_back(10 * uniform(random));
      front.push(i, distance[i]);
    }
    // Nearer ones found while they wait: the queue asks again.
    for (Index i = 0; i < 100; i += 7) distance[i] *= .9;
    double farthest = 0;
    std::vector<char> seen(100, 0);
    Index s = 0;
    while (front.pop(s, [&](Index i) { return distance[i]; })) {
      CHECK(distance[s] >= farthest - step - 1);  // 1: what the nearer ones may have missed
      if (s % 7) CHECK(distance[s] >= farthest - step);
      if (s % 7) farthest = std::max(farthest, distance[s]);
      CHECK_FALSE(seen[s]);
      seen[s] = 1;
    }
    CHECK(std::count(seen.begin(), seen.end(), 1) == 100);
  }
}

TEST_CASE("an infinite step is first in first out") {
  FrontStorage storage;
  storage.reserve(5);
  DualQueue<float> front(storage, std::numeric_limits<float>::infinity());
  const auto far = [](Index) { return 1e30f; };
  Index next = 0, expected = 0, s = 0;
  for (int round = 0; round < 10; ++round) {  // around the ring several times
    for (int i = 0; i < 4; ++i) front.push(next++, 1e30f);
    for (int i = 0; i < 4; ++i) {
      REQUIRE(front.pop(s, far));
      CHECK(s == expected++);
    }
  }
  CHECK_FALSE(front.pop(s, far));
}

TEST_CASE("a step too small to move the limit does not stop the queue") {
  FrontStorage storage;
  storage.reserve(3);
  for (const float distance : {1e9f, 1e30f, 3e38f}) {
    DualQueue<float> front(storage, 1);
    front.push(1, distance);
    int asked = 0;
    Index s = 0;
    const auto distance_of = [&](Index) {
      if (++asked > 100) throw 1;  // it would ask for ever
      return distance;
    };
    CAPTURE(distance);
    CHECK_NOTHROW(front.pop(s, distance_of));
    CHECK(s == 1);
  }
}

TEST_CASE("what is not wanted is not queued") {
  FrontStorage storage;
  storage.reserve(4);
  DualQueue<float> front(storage, 1);
  front.push(0, .5f, false);
  front.push(1, 5, false);
  front.push(2, 7);
  Index s = 0;
  CHECK(front.pop(s, [](Index) { return 7.f; }));
  CHECK(s == 2);
  CHECK_FALSE(front.pop(s, [](Index) { return 7.f; }));
}

TEST_CASE("a priority queue is sorted and skips what is out of date") {
  FrontStorage storage;
  PriorityQueue<float> front(storage);
  std::mt19937 random(3);
  std::vector<float> distance(50);
  for (Index i = 0; i < 50; ++i) {
    distance[i] = static_cast<float>(uniform(random)) + 1;
    front.push(i, distance[i]);
    if (i % 2) front.push(i, distance[i] -= .5f);
  }
  float last = 0;
  Index s = 0;
  int pops = 0;
  while (front.pop(s, [&](Index i) { return distance[i]; })) {
    CHECK(distance[s] >= last);
    last = distance[s];
    ++pops;
  }
  CHECK(pops == 50);
}

TEST_CASE("visit marks forget everything at a start, also when their numbers come round") {
  VisitMarks marks;
  marks.resize(3);
  const auto reached = [&](std::size_t i) {
    return (marks.data()[i] ^ marks.current()) < (1 << VisitMarks::epoch_shift);
  };
  bool right = true;
  for (int n = 0; n < 40000; ++n) {
    marks.start();
    right &= !reached(0) && !reached(1) && !reached(2);
    // Vertex 2 is marked once only: its mark must not come to life again.
    marks.data()[n % 2] = static_cast<VisitMarks::Mark>(marks.current() | VisitMarks::waiting | 2);
    if (n == 5) marks.data()[2] = marks.current();
    right &= reached(static_cast<std::size_t>(n % 2));
  }
  CHECK(right);
  CHECK(marks.bytes() >= 6);
  marks.resize(10);
  marks.start();
  CHECK_FALSE(reached(9));
}

}  // namespace plexway::testing::front_test
