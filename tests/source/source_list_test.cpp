#include <plexway/common/closest.hpp>
#include <plexway/error.hpp>
#include <plexway/surface.hpp>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

// Sources as one writes them, and what a field says of its vertices.
namespace plexway::testing::source_list_test {

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

}  // namespace plexway::testing::source_list_test
