#include <Eigen/Core>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <list>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/blocks.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/error.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

namespace plexway::testing::rows_of_test {

namespace {

template <class Mesh>
std::vector<double> from_first(const Mesh& mesh) {
  const auto field = solve(Serial{}, mesh, 0);
  return {field.begin(), field.end()};
}

}  // namespace

TEST_CASE("points and simplices of any array") {
  const std::vector<double> truth = {0, 4, 5, 3};
  const std::vector<std::array<float, 3>> singles = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  const std::vector<std::array<double, 3>> doubles = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  const std::vector<std::int64_t> flat = {0, 1, 2, 0, 2, 3};
  const std::list<std::vector<short>> rows = {{0, 1, 2}, {0, 2, 3}};
  Eigen::MatrixXf eigen(4, 3);
  eigen << 0, 0, 0, 4, 0, 0, 4, 3, 0, 0, 3, 0;
  Eigen::Matrix<int, 2, 3, Eigen::RowMajor> other;
  other << 0, 1, 2, 0, 2, 3;
  CHECK(from_first(TriangleMesh<double>(singles, flat)) == truth);
  CHECK(from_first(TriangleMesh<double>(doubles, rows)) == truth);
  CHECK(from_first(TriangleMesh<double>(eigen, other)) == truth);
  CHECK(from_first(TriangleMesh<float>(std::span(doubles), flat, {.threads = 1})) == truth);
  CHECK(from_first(Wireframe<double>(singles, std::vector<int>{0, 1, 1, 2})) ==
        std::vector<double>{0, 4, 7, std::numeric_limits<double>::infinity()});
  const std::vector<int> coordinates = {0, 0, 0, 4, 0, 0, 4, 3, 0, 0, 0, 3};
  CHECK(from_first(TetMesh<double>(coordinates, std::vector<int>{0, 1, 2, 3})) == truth);
}

TEST_CASE("domains have the precision of the points that they are made of") {
  const std::vector<std::array<float, 3>> singles = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 1}};
  const std::vector<std::array<double, 3>> doubles = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 1}};
  Eigen::MatrixXf eigen(4, 3);
  eigen << 0, 0, 0, 4, 0, 0, 4, 3, 0, 0, 3, 0;
  const std::vector<int> corners = {0, 1, 2}, whole = {0, 0, 0, 4, 0, 0, 4, 3, 0};
  const std::vector<std::array<Index, 3>> plain = {{0, 1, 2}};
  const auto same = []<class D>(const D& domain, const std::type_identity<D>&) {
    CHECK(solve(Serial{}, domain, 0)[2] == Approx(5));
  };
  const std::type_identity<TriangleMesh<float>> one;
  const std::type_identity<TriangleMesh<double>> two;
  same(TriangleMesh(singles, plain), one);
  same(TriangleMesh(eigen, corners, {.threads = 1}), one);
  same(TriangleMesh(doubles, plain), two);
  same(TriangleMesh(whole, corners), two);
  same(TetMesh(singles, std::vector<int>{0, 1, 2, 3}), std::type_identity<TetMesh<float>>());
  same(Wireframe(doubles, std::vector<int>{0, 2}), std::type_identity<Wireframe<double>>());
  const PointCloud cloud(singles, Neighbours{{0, 2, 4, 6, 6}, {1, 2, 0, 2, 1, 0}});
  same(cloud, std::type_identity<PointCloud<float>>());
}

TEST_CASE("a cloud and complexes of simplices of any array") {
  const std::vector<double> truth = {0, 4, 5, 3};
  const std::vector<std::array<float, 3>> singles = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  const std::vector<int> numbers = {0, 0, 0, 4, 0, 0, 4, 3, 0, 0, 3, 0};
  const Neighbours all{{0, 3, 6, 9, 12}, {1, 2, 3, 0, 2, 3, 0, 1, 3, 0, 1, 2}};
  const PointCloud<double> plain(rows_of<double, 3>(singles), all);
  CHECK(from_first(PointCloud<double>(singles, all)) == from_first(plain));
  CHECK(from_first(PointCloud<double>(numbers, all)) == from_first(plain));
  CHECK(from_first(plain) == truth);

  const std::vector<std::int64_t> flat = {0, 1, 2, 0, 2, 3};
  const std::list<std::vector<short>> plane = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  Eigen::MatrixXf eigen(4, 2);
  eigen << 0, 0, 4, 0, 4, 3, 0, 3;
  CHECK(from_first(SimplicialComplex<double, 2>(plane, flat)) == truth);
  CHECK(from_first(SimplicialComplex<double, 2>(eigen, flat)) == truth);
  CHECK(from_first(SimplicialComplex<double, 2>(singles, flat)) == truth);
  CHECK_THROWS_WITH(
      (SimplicialComplex<double, 2>(std::list<std::vector<short>>{{0, 0}, {4}}, flat)),
      "row 1: expected 2 numbers");
}

TEST_CASE("lengths of edges stand in the order that the complexes take") {
  const std::vector<std::array<float, 3>> points = {
      {0, 0, 0}, {1, 0, 0}, {.5f, 2, 0}, {.25f, .5f, 3}, {2, 2, 1}};
  const std::vector<std::array<int, 3>> faces = {{0, 1, 2}, {1, 4, 2}};
  const std::vector<std::array<int, 4>> tets = {{0, 1, 2, 3}, {1, 4, 2, 3}};
  const auto close = [](const std::vector<double>& a, const std::vector<double>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t v = 0; v < a.size(); ++v)
      if (a[v] != b[v]) CHECK(a[v] == Approx(b[v]).epsilon(1e-12));
  };
  const auto sides = metric::edge_lengths_of<metric::triangle_edges>(points, faces);
  CHECK(sides[0] == std::array<double, 3>{1, std::sqrt(4.25), std::sqrt(4.25)});
  close(from_first(TriangleMesh<double>(5, rows_of<Index, 3>(faces), sides)),
        from_first(TriangleMesh<double>(points, faces)));
  close(
      from_first(TetMesh<double>(5, rows_of<Index, 4>(tets),
                                 metric::edge_lengths_of<metric::simplex_edges<4>>(points, tets))),
      from_first(TetMesh<double>(points, tets)));
  close(from_first(SimplicialComplex<double, 2>(
            5, rows_of<Index, 3>(faces),
            metric::edge_lengths_of<metric::simplex_edges<3>>(points, faces))),
        from_first(SimplicialComplex<double, 2>(points, faces)));
  CHECK_THROWS_WITH(metric::edge_lengths_of<metric::triangle_edges>(points, std::vector{0, 1, 5}),
                    "simplex 0: there is no vertex 5");
}

TEST_CASE("rows that are none are refused") {
  const auto three = [](const auto& rows) { return rows_of<Index, 3>(rows); };
  CHECK_THROWS_WITH(three(std::vector<int>{0, 1, 2, 3}), "row 1: expected 3 numbers");
  CHECK_THROWS_WITH(three(std::vector<std::vector<int>>{{0, 1}}), "row 0: expected 3 numbers");
  CHECK_THROWS_WITH(three(std::vector<std::vector<int>>{{0, 1, 2, 3}}),
                    "row 0: expected 3 numbers");
  CHECK_THROWS_WITH(three(std::vector<int>{0, 1, -2}), "row 0: -2 is no number of a vertex");
  CHECK_THROWS_WITH(three(std::vector<std::int64_t>{0, 1, std::int64_t{1} << 32}),
                    "row 0: 4294967296 is no number of a vertex");
  CHECK_THROWS_WITH(three(Eigen::MatrixXi::Zero(1, 2).eval()), "row 0: expected 3 numbers");
  CHECK(three(std::vector<int>()).empty());
}

TEST_CASE("blocks cover every number once on any number of threads") {
  for (const int threads : {0, 1, 2, 5})
    for (const std::size_t count : {0u, 1u, 9u, 10u, 11u, 1000u}) {
      std::vector<std::atomic<int>> seen(count);
      double last = 0;
      plexway::for_blocks(
          count, 10, threads,
          [&](double share) {
            CHECK(share >= last);
            last = share;
            return true;
          },
          [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) ++seen[i];
          });
      for (const auto& s : seen) CHECK(s == 1);
      CHECK(last <= 1);
    }
}

TEST_CASE("blocks hand on what work throws, and stop when progress says so") {
  for (const int threads : {1, 4}) {
    CHECK_THROWS_AS(plexway::for_blocks(1000, 10, threads, {},
                                        [](std::size_t first, std::size_t) {
                                          if (first == 500) throw std::out_of_range("500");
                                        }),
                    std::out_of_range);
    CHECK_THROWS_AS(
        plexway::for_blocks(
            1000000, 10, threads, [](double) { return false; }, [](std::size_t, std::size_t) {}),
        plexway::Cancelled);
  }
}

TEST_CASE("of several blocks that fail the first one counts") {
  for (const int threads : {1, 3, 8})
    for (int turn = 0; turn < 50; ++turn)
      CHECK_THROWS_WITH(
          plexway::for_blocks(1000, 1, threads, {},
                              [](std::size_t first, std::size_t) {
                                if (first < 40) return;
                                if (first == 40)
                                  std::this_thread::sleep_for(std::chrono::microseconds(200));
                                throw std::out_of_range(std::to_string(first));
                              }),
          "40");
}

}  // namespace plexway::testing::rows_of_test
