#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/cloud.hpp>
#include <plexway/mixed.hpp>
#include <plexway/paths/bounded_search.hpp>
#include <plexway/paths/mixed_path_field.hpp>
#include <plexway/paths/path_search.hpp>
#include <plexway/paths/shorten.hpp>
#include <plexway/solid.hpp>
#include <plexway/surface.hpp>
#include <plexway/wireframe.hpp>

namespace plexway::testing::given_arrays_test {

namespace {

using Points = std::vector<std::array<double, 3>>;

// A rectangle of 4 by 3, or a tetrahedron over half of it.
Points corners() { return {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}; }
const std::vector<int> triangles = {0, 1, 2, 0, 2, 3};

// The same points in four other ways, each of which a use is called with.
template <class Use>
void in_each_way(const Points& points, const Use& use) {
  std::vector<std::array<float, 3>> singles;
  std::vector<std::int64_t> flat;
  Eigen::MatrixXf columns(points.size(), 3);
  for (const auto& p : points) {
    columns.row(std::ssize(singles)) << float(p[0]), float(p[1]), float(p[2]);
    singles.push_back({float(p[0]), float(p[1]), float(p[2])});
    for (const double x : p) flat.push_back(static_cast<std::int64_t>(x));
  }
  use(singles);
  use(flat);
  use(columns);
  use(std::vector<std::vector<double>>{{points[0].begin(), points[0].end()},
                                       {points[1].begin(), points[1].end()},
                                       {points[2].begin(), points[2].end()},
                                       {points[3].begin(), points[3].end()}});
}

// Memory that was given back is written to.
void fill_free_memory() {
  std::vector<std::unique_ptr<Points>> filled;
  for (int i = 0; i < 64; ++i)
    filled.push_back(std::make_unique<Points>(4, std::array<double, 3>{-7, -7, -7}));
}

}  // namespace

TEST_CASE("positions that would be gone after the line are kept") {
  const TriangleMesh<double> mesh(corners(), triangles);
  std::optional<PathField<TriangleMesh<double>>> first(std::in_place, mesh, corners());
  PathField<TriangleMesh<double>> moved = std::move(*first);
  first.reset();
  fill_free_memory();
  moved.solve(Serial{}, 0);
  CHECK(moved.trace(2).positions.front() == std::array<double, 3>{4, 3, 0});

  PathField given(mesh,
                  std::vector<std::array<float, 3>>{{0, 0, 1}, {4, 0, 1}, {4, 3, 1}, {0, 3, 1}});
  fill_free_memory();
  given.solve(Serial{}, 0);
  CHECK(given.trace(2).positions.back() == std::array<double, 3>{0, 0, 1});

  PathSearch search(mesh, corners());
  fill_free_memory();
  CHECK(search.find(Serial{}, 0, 2).paths[0].length == Approx(5));
}

TEST_CASE("positions that stay are referred to") {
  const Points points = corners();
  CHECK(Given<std::array<double, 3>>(points).data() == points.data());
  CHECK(GivenPoints(std::span(points)).data() == points.data());
  const GivenPoints kept(corners());
  CHECK(GivenPoints(kept).data() == kept.data());
  CHECK(GivenPoints({{1, 2, 3}}).size() == 1);
  CHECK(GivenPoints().empty());
}

TEST_CASE("what was moved from has no rows") {
  GivenPoints from(corners()), to(std::move(from)), again;
  CHECK((from.empty() && to.size() == 4));  // NOLINT(bugprone-use-after-move)
  again = std::move(to);
  CHECK((to.empty() && again.size() == 4));  // NOLINT(bugprone-use-after-move)
  CHECK(again[2] == std::array<double, 3>{4, 3, 0});
}

TEST_CASE("a domain that would be gone after the line makes no field of paths") {
  const auto refers = []<class User, class Domain>(std::type_identity<User>,
                                                   std::type_identity<Domain>) {
    CHECK(std::constructible_from<User, const Domain&>);
    CHECK_FALSE(std::constructible_from<User, Domain>);
  };
  const auto paths = [&]<class Domain>(std::type_identity<Domain> domain) {
    refers(std::type_identity<PathField<Domain>>(), domain);
  };
  paths(std::type_identity<TriangleMesh<float>>());
  paths(std::type_identity<TetMesh<double>>());
  paths(std::type_identity<Wireframe<double>>());
  paths(std::type_identity<PointCloud<float>>());
  paths(std::type_identity<MixedComplex<double>>());
  using Mesh = TriangleMesh<double>;
  using OnFlips = PathField<Mesh>;
  CHECK(std::constructible_from<OnFlips, const Mesh&, const IntrinsicDelaunay&, const Mesh&>);
  CHECK_FALSE(std::constructible_from<OnFlips, Mesh, const IntrinsicDelaunay&, const Mesh&>);
  CHECK_FALSE(std::constructible_from<OnFlips, const Mesh&, IntrinsicDelaunay, const Mesh&>);
  CHECK_FALSE(std::constructible_from<OnFlips, const Mesh&, const IntrinsicDelaunay&, Mesh>);
  refers(std::type_identity<PathSearch<double>>(), std::type_identity<TriangleMesh<double>>());
  refers(std::type_identity<BoundedSearch<double>>(), std::type_identity<TriangleMesh<double>>());
}

TEST_CASE("paths start at whatever a solve takes, but for sets") {
  const Points points = corners();
  const TriangleMesh<double> mesh(points, triangles);
  PathField field(mesh, points);
  CHECK(field.solve(Serial{}, 0)[2] == Approx(5));
  CHECK(field.solve(Serial{}, {0, 3})[2] == Approx(4));
  CHECK(field.trace(2).source == 1);
  CHECK(field.solve(Serial{}, std::vector<int>{1}, {.accuracy = Accuracy::exact()})[3] ==
        Approx(5));
  CHECK(field.solve(OpenMP{}, closest(points, std::vector<std::array<int, 3>>{{0, 1, 2}},
                                      {2, 0, 5}))[0] == Approx(2));
  CHECK_THROWS_AS(field.solve(Serial{}, VertexSource{.vertices = {0, 1}}), UsageError);
  BoundedSearch near(mesh);
  CHECK(near.find(Serial{}, 0, 3.5).vertices.size() == 2);
  CHECK(
      near.find(Serial{}, {0, 2}, {.accuracy = Accuracy::fast(), .radius = 3.5}).vertices.size() ==
      4);
}

TEST_CASE("paths have coordinates from any array") {
  const Points points = corners();
  const TriangleMesh<double> mesh(points, triangles);
  const Wireframe<double> wires(points, std::vector<int>{0, 1, 1, 2, 2, 3});
  const PointCloud<double> cloud(
      points, Neighbours{{0, 3, 6, 9, 12}, {1, 2, 3, 0, 2, 3, 0, 1, 3, 0, 1, 2}});
  in_each_way(points, [&](const auto& given) {
    const auto end = [&](const auto& domain) {
      PathField field(domain, given);
      field.solve(Serial{}, 0);
      return field.trace(2).positions.front();
    };
    CHECK(end(mesh) == points[2]);
    CHECK(end(wires) == points[2]);
    CHECK(end(cloud) == points[2]);
    PathField field(mesh, given);
    field.solve(Serial{}, 0);
    const Path tight = shortened(mesh, field.trace(2).points, given);
    CHECK(tight.positions.front() == points[2]);
  });
}

TEST_CASE("pieces of mixed domains lie where any array says") {
  const Points points = corners();
  in_each_way(points, [&](const auto& given) {
    MixedComplex<double> mixed;
    const auto sheet = mixed.add(TriangleMesh<double>(given, triangles), given);
    const auto wire = mixed.add(Wireframe<double>(given, std::vector<int>{1, 3}), given);
    CHECK(mixed.weld(sheet, wire) == 4);
    PathField field(mixed, Points{points[0], points[1], points[2], points[3], points[0], points[1],
                                  points[2], points[3]});
    CHECK(field.solve(Serial{}, 1)[wire.vertex(3)] == Approx(5));
    CHECK(field.trace(wire.vertex(3)).positions.front() == points[3]);
  });
}

TEST_CASE("isolines and isosurfaces of any array") {
  const Points flat = corners(), points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const std::vector<float> singles = {0, 4, 4, 4};
  in_each_way(points, [&](const auto& given) {
    const Isosurfaces shells = isosurfaces(given, std::vector<int>{0, 1, 2, 3}, singles, {1, 2.0});
    REQUIRE(shells.triangles.size() == 2);
    CHECK(std::ranges::count(shells.positions, std::array<double, 3>{0, 2, 0}) == 1);
    const auto field = solve(Serial{}, TetMesh(given, std::vector<int>{0, 1, 2, 3}), 0);
    CHECK(isosurfaces(given, std::vector<int>{0, 1, 2, 3}, field, {2}).triangles.size() == 1);
  });
  in_each_way(flat, [&](const auto& given) {
    const auto lines = isolines(given, triangles, std::vector<int>{0, 4, 5, 3}, {2});
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].points.size() == 3);
  });
}

}  // namespace plexway::testing::given_arrays_test
