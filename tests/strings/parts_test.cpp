#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>

#include "data/cell_lattice.hpp"
#include "strings/labels.hpp"
#include "strings/pull.hpp"
#include "strings/solid_space.hpp"

// Pulling taut, and what vertices keep, each by itself.

namespace plexway::testing::strings_parts_test {
namespace {

using namespace detail::strings;

constexpr double pi = std::numbers::pi;

// A wall's upper end along z, the wall below it.
Place wall(double x, double low, double high) {
  return {{x, 0, 0}, {0, 0, 1}, low, high, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, 2 * pi};
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

TEST_CASE("a vertex keeps four strings of a source, whatever solids they come through") {
  VertexLabels at;
  const auto take = [&](double distance, Index source, unsigned media) {
    return at.take({distance, 8 * source + media, source, {1, 0, 0}, 0, 1u << media},
                   {.behind = .5, .reach = 1, .cosine = .99});
  };
  for (unsigned n = 0; n < 4; ++n) CHECK(take(2 + n / 8., 0, n));
  CHECK_FALSE(take(2.5, 0, 4));
  CHECK(take(2.0625, 0, 5));  // in the place of the longest
  CHECK(at.labels.size() == 4);
  CHECK(at.labels.back().distance == 2.25);
  CHECK(take(2.5, 1, 0));
  CHECK(at.labels.size() == 5);
}

TEST_CASE("a vertex takes no string twice") {
  VertexLabels at;
  const detail::strings::Spread spread = {.behind = .5, .reach = 1, .cosine = .99};
  // One that ends in a place at the vertex comes from no direction.
  detail::strings::Label label = {1, 7, 0, {0, 0, 0}, 0, 1};
  CHECK(at.take(label, spread));
  CHECK_FALSE(at.take(label, spread));
  label.distance = .75;
  CHECK(at.take(label, spread));
  CHECK(at.labels.size() == 1);
}

TEST_CASE("a vertex keeps two strings of a source, and eight where edges are sharp") {
  for (const Index most : {detail::strings::Spread::few, detail::strings::Spread::many}) {
    VertexLabels at;
    const auto take = [&](double distance, Index chain) {
      const double angle = chain;
      return at.take({distance, chain, 0, {std::cos(angle), std::sin(angle), 0}, 0, 1},
                     {.behind = .5, .reach = 1, .cosine = .99, .own = most});
    };
    for (Index n = 0; n < most; ++n) CHECK(take(2 + n / 64., n));
    CHECK_FALSE(take(2.25, most));
    CHECK(take(1.75, most + 1));  // in the place of the longest
    CHECK(at.labels.size() == most);
    CHECK(at.best().distance == 1.75);
  }
}

TEST_CASE("vertices are sharp at a corner of more than a half turn, and beside it") {
  // An L of cells, long arms: the corner is at (1, 1).
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<Index, 4>> tets;
  std::map<std::array<int, 3>, Index> numbers;
  const auto number = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = numbers.try_emplace(at, static_cast<Index>(places.size()));
    if (is_new) places.push_back({double(at[0]), double(at[1]), double(at[2])});
    return found->second;
  };
  for (int n = 0; n < 6; ++n) {
    samples::add_cell({n, 0, 0}, number, tets);
    if (n > 0) samples::add_cell({0, n, 0}, number, tets);
  }
  const TetMesh<float> mesh(places, tets);
  const SolidSpace space(mesh);
  const auto is_sharp = [&](const std::array<int, 3>& at) {
    return space.is_sharp(mesh.inside_vertex(numbers.at(at)));
  };
  for (const int z : {0, 1}) {
    CHECK(is_sharp({1, 1, z}));
    CHECK(is_sharp({2, 1, z}));
    CHECK(is_sharp({1, 0, z}));
    CHECK_FALSE(is_sharp({3, 1, z}));
    CHECK_FALSE(is_sharp({0, 5, z}));
  }
}

}  // namespace
}  // namespace plexway::testing::strings_parts_test
