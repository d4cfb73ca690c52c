// Slits between evenly spaced points that are narrow enough to be bridged: told; rows far apart,
// steps in density and gaps by chance are not.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/warnings.hpp>

namespace plexway::testing::bridged_gaps_test {

namespace {

using Places = std::vector<std::array<double, 3>>;

constexpr std::size_t side = 50;

// A square of points one apart, each moved by up to `moved`, bent to a part of a tube, but for a
// slit as far as y = 30.
Places sheet(double slit, double moved, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-moved, moved);
  Places at;
  for (std::size_t n = 0; n < side * side; ++n) {
    const double x = static_cast<double>(n % side) + off(random),
                 y = static_cast<double>(n / side) + off(random);
    if (std::abs(x - 24.5) < slit / 2 && y < 30) continue;
    at.push_back({20 * std::cos(x / 20), y, 20 * std::sin(x / 20)});
  }
  return at;
}

// Rows that are `apart` as far as two points of a row, or denser in one half than in the other.
Places rows(double apart, double denser) {
  Places at;
  for (double y = 0; y < 60; y += apart)
    for (double x = 0; x < 60; x += x < 30 ? 1 : denser) at.push_back({x, y, 0});
  return at;
}

// Of a sphere, by longitude and latitude.
Places globe() {
  Places at;
  for (int i = 1; i < 40; ++i)
    for (int j = 0; j < 80; ++j) {
      const double down = std::numbers::pi * i / 40, along = std::numbers::pi * j / 40;
      at.push_back(
          {std::sin(down) * std::cos(along), std::sin(down) * std::sin(along), std::cos(down)});
    }
  return at;
}

AnyDomain cloud(Places at) {
  io::Points points;
  points.positions = std::move(at);
  return AnyDomain(AnyShape::cloud(points));
}

std::string gaps(Places at) {
  for (const Warning& warning : domain_warnings(cloud(std::move(at)), Reader::tool))
    if (warning.text.find("in rows over gaps") != warning.text.npos && warning.doubtful)
      return warning.text;
  return "";
}

}  // namespace

TEST_CASE("clouds: a bridged slit is told of, rows and steps in density and chance are not") {
  CHECK(gaps(sheet(2, 0)) ==
        "59 triangles (point 23 is the first of their points) lie in rows over gaps about twice as "
        "wide as points are apart, or wider, and paths cross them: distances are too short if the "
        "surface ends there, as at a slit; neighbours within less than the gap's width keep it "
        "open (--neighbour-radius)");
  for (const unsigned seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    for (const double moved : {0.1, 0.2, 0.35}) CHECK(!gaps(sheet(2.5, moved, seed)).empty());
    for (const double moved : {0.1, 0.2, 0.35, 0.5}) CHECK(gaps(sheet(0, moved, seed)).empty());
  }
  CHECK(gaps(sheet(0, 0)).empty());
  for (const double apart : {1., 2., 3., 5.})
    for (const double denser : {1., 2., 3.}) {
      CAPTURE(apart, denser);
      CHECK(gaps(rows(apart, denser)).empty());
    }
  CHECK(gaps(globe()).empty());
  // Not bridged: the path from one bank to the other goes around, where the end is rounded.
  CHECK(gaps(sheet(4, 0)).empty());
  const double step = 40 * std::sin(1. / 40), around = 58 + 3 * step + 2 * std::hypot(1, step);
  CHECK(cloud(sheet(4, 0)).solve(Serial{}, PointSource::at(22))[23] ==
        Approx(around).epsilon(0.06));
}

}  // namespace plexway::testing::bridged_gaps_test
