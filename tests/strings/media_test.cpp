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
#include "labels/mixed_domains.hpp"
#include "strings/mixed_strings.hpp"
#include "strings/solver.hpp"

namespace plexway::testing::media_test {
using namespace detail;

// Strings through several media, against Snell's law and head waves: exact to rounding.

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

// Mixed domains by strings where two things meet: closed forms.

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
    strings.solve(domain.complex, space, std::span(&source, 1), {}, {}, field);
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

}  // namespace plexway::testing::media_test
