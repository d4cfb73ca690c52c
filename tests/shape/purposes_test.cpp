#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/sampling/farthest_points.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/isolines.hpp>
#include <plexway/shape/scene.hpp>
#include <plexway/shape/search.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "folder.hpp"
#include "shape/files/files.hpp"
#include "shape/kinds.hpp"

namespace purposes_test {

// What is done on a domain besides solving, for domains of any kind: every cell of that table
// (support.hpp, Purpose). Every yes is right by the closed form, every no says its sentence.

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

// Domains by lengths alone: what draws and measures in space is refused by the table (support.hpp,
// shape/support.hpp), what does not is right.

using Catch::Matchers::EndsWith;

namespace {

double between(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

// Each kind that may be told by lengths, with the places that its lengths are of.
std::vector<Kind> by_lengths() {
  std::vector<Kind> all;
  for (const Kind& kind : all_kinds()) {
    const auto length = [&](std::size_t s, std::size_t i, std::size_t j) {
      const auto corner = kind.shape.corners(s);
      return between(kind.places[corner[i]], kind.places[corner[j]]);
    };
    const std::size_t n = kind.places.size(), simplices = kind.shape.simplices();
    if (const auto* surface = std::get_if<io::Triangles>(&kind.shape.data())) {
      std::vector<std::array<double, 3>> rows;
      for (std::size_t s = 0; s < simplices; ++s)
        rows.push_back({length(s, 0, 1), length(s, 1, 2), length(s, 2, 0)});
      all.push_back({AnyShape::surface(n, surface->triangles, rows), kind.places});
    } else if (const auto* solid = std::get_if<io::Tets>(&kind.shape.data())) {
      std::vector<std::array<double, 6>> rows;
      for (std::size_t s = 0; s < simplices; ++s)
        rows.push_back({length(s, 0, 1), length(s, 0, 2), length(s, 1, 2), length(s, 0, 3),
                        length(s, 1, 3), length(s, 2, 3)});
      all.push_back({AnyShape::solid(n, solid->tets, rows), kind.places});
    } else if (const auto* wires = std::get_if<io::Edges>(&kind.shape.data())) {
      std::vector<double> rows;
      for (std::size_t s = 0; s < simplices; ++s) rows.push_back(length(s, 0, 1));
      all.push_back({AnyShape::wireframe(n, wires->edges, rows), kind.places});
    } else if (const auto* given = std::get_if<SimplexShape>(&kind.shape.data())) {
      SimplexShape shape = *given;
      shape.positions.clear(), shape.axes = 0;
      for (std::size_t s = 0; s < simplices; ++s)
        for (std::size_t j = 1; j < 3; ++j)
          for (std::size_t i = 0; i < j; ++i) shape.lengths.push_back(length(s, i, j));
      all.push_back({AnyShape::simplices(shape), kind.places});
    }
  }
  return all;
}

}  // namespace

TEST_CASE("what goes by lengths alone, and what needs positions") {
  const ::testing::Folder folder;
  for (const Kind& kind : by_lengths()) {
    const AnyShape& shape = kind.shape;
    INFO(kind_name(shape.kind()));
    const AnyDomain domain = exactly(kind);
    const PointSource source = PointSource::at(0);
    const AnyPathField field = domain.path_field(Serial{}, std::span(&source, 1));
    check_field(kind, field.field());
    const std::vector<double> distance = field.field().doubles();
    const double value = 0.45;
    const auto check = [&](Purpose purpose, const std::function<void()>& use) {
      const Support found = support(purpose, shape);
      INFO("purpose " << static_cast<int>(purpose));
      if (found)
        use();
      else
        CHECK_THROWS_WITH(use(), EndsWith(found.sentence()));
    };
    for (const Purpose purpose :
         {Purpose::places, Purpose::isolines, Purpose::arcs, Purpose::isosurfaces,
          Purpose::pictures, Purpose::parts, Purpose::volumes, Purpose::lines, Purpose::directions,
          Purpose::tensors})
      CHECK_FALSE(static_cast<bool>(support(purpose, shape)));
    check(Purpose::places, [&] { (void)shape.closest({0, 0, 0}); });
    check(Purpose::places, [&] { (void)shape.position(source); });
    check(Purpose::isolines, [&] { (void)isolines(domain, distance, std::span(&value, 1)); });
    check(Purpose::arcs, [&] { (void)isolines(shape, field, std::span(&value, 1), 1e-3); });
    check(Purpose::arcs, [&] { (void)fine_field(shape, field, 1e-3); });
    check(Purpose::isosurfaces, [&] { (void)isosurfaces(shape, distance, std::span(&value, 1)); });
    check(Purpose::pictures, [&] { (void)ShapeScene(shape, {}); });
    check(Purpose::parts, [&] { check_partitioned(shape, folder.at("a.pvtu")); });
    check(Purpose::volumes, [&] { shape.write_field(folder.at("a.vdb"), distance); });
    check(Purpose::lines, [&] { (void)shape.joined(std::span(&source, 1)); });
    check(Purpose::directions, [&] { (void)field.gradient(); });
    const auto half = [&](Purpose purpose, const metric::Metric& metric) {
      check(purpose, [&] {
        const auto lengths = std::make_shared<const MeasuredLengths>(shape.measure(metric));
        check_field(kind, exactly(kind, {.lengths = lengths}).solve(Serial{}, source), 0.5);
      });
    };
    half(Purpose::metrics, metric::SimplexSpeeds{std::vector<double>(shape.simplices(), 2)});
    half(Purpose::tensors, metric::VertexTensors{std::vector<metric::Tensor>(
                               shape.vertices(), metric::Tensor::of_speed(2))});
    metric::GivenLengths given;
    for (std::size_t s = 0; s < shape.simplices(); ++s) {
      const auto corner = shape.corners(s);
      for (std::size_t i = 0; i < corner.size(); ++i)
        for (std::size_t j = i + 1; j < corner.size(); ++j)
          given.edges.push_back({corner[i], corner[j],
                                 0.5 * between(kind.places[corner[i]], kind.places[corner[j]])});
    }
    half(Purpose::given_lengths, given);
    if (support(Purpose::searches, shape)) {
      const PointSource far = PointSource::at(static_cast<Index>(kind.places.size() - 1));
      const SearchResult found = find_paths(domain, std::span(&source, 1), std::span(&far, 1));
      CHECK(found.distance[0] == Approx(kind.from_first(far.vertex)).epsilon(1e-5));
    }
  }
}

TEST_CASE("what domains themselves are asked") {
  const Solid cube = solid_cube(1, 0);
  const TetMesh<double> embedded(cube.positions, cube.tets);
  std::vector<std::array<double, 6>> rows;
  for (const auto& t : cube.tets) {
    const auto& p = cube.positions;
    const auto length = [&](std::size_t i, std::size_t j) { return between(p[t[i]], p[t[j]]); };
    rows.push_back(
        {length(0, 1), length(0, 2), length(1, 2), length(0, 3), length(1, 3), length(2, 3)});
  }
  const TetMesh<double> by_lengths(cube.positions.size(), cube.tets, rows);
  MixedComplex<double> mixed;
  CHECK(mixed.add(embedded).simplices == cube.tets.size());
  CHECK_THROWS_WITH(mixed.add(by_lengths), support(Purpose::pieces, by_lengths).sentence());
  for (const DomainKind kind : {DomainKind::simplices, DomainKind::cloud, DomainKind::mixed})
    CHECK_FALSE(static_cast<bool>(support(Purpose::pieces, kind)));  // by types
  metric::SimplexSpeeds speeds{std::vector<double>(cube.tets.size(), 1),
                               {.sides = metric::Sides::own}};
  CHECK_THROWS_WITH(metric::tet_lengths(cube.positions, cube.tets, speeds),
                    support_of_own_sides(DomainKind::solid).sentence());
  const Surface square = grid(2, 2);
  CHECK(static_cast<bool>(support_of_own_sides(DomainKind::surface)));
  speeds.speed.assign(square.faces.size(), 1);
  CHECK(metric::triangle_lengths(square.positions, square.faces, speeds).size() ==
        square.faces.size());
}

}  // namespace purposes_test
