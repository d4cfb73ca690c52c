#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <random>
#include <span>

#include "data/mixed_pieces.hpp"
#include "data/random_stacks.hpp"
#include "strings/solver.hpp"

// Strings through several media, against Snell's law and head waves: exact to rounding.

namespace plexway::testing::strings_media_test {
namespace {

using samples::Position;
using strings::Point;

/// Pieces that share points where they are at the same place.
struct Domain {
  strings::Parts parts;
  std::map<std::array<long, 3>, Index> at;

  Index number(const Position& p) {
    std::array<long, 3> key;
    for (std::size_t i = 0; i < 3; ++i) key[i] = std::lround(p[i] * 1e7);
    const auto [it, is_new] = at.insert({key, static_cast<Index>(parts.points.size())});
    if (is_new) parts.points.push_back({p[0], p[1], p[2]});
    return it->second;
  }
  template <class Shape>
  void add(const Shape& shape, double speed) {
    const auto take = [&](const auto& simplices, auto& to, std::vector<double>& slowness) {
      for (auto simplex : simplices) {
        for (Index& v : simplex) v = number(shape.positions[v]);
        to.push_back(simplex);
        slowness.push_back(1 / speed);
      }
    };
    if constexpr (requires { shape.tets; })
      take(shape.tets, parts.tets, parts.slow_tets);
    else if constexpr (requires { shape.faces; })
      take(shape.faces, parts.faces, parts.slow_faces);
    else
      take(shape.edges, parts.edges, parts.slow_edges);
  }
};

using Exact = std::function<double(const Position&, const Position&)>;

/// From a few points at random: the greatest share by which a distance is off, on either side.
double worst(const Domain& domain, std::mt19937& random, int sources, const Exact& exact) {
  const strings::MediaSpace space(domain.parts);
  strings::Solver solver(space);
  const auto& points = domain.parts.points;
  const auto at = [&](Index p) { return Position{points[p].x, points[p].y, points[p].z}; };
  double worst = 0;
  for (int n = 0; n < sources; ++n) {
    strings::Source source;
    source.point = static_cast<Index>(random() % points.size());
    source.at = space.point(source.point);
    solver.solve(std::span(&source, 1));
    for (Index p = 0; p < points.size(); ++p) {
      const double truth = exact(at(source.point), at(p));
      if (!(truth > 1e-12)) continue;
      const double off = std::abs(solver.distance(p) * space.unit() / truth - 1);
      worst = off <= worst ? worst : off;  // and what is no number
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("strings through layers obey Snell's law, and run along planes") {
  using samples::Layers;
  std::mt19937 random(7);
  for (const Layers& layers :
       {Layers{{.4}, {1, .3}}, Layers{{.4}, {1, .5}}, Layers{{.4}, {1, 2}}, Layers{{.4}, {1, 3}},
        Layers{{.3, .65}, {2, 1, 1.5}}, Layers{{.2, .4, .6, .8}, {1, 3, 1, .3, 2}}}) {
    Domain domain;
    const auto blocks = samples::blocks_of(layers, 8, .15, 1);
    for (std::size_t k = 0; k < blocks.size(); ++k) domain.add(blocks[k], layers.v[k]);
    CHECK(worst(domain, random, 4,
                [&](const Position& p, const Position& q) { return layers.time(p, q); }) < 1e-12);
  }
}

TEST_CASE("strings through random stacks of slabs, coarser than they are thick") {
  std::mt19937 random(7);
  for (int plan = 0; plan < 20; ++plan) {
    const samples::Stack stack = samples::random_stack(random, 20, .7, 1.5);
    Domain domain;
    for (std::size_t k = 0; k < stack.blocks.size(); ++k)
      domain.add(stack.blocks[k], stack.layers.v[k]);
    CAPTURE(plan);
    CHECK(worst(domain, random, 2, [&](const Position& p, const Position& q) {
            return stack.layers.time(p, q);
          }) < 1e-10);
  }
}

TEST_CASE("strings along wires and sheets in a solid, skins and sheets that stand on it") {
  constexpr std::size_t n = 8;
  constexpr double y = .5, z = .25;
  std::mt19937 random(5);
  for (const double c : {.5, 1.5, 2., 5.}) {
    CAPTURE(c);
    const auto solid = samples::block({0, 0, 0}, {1, 1, 1}, n);
    const auto straight = [](const Position& p, const Position& q) {
      return samples::distance(p, q);
    };
    Domain wire;
    wire.add(solid, 1);
    std::vector<Position> along;
    for (std::size_t i = 0; i <= n; ++i) along.push_back({double(i) / n, y, z});
    wire.add(samples::rod(along), c);
    CHECK(worst(wire, random, 4, [&](const Position& p, const Position& q) {
            return samples::along_fast(std::hypot(p[1] - y, p[2] - z),
                                       std::hypot(q[1] - y, q[2] - z), std::abs(p[0] - q[0]), c,
                                       straight(p, q));
          }) < 1e-12);
    for (const double height : {z, 1.}) {
      Domain sheet;
      sheet.add(solid, 1);
      sheet.add(samples::sheet({0, 0, height}, {1, 0, 0}, {0, 1, 0}, n, n), c);
      CHECK(worst(sheet, random, 4, [&](const Position& p, const Position& q) {
              return samples::along_fast(std::abs(p[2] - height), std::abs(q[2] - height),
                                         std::hypot(p[0] - q[0], p[1] - q[1]), c, straight(p, q));
            }) < 1e-12);
    }
    Domain standing;
    standing.add(solid, 1);
    standing.add(samples::sheet({.5, 0, 1}, {0, 1, 0}, {0, 0, 1}, n, n), c);
    CHECK(worst(standing, random, 4, [&](const Position& p, const Position& q) {
            const auto off = [](const Position& r) {
              return r[2] > 1 ? r[2] - 1 : std::hypot(r[0] - .5, 1 - r[2]);
            };
            const double x = std::abs(p[1] - q[1]), from = off(p), to = off(q);
            if (p[2] <= 1 && q[2] <= 1) return samples::along_fast(from, to, x, c, straight(p, q));
            if (p[2] > 1 && q[2] > 1) {
              const double direct = straight(p, q) / c;
              return c >= 1 ? direct : samples::along_fast(from / c, to / c, x / c, 1 / c, direct);
            }
            return p[2] > 1 ? samples::refracted(from, to, x, c, 1)
                            : samples::refracted(to, from, x, c, 1);
          }) < 1e-12);
  }
}

// The length is convex: whatever crossings a pull starts at, it finds Snell's.
TEST_CASE("strings over many planes are pulled to where Snell's law has them") {
  std::mt19937 random(3);
  const auto share = [&](double low, double high) { return samples::between(random, low, high); };
  strings::Puller puller;
  for (int k = 0; k < 2000; ++k) {
    const std::size_t n = 2 + random() % 8;
    samples::Layers layers;
    std::vector<strings::Place> places;
    double z = 0;
    const Point zero = {0, 0, 0};
    for (std::size_t i = 0; i <= n; ++i) {
      layers.v.push_back(std::pow(3., share(-1, 1)));
      if (i == n) break;
      layers.z.push_back(z += share(.5, 2));
      strings::Place plane{{share(-1, 1), 0, z}, {1, 0, 0}, -1e300, 1e300, zero, zero, zero, 0};
      plane.wide = {0, 1, 0};
      plane.is_plane = true;
      places.push_back(plane);
    }
    strings::String string;
    const bool from_plane = random() % 2 == 0, to_plane = random() % 2 == 0;
    const Point from = {0, 0, from_plane ? layers.z[0] : layers.z[0] - share(0, 1)},
                to = {share(0, 10), share(0, 3), to_plane ? z : z + share(0, 1)};
    string.knots.push_back({from});
    for (const auto& p : places) {
      const double t = share(0, 1);
      string.knots.push_back({{}, &p, t * to.x - p.origin.x, t * to.y});
    }
    string.knots.push_back({to});
    for (std::size_t i = 0; i <= n; ++i) string.knots[i].slowness = 1 / layers.v[i];
    puller.pull(string);
    const double x = std::hypot(to.x, to.y);
    double truth = layers.through(x, from.z, to.z);
    if (from_plane) truth = std::min(truth, layers.along(0, 0, x, from.z, to.z));
    if (to_plane) truth = std::min(truth, layers.along(n - 1, n, x, from.z, to.z));
    CAPTURE(k, n, from_plane, to_plane);
    CHECK(string.length == Approx(truth).epsilon(1e-10));
  }
}

}  // namespace plexway::testing::strings_media_test
