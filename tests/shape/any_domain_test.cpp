// The facade beside the calls that it stands for: the same bits for every kind and precision.

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <thread>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/paths/cloud_path_field.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "folder.hpp"
#include "with_accuracy.hpp"

namespace plexway::any_domain_test {

namespace {

namespace meshes = plexway::testing;
using meshes::Surface;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<std::array<Index, 2>> edges_of(const Surface& surface) {
  std::set<std::array<Index, 2>> edges;
  for (const auto& f : surface.faces)
    for (std::size_t i = 0; i < 3; ++i)
      edges.insert({std::min(f[i], f[(i + 1) % 3]), std::max(f[i], f[(i + 1) % 3])});
  return {edges.begin(), edges.end()};
}

template <class Real>
BuildOptions as_given() {
  return {.precision = std::is_same_v<Real, float> ? Precision::float32 : Precision::float64,
          .triangulation = Triangulation::input};
}

// Both solved from the same sources by the same executor: not a bit apart.
template <class Complex>
void check_same(const AnyDomain& any, const Complex& complex, const AnyExecutor& executor,
                const SourceList& sources, const PropagateOptions& options = {}) {
  using Real = RealOf<Complex>;
  const AnyField field = any.solve(executor, sources, options);
  const DistanceField<Real> direct = std::holds_alternative<OpenMP>(executor)
                                         ? [&] {
                                             if constexpr (supports<OpenMP, Complex>)
                                               return solve(std::get<OpenMP>(executor), complex,
                                                            sources, options);
                                             else
                                               return DistanceField<Real>();
                                           }()
                                         : solve(Serial{}, complex, sources, options);
  const auto& got = std::get<DistanceField<Real>>(field.data);
  REQUIRE(direct.distance.size() == any.vertices());
  CHECK(got.distance == direct.distance);
  CHECK(got.label == direct.label);
  CHECK(got.complete == direct.complete);
  CHECK(got.statistics.expansions == direct.statistics.expansions);
  // Again, into memory that was used: still the same.
  AnyField again = any.solve(executor, PointSource::at(1), options);
  any.solve(executor, sources, options, again);
  CHECK(std::get<DistanceField<Real>>(again.data).distance == direct.distance);
}

template <class Complex>
void check_kind(const AnyDomain& any, const Complex& complex) {
  const std::vector<PointSource> two = {PointSource::at(3), PointSource::at(17)};
  check_same(any, complex, Serial{}, PointSource::at(5));
  check_same(any, complex, Serial{}, two);
  check_same(any, complex, Serial{}, VertexSource{.vertices = {2, 9}, .offsets = {0.25, 0}});
  check_same(any, complex, Serial{}, PointSource::at(5), {.radius = 0.5});
  check_same(any, complex, Serial{}, PointSource::at(5), {.max_expansions = 10});
  if constexpr (supports<OpenMP, Complex>)
    if (openmp_built()) check_same(any, complex, OpenMP{.threads = 2}, two);
  // Many at once: each as it is alone, whoever runs it.
  std::vector<PointSource> many;
  for (Index v = 0; v < 11; ++v) many.push_back(PointSource::at(2 * v));
  std::vector<double> rows(many.size() * any.vertices(), -1);
  CHECK(any.solve_each(Serial{}, many, {}, std::span(rows)));
  for (std::size_t k = 0; k < many.size(); ++k) {
    const auto alone = solve(Serial{}, complex, many[k]);
    for (std::size_t v = 0; v < any.vertices(); ++v)
      REQUIRE(rows[k * any.vertices() + v] == static_cast<double>(alone.distance[v]));
  }
  if (openmp_built()) {
    std::vector<double> shared(rows.size(), -1);
    CHECK(any.solve_each(OpenMP{.threads = 3}, many, {}, std::span(shared)));
    CHECK(shared == rows);
  }
  CHECK_THROWS_AS(any.solve_each(Serial{}, many, {}, std::span(rows).first(7)), UsageError);
}

template <class Real>
void check_surface() {
  const Surface grid = meshes::slit_square(9);
  const AnyDomain any(AnyShape::surface(grid.positions, grid.faces), as_given<Real>());
  const TriangleMesh<Real> mesh(grid.positions, grid.faces);
  check_kind(any, mesh);
  CHECK(any.kind() == DomainKind::surface);
  CHECK(any.simplices() == grid.faces.size());
  CHECK(any.components() == mesh.summary().components);
  check_same(any, mesh, Serial{}, PointSource::in(7, {0.2, 0.3, 0.5}));

  const PointSource source = PointSource::at(0), target = PointSource::in(11, {0.1, 0.6, 0.3});
  PathField field(mesh, grid.positions);
  field.solve(Serial{}, source);
  const AnyPathField paths = any.path_field(Serial{}, std::span(&source, 1));
  CHECK(paths.trace(target).length == field.trace(target).length);
  CHECK(paths.trace(target).positions == field.trace(target).positions);
  CHECK(paths.at(target) == field.at(target));
  CHECK(paths.gradient() == field.gradient());
}

}  // namespace

TEST_CASE("any domain: surfaces as the direct calls have them") {
  check_surface<float>();
  check_surface<double>();
}

TEST_CASE("any domain: solids, wireframes and simplices as the direct calls have them") {
  const auto solid = meshes::solid_cube(4);
  const Surface grid = meshes::grid(9, 8, 2, 1);
  const auto edges = edges_of(grid);
  const auto of = [&](auto real) {
    using Real = decltype(real);
    check_kind(AnyDomain(AnyShape::solid(solid.positions, solid.tets), as_given<Real>()),
               TetMesh<Real>(solid.positions, solid.tets));
    check_kind(AnyDomain(AnyShape::wireframe(grid.positions, edges), as_given<Real>()),
               Wireframe<Real>(grid.positions, edges));
    std::vector<double> flat;
    std::vector<Index> corners;
    for (const auto& p : grid.positions) flat.insert(flat.end(), {p[0], p[1]});
    for (const auto& f : grid.faces) corners.insert(corners.end(), f.begin(), f.end());
    check_kind(AnyDomain(AnyShape::simplices({.dimension = 2,
                                              .vertices = grid.positions.size(),
                                              .axes = 2,
                                              .positions = flat,
                                              .corners = corners}),
                         as_given<Real>()),
               SimplicialComplex<Real, 2>(flat, 2, grid.faces));
  };
  of(float{});
  of(double{});
}

TEST_CASE("any domain: lengths alone as the direct calls have them") {
  const Surface ball = meshes::sphere(2);
  const auto lengths = meshes::lengths_of(ball);
  check_kind(
      AnyDomain(AnyShape::surface(ball.positions.size(), ball.faces, lengths), as_given<double>()),
      TriangleMesh<double>(ball.positions.size(), ball.faces, lengths));
  const std::vector<std::array<Index, 2>> edges = {{0, 1}, {1, 2}, {2, 3}, {0, 3}};
  const AnyDomain ring(AnyShape::wireframe(5, edges, {1, 2, 3, 4}), as_given<double>());
  CHECK(ring.solve(Serial{}, PointSource::at(0)).doubles() ==
        std::vector<double>{0, 1, 3, 4, infinity});
  CHECK_THROWS_AS(ring.shape().closest({0, 0, 0}), UsageError);
  // A 4-simplex with all lengths 1.
  const AnyDomain four(AnyShape::simplices({.dimension = 4,
                                            .vertices = 5,
                                            .corners = {0, 1, 2, 3, 4},
                                            .lengths = std::vector<double>(10, 1)}),
                       as_given<double>());
  CHECK(four.kind() == DomainKind::simplices);
  const AnyField field = four.solve(Serial{}, PointSource::at(2));
  for (std::size_t v = 0; v < 5; ++v) CHECK(field[v] == Approx(v == 2 ? 0 : 1).margin(1e-15));
}

#ifdef PLEXWAY_HAS_FLANN
TEST_CASE("any domain: clouds as the direct calls have them") {
  std::mt19937 random(5);
  io::Points points;
  for (int i = 0; i < 600; ++i)
    points.positions.push_back({meshes::uniform(random), meshes::uniform(random), 0});
  const AnyShape shape = AnyShape::cloud(points);
  REQUIRE(shape.cloud() != nullptr);
  const auto of = [&](auto real) {
    using Real = decltype(real);
    const PointCloud<Real> cloud(shape.cloud()->measured(), shape.cloud()->neighbours);
    const AnyDomain any(shape, as_given<Real>());
    check_kind(any, cloud);
    REQUIRE(any.cloud() != nullptr);
    CHECK(any.cloud()->triangles == cloud.summary().triangles);
    CHECK(any.simplices() == cloud.summary().triangles);
    const PointSource source = PointSource::at(4);
    PathField field(cloud, points.positions);
    field.solve(Serial{}, source);
    CHECK(any.path_field(Serial{}, std::span(&source, 1)).trace(PointSource::at(77)).length ==
          field.trace(77).length);
  };
  of(float{});
  of(double{});
}
#endif

TEST_CASE("any domain: a surface is solved on the triangles that pay") {
  // Needles across, so that nearly all edges are not Delaunay.
  const Surface grid = meshes::grid(40, 4, 1, 1);
  const AnyShape shape = AnyShape::surface(grid.positions, grid.faces);
  const auto made = triangulate<float>(grid.positions, grid.faces, Retriangulation::refined);
  REQUIRE(made.delaunay.has_value());
  const AnyDomain any(shape, {.triangulation = Triangulation::refined});
  CHECK(any.triangulation().done == Triangulation::refined);
  CHECK(any.triangulation().inserted_vertices == made.delaunay->summary().inserted_vertices);
  const PointSource source = PointSource::in(100, {0.2, 0.2, 0.6});
  const auto at = shape.position(source);
  for (const auto& [accuracy, off] :
       {std::pair(Accuracy::fast(), 1e-5), {Accuracy::usual(), 5e-5}}) {
    const PropagateOptions options = meshes::at(accuracy);
    auto direct = solve(Serial{}, made.mesh, made.delaunay->to_intrinsic(source), options);
    direct.distance.resize(grid.positions.size());
    const AnyField field = any.solve(Serial{}, source, options);
    CHECK(std::get<DistanceField<float>>(field.data).distance == direct.distance);
    for (std::size_t v = 0; v < field.size(); ++v) {
      const auto& p = grid.positions[v];
      CHECK(field[v] == Approx(std::hypot(p[0] - at[0], p[1] - at[1])).epsilon(off).margin(1e-6));
    }
  }
  // Lines lie in the triangles of the shape.
  const std::vector<PointSource> ends = {PointSource::at(0), PointSource::at(40)};
  const CurveSource line = shape.joined(ends);
  const AnyDomain twice(shape,
                        {.precision = Precision::float64, .triangulation = Triangulation::refined});
  CHECK_THROWS_WITH(twice.solve(Serial{}, line),
                    support(Triangulation::refined, SourceKind::curve).sentence());
  CHECK(static_cast<bool>(support(Triangulation::automatic, SourceKind::curve)));
  const AnyDomain open(shape, {.precision = Precision::float64});
  const AnyField from_line = open.solve(Serial{}, line);
  CHECK(from_line.triangulation.done == Triangulation::input);
  for (std::size_t v = 0; v < from_line.size(); ++v)
    CHECK(from_line[v] == Approx(grid.positions[v][1]).margin(1e-9));
  // Paths and points in triangles are those of the shape.
  const AnyPathField paths = any.path_field(Serial{}, std::span(&source, 1));
  const PointSource target = PointSource::in(9, {0.3, 0.3, 0.4});
  const auto to = shape.position(target);
  const double straight = std::hypot(to[0] - at[0], to[1] - at[1]);
  const Path path = paths.trace(target);
  CHECK(path.length == Approx(straight).epsilon(1e-13));
  CHECK(path.positions.front() == to);
  for (std::size_t i = 0; i < path.points.size(); ++i)
    CHECK(path.points[i].simplex < shape.simplices());
  CHECK(paths.at(target) == Approx(straight).epsilon(1e-5));
}

TEST_CASE("any domain: many threads solve on one domain") {
  const Surface ball = meshes::sphere(4);
  const AnyDomain any(AnyShape::surface(ball.positions, ball.faces));
  std::vector<AnyField> alone;
  for (Index s = 0; s < 8; ++s) alone.push_back(any.solve(Serial{}, PointSource::at(31 * s)));
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (Index t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      AnyField field;
      for (Index n = 0; n < 16; ++n) {
        const Index s = (n * 3 + t) % 8;
        any.solve(Serial{}, PointSource::at(31 * s), {}, field);
        if (field.doubles() != alone[s].doubles()) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}

TEST_CASE("any domain: callbacks end a solve and the next one is right") {
  const Surface grid = meshes::grid(300, 300);
  const AnyDomain any(AnyShape::surface(grid.positions, grid.faces));
  const auto before = any.solve(Serial{}, PointSource::at(0)).doubles();
  PropagateOptions never;
  never.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(any.solve(Serial{}, PointSource::at(0), never), Cancelled);
  CHECK(any.solve(Serial{}, PointSource::at(0)).doubles() == before);
}

TEST_CASE("any domain: what does not go together is refused by the table's sentence") {
  const Surface grid = meshes::grid(4, 4);
  const AnyDomain single(AnyShape::surface(grid.positions, grid.faces), as_given<float>());
  const SimplexSource triangle{.simplex = 3};
  PropagateOptions labels;
  labels.accuracy = Accuracy::fast();
  const Support no = single.support(Serial{}, triangle, labels);
  CHECK(no.refusal() == Refusal::shapes_float);
  CHECK_THROWS_WITH(single.solve(Serial{}, triangle, labels), no.sentence());
  CHECK(static_cast<bool>(single.support(Serial{}, triangle)));
  CHECK(static_cast<bool>(single.support(Serial{}, PointSource::at(0))));
  const AnyDomain twice(AnyShape::surface(grid.positions, grid.faces), as_given<double>());
  CHECK(twice.support(GL{}, PointSource::at(0)).refusal() == Refusal::gl_double);
  CHECK_THROWS_AS(twice.solve(GL{}, PointSource::at(0)), UsageError);
  CHECK_THROWS_AS(AnyShape::surface(grid.positions, {{0, 1, 99}}), InputError);
  CHECK_THROWS_AS(AnyShape::simplices({.dimension = 5}), InputError);
  CHECK_THROWS_AS(AnyDomain(AnyShape::wireframe(grid.positions, edges_of(grid)),
                            {.triangulation = Triangulation::delaunay}),
                  UsageError);
}

TEST_CASE("any domain: speeds by a metric") {
  const Surface grid = meshes::grid(6, 6);
  const AnyShape shape = AnyShape::surface(grid.positions, grid.faces);
  BuildOptions options = as_given<double>();
  options.lengths = std::make_shared<const MeasuredLengths>(
      shape.measure(metric::SimplexSpeeds{.speed = std::vector<double>(grid.faces.size(), 4.0)}));
  const AnyField fast = AnyDomain(shape, options).solve(Serial{}, PointSource::at(0));
  for (std::size_t v = 0; v < fast.size(); ++v)
    CHECK(fast[v] ==
          Approx(std::hypot(grid.positions[v][0], grid.positions[v][1]) / 4).margin(1e-12));
}

TEST_CASE("any domain: a file is as its arrays") {
  const ::testing::Folder folder;
  const Surface ball = meshes::sphere(3);
  const auto file = folder.path() / "ball.obj";
  io::write_triangles(file, {ball.positions, ball.faces});
  const AnyDomain read = AnyDomain::read(file);
  const AnyDomain made(AnyShape::surface(ball.positions, ball.faces));
  CHECK(read.shape().file() == file);
  CHECK(read.solve(Serial{}, PointSource::at(9)).doubles() ==
        made.solve(Serial{}, PointSource::at(9)).doubles());
  const AnyDomain wires = AnyDomain::read(file, {.as = DomainKind::wireframe});
  CHECK(wires.simplices() == edges_of(ball).size());
  CHECK_THROWS_WITH(AnyShape::read(file, {.cloud = {.k = 3}}),
                    Catch::Contains("need a cloud") && !Catch::Contains("--"));
  const auto out = folder.path() / "out.npy";
  read.shape().write_field(out, made.solve(Serial{}, PointSource::at(9)).doubles());
  CHECK(std::filesystem::file_size(out) > 8 * ball.positions.size());
}

TEST_CASE("any domain: regions of a mixed domain with speeds of their own") {
  // Two unit squares side by side, the right one twice as fast, and a wire, four times as fast.
  const Surface grid = meshes::grid(16, 8, 2, 1);
  MixedShape shape;
  shape.positions = grid.positions;
  MixedShape::Part part;
  part.triangles = grid.faces;
  const Index start = grid.nearest(0, 0.5), end = grid.nearest(2, 0.5);
  const auto far = static_cast<Index>(shape.positions.size());
  shape.positions.push_back({2, 0.5, 8});
  part.edges = {{end, far}};
  part.vertices = shape.positions.size();
  shape.parts = {part};
  const AnyShape mixed = AnyShape::mixed(shape);
  metric::SimplexSpeeds speeds{.speed = {4}};
  for (const auto& f : part.triangles) {
    double x = 0;
    for (const Index v : f) x += shape.positions[v][0] / 3;
    speeds.speed.push_back(x < 1 ? 1 : 2);
  }
  BuildOptions options = as_given<double>();
  options.lengths = std::make_shared<const MeasuredLengths>(mixed.measure(speeds));
  const AnyDomain any(mixed, options);
  CHECK(any.components() == 1);
  const AnyField field = any.solve(Serial{}, PointSource::at(start));
  CHECK(field[end] == Approx(1.5).epsilon(1e-9));
  // The wire starts from what the triangles at its end have, before vertices are read out.
  CHECK(field[far] == Approx(1.5 + 2).epsilon(1e-5));
  double worst = 0, mean = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < grid.positions.size(); ++v) {
    const auto& p = grid.positions[v];
    if (p[0] < 1 - 1e-9) continue;  // there fast ways along the middle may be shorter
    double exact = infinity;
    for (int i = 0; i <= 20000; ++i) {
      const double y = i / 20000.;
      exact = std::min(exact, std::hypot(1, y - 0.5) + std::hypot(p[0] - 1, p[1] - y) / 2);
    }
    worst = std::max(worst, std::abs(field[v] / exact - 1));
    mean += std::abs(field[v] / exact - 1);
    ++count;
  }
  CAPTURE(worst, mean / static_cast<double>(count));
  // As docs/contributing/methods/mixed.md has it for domains whose pieces are of different speed.
  CHECK(worst < 4e-3);
  CHECK(mean / static_cast<double>(count) < 2e-4);
  // From a point of a triangle, by the shape's number of it.
  const PointSource inside = mixed.closest({1.9, 0.5, 0});
  CHECK(inside.simplex != none);
  CHECK(any.solve(Serial{}, inside)[far] == Approx(0.05 + 2).epsilon(1e-9));
  CHECK_THROWS_AS(mixed.measure(metric::SimplexSpeeds{.speed = {1, 2}}), InputError);
  CHECK_THROWS_AS(mixed.measure(metric::VertexTensors{}), UsageError);
}

TEST_CASE("any domain: a mixed domain over shared vertices") {
  // A cube, a sheet that goes on from its edge x = 1, z = 0, and a wire from the sheet's far
  // corner.
  const auto cube = meshes::solid_cube(3, 0);
  MixedShape shape;
  shape.positions = cube.positions;
  MixedShape::Part part;
  part.tets = cube.tets;
  std::vector<std::array<Index, 2>> row;  // below: of the cube; the other side: new
  std::vector<Index> rim;
  for (Index v = 0; v < cube.positions.size(); ++v)
    if (std::abs(cube.positions[v][0] - 1) < 1e-12 && std::abs(cube.positions[v][2]) < 1e-12)
      rim.push_back(v);
  std::sort(rim.begin(), rim.end(),
            [&](Index a, Index b) { return cube.positions[a][1] < cube.positions[b][1]; });
  REQUIRE(rim.size() == 4);
  for (const Index v : rim) {
    const auto& p = cube.positions[v];
    row.push_back({v, static_cast<Index>(shape.positions.size())});
    shape.positions.push_back({p[0] + 1, p[1], p[2]});
  }
  for (std::size_t i = 0; i + 1 < row.size(); ++i) {
    part.triangles.push_back({row[i][0], row[i][1], row[i + 1][1]});
    part.triangles.push_back({row[i][0], row[i + 1][1], row[i + 1][0]});
  }
  const auto end = static_cast<Index>(shape.positions.size());
  shape.positions.push_back({2, 1, 5});
  part.edges = {{row.back()[1], end}};
  const auto alone = static_cast<Index>(shape.positions.size());
  shape.positions.push_back({9, 9, 9});  // in no simplex
  part.vertices = shape.positions.size();
  shape.parts = {part};
  const AnyShape mixed = AnyShape::mixed(shape);
  const AnyDomain any(mixed, as_given<double>());
  CHECK(any.kind() == DomainKind::mixed);
  CHECK(any.components() == 1);
  CHECK(mixed.dimension() == 3);
  CHECK(mixed.simplices() == part.edges.size() + part.triangles.size() + part.tets.size());
  CHECK(mixed.corners(0).size() == 2);
  CHECK(mixed.corners(1).size() == 3);
  // From the wire's end: 5 along it, then straight over the sheet and through the cube's floor.
  const AnyField field = any.solve(Serial{}, PointSource::at(end));
  double worst = 0;
  for (std::size_t v = 0; v < field.size(); ++v) {
    if (v == end || v == alone) continue;
    const auto& p = shape.positions[v];
    const double over = std::hypot(2 - p[0], 1 - p[1]);
    if (p[2] == 0) worst = std::max(worst, std::abs(field[v] / (5 + over) - 1));
  }
  CHECK(worst < 1e-6);
  CHECK(field[end] == 0);
  CHECK(field[alone] == infinity);
  CHECK(field[row.back()[1]] == Approx(5));
  CHECK_THROWS_AS(any.solve(Serial{}, PointSource::at(alone)), UsageError);
  if (openmp_built()) {
    const AnyField by_team = any.solve(OpenMP{.threads = 2}, PointSource::at(end));
    for (std::size_t v = 0; v < shape.positions.size(); ++v) CHECK(by_team[v] == field[v]);
  }
  // A point of the wire, by the shape's numbers.
  const PointSource middle = mixed.closest({2, 1, 2.5});
  CHECK(middle.simplex == 0);
  const AnyField from = any.solve(Serial{}, middle);
  CHECK(from[end] == Approx(2.5));
  CHECK(from[row.back()[1]] == Approx(2.5));
}

}  // namespace plexway::any_domain_test
