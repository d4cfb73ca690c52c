// Segments, polylines and triangles as sources by windows, against closed forms: wherever their
// light falls, in generic positions.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "complexes/flat_curves.hpp"
#include "complexes/jittered.hpp"
#include "complexes/test_meshes.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::curve_sources_test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Rule = std::function<double(Index)>;

struct Errors {
  double mean = 0, max = 0, low = 0;
};

/// Relative to the distance or, close to the source, to `least`.
template <class Values>
Errors errors(const Values& found, const Rule& exact, double least) {
  Errors e;
  for (Index v = 0; v < found.size(); ++v) {
    const double d = exact(v), off = (static_cast<double>(found[v]) - d) / std::max(d, least);
    e.mean += std::abs(off) / static_cast<double>(found.size());
    e.max = std::max(e.max, std::abs(off));
    e.low = std::min(e.low, off);
  }
  return e;
}

/// By all that solves from curves: exact but for rounding, or off by what was asked.
void check_all(const Surface& s, const std::vector<Source>& sources, const Rule& rule,
               double least) {
  const auto twice = s.mesh<double>();
  const auto once = s.mesh<float>();
  const auto exact = solve(Serial{}, twice, sources, at(Accuracy::exact()));
  const Errors e = errors(exact.distance, rule, least);
  CHECK(e.max < 1e-9);
  CHECK(exact.accuracy == Accuracy::exact());
  const auto merged = solve(Serial{}, twice, sources);
  CHECK(merged.accuracy == Accuracy::accurate());
  const Errors m = errors(merged.distance, rule, least);
  // The worst is what the points at its ends have alone, in a plane too.
  CHECK(m.mean < 1e-5);
  CHECK(m.max < 2e-4);
  const auto single = solve(Serial{}, once, sources);
  CHECK(single.accuracy == Accuracy::accurate());
  const Errors f = errors(single.distance, rule, least);
  CHECK(f.mean < 2e-5);
  CHECK(f.max < 2e-4);
  for (const Schedule schedule : {Schedule::fifo, Schedule::priority}) {
    PropagateOptions options = at(Accuracy::exact());
    options.schedule = schedule;
    CHECK(solve(Serial{}, twice, sources, options).distance == exact.distance);
  }
  if (openmp_built()) {
    CHECK(solve(OpenMP{2}, once, sources).distance == single.distance);
    CHECK(solve(OpenMP{2}, twice, sources, at(Accuracy::exact())).distance == exact.distance);
  }
  if (sources.size() == 1) return;
  REQUIRE(exact.label.size() == exact.distance.size());
}

Position random_place(std::mt19937& random) {
  return {0.05 + 0.9 * uniform(random), 0.05 + 0.9 * uniform(random), 0};
}

}  // namespace

TEST_CASE("curves as windows: segments anywhere in a plane") {
  std::mt19937 random(11);
  for (const Index n : {5u, 20u, 60u})
    for (int i = 0; i < 3; ++i) {
      const Surface s = jittered(n, 3 + static_cast<unsigned>(i));
      const Position a = random_place(random), b = random_place(random);
      CAPTURE(n, i);
      check_all(
          s, {flat_curve(s, a, b).source()},
          [&](Index v) { return distance_to_segment(s.positions[v], a, b); }, 1. / n);
    }
}

TEST_CASE("curves as windows: segments along edges, the rim's too, with an offset") {
  const Surface s = grid(24, 24);
  const Position ends[][2] = {{{0.25, 0.5, 0}, {0.75, 0.5, 0}},
                              {{0, 0, 0}, {1, 0, 0}},
                              {{1, 0.25, 0}, {1, 0.75, 0}},
                              {{0.125, 0.125, 0}, {0.5, 0.5, 0}}};
  for (const auto& [a, b] : ends) {
    CurveSource curve = flat_curve(s, a, b).source();
    curve.offset = 0.375;
    check_all(
        s, {curve},
        [&, a = a, b = b](Index v) { return 0.375 + distance_to_segment(s.positions[v], a, b); },
        1. / 24);
  }
}

TEST_CASE("curves as windows: polylines, several curves and points, and whose a vertex is") {
  std::mt19937 random(5);
  const Surface s = jittered(30, 8);
  for (int round = 0; round < 3; ++round) {
    std::vector<std::vector<Position>> lines(2);
    std::vector<Source> sources;
    for (auto& line : lines) {
      CurveSource bent;
      bent.offset = 0.1 * uniform(random);
      for (int i = 0; i < 4; ++i) {
        line.push_back(random_place(random));
        if (i == 0) continue;
        const CurveSource piece =
            flat_curve(s, line[line.size() - 2], line[line.size() - 1]).source();
        bent.points.insert(bent.points.end(), piece.points.begin() + (i > 1), piece.points.end());
      }
      sources.push_back(bent);
    }
    sources.push_back(PointSource::at(77));
    sources.push_back(SimplexSource{.simplex = 1201, .offset = 0.05});
    const auto to = [&](std::size_t n, Index v) {
      const Position& p = s.positions[v];
      if (n == 2) return distance_to_segment(p, s.positions[77], s.positions[77]);
      double d = infinity;
      if (n < 2) {
        for (std::size_t i = 1; i < lines[n].size(); ++i)
          d = std::min(d, distance_to_segment(p, lines[n][i - 1], lines[n][i]));
        return d + std::get<CurveSource>(sources[n]).offset;
      }
      for (std::size_t i = 0; i < 3; ++i)
        d = std::min(d, distance_to_segment(p, s.positions[s.faces[1201][i]],
                                            s.positions[s.faces[1201][(i + 1) % 3]]));
      return d + 0.05;
    };
    const Rule rule = [&](Index v) {
      double d = infinity;
      for (std::size_t n = 0; n < 4; ++n) d = std::min(d, to(n, v));
      return d;
    };
    check_all(s, sources, rule, 1. / 30);
    for (const Accuracy accuracy : {Accuracy::exact(), Accuracy::accurate()}) {
      const auto field = solve(Serial{}, s.mesh<double>(), sources, at(accuracy));
      for (Index v = 0; v < s.positions.size(); ++v) CHECK(to(field.label[v], v) <= rule(v) + 1e-4);
    }
  }
}

TEST_CASE("curves as windows: a curve twice, and a point on it") {
  const Surface s = jittered(16, 2);
  const Position a = {0.2, 0.3, 0}, b = {0.8, 0.55, 0};
  const CurveSource curve = flat_curve(s, a, b).source();
  const Index on = 140;
  const Position c = s.positions[on];
  CurveSource through = flat_curve(s, c, b).source();
  const std::vector<Source> sources = {curve, curve, through, PointSource::at(on)};
  check_all(
      s, sources,
      [&](Index v) {
        return std::min(distance_to_segment(s.positions[v], a, b),
                        distance_to_segment(s.positions[v], c, b));
      },
      1. / 16);
  const auto field = solve(Serial{}, s.mesh<double>(), sources, at(Accuracy::exact()));
  CHECK(field.distance[on] == 0);
  CHECK((field.label[on] == 2 || field.label[on] == 3));
}

TEST_CASE("curves as windows: light goes on over the sides of prisms, as fine as they are") {
  for (const Index n : {8u, 24u, 60u}) {
    const double height = n / 2.;
    const Surface flat = grid(n, n, n, height), round = prism(n, n, height);
    const Position a = {0.263 * n, 0.13 * n, 0}, b = {0.55 * n, 0.345 * n, 0};
    CAPTURE(n);
    check_all(
        round, {flat_curve(flat, a, b).source()},
        [&](Index v) {
          const double x = static_cast<double>(v % n), y = round.positions[v][2];
          double d = infinity;
          for (const double turn : {-1., 0., 1.})
            d = std::min(d, distance_to_segment({x + turn * n, y, 0}, a, b));
          return d;
        },
        0.5);
  }
}

TEST_CASE("curves as windows: light bends around a corner") {
  // An L: the square without its upper right quarter.
  for (const Index n : {6u, 16u, 40u}) {
    const Surface s = cut(jittered(2 * n, n), [](double x, double y) { return x < .5 || y < .5; });
    const Position c = s.positions[s.nearest(0.5, 0.5)];
    // A segment in the upper arm; light from it to the right arm bends at the corner, if the
    // straight line passes beyond it.
    const Position a = {0.06, 0.97, 0}, b = {0.21, 0.83, 0};
    const auto field = solve(Serial{}, s.mesh<double>(), Source(flat_curve(s, a, b).source()),
                             at(Accuracy::exact()));
    const auto merged = solve(Serial{}, s.mesh<float>(), Source(flat_curve(s, a, b).source()));
    // Many points of it: never nearer than the curve, and hardly farther than the step between.
    const FlatCurve curve = flat_curve(s, a, b);
    const auto sampled =
        solve(Serial{}, s.mesh<double>(), std::span<const PointSource>(curve.points(400)),
              at(Accuracy::exact()));
    CAPTURE(n, c[0], c[1]);
    for (Index v = 0; v < s.positions.size(); ++v) {
      if (std::isinf(sampled.distance[v])) continue;  // left over by the cut
      CHECK(field.distance[v] <= sampled.distance[v] + 1e-9);
      CHECK(field.distance[v] > sampled.distance[v] - 2e-3);
      CHECK(static_cast<double>(merged.distance[v]) ==
            Approx(field.distance[v]).epsilon(2e-3).margin(2e-3 / n));
    }
  }
}

TEST_CASE("curves as windows: every page of a book has the light of the others") {
  const Index n = 12;
  const Surface book = sheets(3, n);
  Surface flat = book;  // page 0 to the right of x = 0, the others to the left
  const std::size_t own = static_cast<std::size_t>(n + 1) * (n + 1);
  for (std::size_t v = 0; v < flat.positions.size(); ++v) {
    const Position p = book.positions[v];
    const double x = std::hypot(p[0], p[1]);
    flat.positions[v] = {v < own ? x : -x, p[2], 0};
  }
  const auto first_page = [&](Index f) { return f < 2 * n * n; };
  const std::pair<Position, Position> segments[] = {{{0.21, 0.17, 0}, {0.72, 0.58, 0}},
                                                    {{0.31, 0.12, 0}, {0.34, 0.93, 0}}};
  for (const auto& [a, b] : segments)
    check_all(
        book, {flat_curve(flat, a, b, first_page).source()},
        [&, a = a, b = b](Index v) { return distance_to_segment(flat.positions[v], a, b); },
        1. / n);
  // Along the edge that all pages share, and from it to a place on another page.
  CurveSource spine{.points = {PointSource::at(2), PointSource::at(3), PointSource::at(4)}};
  check_all(
      book, {spine},
      [&](Index v) {
        return distance_to_segment(flat.positions[v], {0, 2. / n, 0}, {0, 4. / n, 0});
      },
      1. / n);
}

TEST_CASE("curves as windows: a triangle is all zero, wherever it lies") {
  const Surface s = jittered(20, 4);
  for (const Index f : {399u, 0u, 39u, 417u, 799u})
    check_all(
        s, {SimplexSource{.simplex = f, .offset = 0.25}},
        [&](Index v) {
          double d = infinity;
          for (std::size_t i = 0; i < 3; ++i)
            d = std::min(d, distance_to_segment(s.positions[v], s.positions[s.faces[f][i]],
                                                s.positions[s.faces[f][(i + 1) % 3]]));
          return d + 0.25;
        },
        1. / 20);
}

TEST_CASE("curves as windows: one-sided surfaces and curved ones, against many points") {
  const Surface strip = moebius(30, 4);
  const Surface ball = sphere(3);
  for (const Surface* s : {&strip, &ball}) {
    // Along edges, from vertex to vertex of some triangles in a row, and across one.
    CurveSource curve;
    std::vector<PointSource> points;
    const Face& f = s->faces[7];
    const auto add = [&](const std::array<double, 3>& from, const std::array<double, 3>& to) {
      for (int i = 0; i <= 300; ++i) {
        std::array<double, 3> w;
        for (std::size_t k = 0; k < 3; ++k) w[k] = from[k] + (to[k] - from[k]) * i / 300;
        points.push_back(PointSource::in(7, w));
      }
    };
    curve.points = {PointSource::at(f[0]), PointSource::at(f[1]),
                    PointSource::in(7, {0.3, 0., 0.7})};
    add({1, 0, 0}, {0, 1, 0});
    add({0, 1, 0}, {0.3, 0, 0.7});
    const auto mesh = s->mesh<double>();
    const auto field = solve(Serial{}, mesh, Source(curve), at(Accuracy::exact()));
    const auto usual = solve(Serial{}, mesh, Source(curve));
    const auto single = solve(Serial{}, s->mesh<float>(), Source(curve));
    const auto sampled =
        solve(Serial{}, mesh, std::span<const PointSource>(points), at(Accuracy::exact()));
    double mean = 0;
    for (Index v = 0; v < s->positions.size(); ++v) {
      CHECK(field.distance[v] <= sampled.distance[v] + 1e-9);
      CHECK(field.distance[v] > sampled.distance[v] - 1e-3);
      mean += std::abs(usual.distance[v] - field.distance[v]) /
              std::max(field.distance[v], mesh.unit()) / static_cast<double>(s->positions.size());
      CHECK(usual.distance[v] == Approx(field.distance[v]).epsilon(1e-2).margin(1e-3));
      CHECK(static_cast<double>(single.distance[v]) ==
            Approx(field.distance[v]).epsilon(1e-2).margin(1e-3));
    }
    CHECK(mean < 5e-4);
  }
}

TEST_CASE("curves as windows: a radius bounds them, a far component is not reached") {
  Surface s = jittered(20, 6);
  const Index first = static_cast<Index>(s.positions.size());
  for (const auto& [x, y] : {std::pair{5., 5.}, {6., 5.}, {5., 6.}}) s.add(x, y);
  s.triangle(first, first + 1, first + 2);
  const Position a = {0.3, 0.35, 0}, b = {0.7, 0.45, 0};
  for (const Accuracy accuracy : {Accuracy::exact(), Accuracy::accurate()}) {
    PropagateOptions options = at(accuracy);
    options.radius = 0.2;
    const auto field =
        solve(Serial{}, s.mesh<double>(), Source(flat_curve(s, a, b).source()), options);
    for (Index v = 0; v < s.positions.size(); ++v) {
      const double d = v < first ? distance_to_segment(s.positions[v], a, b) : infinity;
      if (std::abs(d - 0.2) > 1e-4) CHECK(std::isinf(field.distance[v]) == (d > 0.2));
      if (d < 0.2 - 1e-4) CHECK(field.distance[v] == Approx(d).epsilon(1e-4).margin(1e-6));
    }
  }
}

}  // namespace plexway::testing::curve_sources_test
