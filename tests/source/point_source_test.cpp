#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include <plexway/common/closest.hpp>
#include <plexway/error.hpp>
#include <plexway/surface.hpp>

#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::point_source_test {

namespace {

template <class Real>
constexpr double exact_to = sizeof(Real) == 4 ? 1e-5 : 1e-12;

Position point_of(const Surface& s, Index face, const std::array<double, 3>& b) {
  Position p{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t d = 0; d < 3; ++d) p[d] += b[i] * s.positions[s.faces[face][i]][d];
  return p;
}

}  // namespace

TEMPLATE_TEST_CASE("sources anywhere in a face", "", float, double) {
  const Surface flat = random_polygon(6, 60, 80, 2);
  for (const Surface& s : {grid(9, 7), flat, renamed(flat, 4, true, true).surface}) {
    const auto mesh = s.mesh<TestType>();
    std::mt19937 random(6);
    for (int n = 0; n < 60; ++n) {
      const Index face = below(random, s.faces.size());
      std::array<double, 3> b = {uniform(random), uniform(random), uniform(random)};
      if (n % 3 == 1) b[below(random, 3)] = 0;  // on an edge
      const double sum = b[0] + b[1] + b[2];
      for (double& x : b) x /= sum;
      if (n % 3 == 2) {  // at a corner
        b = {0, 0, 0};
        b[below(random, 3)] = 1;
      }
      for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::exact(), Accuracy::usual()})
        for (const Schedule schedule : schedules) {
          if (sizeof(TestType) == 4 && accuracy == Accuracy::exact()) continue;
          PropagateOptions options = at(accuracy);
          options.schedule = schedule;
          const Position p = point_of(s, face, b);
          const std::vector<double> d = solve(mesh, PointSource::in(face, b), options);
          const std::vector<double> exact = straight(s, p);
          double worst = 0;
          for (std::size_t v = 0; v < d.size(); ++v)
            worst = std::max(worst, std::abs(d[v] - exact[v]) / std::max(exact[v], .05));
          CAPTURE(n, face, b[0], b[1], b[2], name(options), accuracy.error());
          // Single precision loses merged light at a vertex now and then: 8e-4 here.
          const double merged = sizeof(TestType) == 4 ? 5e-3 : 3e-4;
          CHECK(worst <= (accuracy == Accuracy::usual() ? merged : exact_to<TestType>));
        }
    }
  }
}

TEMPLATE_TEST_CASE("a corner by its barycentric coordinates is that vertex", "", float, double) {
  for (const Surface& s : {sphere(2), renamed(cube(4), 2, true, true).surface, moebius(12)}) {
    const auto mesh = s.mesh<TestType>();
    for (const Index face : {0u, 17u, 30u})
      for (std::size_t i = 0; i < 3; ++i) {
        std::array<double, 3> b{};
        b[i] = 1;
        const auto d = solve(mesh, PointSource::in(face, b));
        const auto e = solve(mesh, PointSource::at(s.faces[face][i]));
        CHECK(compare(d, e).max <= (sizeof(TestType) == 4 ? 1e-6 : 1e-14));
        CHECK(d[s.faces[face][i]] == 0);
      }
  }
}

TEMPLATE_TEST_CASE("sources in a face under the other policies", "", float, double) {
  const Surface s = sphere(3);
  const auto mesh = s.mesh<TestType>();
  const std::array<double, 3> b = {.3, .1, .6};
  Position p = point_of(s, 100, b);
  const double r = std::hypot(p[0], p[1], p[2]);
  for (double& c : p) c /= r;
  const std::vector<double> exact = by_rule(s, [&](const Position& q) {
    return 2 * std::asin(std::min(1., std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) / 2));
  });
  for (const Visibility visibility : visibilities)
    for (const Schedule schedule : schedules) {
      PropagateOptions options;
      options.visibility = visibility;
      options.schedule = schedule;
      const Errors e = compare(solve(mesh, PointSource::in(100, b), options), exact);
      CAPTURE(name(options), e.mean, e.max);
      CHECK(e.fits);
      CHECK(e.mean < 1.2e-2);
    }
}

TEMPLATE_TEST_CASE("the distance at a source is its offset, exactly", "", float, double) {
  const auto mesh = sphere(3).mesh<TestType>();
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::exact(), Accuracy::usual()})
    for (const double offset : {0., 1e-20, .1, 3., 1e4}) {
      if (sizeof(TestType) == 4 && accuracy == Accuracy::exact()) continue;
      const auto field =
          plexway::solve(Serial{}, mesh, PointSource{.vertex = 20, .offset = offset}, at(accuracy));
      CHECK(field.distance[20] == static_cast<TestType>(offset));
      const auto plain = plexway::solve(Serial{}, mesh, PointSource::at(20), at(accuracy));
      double worst = 0;
      for (std::size_t v = 0; v < field.distance.size(); ++v)
        worst = std::max(worst,
                         std::abs(double(field.distance[v]) - offset - double(plain.distance[v])));
      CAPTURE(offset, accuracy.error());
      const double rounding = (sizeof(TestType) == 4 ? 1e-5 : 1e-12) * (1 + offset);
      CHECK(worst <= rounding + (accuracy == Accuracy::usual() ? 3e-4 : 0));
    }
}

TEMPLATE_TEST_CASE("an offset so large that an edge hardly counts beside it", "", float, double) {
  const Surface s = sphere(2);
  for (const double offset : {1e9, 1e18}) {
    const auto field =
        plexway::solve(Serial{}, s.mesh<TestType>(), PointSource{.vertex = 20, .offset = offset});
    bool near = true;
    for (const TestType d : field.distance) near &= std::abs(double(d) / offset - 1) < 1e-6;
    CHECK(near);
  }
}

TEMPLATE_TEST_CASE("a source on a boundary edge or a diagonal sees both sides", "", float, double) {
  // Where it is rounded to must not count as behind its own edge.
  const Surface s = grid(9, 7);
  const auto mesh = s.mesh<TestType>();
  for (const Index face : {14u, 35u, 44u, 61u, 100u})
    for (std::size_t i = 0; i < 3; ++i)
      for (const double at : {.1, .3, .5, .549536, .728666, .955}) {
        std::array<double, 3> b{};
        b[i] = at;
        b[(i + 1) % 3] = 1 - at;
        for (const Visibility visibility : {Visibility::saddles, Visibility::centroid}) {
          PropagateOptions options = by_labels();
          options.visibility = visibility;
          const Errors e = compare(solve(mesh, PointSource::in(face, b), options),
                                   straight(s, point_of(s, face, b)));
          CAPTURE(face, i, at, name(options));
          // The plain step keeps squared lengths only: a source on a hinge gets its height as the
          // root of a rounding error.
          CHECK(e.max <= (visibility == Visibility::centroid ? 0.1 : 1e-5));
        }
        CHECK(
            compare(solve(mesh, PointSource::in(face, b)), straight(s, point_of(s, face, b))).max <=
            3e-4);
      }
}

TEMPLATE_TEST_CASE("an unreferenced vertex as source reaches itself only", "", float, double) {
  Surface s = grid(3, 3);
  const Index lone = s.add(.5, .5);
  const auto mesh = s.mesh<TestType>();
  for (const Visibility visibility : visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    const auto d = solve(mesh, PointSource::at(lone), options);
    CHECK(d[lone] == 0);
    CHECK(std::count_if(d.begin(), d.end(), [](double x) { return std::isinf(x); }) == 16);
    const PointSource both[] = {PointSource::at(lone), PointSource::at(5)};
    const auto field = plexway::solve(Serial{}, mesh, both, options);
    CHECK(field.label[lone] == 0);
    CHECK(field.label[0] == 1);
    CHECK(field.distance[lone] == 0);
  }
}

TEMPLATE_TEST_CASE("several sources: the nearest one counts, and its label", "", float, double) {
  Surface s = grid(24, 24);
  const Index far = s.add(9, 9), b = s.add(10, 9), c = s.add(9, 10);
  s.triangle(far, b, c);
  s.add(50, 50);
  const auto mesh = s.mesh<TestType>();
  std::mt19937 random(3);
  for (int n = 0; n < 6; ++n) {
    std::vector<PointSource> sources;
    std::vector<Position> places;
    for (int i = 0; i < 2 + n; ++i) {
      const Index v = below(random, 625);
      sources.push_back({.vertex = v, .offset = i % 2 ? .1 * uniform(random) : 0});
      places.push_back(s.positions[v]);
    }
    for (const Schedule schedule : schedules) {
      PropagateOptions options;
      options.schedule = schedule;
      const auto field = plexway::solve(Serial{}, mesh, sources, options);
      REQUIRE(field.label.size() == s.positions.size());
      // Exact within a cell; where cells meet, a triangle's centre speaks for its corners.
      double worst = 0, label_gap = 0;
      for (std::size_t v = 0; v < 625; ++v) {
        std::vector<double> d;
        for (std::size_t i = 0; i < sources.size(); ++i)
          d.push_back(sources[i].offset + std::hypot(s.positions[v][0] - places[i][0],
                                                     s.positions[v][1] - places[i][1]));
        const double least = *std::min_element(d.begin(), d.end());
        worst = std::max(worst, std::abs(double(field.distance[v]) - least));
        REQUIRE(field.label[v] < sources.size());
        label_gap = std::max(label_gap, d[field.label[v]] - least);
      }
      CAPTURE(n, name(options));
      CHECK(worst < 4e-3);
      CHECK(label_gap < 1e-6);
      for (std::size_t v = 625; v < s.positions.size(); ++v) {
        CHECK(std::isinf(field.distance[v]));
        CHECK(field.label[v] == none);
      }
    }
  }
}

TEMPLATE_TEST_CASE("several sources agree with each alone", "", float, double) {
  const Surface s = sphere(4);
  const auto mesh = s.mesh<TestType>();
  const std::vector<PointSource> sources = {PointSource::at(0), PointSource::in(500, {.2, .5, .3}),
                                            PointSource::at(900)};
  for (const Visibility visibility : visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    const auto field = plexway::solve(Serial{}, mesh, sources, options);
    std::vector<std::vector<double>> alone;
    for (const PointSource& source : sources) alone.push_back(solve(mesh, source, options));
    double worst = 0, sum = 0;
    for (std::size_t v = 0; v < field.distance.size(); ++v) {
      const double least = std::min({alone[0][v], alone[1][v], alone[2][v]});
      const double e = std::abs(double(field.distance[v]) - least);
      worst = std::max(worst, e);
      sum += e;
    }
    CAPTURE(name(options), sum);
    CHECK(worst < .06);
    CHECK(sum / double(field.distance.size()) < 1e-3);
    CHECK(field.label[0] == 0);
    CHECK(field.label[900] == 2);
    for (const Index v : s.faces[500]) CHECK(field.label[v] == 1);
  }
}

TEST_CASE("the same source twice: the first is named") {
  const auto mesh = grid(4, 4).mesh<float>();
  const PointSource twice[] = {PointSource::at(7), PointSource::at(7)};
  const auto field = plexway::solve(Serial{}, mesh, twice);
  CHECK(field.distance[7] == 0);
  CHECK(field.label[7] == 0);
  CHECK(plexway::solve(Serial{}, mesh, PointSource::at(7)).label.empty());
}

TEST_CASE("a list of sources that has a name keeps what was made for it") {
  const auto mesh = grid(4, 4).mesh<double>();
  const auto zero_at = [&](const SourceList& list, std::initializer_list<Index> vertices) {
    const auto field = plexway::solve(Serial{}, mesh, list);
    for (const Index v : vertices) CHECK(field.distance[v] == 0);
  };
  const std::vector<PointSource> rows = {PointSource::at(3), PointSource::at(8)};
  const SourceList one(PointSource::at(7));
  const SourceList several{std::vector<PointSource>(rows)};
  const SourceList fixed{std::array{PointSource::at(2), PointSource::at(9)}};
  const SourceList any{Source(PointSource::at(5))};
  const SourceList sets{std::vector<Source>{VertexSource{.vertices = {1, 4}}, PointSource::at(6)}};
  const SourceList copy(one);
  const SourceList second = several.only(1);
  std::vector<double> elsewhere(1000, 1);  // what is gone may be written over
  zero_at(one, {7});
  zero_at(several, {3, 8});
  zero_at(fixed, {2, 9});
  zero_at(any, {5});
  zero_at(sets, {1, 4, 6});
  zero_at(copy, {7});
  zero_at(second, {8});
  CHECK(SourceList(rows).points().data() == rows.data());
  CHECK(one.only_points());
  CHECK_FALSE(sets.only_points());
}

// Sources as one writes them, and what a field says of its vertices.

namespace {

const std::vector<std::array<double, 3>> corners = {
    {0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}, {9, 9, 9}};
const std::vector<std::array<Index, 3>> faces = {{0, 1, 2}, {0, 2, 3}};
constexpr double unreached = std::numeric_limits<double>::infinity();

std::vector<double> from(const SourceList& sources) {
  return solve(Serial{}, TriangleMesh<double>(corners, faces), sources).distance;
}

}  // namespace

TEST_CASE("sources are numbers, and what stands in braces") {
  const TriangleMesh<double> mesh(corners, faces);
  const std::vector<double> one = {0, 4, 5, 3, unreached}, two = {0, 3, 0, 3, unreached};
  CHECK(solve(Serial{}, mesh, 0).distance == one);
  CHECK(from(std::size_t{0}) == one);
  CHECK(from({0, 2}) == two);
  CHECK(from(std::vector<std::int64_t>{0, 2}) == two);
  CHECK(from(std::vector<Index>{2, 0}) == two);
  CHECK_THROWS_AS(from(std::vector<int>{0, -2}), UsageError);
  CHECK(from({PointSource::at(0), PointSource::at(2)}) == two);
  // Kept beyond the line that they stand in.
  const SourceList list = {PointSource::at(0), VertexSource{.vertices = {1}, .offset = 2}};
  CHECK(list.size() == 2);
  CHECK(from(list) == std::vector<double>{0, 2, 5, 3, unreached});
  CHECK(solve_each(Serial{}, mesh, {0, 2}).row(1)[0] == 5);
  CHECK_THROWS_AS(from(-1), UsageError);
  CHECK_THROWS_AS(from(std::size_t{1} << 40), UsageError);
  CHECK_THROWS_AS(from(5), UsageError);
}

TEST_CASE("the closest point is a source") {
  CHECK(closest(corners, faces, {4, 3, 1}).vertex == 2);
  const PointSource point = closest(corners, faces, {4, 1, 9});
  CHECK(from(point)[1] == Approx(1));
  CHECK(from(point)[0] == Approx(std::sqrt(17)));
  const std::vector<std::array<Index, 2>> edges = {{0, 1}};
  CHECK(closest(corners, edges, {1, 7, 0}).barycentric[1] == Approx(.25));
  const std::vector<std::array<Index, 4>> tets = {{0, 1, 2, 4}};
  CHECK(closest(corners, tets, {3, 2, 2}).simplex == 0);
  CHECK_THROWS_AS(closest(corners, std::span(faces).first(0), {0, 0, 0}), UsageError);
  CHECK_THROWS_AS(closest(corners, faces, {0, NAN, 0}), UsageError);
}

TEST_CASE("the closest point of arrays of any kind") {
  std::vector<std::array<float, 3>> singles;
  for (const auto& p : corners)
    singles.push_back(
        {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  CHECK(closest(singles, triangles, {4, 3, 1}).vertex == 2);
  CHECK(closest(corners, std::vector<std::vector<short>>{{0, 1}}, {1, 7, 0}).barycentric[1] ==
        Approx(.25));
  CHECK(closest(singles, std::vector<std::array<long, 4>>{{0, 1, 2, 4}}, {3, 2, 2}).simplex == 0);
  CHECK_THROWS_AS(closest(singles, std::vector<std::vector<int>>(), {0, 0, 0}), UsageError);
  CHECK_THROWS_AS(closest(singles, std::vector<std::array<int, 5>>{{}}, {0, 0, 0}), UsageError);
}

TEST_CASE("a field has a size, elements and labels") {
  const TriangleMesh<float> mesh(corners, faces);
  const auto one = solve(Serial{}, mesh, 0), two = solve(Serial{}, mesh, {0, 2});
  CHECK(one.size() == 5);
  CHECK(one[2] == 5);
  CHECK(std::vector<float>(one.begin(), one.end()) == one.distance);
  CHECK(one.reached(3));
  CHECK_FALSE(one.reached(4));
  CHECK(one.label_of(3) == 0);
  CHECK(one.label_of(4) == none);
  CHECK(two.label_of(2) == 1);
  CHECK(two.label_of(4) == none);
}

}  // namespace plexway::testing::point_source_test
