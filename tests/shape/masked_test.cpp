// Masks as a property of a domain: against brute force, and bit by bit against a domain that was
// built without what is closed.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/pairs.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "folder.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::masked_test {

namespace {

// Shortest ways among triangles in a plane by brute force: whoever sees whom, and Dijkstra.

/// Of a surface in the plane z = 0 without folds, with any walls, holes and slits, in generic
/// position: no three vertices on a line but for those of straight walls. Quadratic in the vertices
/// times the walls.
class PlaneWays {
 public:
  explicit PlaneWays(const Surface& surface) : surface_(surface) {
    std::map<std::pair<Index, Index>, int> count;
    for (const Face& f : surface.faces)
      for (std::size_t i = 0; i < 3; ++i) ++count[std::minmax(f[i], f[(i + 1) % 3])];
    std::vector<char> rim(surface.positions.size(), 0);
    for (const auto& [edge, n] : count) {
      if (n != 1) continue;
      walls_.push_back({edge.first, edge.second});
      rim[edge.first] = rim[edge.second] = 1;
    }
    edges_ = std::move(count);
    for (Index v = 0; v < rim.size(); ++v)
      if (rim[v] != 0) stops_.push_back(v);
  }

  /// One a vertex; +inf where no way leads.
  [[nodiscard]] std::vector<double> from(Index source) const {
    const std::size_t n = surface_.positions.size();
    std::vector<double> best(n, std::numeric_limits<double>::infinity());
    std::vector<char> done(n, 0);
    best[source] = 0;
    for (Index at = source; at != none;) {
      done[at] = 1;
      for (Index v = 0; v < n; ++v)
        if (done[v] == 0 && best[at] + length(at, v) < best[v] && sees(at, v))
          best[v] = best[at] + length(at, v);
      at = none;
      for (const Index v : stops_)
        if (done[v] == 0 && std::isfinite(best[v]) && (at == none || best[v] < best[at])) at = v;
    }
    return best;
  }

  [[nodiscard]] double length(Index a, Index b) const {
    const Position &p = surface_.positions[a], &q = surface_.positions[b];
    return std::hypot(p[0] - q[0], p[1] - q[1]);
  }

 private:
  using Point = std::array<double, 2>;

  [[nodiscard]] Point at(Index v) const {
    return {surface_.positions[v][0], surface_.positions[v][1]};
  }
  // Twice the area of a triangle, > 0 where it turns left.
  static double turn(const Point& a, const Point& b, const Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  static bool apart(double a, double b) {
    constexpr double close = 1e-13;
    return (a > close && b < -close) || (a < -close && b > close);
  }

  // No wall is crossed, and what lies between is floor.
  [[nodiscard]] bool sees(Index from, Index to) const {
    if (edges_.contains(std::minmax(from, to))) return true;
    const Point a = at(from), b = at(to);
    for (const auto& [u, v] : walls_) {
      if (u == from || u == to || v == from || v == to) continue;
      const Point p = at(u), q = at(v);
      if (apart(turn(a, b, p), turn(a, b, q)) && apart(turn(p, q, a), turn(p, q, b))) return false;
    }
    const Point middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    return std::any_of(surface_.faces.begin(), surface_.faces.end(), [&](const Face& f) {
      const double side = turn(at(f[0]), at(f[1]), at(f[2])) > 0 ? 1 : -1;
      for (std::size_t i = 0; i < 3; ++i)
        if (side * turn(at(f[i]), at(f[(i + 1) % 3]), middle) < -1e-13) return false;
      return true;
    });
  }

  const Surface& surface_;
  std::map<std::pair<Index, Index>, int> edges_;
  std::vector<std::array<Index, 2>> walls_;
  std::vector<Index> stops_;  // where a way may bend
};

constexpr double inf = std::numeric_limits<double>::infinity();

// A square in which every vertex is moved, those of its rim too.
Surface jittered(Index n, unsigned seed) {
  std::mt19937 random(seed);
  Surface s = grid(n, n);
  for (Position& p : s.positions)
    for (std::size_t k = 0; k < 2; ++k) p[k] += (uniform(random) - 0.5) * 0.5 / n;
  return s;
}

Surface opened(const Surface& s, const Mask& mask) { return {s.positions, mask.open(s.faces)}; }

AnyDomain masked(const Surface& s, const Mask& mask, Precision precision = Precision::float64) {
  return AnyDomain(AnyShape::surface(s.positions, s.faces),
                   {.precision = precision, .mask = std::make_shared<Mask>(mask)});
}

struct Worst {
  double exact = 0, usual = 0, labels = 0;
  void take(const AnyDomain& domain, Index source, const std::vector<double>& truth) {
    const auto off = [&](Accuracy accuracy) {
      const AnyField field =
          domain.solve(Serial{}, PointSource::at(source), plexway::testing::at(accuracy));
      double worst = 0;
      for (std::size_t v = 0; v < truth.size(); ++v) {
        CAPTURE(v, truth[v], field[v]);
        REQUIRE(std::isfinite(field[v]) == std::isfinite(truth[v]));
        if (std::isfinite(truth[v]) && truth[v] > 0)
          worst = std::max(worst, std::abs(field[v] / truth[v] - 1));
      }
      return worst;
    };
    exact = std::max(exact, off(Accuracy::exact()));
    usual = std::max(usual, off(Accuracy::usual()));
    labels = std::max(labels, off(Accuracy::fast()));
  }
};

}  // namespace

TEST_CASE("a wall of vertices with a door one vertex wide, in generic position") {
  // Vertices that are closed close the triangles about them, so the door is not a hole in a line:
  // it is one vertex between two spikes, and who comes to it has to pass the spikes' rims. The way
  // is not |s - door| + |door - p|, which is up to 4 % short.
  const Index n = 12, middle = n / 2, height = 5;
  Worst worst;
  double line_is_short = 0;
  for (const unsigned seed : {1, 2, 3}) {
    const Surface s = jittered(n, seed);
    const Index door = height * (n + 1) + middle;
    Mask mask(s.positions.size(), s.faces.size());
    for (Index y = 0; y <= n; ++y)
      if (y != height) mask.close_vertex(y * (n + 1) + middle);
    const Surface room = opened(s, mask);
    const PlaneWays ways(room);
    const AnyDomain domain = masked(s, mask);
    for (const Index source : {Index{1}, 4 * (n + 1) + 1, 8 * (n + 1) + 3, 11 * (n + 1) + 4}) {
      const std::vector<double> truth = ways.from(source);
      worst.take(domain, source, truth);
      for (Index v = 0; v < truth.size(); ++v)
        if (v % (n + 1) > middle && std::isfinite(truth[v])) {
          const double line = ways.length(source, door) + ways.length(door, v);
          CHECK(line < truth[v] * (1 + 1e-14));
          line_is_short = std::max(line_is_short, 1 - line / truth[v]);
        }
    }
  }
  CAPTURE(worst.exact, worst.usual, worst.labels, line_is_short);
  CHECK(line_is_short > 1e-2);
  CHECK(worst.exact < 1e-13);
  CHECK(worst.usual < 1e-3);
  CHECK(worst.labels < 2e-2);
}

TEST_CASE("walls at random in a plane: every corner of a rim bends ways, pinched ones too") {
  Worst worst;
  std::mt19937 random(5);
  for (const unsigned seed : {11, 12, 13, 14}) {
    const Index n = 11;
    const Surface s = jittered(n, seed);
    Mask mask(s.positions.size(), s.faces.size());
    for (Index f = 0; f < s.faces.size(); ++f)
      if (uniform(random) < 0.12) mask.close_simplex(f);
    for (Index v = 0; v < s.positions.size(); ++v)
      if (uniform(random) < 0.03) mask.close_vertex(v);
    const Surface room = opened(s, mask);
    const PlaneWays ways(room);
    const AnyDomain domain = masked(s, mask);
    for (int k = 0; k < 4; ++k) {
      const Index source = below(random, s.positions.size());
      worst.take(domain, source, ways.from(source));
    }
  }
  CAPTURE(worst.exact, worst.usual, worst.labels);
  CHECK(worst.exact < 1e-13);
  CHECK(worst.usual < 5e-3);  // labels promise nothing among walls like these
}

TEST_CASE("behind a mask fields, sources and paths keep the numbers of the shape") {
  const Surface s = jittered(14, 3);
  std::mt19937 random(8);
  Mask mask(s.positions.size(), s.faces.size());
  for (Index f = 0; f < s.faces.size(); ++f)
    if (uniform(random) < 0.15) mask.close_simplex(f);
  mask.close_vertex(100);
  const Surface room = opened(s, mask);
  const auto numbers = mask.number(std::span<const Face>(s.faces));
  for (const Precision precision : {Precision::float32, Precision::float64})
    for (const Triangulation triangulation : {Triangulation::automatic, Triangulation::delaunay}) {
      const AnyDomain domain(AnyShape::surface(s.positions, s.faces),
                             {.precision = precision,
                              .triangulation = triangulation,
                              .mask = std::make_shared<Mask>(mask)});
      const AnyDomain cut(AnyShape::surface(s.positions, room.faces),
                          {.precision = precision, .triangulation = triangulation});
      CHECK(domain.simplices() == s.faces.size());
      CHECK(domain.components() == cut.components());
      CHECK(domain.open_simplices()->size() == room.faces.size());
      std::vector<Source> outside, inside;
      for (Index f = 7; f < s.faces.size(); f += 31) {
        if (numbers[f] == none) continue;
        outside.push_back(PointSource::in(f, {0.2, 0.5, 0.3}));
        inside.push_back(PointSource::in(numbers[f], {0.2, 0.5, 0.3}));
      }
      outside.push_back(VertexSource{.vertices = {3, 60}});
      inside.push_back(outside.back());
      REQUIRE(outside.size() > 5);
      for (std::size_t k = 0; k < outside.size(); ++k) {
        const AnyField field = domain.solve(Serial{}, outside[k]);
        CHECK(field.doubles() == cut.solve(Serial{}, inside[k]).doubles());
      }
      CHECK(domain.solve(Serial{}, SourceList(outside)).doubles() ==
            cut.solve(Serial{}, SourceList(inside)).doubles());
      // Rows of matrices.
      PairsRequest of_shape{.rows = SourceList(outside)}, of_cut{.rows = SourceList(inside)};
      const auto near = [&](const AnyDomain& of, const PairsRequest& request) {
        std::vector<std::vector<NearEntry<double>>> rows(outside.size());
        near_pairs(Serial{}, of, request, {.radius = 0.3},
                   {[&](std::size_t row, SparseRow<double> entries) {
                     rows[row].assign(entries.begin(), entries.end());
                   }});
        return rows;
      };
      const auto ours = near(domain, of_shape), theirs = near(cut, of_cut);
      for (std::size_t k = 0; k < ours.size(); ++k)
        CHECK(std::equal(ours[k].begin(), ours[k].end(), theirs[k].begin(), theirs[k].end(),
                         [](const auto& a, const auto& b) {
                           return a.column == b.column && a.distance == b.distance;
                         }));
      // Ways, and distances inside triangles.
      const auto paths = domain.path_field(Serial{}, std::vector<PointSource>{PointSource::at(2)});
      const auto of_the_cut =
          cut.path_field(Serial{}, std::vector<PointSource>{PointSource::at(2)});
      for (const Source& place : outside) {
        const auto* point = std::get_if<PointSource>(&place);
        if (point == nullptr) continue;
        PointSource there = *point;
        there.simplex = numbers[point->simplex];
        const Path path = paths.trace(*point), other = of_the_cut.trace(there);
        CHECK(path.length == other.length);
        CHECK(path.positions == other.positions);
        REQUIRE(path.points.size() == other.points.size());
        for (std::size_t i = 0; i < path.points.size(); ++i)
          CHECK(numbers[path.points[i].simplex] == other.points[i].simplex);
        CHECK(paths.at(*point) == of_the_cut.at(there));
      }
      const auto slopes = paths.gradient();
      REQUIRE(slopes.size() == s.faces.size());
      const auto slopes_of_cut = of_the_cut.gradient();
      for (Index f = 0; f < slopes.size(); ++f)
        CHECK(slopes[f] == (numbers[f] == none ? Position{0, 0, 0} : slopes_of_cut[numbers[f]]));
      // A vertex behind the mask reaches itself, a simplex nothing.
      const AnyField alone = domain.solve(Serial{}, PointSource::at(100));
      CHECK(alone[100] == 0);
      CHECK(alone[99] == inf);
      const Index closed =
          static_cast<Index>(std::find(numbers.begin(), numbers.end(), none) - numbers.begin());
      CHECK_THROWS_AS(domain.solve(Serial{}, PointSource::in(closed, {0.2, 0.5, 0.3})), UsageError);
      CHECK_THROWS_AS(paths.at(PointSource::in(closed, {0.2, 0.5, 0.3})), UsageError);
      // Other walls, and none.
      const AnyDomain open = domain.masked(nullptr);
      CHECK(open.open_simplices() == nullptr);
      CHECK(&open.shape().state() == &domain.shape().state());
      CHECK(open.solve(Serial{}, PointSource::at(5)).doubles() ==
            AnyDomain(AnyShape::surface(s.positions, s.faces),
                      {.precision = precision, .triangulation = triangulation})
                .solve(Serial{}, PointSource::at(5))
                .doubles());
      CHECK(open.masked(std::make_shared<Mask>(mask)).solve(Serial{}, outside[0]).doubles() ==
            domain.solve(Serial{}, outside[0]).doubles());
    }
}

TEST_CASE("masks of solids, wireframes and simplices, with lengths and metrics") {
  const Solid whole = cubes(4, 4, 3, 0.25, 0.2, [](Index, Index, Index) { return true; });
  Mask mask(whole.positions.size(), whole.tets.size());
  for (Index t = 0; t < whole.tets.size(); t += 7) mask.close_simplex(t);
  mask.close_vertex(13);
  const auto open = mask.open(whole.tets);
  const auto walls = std::make_shared<Mask>(mask);
  const auto same = [](const AnyDomain& a, const AnyDomain& b) {
    for (const Index v : {0U, 40U}) {
      const auto d = a.solve(Serial{}, PointSource::at(v)).doubles();
      CHECK(d == b.solve(Serial{}, PointSource::at(v)).doubles());
      CHECK(std::count(d.begin(), d.end(), inf) > 0);
      CHECK(std::count(d.begin(), d.end(), inf) < 10);
    }
  };
  const AnyShape solid = AnyShape::solid(whole.positions, whole.tets),
                 cut = AnyShape::solid(whole.positions, open);
  same(AnyDomain(solid, {.mask = walls}), AnyDomain(cut));
  // Two speeds, at whose faces paths are refracted: a domain of regions.
  std::vector<double> speed(whole.tets.size(), 1);
  for (std::size_t t = 0; t < speed.size(); ++t)
    if (whole.positions[whole.tets[t][0]][2] > 0.3) speed[t] = 2;
  metric::SimplexSpeeds two{speed, {.sides = metric::Sides::own}},
      two_open{mask.open_rows(std::span<const std::array<Index, 4>>(whole.tets), speed),
               {.sides = metric::Sides::own}};
  const auto measured = [](const AnyShape& shape, const metric::Metric& metric) {
    return std::make_shared<const MeasuredLengths>(shape.measure(metric));
  };
  const AnyDomain layers(solid, {.lengths = measured(solid, two), .mask = walls}),
      layers_cut(cut, {.lengths = measured(cut, two_open)});
  CHECK(layers.components() == layers_cut.components());
  same(layers, layers_cut);

  SimplexShape given;
  given.dimension = 3;
  given.axes = 3;
  given.vertices = whole.positions.size();
  for (const Position& p : whole.positions)
    given.positions.insert(given.positions.end(), p.begin(), p.end());
  SimplexShape less = given;
  for (const auto& tet : whole.tets)
    given.corners.insert(given.corners.end(), tet.begin(), tet.end());
  for (const auto& tet : open) less.corners.insert(less.corners.end(), tet.begin(), tet.end());
  same(AnyDomain(AnyShape::simplices(given), {.mask = walls}),
       AnyDomain(AnyShape::simplices(less)));

  // A ring of lengths alone.
  Mask gap(4, 4);
  gap.close_simplex(0);
  const AnyDomain ring(AnyShape::wireframe(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {1, 2, 3, 4}),
                       {.mask = std::make_shared<Mask>(gap)});
  CHECK(ring.solve(Serial{}, PointSource::at(0)).doubles() == std::vector<double>{0, 9, 7, 4});
  CHECK(ring.solve(Serial{}, PointSource::in(3, {0.25, 0.75})).doubles() ==
        std::vector<double>{1, 8, 6, 3});
  const auto way = ring.path_field(Serial{}, std::vector<PointSource>{PointSource::at(0)})
                       .trace(PointSource::at(1));
  CHECK(way.length == 9);
  for (const PathPoint& at : way.points) CHECK(at.simplex != 0);
}

TEST_CASE("masks that fit nothing, close everything or are to be kept are refused") {
  const Surface s = grid(3, 3);
  const AnyShape shape = AnyShape::surface(s.positions, s.faces);
  const auto with = [](Mask mask) { return BuildOptions{.mask = std::make_shared<Mask>(mask)}; };
  CHECK_THROWS_AS(AnyDomain(shape, with(Mask(3, 18))), UsageError);
  CHECK_THROWS_AS(AnyDomain(shape, with(Mask(16, 17))), UsageError);
  Mask all(16, 18);
  for (Index f = 0; f < 18; ++f) all.close_simplex(f);
  CHECK_THROWS_AS(AnyDomain(shape, with(all)), InputError);
  const ::testing::Folder folder;
  CHECK_THROWS_AS(AnyDomain(shape, with(Mask(16, 18))).keep(folder.at("a.plexway")), UsageError);
  CHECK(folder.files() == 0);
}

}  // namespace plexway::testing::masked_test
