#include <catch2/catch.hpp>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>

#include "message_of.hpp"

namespace plexway::simplicial_complex_test {

using Catch::Matchers::Contains;

namespace {

using testing::message_of;

const double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <int N>
KuhnGrid<N> box(std::size_t n) {
  typename KuhnGrid<N>::Place cells;
  typename KuhnGrid<N>::Point spacing;
  for (std::size_t a = 0; a < N; ++a) {
    cells[a] = n + a;
    spacing[a] = 1. / static_cast<double>(a + 1);
  }
  return KuhnGrid<N>(cells, spacing);
}

template <int N>
void check_box(std::size_t n) {
  const KuhnGrid<N> grid = box<N>(n);
  const auto simplices = grid.simplices();
  double volume = 1, sum = 0;
  std::size_t cells = 1, factorial = 1, boundary = 0;
  for (std::size_t a = 0; a < N; ++a) {
    volume *= static_cast<double>(n + a) / static_cast<double>(a + 1);
    cells *= n + a;
    factorial *= a + 1;
  }
  for (std::size_t a = 0; a < N; ++a) boundary += 2 * cells / (n + a) * factorial / N;
  for (const auto& s : simplices) {
    Eigen::Matrix<double, N, N> edges;
    for (int i = 0; i < N; ++i)
      for (int a = 0; a < N; ++a)
        edges(a, i) =
            grid.position(s[static_cast<std::size_t>(i) + 1])[static_cast<std::size_t>(a)] -
            grid.position(s[0])[static_cast<std::size_t>(a)];
    sum += std::abs(edges.determinant()) / static_cast<double>(factorial);
  }
  CHECK(sum == Approx(volume).epsilon(1e-12));
  const auto domain = grid.template complex<double>();
  const SimplicialSummary& made = domain.summary();
  CAPTURE(N);
  CHECK(simplices.size() == factorial * cells);
  CHECK(made.simplices == factorial * cells);
  CHECK(made.vertices == grid.vertex_count());
  CHECK(made.boundary_facets == boundary);
  CHECK(2 * made.facets == (N + 1) * made.simplices + boundary);
  CHECK(made.components == 1);
  CHECK(made.fan_facets == 0);
  CHECK(made.pinched_vertices == 0);
  CHECK(made.unreferenced_vertices == 0);
  CHECK(made.degenerate_simplices == 0);
  CHECK(made.violated_simplices == 0);
  CHECK(domain.bytes() > made.simplices * 40);
}

}  // namespace

TEST_CASE("a Kuhn grid fills its box and fits together") {
  check_box<2>(3);
  check_box<3>(3);
  check_box<4>(2);
}

TEST_CASE("grid vertices are found by place and by position") {
  const KuhnGrid<4> grid({2, 3, 4, 1}, {1, .5, .25, 2}, {-1, 0, 1, 3});
  CHECK(grid.vertex_count() == 3 * 4 * 5 * 2);
  for (Index v = 0; v < grid.vertex_count(); ++v) {
    CHECK(grid.vertex(grid.place(v)) == v);
    auto p = grid.position(v);
    CHECK(grid.nearest(p) == v);
    for (std::size_t a = 0; a < 4; ++a) p[a] += (a % 2 ? .3 : -.3) * (a < 2 ? .5 : .25);
    CHECK(grid.nearest(p) == v);
    for (std::size_t a = 0; a < 4; ++a) CHECK(grid.positions()[4 * v + a] == grid.position(v)[a]);
  }
  CHECK(grid.vertex({1, 0, 0, 0}) == 1);
  CHECK(grid.position(grid.vertex({2, 3, 4, 1})) == std::array<double, 4>{1, 1.5, 2, 5});
  CHECK(grid.centre({0, 0, 0, 0}) == std::array<double, 4>{-.5, .25, 1.125, 4});
  CHECK(grid.nearest({100, -100, 100, -100}) == grid.vertex({2, 0, 4, 0}));
}

TEST_CASE("absent cells leave holes and vertices without simplices") {
  const KuhnGrid<3> grid({5, 5, 5}, {1, 1, 1});
  const auto inner = [](const auto& cell) {
    return std::all_of(cell.begin(), cell.end(), [](std::size_t c) { return c > 0 && c < 4; });
  };
  const SimplicialSummary made = grid.complex<float>(inner).summary();
  CHECK(made.simplices == 6 * (125 - 27));
  CHECK(made.boundary_facets == 2 * (6 * 25 + 6 * 9));
  CHECK(made.unreferenced_vertices == 8);
  CHECK(made.components == 1);
  const auto slab = [](const auto& cell) { return cell[1] == 2; };
  CHECK(grid.complex<float>(slab).summary().components == 2);
  CHECK_THAT(message_of([&] { (void)grid.complex<float>([](const auto&) { return true; }); }),
             Contains("no simplices"));
}

TEST_CASE("facets may have many simplices, and parts may only touch") {
  using Tets = std::vector<std::array<Index, 4>>;
  const std::vector<double> p = {0,  0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0,
                                 -1, 1, 1, 1, 5, 5, 5, 6, 5, 5, 5, 6, 5};
  const SimplicialComplex<double, 3> fan(p, 3, Tets{{0, 1, 2, 3}, {2, 4, 0, 1}, {5, 1, 2, 0}});
  CHECK(fan.summary().fan_facets == 1);
  CHECK(fan.summary().facets == 10);
  CHECK(fan.summary().boundary_facets == 9);
  CHECK(fan.summary().pinched_vertices == 0);
  CHECK(fan.summary().unreferenced_vertices == 3);
  // One edge in common: both its ends are pinched, and it is one component.
  const SimplicialComplex<double, 3> edge(p, 3, Tets{{0, 1, 2, 3}, {0, 1, 4, 6}, {5, 6, 7, 8}});
  CHECK(edge.summary().pinched_vertices == 3);
  CHECK(edge.summary().components == 1);
  const SimplicialComplex<double, 3> apart(p, 3, Tets{{0, 1, 2, 3}, {5, 6, 7, 8}});
  CHECK(apart.summary().components == 2);
  CHECK(apart.summary().degenerate_simplices == 0);
}

TEST_CASE("lengths that no simplex has are counted") {
  const auto violated = [](const auto& lengths) {
    constexpr std::size_t edges = std::tuple_size_v<std::decay_t<decltype(lengths)>>;
    constexpr int n = edges == 3 ? 2 : edges == 6 ? 3 : 4;
    std::array<Index, n + 1> corners;
    for (Index i = 0; i <= n; ++i) corners[i] = i;
    const SimplicialComplex<float, n> one(n + 1, std::span(&corners, 1), std::span(&lengths, 1));
    return std::pair(one.summary().violated_simplices, one.summary().degenerate_simplices);
  };
  using Counts = std::pair<std::size_t, std::size_t>;
  CHECK(violated(std::array<double, 3>{3, 4, 5}) == Counts(0, 0));
  CHECK(violated(std::array<double, 3>{1, 1, 3}) == Counts(1, 0));
  CHECK(violated(std::array<double, 3>{1, 3, 2}) == Counts(0, 1));
  CHECK(violated(std::array<double, 3>{0, 0, 0}) == Counts(0, 1));
  CHECK(violated(std::array<double, 6>{1, 1, 1, 1, 1, 1}) == Counts(0, 0));
  // Every face is a triangle, but the apex cannot come so near: 1 / sqrt(3) from all three.
  CHECK(violated(std::array<double, 6>{1, 1, 1, .57, .57, .57}) == Counts(1, 0));
  CHECK(violated(std::array<double, 6>{1, 1, 1, .58, .58, .58}) == Counts(0, 0));
  const double d = std::sqrt(2);  // a square with both diagonals
  CHECK(violated(std::array<double, 6>{1, d, 1, 1, d, 1}) == Counts(0, 1));
  CHECK(violated(std::array<double, 10>{1, 1, 1, 1, 1, 1, 1, 1, 1, 1}) == Counts(0, 0));
  CHECK(violated(std::array<double, 10>{1, 1, 1, 1, 1, 1, .6, .6, .6, .6}) == Counts(1, 0));
}

TEST_CASE("two lengths of one edge are refused, the mean of what rounding makes of one is taken") {
  const std::vector<std::array<Index, 3>> faces = {{2, 1, 0}, {1, 2, 3}};
  const auto made = [&](double other) {
    const std::vector<std::array<double, 3>> lengths = {{2, 2, 2}, {other, 3, 3}};  // (2, 1)
    return SimplicialComplex<double, 2>(4, faces, lengths);
  };
  CHECK_THROWS_WITH(made(4), Catch::Contains("the edge 1 - 2 has the length 2") &&
                                 Catch::Contains("4 in another"));
  const auto domain = made(2 + 2e-6);
  std::size_t shared = 0;
  for (const auto& record : domain.records())
    for (const double l2 : record.length2)
      shared += std::abs(std::sqrt(l2) * domain.unit() - (2 + 1e-6)) < 1e-9;
  CHECK(shared == 2);
}

TEST_CASE("bad simplices name themselves") {
  const std::vector<double> p(5 * 6, 0.5);
  std::vector<std::array<Index, 5>> s = {{0, 1, 2, 3, 4}, {1, 2, 3, 4, 5}};
  std::vector<std::array<double, 10>> lengths(2);
  for (auto& row : lengths) row.fill(1);
  const auto from_positions = [&] { SimplicialComplex<float, 4>(p, 5, s); };
  const auto from_lengths = [&] { SimplicialComplex<float, 4>(6, s, lengths); };
  CHECK(message_of(from_positions).empty());
  CHECK(message_of(from_lengths).empty());
  s[1][3] = 6;
  CHECK_THAT(message_of(from_positions), Contains("simplex 1") && Contains("vertex 6"));
  CHECK_THAT(message_of(from_lengths), Contains("simplex 1") && Contains("vertex 6"));
  s[1][3] = 2;
  CHECK_THAT(message_of(from_positions),
             Contains("simplex 1") && Contains("vertex 2 occurs twice"));
  s[1][3] = 4, s[1][4] = 5, s[1][2] = 3, s[1][1] = 2;
  for (const double bad : {-1., infinity, not_a_number}) {
    lengths[1][9] = bad;
    CHECK_THAT(message_of(from_lengths), Contains("simplex 1") && Contains("length"));
  }
  lengths.pop_back();
  CHECK_THAT(message_of(from_lengths), Contains("2 simplices with 1 rows"));
  std::vector<double> q = p;
  q[17] = not_a_number;
  CHECK_THAT(message_of([&] { SimplicialComplex<float, 4>(q, 5, s); }), Contains("vertex 3"));
  CHECK_THAT(message_of([&] { SimplicialComplex<float, 4>(p, 3, s); }), Contains("dimension"));
  CHECK_THAT(message_of([&] { SimplicialComplex<float, 4>(p, 7, s); }), Contains("dimension"));
  q.assign(30, 1.7e308);
  q[0] = -1.7e308;
  CHECK_THAT(message_of([&] { SimplicialComplex<float, 4>(q, 5, s); }), Contains("too long"));
  s.clear();
  CHECK_THAT(message_of(from_positions), Contains("no simplices"));
}

TEST_CASE("bad grids say which axis") {
  using Grid = KuhnGrid<2>;
  CHECK_THAT(message_of([] { Grid({3, 0}, {1, 1}); }), Contains("axis 1"));
  CHECK_THAT(message_of([] { Grid({3, 3}, {0, 1}); }), Contains("axis 0"));
  CHECK_THAT(message_of([] { Grid({3, 3}, {1, not_a_number}); }), Contains("axis 1"));
  CHECK_THAT(message_of([] { Grid({{{0, 1, 1}, {0, 1}}}); }), Contains("axis 0"));
  CHECK_THAT(message_of([] { Grid({{{0, 1}, {infinity}}}); }), Contains("axis 1"));
  CHECK_THAT(message_of([] { Grid({1u << 17, 1u << 17}, {1, 1}); }), Contains("too many"));
}

}  // namespace plexway::simplicial_complex_test
