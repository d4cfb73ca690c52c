#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "data/random_stacks.hpp"
#include "labels/mixed_domains.hpp"
#include "strings/mixed_strings.hpp"

// Mixed domains by strings where two things meet: closed forms.

namespace mixed_strings_test {

using namespace mixed_domains;

namespace {

double least(double low, double high, const std::function<double(double)>& f) {
  for (int i = 0; i < 80; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return f((low + high) / 2);
}

/// Without the triangles that have their middle in a rectangle.
Sheet cut(const Sheet& whole, const Position& low, const Position& high) {
  Sheet s;
  std::vector<Index> number(whole.positions.size(), none);
  for (auto face : whole.faces) {
    Position at = {0, 0, 0};
    for (const Index v : face)
      for (std::size_t k = 0; k < 3; ++k) at[k] += whole.positions[v][k] / 3;
    if (at[0] > low[0] && at[0] < high[0] && at[1] > low[1] && at[1] < high[1]) continue;
    for (Index& v : face) {
      if (number[v] == none) {
        number[v] = static_cast<Index>(s.positions.size());
        s.positions.push_back(whole.positions[v]);
      }
      v = number[v];
    }
    s.faces.push_back(face);
  }
  return s;
}

}  // namespace

TEST_CASE("no string goes over what a sheet leaves out") {
  Welded domain(0);
  const auto solid = domain.add(block({0, 0, 0}, {1, 1, .5}, {8, 8, 4}), .01);
  const auto plate =
      domain.add(cut(sheet({0, 0, .5}, {1, 0, 0}, {0, 1, 0}, 8, 8), {.5, .5, 0}, {1, 1, 1}), 1);
  domain.weld(solid, plate);
  const Position from = {.25, 1, .5};
  const Errors e = errors(domain, domain.nearest(plate, from), [&](Index v) {
    if (!Welded::of(plate, v)) return 0.;
    const Position& to = domain.positions[v];
    const double side = (to[0] - from[0]) * (.5 - from[1]) - (to[1] - from[1]) * (.5 - from[0]);
    if (!(to[0] > .5 && side < 0)) return distance(from, to);
    return std::hypot(.25, .5) + std::hypot(to[0] - .5, to[1] - .5);
  });
  CAPTURE(e.mean, e.worst, e.low);
  CHECK(e.worst < 1e-12);
}

TEST_CASE("a wire that ends inside a block") {
  for (const double c : {2., 5.})
    for (const Position& from :
         {Position{0, .25, .5}, Position{.5, .5, .25}, Position{.25, 1, 1}}) {
      Welded domain(0);
      const auto solid = domain.add(block({0, 0, 0}, {1, 1, 1}, 4));
      std::vector<Position> line;
      for (int i = 1; i <= 3; ++i) line.push_back({i / 4., .5, .25});
      domain.weld(solid, domain.add(rod(line), c));
      const Errors e = errors(domain, domain.nearest(solid, from), [&](Index v) {
        const Position& to = domain.positions[v];
        const auto along = [&](double s) {
          return distance(from, {s, .5, .25}) + least(.25, .75, [&](double t) {
                   return std::abs(s - t) / c + distance({t, .5, .25}, to);
                 });
        };
        return std::min(distance(from, to), least(.25, .75, along));
      });
      CAPTURE(c, e.mean, e.worst, e.low);
      CHECK(e.worst < 1e-9);
    }
}

TEST_CASE("sources and points anywhere in two layers, faces between them too") {
  std::mt19937 random(1);
  const Layers layers = {{.45}, {1, 2}};
  Welded domain(0);
  const auto blocks = blocks_of(layers, 8, .15, 1);
  const auto lower = domain.add(blocks[0], 1), upper = domain.add(blocks[1], 2);
  domain.weld(lower, upper);
  const auto space = MixedSpace::of(domain.complex);
  REQUIRE(space->media);
  const auto draw = [&](PointSource& point, int k) {
    std::array<double, 4> w;
    double sum = 0;
    for (double& x : w) x = between(random, 0, 1);
    if (k % 4 == 1) w[random() % 4] = 0;
    if (k % 4 == 2) w[0] = w[2] = 0;
    for (const double x : w) sum += x;
    for (double& x : w) x /= sum;
    const auto simplex = static_cast<Index>(random() % domain.complex.simplex_count());
    point = PointSource::in(simplex, {w[0], w[1], w[2], w[3]});
    const strings::Point at = space->media->outer(space->media->at(space->simplex(simplex), w));
    return Position{at.x, at.y, at.z};
  };
  double worst = 0;
  for (int k = 0; k < 20; ++k) {
    PointSource source, point;
    const Position from = draw(source, k);
    MixedStrings strings;
    DistanceField<double> field;
    strings.solve(domain.complex, space, std::span(&source, 1), {}, field);
    for (Index v = 0; v < domain.positions.size(); ++v) {
      const double truth = layers.time(from, domain.positions[v]);
      worst = std::max(worst, std::abs(field.distance[v] - truth));
    }
    for (int j = 0; j < 40; ++j) {
      const Position to = draw(point, j);
      worst = std::max(worst, std::abs(strings.at(point).distance - layers.time(from, to)));
    }
  }
  CHECK(worst < 1e-12);
}

}  // namespace mixed_strings_test
