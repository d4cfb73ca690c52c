// Clouds of points at random, in which nobody can say to a spacing where a slit ends: told where it
// matters, and nowhere else.

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/warnings.hpp>

namespace plexway::testing::scattered_rims_test {

namespace {

// Of the unit square, bent to a quarter of a tube, but for a slit of width 0.16 as far as `top`.
std::vector<std::array<double, 3>> sheet(std::size_t count, unsigned seed, double top, bool even) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in(0, 1), off(-0.3, 0.3);
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  const double step = 1 / static_cast<double>(side);
  std::vector<std::array<double, 3>> points;
  for (std::size_t n = 0; n < side * side; ++n) {
    const double x = even ? step * (static_cast<double>(n % side) + 0.5 + off(random)) : in(random);
    const double y = even ? step * (static_cast<double>(n / side) + 0.5 + off(random)) : in(random);
    if (std::abs(x - 0.5) < 0.08 && y < top) continue;
    points.push_back({std::sin(x), std::cos(x), y});
  }
  return points;
}

bool warned(std::vector<std::array<double, 3>> at) {
  io::Points points;
  points.positions = std::move(at);
  const AnyDomain domain(AnyShape::cloud(points));
  const auto field = domain.solve(Serial{}, PointSource::at(0));
  for (const Warning& warning : warnings(domain, field, PointSource::at(0)))
    if (warning.text.find("scattered as by chance") != warning.text.npos) return warning.doubtful;
  return false;
}

}  // namespace

TEST_CASE("scattered points: a slit in them is told of, a straight rim and even points are not") {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    CAPTURE(seed);
    CHECK(warned(sheet(2000, seed, 0.6, false)));
    CHECK(!warned(sheet(2000, seed, 0, false)));
    CHECK(!warned(sheet(2000, seed, 0.6, true)));
  }
  // Finer points know it better.
  CHECK(!warned(sheet(20000, 5, 0.6, false)));
}

}  // namespace plexway::testing::scattered_rims_test
