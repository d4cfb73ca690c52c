#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing::linear_field_test {

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

}  // namespace plexway::testing::linear_field_test
