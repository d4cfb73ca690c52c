// What is done on a domain besides solving, for domains of any kind: every cell of that table
// (support.hpp, Purpose). Every yes is right by the closed form, every no says its sentence.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <plexway/any/complex.hpp>
#include <plexway/any/isolines.hpp>
#include <plexway/any/scene.hpp>
#include <plexway/any_domain.hpp>
#include <plexway/apps/farthest_points.hpp>
#include <plexway/complex/kuhn_grid.hpp>
#include <plexway/error.hpp>

#include "complex/test_meshes.hpp"
#include "complex/test_solids.hpp"
#include "folder.hpp"

using namespace plexway;
using namespace plexway::testing;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

/// A convex domain of a kind, straight lines or bars, and where its vertices are.
struct Kind {
  AnyShape shape;
  std::vector<Position> places;

  [[nodiscard]] double distance(const Position& a, const Position& b) const {
    const double x = std::abs(a[0] - b[0]), y = std::abs(a[1] - b[1]);
    return shape.kind() == DomainKind::wireframe ? x + y : std::hypot(x, y, a[2] - b[2]);
  }
  [[nodiscard]] double from_first(std::size_t v) const { return distance(places[0], places[v]); }
  [[nodiscard]] Position place(const PointSource& p) const {
    if (p.vertex != none) return places[p.vertex];
    Position at{};
    const auto corners = shape.corners(p.simplex);
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) at[k] += p.barycentric[i] * places[corners[i]][k];
    return at;
  }
};

std::vector<Kind> all_kinds() {
  std::vector<Kind> all;
  const Surface square = grid(10, 10);
  all.push_back({AnyShape::surface(square.positions, square.faces), square.positions});
  const Solid cube = solid_cube(4);
  all.push_back({AnyShape::solid(cube.positions, cube.tets), cube.positions});
  std::vector<Position> points;
  std::vector<std::array<Index, 2>> bars;
  for (Index v = 0; v < 100; ++v) {
    points.push_back({0.1 * (v % 10), 0.1 * (v / 10), 0});
    if (v % 10 > 0) bars.push_back({v - 1, v});
    if (v >= 10) bars.push_back({v - 10, v});
  }
  all.push_back({AnyShape::wireframe(points, bars), points});
  const KuhnGrid<2> kuhn({8, 8}, {0.1, 0.1});
  SimplexShape simplices{.dimension = 2, .axes = 2};
  simplices.positions = kuhn.positions();
  simplices.vertices = kuhn.vertex_count();
  for (const auto& s : kuhn.simplices())
    simplices.corners.insert(simplices.corners.end(), s.begin(), s.end());
  std::vector<Position> flat;
  for (Index v = 0; v < kuhn.vertex_count(); ++v)
    flat.push_back({kuhn.position(v)[0], kuhn.position(v)[1], 0});
  all.push_back({AnyShape::simplices(simplices), flat});
  MixedShape mixed;
  for (const double from : {0., 1.}) {
    mixed.parts.push_back(
        {.first_vertex = mixed.positions.size(), .vertices = square.positions.size()});
    for (Position p : square.positions) p[0] += from, mixed.positions.push_back(p);
    for (auto f : square.faces) {
      for (Index& v : f) v += static_cast<Index>(mixed.parts.back().first_vertex);
      mixed.parts.back().triangles.push_back(f);
    }
  }
  mixed.tolerance = 1e-9;
  all.push_back({AnyShape::mixed(mixed), mixed.positions});
  try {
    io::Points cloud;
    cloud.positions = points;
    all.push_back({AnyShape::cloud(cloud), points});
  } catch (const NotBuiltError&) {
    WARN("no clouds in this build");
  }
  return all;
}

AnyDomain exactly(const Kind& kind, BuildOptions options = {}) {
  options.precision = Precision::twice;
  return AnyDomain(kind.shape, options);
}

/// Every vertex against the closed form: `scale` times it, unreached where `open` is false.
void check_field(const Kind& kind, const AnyField& field, double scale = 1,
                 const std::function<bool(const Position&)>& open = {}) {
  for (std::size_t v = 0; v < kind.places.size(); ++v) {
    const bool reached = !open || open(kind.places[v]);
    INFO("vertex " << v);
    CHECK(field[v] ==
          (reached ? Approx(scale * kind.from_first(v)).epsilon(1e-6).margin(1e-9) : Approx(inf)));
  }
}

// Inside of a simplex, away from the source.
PointSource inside(const Kind& kind) {
  PointSource at{.simplex = static_cast<Index>(kind.shape.simplices() * 2 / 3)};
  const std::size_t corners = kind.shape.corners(at.simplex).size();
  for (std::size_t i = 0; i < corners; ++i)
    at.barycentric[i] = (i == 0 ? 0.75 : 0.25 / static_cast<double>(corners - 1));
  return at;
}

// Does it, or throws the sentence. `use` asks outside of a CHECK first.
void check(const Kind& kind, Purpose purpose, const std::function<void()>& use) {
  const Support found = support(purpose, kind.shape.kind());
  INFO(kind_name(kind.shape.kind()) << ", purpose " << static_cast<int>(purpose));
  if (found)
    use();
  else
    CHECK_THROWS_WITH(use(), found.sentence());
}

}  // namespace

TEST_CASE("what is done with a field of any domain") {
  for (const Kind& kind : all_kinds()) {
    const AnyDomain domain = exactly(kind);
    const PointSource source = PointSource::at(0);
    const AnyPathField field = domain.path_field(Serial{}, std::span(&source, 1));
    check_field(kind, field.field());
    check(kind, Purpose::paths, [&] {
      for (Index v = 0; v < kind.places.size(); v += 7) {
        const double length = field.trace(PointSource::at(v)).length;
        CHECK(length == Approx(kind.from_first(v)).epsilon(1e-6).margin(1e-9));
      }
    });
    check(kind, Purpose::read_out, [&] {
      const PointSource at = kind.shape.cloud() ? PointSource::in(0, {.2, .3, .5}) : inside(kind);
      const double read = field.at(at);
      CHECK(read == Approx(kind.distance(kind.places[0], kind.place(at))).epsilon(1e-6));
    });
    if (support(Purpose::read_out, kind.shape.kind()))
      CHECK(field.at(PointSource::at(7)) == Approx(kind.from_first(7)).epsilon(1e-6));
    check(kind, Purpose::directions, [&] {
      const auto found = field.gradient();
      REQUIRE(found.size() == kind.shape.simplices());
      const std::size_t s = inside(kind).simplex;
      PointSource centre{.simplex = static_cast<Index>(s)};
      const std::size_t corners = kind.shape.corners(s).size();
      for (std::size_t i = 0; i < corners; ++i)
        centre.barycentric[i] = 1 / static_cast<double>(corners);
      const Position p = kind.place(centre);
      double along = 0;
      for (std::size_t k = 0; k < 3; ++k) along += found[s][k] * p[k];
      CHECK(along > 0.998 * std::hypot(p[0], p[1], p[2]));
    });
    check(kind, Purpose::isolines, [&] {
      const double value = 0.45;
      const auto lines = isolines(domain, field.field(), std::span(&value, 1));
      REQUIRE_FALSE(lines.empty());
      for (const Path& line : lines)
        for (const auto& p : line.positions)
          CHECK(std::hypot(p[0], p[1]) == Approx(value).epsilon(1e-2));
    });
    check(kind, Purpose::pictures, [&] {
      const auto distance = field.field().doubles();
      SceneContent content;
      content.distance = distance;
      const ShapeScene scene(kind.shape, content);
      REQUIRE_FALSE(scene.scene().parts.empty());
      CHECK(scene.scene().parts[0].positions.size() == kind.places.size());
    });
    check(kind, Purpose::samples, [&] {
      const auto found = with_sampled(domain, [&](const auto& complex) {
        return farthest_points(Serial{}, complex, std::span(&source, 1), {.count = 2});
      });
      REQUIRE(found.points.size() == 2);
      CHECK(found.distance[1] == Approx(kind.distance(kind.places[0], kind.places.back())));
    });
  }
}

TEST_CASE("how a domain of any kind is made") {
  const ::testing::Folder folder;
  for (const Kind& kind : all_kinds()) {
    const PointSource source = PointSource::at(0);
    check(kind, Purpose::masks, [&] {
      // Half of it is closed; what is left is convex.
      auto mask = std::make_shared<Mask>(kind.shape.vertices(), kind.shape.simplices());
      const auto open = [](const Position& p) { return p[0] < 0.55; };
      for (std::size_t v = 0; v < kind.places.size(); ++v)
        if (!open(kind.places[v])) mask->close_vertex(static_cast<Index>(v));
      check_field(kind, exactly(kind, {.mask = mask}).solve(Serial{}, source), 1, open);
    });
    check(kind, Purpose::metrics, [&] {
      const metric::SimplexSpeeds twice{
          std::vector<double>(std::max<std::size_t>(kind.shape.simplices(), 1), 2)};
      const auto lengths = std::make_shared<const MeasuredLengths>(kind.shape.measure(twice));
      check_field(kind, exactly(kind, {.lengths = lengths}).solve(Serial{}, source), 0.5);
    });
    check(kind, Purpose::triangulations, [&] {
      check_field(
          kind, exactly(kind, {.triangulation = Triangulation::delaunay}).solve(Serial{}, source));
    });
    check(kind, Purpose::kept_builds, [&] {
      const auto file = folder.at(std::string(kind_name(kind.shape.kind())) + ".plexway");
      const AnyDomain domain = exactly(kind);
      domain.keep(file);
      const AnyDomain opened = AnyDomain::read(file, {}, {.precision = Precision::twice});
      CHECK(opened.solve(Serial{}, source).doubles() == domain.solve(Serial{}, source).doubles());
    });
  }
}
