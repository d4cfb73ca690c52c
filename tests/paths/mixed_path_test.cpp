// Paths on mixed domains: their lengths against closed forms and against the distances, and every
// line in its simplex.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <plexway/paths/mixed_path_field.hpp>

#include "labels/mixed_domains.hpp"
#include "paths/path_testing.hpp"

namespace mixed_path_test {

namespace {

using namespace mixed_domains;
using plexway::testing::off_tet;
using plexway::testing::off_triangle;

/// A domain with what explicit geometry needs: its simplices' corners, and their speeds.
struct Scene : Welded {
  using Welded::Welded;
  std::vector<std::vector<Index>> corners;
  std::vector<double> speed;

  template <class Shape>
  Piece add(const Shape& shape, double c = 1) {
    const auto first = static_cast<Index>(positions.size());
    const auto take = [&](const auto& simplices) {
      for (const auto& simplex : simplices) {
        corners.emplace_back();
        for (const Index v : simplex) corners.back().push_back(first + v);
        speed.push_back(c);
      }
    };
    if constexpr (requires { shape.tets; })
      take(shape.tets);
    else if constexpr (requires { shape.faces; })
      take(shape.faces);
    else
      take(shape.edges);
    return Welded::add(shape, c);
  }

  [[nodiscard]] Position at(const PathPoint& p) const {
    return plexway::testing::place(positions, corners[p.simplex], p.barycentric);
  }
  /// How far a point is outside of a simplex.
  [[nodiscard]] double off(const Position& p, Index simplex) const {
    const auto& c = corners[simplex];
    const auto corner = [&](std::size_t i) { return positions[c[i]]; };
    if (c.size() == 4) return off_tet(p, {corner(0), corner(1), corner(2), corner(3)});
    return off_triangle(p, corner(0), corner(1), corner(c.size() - 1));
  }
};

struct Gaps {
  double mean = 0, worst = 0, low = 0;  // of lengths, against the truth
  double field = 0, worst_field = 0;    // against the distances
};

/// Paths from vertices to a vertex, their geometry checked; exact(vertex).
Gaps gaps(const Scene& scene, Index source, const std::function<double(Index)>& exact,
          std::size_t count, unsigned seed = 1) {
  std::vector<Position> moved;
  for (const Position& p : scene.positions) moved.push_back(scene.move(p));
  PathField field(scene.complex, moved);
  field.solve(Serial{}, PointSource::at(source));
  std::mt19937 random(seed);
  Gaps gaps;
  const double scale = scene.move.scale;
  for (std::size_t n = 0; n < count; ++n) {
    const auto v = static_cast<Index>(random() % scene.positions.size());
    const Path path = field.trace(v);
    const double truth = exact(v), length = path.length / scale;
    CAPTURE(source, v, truth, length);
    if (truth == infinity) {
      CHECK(path.source == none);
      CHECK(path.length == infinity);
      continue;
    }
    REQUIRE(path.source == 0);
    REQUIRE(path.points.size() == path.positions.size());
    REQUIRE_FALSE(path.points.empty());
    CHECK(distance(scene.at(path.points.front()), scene.positions[v]) < 1e-9);
    CHECK(distance(scene.at(path.points.back()), scene.positions[source]) < 1e-9);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
      const Position p = scene.at(path.points[i]), q = scene.at(path.points[i + 1]);
      CHECK(distance(path.positions[i], moved[0]) < 10 * scale);
      CHECK(scene.off(q, path.points[i].simplex) < 1e-9);
      sum += distance(p, q) / scene.speed[path.points[i].simplex];
    }
    CHECK(sum == Approx(length).epsilon(1e-9).margin(1e-12));
    if (truth < 1e-12) {
      CHECK(length < 1e-9);
      continue;
    }
    const double off = length / truth - 1;
    const double promised = field.distances().distance[v] / path.length - 1;
    gaps.mean += std::abs(off) / double(count);
    gaps.worst = std::max(gaps.worst, off);
    gaps.low = std::min(gaps.low, off);
    gaps.field += std::abs(promised) / double(count);
    gaps.worst_field = std::max(gaps.worst_field, std::abs(promised));
  }
  return gaps;
}

void check(const Gaps& g, double mean, double worst) {
  CAPTURE(g.mean, g.worst, g.low, g.field, g.worst_field);
  CHECK(g.mean < mean);
  CHECK(g.worst < worst);
  CHECK(g.low > -1e-8);  // a path is never shorter than the shortest
  CHECK(g.field < 1e-3);
  CHECK(g.worst_field < 1e-2);
}

/// Where strings solve the domain: as long as the distance, which is the truth.
void check_strings(const Gaps& g) {
  CAPTURE(g.mean, g.worst, g.low, g.worst_field);
  CHECK(g.worst < 1e-12);
  CHECK(g.low > -1e-12);
  CHECK(g.worst_field < 1e-12);
}

}  // namespace

TEST_CASE("a path bends at the corner that welding two rectangles makes") {
  Scene scene(4);
  const auto one = scene.add(sheet({0, 0, 0}, {2, 0, 0}, {.2, 1, 0}, 12, 7));
  const auto other = scene.add(sheet({.2, 1, 0}, {1, 0, 0}, {.2, 1, 0}, 6, 5));
  REQUIRE(scene.weld(one, other) == 7);
  const Position corner = {1.2, 1, 0};
  for (const Index source : {other.vertex(3), other.vertex(20), other.vertex(40)}) {
    const Position from = scene.positions[source];
    check(gaps(
              scene, source,
              [&](Index v) {
                const Position& p = scene.positions[v];
                if (Scene::of(other, v)) return distance(from, p);
                // Over the line y = 1 left of the corner, or around it.
                const double down = std::max(from[1] - p[1], 1e-300);
                const double x = from[0] + (p[0] - from[0]) * (from[1] - 1) / down;
                if (x <= 1.2 + 1e-12) return distance(from, p);
                return distance(from, corner) + distance(corner, p);
              },
              60),
          1e-9, 1e-8);
  }
}

TEST_CASE("a path runs along a skin of another speed where that pays") {
  constexpr std::size_t n = 8;
  for (const double c : {.5, 1., 2.})
    for (const Position& from :
         {Position{0, 0, 1}, Position{.25, .25, .75}, Position{.25, .5, .5}}) {
      Scene scene(1);
      const auto skin = scene.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, n, n), c);
      const auto solid = scene.add(block({0, 0, 0}, {1, 1, 1}, n));
      scene.weld(skin, solid);
      CAPTURE(c, from[0], from[1], from[2]);
      check_strings(gaps(
          scene, scene.nearest(solid, from),
          [&](Index v) {
            const Position& p = scene.positions[v];
            return along_fast(1 - from[2], 1 - p[2], std::hypot(p[0] - from[0], p[1] - from[1]), c,
                              distance(from, p));
          },
          20));
    }
}

TEST_CASE("paths to points inside simplices are as long as their distances") {
  constexpr std::size_t n = 8;
  const Position from = {.25, .25, .75};
  for (const double c : {.5, 2.}) {
    Scene scene(1);
    const auto skin = scene.add(sheet({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, n, n), c);
    const auto solid = scene.add(block({0, 0, 0}, {1, 1, 1}, n));
    scene.weld(skin, solid);
    PathField field(scene.complex);
    const Index source = scene.nearest(solid, from);
    const Position start = scene.positions[source];
    field.solve(Serial{}, PointSource::at(source));
    std::mt19937 random(3);
    double worst = 0;
    for (int k = 0; k < 60; ++k) {
      PointSource at{.simplex = static_cast<Index>(random() % scene.corners.size())};
      const auto& corners = scene.corners[at.simplex];
      double sum = 0;
      for (std::size_t i = 0; i < corners.size(); ++i)
        sum += at.barycentric[i] = 0.01 + static_cast<double>(random() % 1000) / 1000;
      for (double& b : at.barycentric) b /= sum;
      const Position p = scene.at({at.simplex, at.barycentric});
      const double truth =
          along_fast(1 - start[2], 1 - p[2], std::hypot(p[0] - start[0], p[1] - start[1]), c,
                     distance(start, p));
      const double scale = scene.move.scale, length = field.trace(at).length / scale;
      const double read = field.at(at) / scale;
      CAPTURE(c, at.simplex, truth, length, read);
      CHECK(read == Approx(length).epsilon(1e-12));
      worst = std::max(worst, std::abs(length / truth - 1));
    }
    CAPTURE(c, worst);
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("a path is refracted into a sheet that stands on a block") {
  constexpr std::size_t n = 8;
  for (const double c : {.5, 1., 2.})
    for (const Position& from : {Position{.5, 0, 1.5}, Position{.25, 0, .5}, Position{.5, 0, 1}}) {
      Scene scene(2);
      const auto plate = scene.add(sheet({.5, 0, 1}, {0, 1, 0}, {0, 0, 1}, n, n), c);
      const auto solid = scene.add(block({0, 0, 0}, {1, 1, 1}, n));
      scene.weld(plate, solid);
      const auto& foot = [](const Position& p) {
        return p[2] > 1 ? p[2] - 1 : std::hypot(p[0] - .5, 1 - p[2]);
      };
      const Index source = scene.nearest(from[2] > 1 ? plate : solid, from);
      CAPTURE(c, from[0], from[1], from[2]);
      check_strings(gaps(
          scene, source,
          [&](Index v) {
            const Position& p = scene.positions[v];
            const double x = std::abs(p[1] - from[1]), r = foot(from), rho = foot(p);
            const bool above = p[2] > 1 || (p[2] == 1 && Scene::of(plate, v));
            if (!above && from[2] <= 1) return along_fast(r, rho, x, c, distance(from, p));
            if (above && from[2] > 1) {
              const double direct = distance(from, p) / c;
              return c >= 1 ? direct : along_fast(r / c, rho / c, x / c, 1 / c, direct);
            }
            return above ? refracted(rho, r, x, c, 1) : refracted(r, rho, x, c, 1);
          },
          20));
    }
}

TEST_CASE("a path takes the wire between two solids") {
  Scene scene(3);
  const auto one = scene.add(block({0, 0, 0}, {1, 1, 1}, 4));
  const auto other = scene.add(block({3, 0, 0}, {4, 1, 1}, 5), 2);
  const Position in = {1, .5, .25}, out = {3, .4, .6};
  const auto wire = scene.add(rod({in, {2, 0, 0}, {2.5, 3, 1}, out}), 5);
  scene.weld(one, wire);
  scene.weld(other, wire);
  const double length =
      distance(in, {2, 0, 0}) + distance({2, 0, 0}, {2.5, 3, 1}) + distance({2.5, 3, 1}, out);
  for (const Index source : {one.vertex(0), one.vertex(77)}) {
    const Position from = scene.positions[source];
    check_strings(gaps(
        scene, source,
        [&](Index v) {
          const Position& p = scene.positions[v];
          if (Scene::of(one, v)) return distance(from, p);
          const double to_wire = distance(from, in);
          if (Scene::of(other, v)) return to_wire + length / 5 + distance(out, p) / 2;
          double along = 0;
          const Position corners[] = {in, {2, 0, 0}, {2.5, 3, 1}, out};
          for (Index i = 0; i < v - wire.first_vertex; ++i)
            along += distance(corners[i], corners[i + 1]);
          return to_wire + along / 5;
        },
        60));
  }
}

TEST_CASE("a path between solids of two speeds follows Snell and runs ahead along the faster") {
  constexpr std::size_t n = 8;
  for (const Position& from : {Position{.25, .5, .5}, Position{1, .5, .5}, Position{0, 0, 0}}) {
    Scene scene(0);
    const auto one = scene.add(block({0, 0, 0}, {1, 1, 1}, n));
    const auto other = scene.add(block({1, 0, 0}, {2, 1, 1}, n), 2);
    scene.weld(one, other);
    CAPTURE(from[0], from[1], from[2]);
    check_strings(gaps(
        scene, scene.nearest(one, from),
        [&](Index v) {
          const Position& p = scene.positions[v];
          const double x = std::hypot(p[1] - from[1], p[2] - from[2]);
          if (Scene::of(one, v)) return along_fast(1 - from[0], 1 - p[0], x, 2, distance(from, p));
          return refracted(1 - from[0], p[0] - 1, x, 1, 2);
        },
        30));
  }
}

TEST_CASE("a path through layers of several speeds, their cells moved at random") {
  const Layers stacks[] = {{{.4}, {1, 2}}, {{.3, .65}, {2, 1, 1.5}}};
  unsigned seed = 1;
  for (const Layers& layers : stacks) {
    Scene scene(++seed);
    std::vector<Scene::Piece> pieces;
    const auto blocks = blocks_of(layers, 8, .15, seed);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      pieces.push_back(scene.add(blocks[k], layers.v[k]));
      for (std::size_t i = 0; i < k; ++i) scene.weld(pieces[i], pieces[k]);
    }
    for (const Index source : {Index(7), Index(200), Index(500)})
      check_strings(gaps(
          scene, source,
          [&](Index v) { return layers.time(scene.positions[source], scene.positions[v]); }, 20));
  }
}

TEST_CASE("paths from several sources, and what a radius leaves out") {
  Scene scene(0);
  const auto one = scene.add(block({0, 0, 0}, {1, 1, 1}, 4));
  const auto other = scene.add(block({1, 0, 0}, {2, 1, 1}, 4), 2);
  scene.weld(one, other);
  PathField field(scene.complex);
  PointSource near = PointSource::in(3, {.1, .2, .3, .4}), far = PointSource::at(other.vertex(110));
  near.offset = .25;
  const std::array sources = {near, far};
  PropagateOptions options;
  options.radius = .8;
  field.solve(Serial{}, sources, options);
  std::size_t left_out = 0;
  for (Index v = 0; v < scene.positions.size(); ++v) {
    const Path path = field.trace(v);
    const double found = field.distances().distance[v];
    CAPTURE(v, found, path.length);
    if (found == infinity) {
      CHECK(path.source == none);
      ++left_out;
      continue;
    }
    REQUIRE(path.source == field.distances().label[v]);
    CHECK(path.length + sources[path.source].offset == Approx(found).epsilon(1e-12));
    CHECK(field.at(PointSource::at(v)) == found);
  }
  CHECK(left_out > 10);
  CHECK(left_out + 10 < scene.positions.size());
  CHECK(field.at(near) == Approx(.25).epsilon(1e-12));
  const Path none_at_all = field.trace(near);
  CHECK(none_at_all.length == 0);
  REQUIRE(none_at_all.points.size() == 1);
  CHECK(none_at_all.points[0].simplex == 3);
}

// Distances are measured against a round ball, but this one has facets, so they come out short. A
// path lies in the facets: what is short with both is theirs.
TEST_CASE("on a ball with a fast skin distances are those of paths over its facets") {
  const Block b = ball(8);
  Scene scene(0);
  const auto solid = scene.add(b);
  const auto skin = scene.add(skin_of(b), 3);
  scene.weld(solid, skin);
  Index source = 0;
  for (Index v = 0; v < solid.vertices; ++v)
    if (distance(scene.positions[v], {.3, .5, .81}) <
        distance(scene.positions[source], {.3, .5, .81}))
      source = v;
  PathField field(scene.complex);
  field.solve(Serial{}, PointSource::at(source));
  const auto from_round = [&](Index v, double d) {
    return d / by_the_skin(scene.positions[source], scene.positions[v], 3) - 1;
  };
  const Index under = scene.nearest(solid, {0, 0, .75});  // a cell under the skin
  CHECK(from_round(under, field.distances().distance[under]) < -2e-2);
  CHECK(from_round(under, field.trace(under).length) < -2e-2);
  double mean = 0, worst = 0, low = 0;
  std::size_t count = 0;
  for (Index v = 0; v < scene.positions.size(); v += 9) {
    if (distance(scene.positions[source], scene.positions[v]) == 0) continue;
    const double length = field.trace(v).length, d = field.distances().distance[v];
    mean += std::abs(d / length - 1);
    worst = std::max(worst, std::abs(d / length - 1));
    low = std::min(low, d / length - 1);
    ++count;
  }
  mean /= static_cast<double>(count);
  CAPTURE(mean, worst, low);
  CHECK(mean < 1e-3);
  CHECK(worst < 1e-2);
  CHECK(low > -1e-3);
}

}  // namespace mixed_path_test
