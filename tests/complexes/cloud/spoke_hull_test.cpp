#include "complexes/cloud/spoke_hull.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace spoke_hull_test {

namespace {

using plexway::Index;
using plexway::Spoke;

Spoke spoke_at(double x, double y, Index place) {
  const double r = x * x + y * y;
  return {x, y, x / r, y / r, place};
}

long double turn(const Spoke& a, const Spoke& b, const Spoke& c) {
  const auto of = [](double x) { return static_cast<long double>(x); };
  return (of(b.u) - of(a.u)) * (of(c.v) - of(a.v)) - (of(b.v) - of(a.v)) * (of(c.u) - of(a.u));
}

// Who is next: the only one with all others to the left. Else none, as where three are in a line.
std::size_t next_of(const std::vector<Spoke>& spokes, std::size_t a) {
  for (std::size_t b = 0; b < spokes.size(); ++b) {
    const auto left = [&](std::size_t c) { return turn(spokes[a], spokes[b], spokes[c]) > 0; };
    bool all = b != a;
    for (std::size_t c = 0; all && c < spokes.size(); ++c) all = c == a || c == b || left(c);
    if (all) return b;
  }
  return spokes.size();
}

std::vector<std::size_t> hull_of(const std::vector<Spoke>& spokes) {
  std::size_t first = 0;
  const auto size = [&](std::size_t i) { return std::hypot(spokes[i].u, spokes[i].v); };
  for (std::size_t i = 1; i < spokes.size(); ++i)
    if (size(i) > size(first)) first = i;
  std::vector<std::size_t> hull;
  for (std::size_t at = first; hull.empty() || at != first; at = next_of(spokes, at)) {
    if (at == spokes.size()) return {};
    hull.push_back(at);
  }
  return hull;
}

std::vector<std::size_t> wrapped(const std::vector<Spoke>& spokes) {
  plexway::SpokeHull hull;
  const auto found = hull.wrap(1000, spokes);
  return {found.begin(), found.end()};
}

}  // namespace

TEST_CASE("the umbrella is the hull of the images, for few and for many neighbours", "[umbrella]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1), size(-30, 3);
  for (int round = 0; round < 4000; ++round) {
    const std::size_t count = 3 + random() % (round % 8 == 0 ? 90 : 20);
    const double unit = std::pow(10, size(random));
    // All around the place, or on one side of it, as at a rim.
    const double shift = round % 3 == 0 ? 1.01 : 0;
    std::vector<Spoke> spokes;
    for (Index i = 0; i < count; ++i)
      spokes.push_back(spoke_at(unit * (uniform(random) + shift), unit * uniform(random), i));
    INFO("round " << round << ", " << count << " neighbours");
    CHECK(wrapped(spokes) == hull_of(spokes));
  }
}

TEST_CASE("images that nearly lie in a line are told apart beyond what is a tie", "[umbrella]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(0, 6.28), off(-5.5, -2);
  for (int round = 0; round < 4000; ++round) {
    // On a circle through the place all but for a share of 3e-6 to 1e-2, and some around it.
    std::vector<Spoke> spokes;
    for (Index i = 0; i < 12; ++i) {
      const double a = angle(random), r = i < 5 ? 1 + std::pow(10, off(random)) : 1.5 + 0.1 * i;
      const double x = i < 5 ? 1 + r * std::cos(a) : r * std::cos(a);
      spokes.push_back(spoke_at(x, r * std::sin(a), i));
    }
    double least = 1;  // sine of the smallest angle between two others, as any of them sees these
    for (std::size_t a = 0; a < spokes.size(); ++a)
      for (std::size_t b = 0; b < spokes.size(); ++b)
        for (std::size_t c = 0; c < b; ++c) {
          if (a == b || a == c) continue;
          const auto away = [&](std::size_t i) {
            return std::hypot(spokes[i].u - spokes[a].u, spokes[i].v - spokes[a].v);
          };
          const auto area = std::abs(static_cast<double>(turn(spokes[a], spokes[b], spokes[c])));
          least = std::min(least, area / (away(b) * away(c)));
        }
    if (least < 2e-6) continue;
    INFO("round " << round << ", least sine " << least);
    CHECK(wrapped(spokes) == hull_of(spokes));
  }
}

TEST_CASE("places on one circle share its triangles, whoever is asked", "[umbrella]") {
  constexpr int side = 9, reach = 2;
  std::vector<Index> number(side * side);
  std::iota(number.begin(), number.end(), Index{0});
  std::shuffle(number.begin(), number.end(), std::mt19937(3));
  const auto at = [&](int x, int y) { return number[static_cast<std::size_t>(y * side + x)]; };
  std::set<std::array<Index, 2>> rings;  // a place, and who is in its ring
  for (int y = reach; y < side - reach; ++y)
    for (int x = reach; x < side - reach; ++x) {
      std::vector<Spoke> spokes;
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          if (i != 0 || j != 0) spokes.push_back(spoke_at(i, j, at(x + i, y + j)));
      plexway::SpokeHull hull;
      for (const std::size_t i : hull.wrap(at(x, y), spokes))
        rings.insert({at(x, y), spokes[i].place});
    }
  const auto share = [&](Index a, Index b) {
    CHECK(rings.count({a, b}) == rings.count({b, a}));
    return rings.count({a, b}) != 0;
  };
  for (int y = reach; y < side - reach - 1; ++y)
    for (int x = reach; x < side - reach - 1; ++x) {
      CHECK(share(at(x, y), at(x + 1, y)));
      CHECK(share(at(x, y), at(x, y + 1)));
      CHECK(share(at(x, y), at(x + 1, y + 1)) != share(at(x + 1, y), at(x, y + 1)));
    }
}

}  // namespace spoke_hull_test
