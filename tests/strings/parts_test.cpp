#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "strings/chains.hpp"
#include "strings/labels.hpp"
#include "strings/pull.hpp"

// Chains, labels and pulling taut, each by itself.

namespace plexway::testing::strings_parts_test {
namespace {

using namespace strings;

constexpr double pi = std::numbers::pi;

// A wall's upper end along z, the wall below it.
Place wall(double x, double low, double high) {
  return {{x, 0, 0}, {0, 0, 1}, low, high, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, 2 * pi};
}

TEST_CASE("equal chains are one number") {
  Chains chains;
  chains.clear();
  const Index first = chains.root(0), second = chains.root(1);
  const Index a = chains.with(first, 7), b = chains.with(a, 9);
  for (Index p = 0; p < 1000; ++p) chains.with(second, p);
  CHECK(chains.root(0) == first);
  CHECK(chains.root(1) == second);
  CHECK(chains.with(first, 7) == a);
  CHECK(chains.with(a, 9) == b);
  CHECK(chains.with(second, 7) != a);
  CHECK(chains.source(b) == 0);
  CHECK(chains[b].place == 9);
  CHECK(chains[b].parent == a);
}

TEST_CASE("a taut string unfolds to a straight line") {
  // Over walls in a row that are equally high the heights add up, and z is shared out by them.
  std::vector<Place> walls;
  for (int n = 0; n < 6; ++n) walls.push_back(wall(n, -9, 9));
  Puller puller;
  for (std::size_t count = 1; count <= walls.size(); ++count) {
    String string;
    string.knots.push_back({{-1, -2, 0}});
    for (std::size_t n = 0; n < count; ++n)
      string.knots.push_back({{}, &walls[n], n % 2 == 0 ? -5. : 8.});
    string.knots.push_back({{double(count) + 2, -1, 3}});
    puller.pull(string);
    const double flat = std::hypot(1, 2) + double(count - 1) + std::hypot(3, 1);
    CHECK(string.length == Approx(std::hypot(flat, 3)).epsilon(1e-14));
  }
}

TEST_CASE("bends stay at the end of a place while the string presses them outward") {
  const Place first = wall(0, 1, 2), second = wall(1, -1, 0);
  String string;
  string.knots = {{{-1, -1, 0}}, {{}, &first, 2}, {{}, &second, -1}, {{2, -1, 0}}};
  Puller().pull(string);
  CHECK(string.knots[1].t == 1);
  CHECK(string.knots[2].t == Approx(0).margin(1e-12));
}

TEST_CASE("a string presses against a crack from one side to the other") {
  const Place end = wall(0, -1, 1);
  const auto angle = [&](double x, double y) { return end.angle_of({x, y, 0}); };
  CHECK(end.presses(angle(.1, -1), angle(-.1, -1)));
  CHECK(end.presses(angle(1, -.1), angle(-1, -.1)));
  CHECK_FALSE(end.presses(angle(1, .1), angle(-1, .1)));
  CHECK_FALSE(end.presses(angle(.1, -1), angle(1, 0)));
  CHECK(end.presses(angle(0, -1), angle(1, -1)));  // in its plane: on both sides
}

TEST_CASE("a vertex keeps strings from different sides") {
  VertexLabels at;
  CHECK(at.take({2, 0, {1, 0, 0}}, .5));
  CHECK_FALSE(at.take({2.1, 1, {1, 0, 0}}, .5));  // alike and longer
  CHECK(at.take({2.2, 2, {0, 1, 0}}, .5));
  CHECK_FALSE(at.take({2.6, 3, {0, 0, 1}}, .5));  // too long
  CHECK(at.take({1.9, 4, {1, 0, 0}}, .5));        // in the place of the first
  CHECK(at.best().chain == 4);
  CHECK_FALSE(at.knows(0));
  CHECK(at.knows(2));
  CHECK(at.take({1, 5, {0, 0, 1}}, .5));  // all others are too long now
  CHECK_FALSE(at.knows(2));
}

}  // namespace
}  // namespace plexway::testing::strings_parts_test
