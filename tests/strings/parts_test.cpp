#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
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

// Rows in the triangles of a fan that folds in space, each of which shares a vertex with the next.
TEST_CASE("a string across a strip of rows is as short as it can be") {
  std::mt19937 random(5);
  const auto share = [&] { return 2 * (static_cast<double>(random()) / 4294967296.) - 1; };
  const auto point = [&](double height) { return Point{3 * share(), 3 * share(), height}; };
  for (int plan = 0; plan < 300; ++plan) {
    const std::size_t rows = 2 + random() % 6;
    std::vector<Point> ends = {{0, 0, 0}, {1 + share() / 2, share() / 2, 0}};
    std::vector<std::array<Index, 2>> row = {{0, 1}};
    while (row.size() < rows) {
      const std::array<Index, 2> last = row.back();
      const auto fresh = static_cast<Index>(ends.size());
      ends.push_back(point(static_cast<double>(row.size())));
      row.push_back(random() % 2 == 0 ? std::array{last[0], fresh} : std::array{fresh, last[1]});
    }
    std::vector<Place> places;
    for (const auto& [a, b] : row) {
      const Point d = ends[b] - ends[a];
      Place place{ends[a], unit(d), 0, norm(d), {}, {}, {}, 2 * pi};
      place.end[0] = a;
      place.end[1] = b;
      places.push_back(place);
    }
    String s;
    s.knots = {{point(-1)}};
    for (const Place& place : places) {
      s.knots.push_back({place.at(0), &place});
      s.knots.back().t = place.high / 2;
    }
    s.knots.push_back({point(static_cast<double>(rows))});
    Puller().pull(s);
    // Moved by any bit, no bend or two neighbours make it shorter.
    const auto length = [&](const std::vector<double>& t) {
      double sum = 0;
      Point last = s.knots[0].at;
      for (std::size_t k = 0; k < rows; ++k) {
        const Point next = places[k].at(std::clamp(t[k], 0., places[k].high));
        sum += norm(next - last);
        last = next;
      }
      return sum + norm(s.knots.back().at - last);
    };
    std::vector<double> best;
    for (std::size_t k = 1; k <= rows; ++k) best.push_back(s.knots[k].t);
    CAPTURE(plan, rows);
    CHECK(std::abs(length(best) - s.length) < 1e-12 * s.length);
    for (const double step : {1., .1, 1e-2, 1e-3})
      for (int n = 0; n < 200; ++n) {
        std::vector<double> t = best;
        for (double& x : t) x += step * share();
        CHECK(length(t) >= s.length * (1 - 1e-12));
      }
  }
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
  constexpr Spread spread = {.5, 0};
  VertexLabels at;
  CHECK(at.take({2, 0, 0, {1, 0, 0}}, spread));
  CHECK_FALSE(at.take({2.1, 1, 0, {1, 0, 0}}, spread));  // alike and longer
  CHECK(at.take({2.2, 2, 0, {0, 1, 0}}, spread));
  CHECK_FALSE(at.take({2.6, 3, 0, {0, 0, 1}}, spread));  // too long
  CHECK(at.take({1.9, 4, 0, {1, 0, 0}}, spread));        // in the place of the first
  CHECK(at.best().chain == 4);
  CHECK_FALSE(at.knows(0));
  CHECK(at.knows(2));
  CHECK(at.take({1, 5, 0, {0, 0, 1}}, spread));  // all others are too long now
  CHECK_FALSE(at.knows(2));
}

TEST_CASE("a vertex keeps the sources that may be the nearest beside it") {
  constexpr Spread spread = {.5, 1};
  const auto label = [](Index source, double side) {  // ten away, and so far aside
    const double length = std::hypot(10, side);
    return strings::Label{length, source, source, {10 / length, side / length, 0}, length};
  };
  VertexLabels at;
  CHECK(at.take(label(0, 0), spread));
  CHECK(at.take(label(1, 1), spread));  // halfway to it is within reach
  CHECK(at.take(label(2, -2), spread));
  CHECK_FALSE(at.take(label(3, 4), spread));
  CHECK(at.labels.size() == 3);
  CHECK(at.take({9, 4, 4, {1, 0, 0}, 9}, spread));  // an edge before all others
  CHECK(at.labels.size() == 1);
}

}  // namespace
}  // namespace plexway::testing::strings_parts_test
