#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/cube_distance.hpp"
#include "complexes/flat_curves.hpp"
#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::source_sets_test {

namespace {

using Rule = std::function<double(const Position&)>;

// Of a field against closed forms, relative to the distance or, close to the source, to the size of
// the mesh's triangles.
struct Errors {
  double mean = 0, max = 0, low = 0;
};

template <class Values>
Errors errors(const Surface& s, const Values& found, const Rule& exact, double least) {
  Errors e;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const double d = exact(s.positions[v]);
    const double off = (static_cast<double>(found[v]) - d) / std::max(d, least);
    e.mean += std::abs(off) / static_cast<double>(s.positions.size());
    e.max = std::max(e.max, std::abs(off));
    e.low = std::min(e.low, off);
  }
  return e;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// 60 x 60, vertices inside moved by up to a quarter of an edge: none of its triangles turns over.
Surface jittered_grid() {
  Surface s = grid(60, 60);
  std::mt19937 random(3);
  for (Position& p : s.positions)
    for (std::size_t i = 0; i < 2; ++i)
      if (p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1) p[i] += (uniform(random) - .5) / 120;
  return s;
}

}  // namespace

TEST_CASE("a segment in the plane is exact and never too near") {
  const std::pair<Position, Position> segments[] = {{{0.31, 0.42, 0}, {0.64, 0.57, 0}},
                                                    {{0.25, 0.5, 0}, {0.75, 0.5, 0}},
                                                    {{0.1, 0.2, 0}, {0.15, 0.9, 0}}};
  for (const Surface& s : {grid(60, 60), jittered_grid()}) {
    const auto mesh = s.mesh<double>();
    for (const auto& [a, b] : segments) {
      const FlatCurve curve = flat_curve(s, a, b);
      const auto field = solve(Serial{}, mesh, Source(curve.source()), at(Accuracy::exact()));
      const Rule rule = [&, a = a, b = b](const Position& p) {
        return distance_to_segment(p, a, b);
      };
      const Errors e = errors(s, field.distance, rule, 1. / 60);
      CHECK(e.max < 1e-5);
      CHECK(e.low > -1e-9);
      // Two hundred points on it are too far, and more so.
      const auto sampled = solve(Serial{}, mesh, std::span<const PointSource>(curve.points(200)),
                                 at(Accuracy::exact()));
      CHECK(errors(s, sampled.distance, rule, 1. / 60).mean > 10 * e.mean);
    }
  }
}

TEST_CASE("a curve of several lines is the least of them, and light passes other curves") {
  const Position line[] = {
      {0.2, 0.31, 0}, {0.52, 0.42, 0}, {0.61, 0.83, 0}, {0.33, 0.71, 0}, {0.36, 0.6, 0}};
  for (const Surface& s : {grid(60, 60), jittered_grid()}) {
    const auto mesh = s.mesh<double>();
    CurveSource bent;
    for (std::size_t i = 0; i + 1 < std::size(line); ++i) {
      const CurveSource piece = flat_curve(s, line[i], line[i + 1]).source();
      bent.points.insert(bent.points.end(), piece.points.begin() + (i > 0), piece.points.end());
    }
    const Rule rule = [&](const Position& p) {
      double d = infinity;
      for (std::size_t i = 0; i + 1 < std::size(line); ++i)
        d = std::min(d, distance_to_segment(p, line[i], line[i + 1]));
      return d;
    };
    const Errors e = errors(s, solve(Serial{}, mesh, Source(bent), at(Accuracy::exact())).distance,
                            rule, 1. / 60);
    CHECK(e.max < 1e-5);
    CHECK(e.low > -1e-9);

    // A second curve, so late that the first one's light is there long before.
    const Position a = {0.05, 0.52, 0}, b = {0.95, 0.55, 0};
    CurveSource late = flat_curve(s, a, b).source();
    late.offset = 0.3;
    const std::vector<Source> both = {bent, late};
    const auto field = solve(Serial{}, mesh, both, at(Accuracy::exact()));
    const Rule least = [&](const Position& p) {
      return std::min(rule(p), distance_to_segment(p, a, b) + 0.3);
    };
    const Errors two = errors(s, field.distance, least, 1. / 60);
    CHECK(two.max < 1e-5);
    CHECK(two.low > -1e-9);
  }
}

TEST_CASE("a line along edges shines through what another curve crosses") {
  const Surface s = grid(12, 12);
  const auto mesh = s.mesh<double>();
  const Position a = {0.25, 0.25, 0}, b = {0.75, 0.25, 0}, c = {0.31, 0.52, 0}, d = {0.66, 0.61, 0};
  CurveSource far = flat_curve(s, c, d).source();
  far.offset = 10;
  const std::vector<Source> both = {flat_curve(s, a, b).source(), far};
  const auto field = solve(Serial{}, mesh, both, at(Accuracy::exact()));
  const Rule rule = [&](const Position& p) { return distance_to_segment(p, a, b); };
  CHECK(errors(s, field.distance, rule, 1. / 12).max < 1e-5);
  const std::vector<Source> triangle = {both[0], SimplexSource{.simplex = 150, .offset = 10}};
  CHECK(errors(s, solve(Serial{}, mesh, triangle, at(Accuracy::exact())).distance, rule, 1. / 12)
            .max < 1e-5);
}

TEST_CASE("a curve that bends inside a triangle is near at its bend as well") {
  // Its corners in any order; below it another triangle, whose apex is (2, -1).
  const Position corner[] = {{0, 0, 0}, {4, 0, 0}, {2, 4, 0}};
  for (std::size_t first = 0; first < 3; ++first) {
    Surface s;
    for (const Position& p : corner) s.add(p[0], p[1]);
    s.add(2, -1);
    const auto turned = [&](std::size_t i) { return static_cast<Index>((first + i) % 3); };
    s.triangle(turned(0), turned(1), turned(2));
    s.triangle(0, 3, 1);
    CurveSource narrow;
    for (const auto& [x, y] : {std::pair{1.8, 2.}, {2., 0.3}, {2.2, 2.}}) {
      const double top = y / 4, right = (x - 2 * top) / 4;
      const double weight[] = {1 - right - top, right, top};
      PointSource at{.simplex = 0};
      for (std::size_t i = 0; i < 3; ++i) at.barycentric[i] = weight[turned(i)];
      narrow.points.push_back(at);
    }
    const auto field = solve(Serial{}, s.mesh<double>(), Source(narrow));
    CHECK(field.distance[3] == Approx(1.3).epsilon(1e-6));
  }
}

TEST_CASE("a segment along edges lights all of its strip exactly") {
  const Surface s = grid(40, 40);
  const auto mesh = s.mesh<double>();
  const Position a = {0.25, 0.5, 0}, b = {0.75, 0.5, 0};
  const auto field =
      solve(Serial{}, mesh, Source(flat_curve(s, a, b).source()), at(Accuracy::exact()));
  const Errors e = errors(
      s, field.distance, [&](const Position& p) { return distance_to_segment(p, a, b); }, 1e-3);
  CHECK(e.max < 1e-9);
}

TEST_CASE("a segment on a cylinder") {
  const Index n = 24;
  const double height = 12;
  const Surface flat = grid(n, 24, n, height), round = prism(n, 24, height);
  const Position a = {6.3, 3.1, 0}, b = {13.2, 8.3, 0};
  const auto field = solve(Serial{}, round.mesh<double>(), Source(flat_curve(flat, a, b).source()),
                           at(Accuracy::exact()));
  Errors e;
  for (std::size_t v = 0; v < round.positions.size(); ++v) {
    const double x = static_cast<double>(v % n), y = round.positions[v][2];
    double d = infinity;
    for (const double turn : {-1., 0., 1.})
      d = std::min(d, distance_to_segment({x + turn * n, y, 0}, a, b));
    const double off = (field.distance[v] - d) / std::max(d, 0.5);
    e.max = std::max(e.max, std::abs(off));
    e.low = std::min(e.low, off);
  }
  CHECK(e.max < 1e-5);
  CHECK(e.low > -1e-9);
}

TEST_CASE("a segment over an edge of a cube") {
  const Surface s = cube(16);
  // From the top over the edge y = 0 down that side: straight once unfolded.
  const Position a = {0.4, 0.3, 1}, bend = {0.52, 0, 1}, b = {0.6, 0, 0.8};
  const auto on = [&](std::size_t axis, double place) {
    return [&s, axis, place](Index f) {
      for (const Index v : s.faces[f])
        if (std::abs(s.positions[v][axis] - place) > 1e-9) return false;
      return true;
    };
  };
  CurveSource curve = flat_curve(s, a, bend, on(2, 1)).source();
  Surface turned = s;  // that side in the xy plane
  for (Position& p : turned.positions) p = {p[0], p[2], p[1]};
  const CurveSource rest = flat_curve(turned, {bend[0], 1, 0}, {b[0], b[2], 0}, on(1, 0)).source();
  curve.points.insert(curve.points.end(), rest.points.begin() + 1, rest.points.end());

  const Rule rule = [&](const Position& p) {
    const auto at = [&](double t) {  // t < 0.6: on the top
      const double u = t < 0.6 ? t / 0.6 : (t - 0.6) / 0.4;
      const Position &from = t < 0.6 ? a : bend, &to = t < 0.6 ? bend : b;
      Position q;
      for (std::size_t i = 0; i < 3; ++i) q[i] = from[i] + u * (to[i] - from[i]);
      if (t < 0.6)
        q[2] = 1;
      else
        q[1] = 0;
      return cube_distance(q, p);
    };
    double best = infinity, where = 0;
    for (int i = 0; i <= 40; ++i)
      if (const double d = at(i / 40.); d < best) best = d, where = i / 40.;
    double low = std::max(where - 1. / 40, 0.), high = std::min(where + 1. / 40, 1.);
    for (int i = 0; i < 30; ++i) {
      const double p1 = low + (high - low) / 3, p2 = high - (high - low) / 3;
      const double d1 = at(p1), d2 = at(p2);
      best = std::min({best, d1, d2});
      (d1 < d2 ? high : low) = d1 < d2 ? p2 : p1;
    }
    return best;
  };
  for (const Accuracy accuracy : {Accuracy::exact(), Accuracy::accurate()}) {
    const auto field = solve(Serial{}, s.mesh<double>(), Source(curve), at(accuracy));
    const Errors e = errors(s, field.distance, rule, 1. / 16);
    const bool exact = accuracy == Accuracy::exact();
    CHECK(e.max < (exact ? 1e-5 : 2e-4));
    CHECK(e.low > (exact ? -1e-9 : -2e-4));
  }
}

TEST_CASE("a triangle is its own nearest point and sends light over its edges") {
  const Surface s = grid(30, 30);
  const auto mesh = s.mesh<double>();
  for (const Index f : {899u, 0u, 1u, 58u, 59u, 1740u, 1799u}) {  // inside, and in the corners
    const auto field =
        solve(Serial{}, mesh, Source(SimplexSource{.simplex = f}), at(Accuracy::exact()));
    const Rule rule = [&](const Position& p) {
      double d = infinity;
      for (std::size_t i = 0; i < 3; ++i)
        d = std::min(d, distance_to_segment(p, s.positions[s.faces[f][i]],
                                            s.positions[s.faces[f][(i + 1) % 3]]));
      return d;
    };
    CHECK(errors(s, field.distance, rule, 1. / 30).max < 1e-6);
  }
}

TEST_CASE("a circle is as far inside as outside") {
  const Surface s = grid(50, 50);
  const Index centre = s.nearest(0.5, 0.5);
  const BallSource circle = {.centre = PointSource::at(centre), .radius = 0.3, .offset = 0.1};
  const Rule rule = [&](const Position& p) {
    return std::abs(std::hypot(p[0] - 0.5, p[1] - 0.5) - 0.3) + 0.1;
  };
  const auto off = [&](const auto& executor, const auto& mesh, const PropagateOptions& options) {
    return errors(s, solve(executor, mesh, Source(circle), options).distance, rule, 0.1).max;
  };
  CHECK(off(Serial{}, s.mesh<double>(), by_labels()) < 1e-12);
  CHECK(off(Serial{}, s.mesh<double>(), at(Accuracy::exact())) < 1e-12);
  CHECK(off(Serial{}, s.mesh<float>(), by_labels()) < 4e-6);
  CHECK(off(OpenMP{2}, s.mesh<float>(), by_labels()) < 4e-6);
  CHECK(off(Serial{}, s.mesh<double>(), {}) < 1e-9);
  CHECK(off(Serial{}, s.mesh<float>(), {}) < 1e-4);
  CHECK(off(OpenMP{2}, s.mesh<float>(), {}) < 1e-4);
  // Within a radius of 0.15: only beside the rim.
  const auto bounded = solve(Serial{}, s.mesh<double>(), Source(circle), {.radius = 0.15});
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    CHECK(std::isinf(bounded.distance[v]) == (rule(s.positions[v]) > 0.15 + 1e-9));
}

TEST_CASE("several sources of all kinds give the least and say whose it is") {
  const Surface s = grid(40, 40);
  const auto mesh = s.mesh<double>();
  const Position a = {0.1, 0.8, 0}, b = {0.6, 0.9, 0};
  const std::vector<Source> sources = {
      flat_curve(s, a, b).source(),
      BallSource{.centre = PointSource::at(s.nearest(0.75, 0.5)), .radius = 0.2},
      PointSource::at(s.nearest(0.75, 0.5)),
      VertexSource{.vertices = {0, 40}, .offsets = {0.1, 0}, .offset = 0.05}};
  const auto field = solve(Serial{}, mesh, sources, at(Accuracy::exact()));
  const Position c = {0.75, 0.5, 0};
  const auto to = [&](std::size_t n, const Position& p) {
    const double d = std::hypot(p[0] - c[0], p[1] - c[1]);
    if (n == 0) return distance_to_segment(p, a, b);
    if (n == 1) return std::abs(d - 0.2);
    if (n == 2) return d;
    return std::min(std::hypot(p[0], p[1]) + 0.15, std::hypot(p[0] - 1, p[1]) + 0.05);
  };
  REQUIRE(field.label.size() == s.positions.size());
  double worst = 0;
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const Position& p = s.positions[v];
    double best = infinity;
    for (std::size_t n = 0; n < 4; ++n) best = std::min(best, to(n, p));
    worst = std::max(worst, std::abs(field.distance[v] - best));
    wrong += to(field.label[v], p) > best + 1e-3;
  }
  CHECK(worst < 1e-6);
  CHECK(wrong == 0);
  // By default windows are merged.
  const auto usual = solve(Serial{}, mesh, sources);
  CHECK(usual.label == field.label);
  double apart = 0;
  for (std::size_t v = 0; v < s.positions.size(); ++v)
    apart = std::max(apart, std::abs(usual.distance[v] - field.distance[v]));
  CHECK(apart < 1e-4);
}

TEST_CASE("a field goes on from the values of another") {
  const Surface s = grid(30, 30);
  const auto mesh = s.mesh<double>();
  const auto whole = solve(Serial{}, mesh, PointSource::at(0));
  VertexSource front;  // what the field knows at 0.5
  for (Index v = 0; v < s.positions.size(); ++v)
    if (std::abs(s.positions[v][0] - 0.5) < 1e-9) {
      front.vertices.push_back(v);
      front.offsets.push_back(whole.distance[v]);
    }
  const auto rest = solve(Serial{}, mesh, Source(front));
  const Rule rule = [&](const Position& p) {
    double best = infinity;
    for (std::size_t i = 0; i < front.vertices.size(); ++i) {
      const Position& q = s.positions[front.vertices[i]];
      best = std::min(best, front.offsets[i] + std::hypot(p[0] - q[0], p[1] - q[1]));
    }
    return best;
  };
  const Errors e = errors(s, rest.distance, rule, 0.1);
  CHECK(e.mean < 6e-4);
  CHECK(e.low > -1e-9);
  for (const Index v : front.vertices) CHECK(rest.distance[v] == whole.distance[v]);
}

TEST_CASE("sources on solids, wireframes and grids of any dimension") {
  const auto mesh = solid_cube(3).mesh<double>();
  const Source corners = VertexSource{.vertices = {0, 5}};
  const auto field = solve(Serial{}, mesh, corners);
  const PointSource both[] = {PointSource::at(0), PointSource::at(5)};
  CHECK(field.distance == solve(Serial{}, mesh, both).distance);
  const Source ball = BallSource{.centre = PointSource::at(0), .radius = 0.5};
  const auto alone = solve(Serial{}, mesh, PointSource::at(0));
  const auto rim = solve(Serial{}, mesh, ball);
  for (std::size_t v = 0; v < rim.distance.size(); ++v)
    CHECK(rim.distance[v] == Approx(std::abs(alone.distance[v] - 0.5)));
  CHECK_THROWS_WITH(solve(Serial{}, mesh, Source(SimplexSource{.simplex = 0})),
                    Catch::Contains("surfaces and wireframes"));

  // A path of five edges, one long.
  const std::array<Index, 2> edges[] = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
  const double lengths[] = {1, 2, 3, 4};
  const Wireframe<double> wire(5, edges, lengths);
  CHECK(solve(Serial{}, wire, Source(SimplexSource{.simplex = 1})).distance ==
        std::vector<double>{1, 0, 0, 3, 7});
  const CurveSource curve = {
      .points = {PointSource::at(1), PointSource::at(2), PointSource::in(2, {0.5, 0.5})}};
  CHECK(solve(Serial{}, wire, Source(curve)).distance == std::vector<double>{1, 0, 0, 1.5, 5.5});
}

TEST_CASE("unreachable is infinite and several sources are minima, whatever the kind") {
  const Surface two = [&] {
    Surface t = grid(6, 6);
    const Index first = static_cast<Index>(t.positions.size());
    const Surface more = grid(6, 6);
    for (const Position& p : more.positions) t.add(p[0] + 5, p[1]);
    for (const Face& f : more.faces) t.triangle(f[0] + first, f[1] + first, f[2] + first);
    return t;
  }();
  const auto mesh = two.mesh<double>();
  const std::vector<Source> kinds = {
      PointSource::at(3), VertexSource{.vertices = {0, 8}}, SimplexSource{.simplex = 2},
      BallSource{.centre = PointSource::at(24), .radius = 0.2},
      CurveSource{.points = {PointSource::at(0), PointSource::at(1)}, .offset = 0.3}};
  std::vector<double> least(two.positions.size(), infinity);
  for (const Source& source : kinds) {
    const auto field = solve(Serial{}, mesh, source);
    for (std::size_t v = 0; v < two.positions.size(); ++v) {
      CHECK(std::isinf(field.distance[v]) == (v >= 49));
      CHECK(field.distance[v] >= 0);
      least[v] = std::min(least[v], field.distance[v]);
    }
  }
  const auto all = solve(Serial{}, mesh, kinds);
  for (std::size_t v = 0; v < 49; ++v) {
    CHECK(all.distance[v] == Approx(least[v]).margin(2e-2));
    CHECK(all.label[v] < kinds.size());
  }
  for (std::size_t v = 49; v < 98; ++v) {
    CHECK(std::isinf(all.distance[v]));
    CHECK(all.label[v] == none);
  }
}

TEST_CASE("sources that are none are refused by name") {
  const Surface s = grid(4, 4);
  const auto mesh = s.mesh<double>();
  const auto refused = [&](const Source& source, const char* why) {
    CHECK_THROWS_WITH(solve(Serial{}, mesh, source), Catch::Contains(why));
  };
  refused(VertexSource{}, "no vertices");
  refused(VertexSource{.vertices = {1, 2}, .offsets = {1}}, "1 offsets for 2");
  refused(VertexSource{.vertices = {1}, .offset = -1}, "offset");
  refused(VertexSource{.vertices = {1000}}, "out of range");
  refused(BallSource{.centre = PointSource::at(0), .radius = -1}, "radius");
  refused(CurveSource{}, "no points");
  refused(CurveSource{.points = {PointSource::at(0), PointSource::at(24)}}, "share no face");
  refused(SimplexSource{.simplex = 1000}, "out of range");
  const Source segment = CurveSource{.points = {PointSource::at(0), PointSource::at(1)}};
  CHECK_THROWS_WITH(solve(Serial{}, s.mesh<float>(), segment, by_labels()),
                    Catch::Contains("double"));
  CHECK_THROWS_WITH(solve(OpenMP{}, mesh, segment, by_labels()), Catch::Contains("Serial"));
  CHECK_THROWS_WITH(solve(Serial{}, mesh, segment, {.visibility = Visibility::centroid}),
                    Catch::Contains("saddles"));
}

}  // namespace plexway::testing::source_sets_test
