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

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/sampling/farthest_points.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/isolines.hpp>
#include <plexway/shape/scene.hpp>
#include <plexway/shape/search.hpp>

#include "folder.hpp"
#include "shape/kinds.hpp"

namespace purposes_test {

using namespace any_testing;

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
      // Of any numbers: heights have straight lines.
      std::vector<double> height;
      for (const Position& p : kind.places) height.push_back(p[1]);
      const auto levels = isolines(domain, height, std::span(&value, 1));
      REQUIRE_FALSE(levels.empty());
      for (const Path& line : levels)
        for (const auto& p : line.positions) CHECK(p[1] == Approx(value).epsilon(1e-9));
    });
    check(kind, Purpose::places, [&] {
      CHECK(kind.shape.closest(kind.places[7]).vertex == 7);
      CHECK(kind.shape.position(PointSource::at(7)) == kind.places[7]);
    });
    check(kind, Purpose::astar, [&] {
      const PointSource far = PointSource::at(static_cast<Index>(kind.places.size() - 1));
      const SearchResult found = find_paths(domain, std::span(&source, 1), std::span(&far, 1));
      CHECK(found.distance[0] == Approx(kind.from_first(far.vertex)).epsilon(1e-5));
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
      const AnyDomain opened = AnyDomain::read(file, {}, {.precision = Precision::float64});
      CHECK(opened.solve(Serial{}, source).doubles() == domain.solve(Serial{}, source).doubles());
    });
  }
}

}  // namespace purposes_test
