#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>

#include "complexes/common/geometry.hpp"
#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "data/mixed_pieces.hpp"
#include "shape/scene.hpp"

namespace plexway::testing::linear_field_test {
using namespace detail;

namespace {

// Two squares side by side, welded, and a line from their far corner straight up.
MixedShape two_squares_and_a_line() {
  MixedShape shape;
  shape.tolerance = 1e-9;
  const auto add = [&](const std::vector<Position>& positions) -> MixedShape::Part& {
    shape.parts.push_back({.first_vertex = shape.positions.size(), .vertices = positions.size()});
    shape.positions.insert(shape.positions.end(), positions.begin(), positions.end());
    return shape.parts.back();
  };
  for (const double from : {0., 1.}) {
    Surface square = grid(12, 12);
    for (Position& p : square.positions) p[0] += from;
    MixedShape::Part& part = add(square.positions);
    for (const auto& f : square.faces)
      part.triangles.push_back({static_cast<Index>(f[0] + part.first_vertex),
                                static_cast<Index>(f[1] + part.first_vertex),
                                static_cast<Index>(f[2] + part.first_vertex)});
  }
  MixedShape::Part& line = add({{2, 1, 0}, {2, 1, 1}});
  line.edges.push_back(
      {static_cast<Index>(line.first_vertex), static_cast<Index>(line.first_vertex + 1)});
  return shape;
}

}  // namespace

TEST_CASE("fields of mixed domains are read linearly or by paths, and tell directions") {
  const AnyShape shape = AnyShape::mixed(two_squares_and_a_line());
  const AnyDomain domain(shape, {.precision = Precision::float64});
  const PointSource source = PointSource::at(0);
  const AnyPathField field = domain.path_field(Serial{}, std::span(&source, 1));
  const auto exact = [](const Position& p) {
    return p[2] > 0 ? std::hypot(2, 1) + p[2] : std::hypot(p[0], p[1]);
  };
  double worst = 0, sum = 0;
  const auto directions = field.gradient();
  REQUIRE(directions.size() == shape.simplices());
  for (Index s = 0; s < shape.simplices(); ++s) {
    const auto corners = shape.corners(s);
    PointSource at{.simplex = s};
    if (corners.size() == 2)
      at.barycentric = {0.25, 0.75};
    else
      at.barycentric = {0.2, 0.5, 0.3};
    const Position place = shape.position(at);
    const double read = field.at(at, ReadOut::linear);
    double linear = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      linear += at.barycentric[i] * field.field()[corners[i]];
    CHECK(read == Approx(linear).epsilon(1e-15));
    worst = std::max(worst, std::abs(read - exact(place)));
    sum += std::abs(read - exact(place));
    const auto& way = directions[s];
    CHECK(std::hypot(way[0], way[1], way[2]) == Approx(1));
    if (corners.size() == 2) {
      CHECK(way[2] == Approx(1));
    } else if (std::hypot(place[0], place[1]) > 0.5) {
      const double along = (way[0] * place[0] + way[1] * place[1]) / std::hypot(place[0], place[1]);
      CHECK(along > 0.998);  // the chord of a circle, a cell long
    }
  }
  CHECK(worst < 0.03);  // in the triangle at the source, where distances are no linear function
  CHECK(sum / static_cast<double>(shape.simplices()) < 1.5e-3);
  CHECK(field.at(PointSource::at(7), ReadOut::linear) == field.field()[7]);

  CHECK_THROWS_AS(field.at(PointSource::at(100000), ReadOut::linear), UsageError);
  const PointSource apex{.simplex = static_cast<Index>(shape.simplices() - 1),
                         .barycentric = {0.2, 0.3, 0.5, 0}};  // of the line
  CHECK_THROWS_WITH(field.at(apex, ReadOut::linear), Catch::Contains("2 corners"));

  // By the way there, and over the weld and up the line.
  for (const Index s : {0, 100, 200, 287, 400, static_cast<int>(shape.simplices()) - 1}) {
    PointSource at{.simplex = s, .barycentric = {0.2, 0.5, 0.3, 0}};
    if (shape.corners(s).size() == 2) at.barycentric = {0.25, 0.75, 0, 0};
    const double truth = exact(shape.position(at));
    CHECK(field.at(at) == Approx(truth).epsilon(1e-9));
    const Path path = field.trace(at);
    CHECK(path.length == Approx(truth).epsilon(1e-9));
    REQUIRE(path.positions.size() == path.points.size());
    double way = 0;
    for (std::size_t i = 0; i + 1 < path.positions.size(); ++i) {
      const auto &p = path.positions[i], &q = path.positions[i + 1];
      way += std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
      CHECK(path.points[i].simplex < shape.simplices());
    }
    CHECK(way == Approx(truth).epsilon(1e-9));
  }
}

TEST_CASE("fields of complexes of simplices are read linearly") {
  SimplexShape grid;
  grid.dimension = 2;
  grid.axes = 2;
  constexpr Index n = 15;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) grid.positions.insert(grid.positions.end(), {0.1 * i, 0.1 * j});
  grid.vertices = n * n;
  for (Index j = 0; j + 1 < n; ++j)
    for (Index i = 0; i + 1 < n; ++i) {
      const Index v = n * j + i;
      for (const Index corner : {v, v + 1, v + n + 1, v, v + n + 1, v + n})
        grid.corners.push_back(corner);
    }
  const AnyDomain domain(AnyShape::simplices(grid), {.precision = Precision::float64});
  const PointSource source = PointSource::at(0);
  const AnyPathField field = domain.path_field(Serial{}, std::span(&source, 1));
  const PointSource middle = PointSource::in(300, {1. / 3, 1. / 3, 1. / 3});
  const auto place = domain.shape().position(middle);
  CHECK(field.at(middle, ReadOut::linear) == Approx(std::hypot(place[0], place[1])).epsilon(2e-3));
  const auto way = field.gradient()[300];
  CHECK(way[0] * place[0] + way[1] * place[1] ==
        Approx(std::hypot(place[0], place[1])).epsilon(2e-3));
  CHECK_THROWS_WITH(field.at(middle), Catch::Contains("distances are read linearly"));
  CHECK_THROWS_WITH(field.trace(middle), Catch::Contains("paths are traced on"));
}

// Solids whose tetrahedra have speeds of their own, by the facade.

TEST_CASE("any domain: paths are refracted where the speeds of a solid jump") {
  const samples::Layers layers = {{.35, .7}, {1, 2, 1.5}};
  constexpr std::size_t n = 8;
  // One solid of all layers' blocks: vertices at one place are one.
  const auto blocks = samples::blocks_of(layers, n, .15, 3);
  std::map<std::array<double, 3>, Index> number;
  AnyShape::Points positions;
  std::vector<std::array<Index, 4>> tets;
  metric::SimplexSpeeds speeds{.speed = {}, .agreement = {metric::Sides::own}};
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for (auto tet : blocks[k].tets) {
      for (Index& v : tet) {
        const auto& p = blocks[k].positions[v];
        const auto [known, is_new] = number.insert({p, static_cast<Index>(positions.size())});
        if (is_new) positions.push_back(p);
        v = known->second;
      }
      tets.push_back(tet);
      speeds.speed.push_back(layers.v[k]);
    }
  const AnyShape shape = AnyShape::solid(positions, tets);
  const auto errors = [&](BuildOptions options, const metric::SimplexSpeeds& by, Index source) {
    options.lengths = std::make_shared<const MeasuredLengths>(shape.measure(by));
    const AnyDomain any(shape, options);
    CHECK(any.shape().kind() == DomainKind::solid);
    CHECK(any.components() == 1);
    const AnyField field = any.solve(Serial{}, PointSource::at(source));
    REQUIRE(field.size() == positions.size());
    std::array<double, 2> e = {0, 0};
    for (Index v = 0; v < positions.size(); ++v) {
      if (v == source) continue;
      const double off = std::abs(field[v] / layers.time(positions[source], positions[v]) - 1);
      e[0] += off / static_cast<double>(positions.size());
      e[1] = std::max(e[1], off);
    }
    return e;
  };
  for (const Index source : {Index(3), Index(100), Index(500)}) {
    const auto twice = errors(BuildOptions{.precision = Precision::float64}, speeds, source);
    CAPTURE(source, twice[0], twice[1]);
    CHECK(twice[0] < 1e-4);
    CHECK(twice[1] < 2e-2);
    const auto single = errors(BuildOptions{.precision = Precision::float32}, speeds, source);
    CAPTURE(single[0], single[1]);
    CHECK(single[0] < 2e-4);
    CHECK(single[1] < 2e-2);
  }
  // One length an edge is of first order, and what a solid of too many speeds has.
  metric::SimplexSpeeds smooth = speeds;
  smooth.agreement.sides = metric::Sides::mean;
  CHECK(errors(BuildOptions{.precision = Precision::float64}, smooth, 100)[0] > 1e-3);
  metric::SimplexSpeeds many = speeds;
  for (std::size_t t = 0; t < 70; ++t) many.speed[t] = 1 + 1e-3 * static_cast<double>(t);
  CHECK_FALSE(shape.measure(many).refracts);
  CHECK(shape.measure(many).smoothed);
  CHECK(shape.measure(many).tets.size() == tets.size());
  many.speed[5] = 0;
  CHECK_THROWS_AS(shape.measure(many), InputError);
  // A single speed is none: exact, as in space.
  metric::SimplexSpeeds one = speeds;
  std::fill(one.speed.begin(), one.speed.end(), 3.);
  BuildOptions options{.precision = Precision::float64};
  options.lengths = std::make_shared<const MeasuredLengths>(shape.measure(one));
  const AnyDomain any(shape, options);
  const AnyField field = any.solve(Serial{}, PointSource::at(100));
  for (Index v = 0; v < positions.size(); ++v)
    CHECK(field[v] == Approx(samples::distance(positions[100], positions[v]) / 3).epsilon(1e-9));
  CHECK(any.solve(OpenMP{2}, PointSource::at(100)).doubles() == field.doubles());
}

namespace {

// Turned about a skew axis, scaled and moved: no face is parallel to an axis.
Position turned(const Position& p, double scale) {
  const double a = 0.7, b = 1.1;
  const Position q = {p[0] * std::cos(a) - p[1] * std::sin(a),
                      p[0] * std::sin(a) + p[1] * std::cos(a), p[2]};
  return {scale * (q[0] + 3), scale * (q[1] * std::cos(b) - q[2] * std::sin(b)),
          scale * (q[1] * std::sin(b) + q[2] * std::cos(b) - 1)};
}

// From the six walls of the unit cube.
double to_wall(const Position& p) {
  return std::min({p[0], p[1], p[2], 1 - p[0], 1 - p[1], 1 - p[2]});
}

}  // namespace

TEST_CASE("the boundary of a solid is its faces: exact in a turned cube of any unit") {
  for (const double scale : {1., 1e-150, 1e120}) {
    Solid solid = solid_cube(6);
    const std::vector<Position> places = solid.positions;
    for (Position& p : solid.positions) p = turned(p, scale);
    solid.positions.push_back({0, 0, 0});  // in no tetrahedron
    const AnyShape shape = AnyShape::solid(solid.positions, solid.tets);
    const AnyDomain domain(shape, {.precision = Precision::float64});
    const Source boundary = shape.boundary(0.25 * scale);
    const AnyField field = domain.solve(Serial{}, boundary);
    double worst = 0;
    for (std::size_t v = 0; v < places.size(); ++v)
      worst = std::max(worst, std::abs(field[v] / scale - 0.25 - to_wall(places[v])));
    INFO(scale);
    CHECK(worst < 1e-14);
    CHECK(std::isinf(field[places.size()]));
    // Beside another source the nearer counts.
    const Index middle =
        solid.nearest(turned({.5, .5, .5}, scale)[0], turned({.5, .5, .5}, scale)[1],
                      turned({.5, .5, .5}, scale)[2]);
    const std::vector<Source> both = {boundary, PointSource::at(middle)};
    const AnyField nearest = domain.solve(Serial{}, both);
    const double from_middle =
        std::hypot(places[0][0] - places[middle][0], places[0][1] - places[middle][1],
                   places[0][2] - places[middle][2]);
    CHECK(nearest[middle] == 0);
    CHECK(nearest.label()[middle] == 1);
    CHECK(nearest.label()[0] == 0);
    CHECK(nearest[0] / scale == Approx(std::min(0.25, from_middle)).epsilon(1e-12));
  }
}

TEST_CASE("the boundary of a solid by lengths alone is its vertices") {
  const Solid solid = solid_cube(3);
  const AnyShape shape = AnyShape::solid(solid.positions.size(), solid.tets, solid.lengths());
  const auto boundary = std::get<VertexSource>(shape.boundary());
  CHECK(boundary.offsets.empty());
  CHECK(boundary.vertices.size() < solid.positions.size());
}

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// The k nearest of each point, by looking at all.
Neighbours nearest(const std::vector<Point3>& points, std::size_t k) {
  Neighbours found;
  found.begin = {0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    const auto far = [&](Index n) {
      const Point3 to = minus(points[n], points[i]);
      return dot(to, to);
    };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return far(a) < far(b); });
    std::erase(order, static_cast<Index>(i));
    order.resize(std::min(k, order.size()));
    found.of.insert(found.of.end(), order.begin(), order.end());
    found.begin.push_back(static_cast<Index>(found.of.size()));
  }
  return found;
}

}  // namespace

TEST_CASE("slopes of a cloud: a linear function has its gradient, across a tilted plane") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  const Point3 normal = unit(Point3{.3, -.5, .8}), x = some_perpendicular(normal),
               y = cross(normal, x);
  std::vector<Point3> points;
  std::vector<double> value;
  for (int n = 0; n < 200; ++n) {
    const double a = number(random), b = number(random);
    Point3 p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = 7 + a * x[k] + b * y[k];
    points.push_back(p);
    value.push_back(2 * a - 3 * b + 1);
  }
  // Of any length.
  const std::vector<Point3> normals(points.size(), {.6, -1, 1.6});
  const Neighbours neighbours = nearest(points, 8);
  // A neighbour that is not reached counts for nothing.
  value[17] = inf;
  const auto found = cloud_slopes(points, normals, neighbours, value);
  for (std::size_t i = 0; i < points.size(); ++i) {
    CAPTURE(i);
    CHECK(dot(found[i], normal) == Approx(0).margin(1e-12));
    const double along = dot(found[i], x), across = dot(found[i], y);
    CHECK(along == Approx(i == 17 ? 0 : 2).margin(1e-9));
    CHECK(across == Approx(i == 17 ? 0 : -3).margin(1e-9));
  }
}

TEST_CASE("slopes of a cloud: nothing to go by is no slope") {
  const std::vector<Point3> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  const std::vector<double> value = {0, 1, 2, inf};
  const Neighbours all = nearest(points, 3);
  // In a line, no direction across is known; a normal of no length faces nowhere.
  for (const Point3& normal : {Point3{0, 0, 1}, Point3{}})
    for (const Point3& slope : cloud_slopes(points, std::vector<Point3>(4, normal), all, value)) {
      CHECK(slope == Point3{});
    }
}

}  // namespace plexway::testing::linear_field_test
