#include <plexway/pairs/all_pairs.hpp>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "executors/scenes.hpp"

namespace plexway::testing::all_pairs_test {
using namespace detail;

namespace {

template <class Real>
using Rows = std::vector<std::vector<Real>>;

template <class E, class D>
Rows<RealOf<D>> dense(const E& executor, const D& domain, const PairsRequest& request) {
  Rows<RealOf<D>> rows(request.row_count(domain.vertex_count()));
  all_pairs(executor, domain, request,
            {[&](std::size_t k, DenseRow<RealOf<D>> d) { rows[k].assign(d.begin(), d.end()); }});
  return rows;
}

template <class D>
using Sparse = std::vector<std::vector<NearEntry<RealOf<D>>>>;

template <class E, class D>
Sparse<D> near(const E& executor, const D& domain, const PairsRequest& request,
               const NearLimits& limits) {
  Sparse<D> rows(request.row_count(domain.vertex_count()));
  near_pairs(executor, domain, request, limits, {[&](std::size_t k, SparseRow<RealOf<D>> entries) {
               rows[k].assign(entries.begin(), entries.end());
             }});
  return rows;
}

template <class D>
bool same(const Sparse<D>& a, const Sparse<D>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const auto& e, const auto& f) {
      return e.column == f.column && e.distance == f.distance;
    });
  });
}

template <class D>
void check_domain(Accuracy accuracy) {
  using Real = RealOf<D>;
  visit_scenes<D>([&](const Scene<D>& scene) {
    CAPTURE(scene.name);
    const D& domain = scene.domain;
    const std::size_t n = domain.vertex_count();
    PairsRequest all;
    all.block = 7;
    all.solve.accuracy = accuracy;
    Rows<Real> expected;
    for (Index v = 0; v < n; ++v)
      expected.push_back(solve(Serial{}, domain, PointSource::at(v), all.solve).distance);

    CHECK(dense(Serial{}, domain, all) == expected);
    for (const int threads : {1, 2, 3})
      CHECK(dense(OpenMP{.threads = threads}, domain, all) == expected);

    // Some rows, and columns in any order, one of them twice.
    const std::vector<PointSource> rows = {PointSource::at(3), PointSource::at(0),
                                           PointSource::at(3), PointSource::at(5)};
    const std::vector<Index> columns = {5, 1, 5, static_cast<Index>(n - 1)};
    PairsRequest some;
    some.rows = SourceList(rows);
    some.solve = all.solve;
    some.columns = columns;
    const auto chosen = dense(OpenMP{.threads = 2}, domain, some);
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j)
        CHECK(chosen[i][j] == expected[rows[i].vertex][columns[j]]);

    // What is near, against what is left of the whole rows.
    double reach = 0;
    for (const Real d : expected[0])
      if (std::isfinite(d)) reach = std::max(reach, static_cast<double>(d));
    const auto check_near = [&](const PairsRequest& request, const Rows<Real>& whole,
                                const NearLimits& limits) {
      const auto rows_near = near(OpenMP{.threads = 2}, domain, request, limits);
      CHECK(same<D>(rows_near, near(Serial{}, domain, request, limits)));
      for (std::size_t i = 0; i < whole.size(); ++i) {
        std::vector<std::pair<Real, Index>> left;
        for (Index j = 0; j < whole[i].size(); ++j)
          if (whole[i][j] <= static_cast<Real>(limits.radius) && std::isfinite(whole[i][j]))
            left.push_back({whole[i][j], j});
        std::sort(left.begin(), left.end());
        // Those at the limit may be on either side of it, by rounding.
        const double rounding = 8 * static_cast<double>(std::numeric_limits<Real>::epsilon());
        const double rim = left.size() > limits.nearest
                               ? static_cast<double>(left[limits.nearest - 1].first)
                               : limits.radius;
        std::vector<char> found(whole[i].size(), 0);
        for (const auto& [column, distance] : rows_near[i]) {
          found[column] = 1;
          REQUIRE(static_cast<double>(distance) ==
                  Approx(static_cast<double>(whole[i][column])).epsilon(rounding).margin(0));
          REQUIRE(static_cast<double>(distance) <= rim * (1 + rounding));
        }
        for (const auto& [distance, column] : left)
          if (static_cast<double>(distance) < rim * (1 - rounding)) REQUIRE(found[column] == 1);
        REQUIRE(rows_near[i].size() <= limits.nearest);
        REQUIRE(std::is_sorted(rows_near[i].begin(), rows_near[i].end(),
                               [](const auto& a, const auto& b) { return a.column < b.column; }));
        if (left.size() >= limits.nearest) REQUIRE(rows_near[i].size() == limits.nearest);
      }
    };
    check_near(all, expected, {.radius = 0.3 * reach});
    check_near(all, expected, {.nearest = 5});
    check_near(all, expected, {.radius = 0.3 * reach, .nearest = 9});
    check_near(some, chosen, {.radius = 0.5 * reach});
    check_near(some, chosen, {.nearest = 2});
  });
}

}  // namespace

#define PLEXWAY_CHECK(...)                     \
  check_domain<__VA_ARGS__>(Accuracy::fast()); \
  check_domain<__VA_ARGS__>(Accuracy::usual());

TEST_CASE("rows of a matrix are solves, on surfaces"){
    PLEXWAY_SURFACES(PLEXWAY_CHECK)} TEST_CASE("rows of a matrix are solves, in solids"){
    PLEXWAY_SOLIDS(PLEXWAY_CHECK)} TEST_CASE("rows of a matrix are solves, on wireframes"){
    PLEXWAY_WIREFRAMES(PLEXWAY_CHECK)} TEST_CASE("rows of a matrix are solves, in any dimension"){
    PLEXWAY_SIMPLICES(PLEXWAY_CHECK)} TEST_CASE("rows of a matrix are solves, on clouds"){
    PLEXWAY_CLOUDS(PLEXWAY_CHECK)} TEST_CASE("rows of a matrix are solves, on mixed domains"){
    PLEXWAY_MIXED(PLEXWAY_CHECK)}

TEST_CASE("what is near misses nothing behind triangles whose centres are far") {
  // Two grids of squares, and between them needles ten times as long as all that is near: the way
  // from one grid into the other leads across the needles' ends.
  Surface s;
  const auto grid_rows = [&](double from, double step) {
    const Index first = static_cast<Index>(s.positions.size());
    for (Index j = 0; j < 4; ++j)
      for (Index i = 0; i < 11; ++i) s.positions.push_back({0.1 * i, from + step * j, 0});
    for (Index j = 0; j < 3; ++j)
      for (Index i = 0; i < 10; ++i) {
        const Index v = first + 11 * j + i;
        s.faces.push_back({v, v + 1, v + 12});
        s.faces.push_back({v, v + 12, v + 11});
      }
    return first;
  };
  const Index below = grid_rows(0, -0.1), above = grid_rows(0.1, 0.1);
  const Index far = static_cast<Index>(s.positions.size());
  s.positions.push_back({10, 0.1, 0});
  for (Index i = 0; i < 10; ++i) {
    s.faces.push_back({below + i, below + i + 1, far});
    s.faces.push_back({below, above + i + 1, above + i});
  }
  s.faces.push_back({below, far, above + 10});

  const auto mesh = s.mesh<double>();
  const double radius = 0.35;
  const auto few = near(OpenMP{.threads = 2}, mesh, PairsRequest(), {.radius = radius});
  for (Index i = 0; i < far; ++i) {
    std::vector<double> row(far + 1, std::numeric_limits<double>::infinity());
    for (const auto& [column, distance] : few[i]) row[column] = distance;
    for (Index j = 0; j < far; ++j) {
      const double straight =
          std::hypot(s.positions[i][0] - s.positions[j][0], s.positions[i][1] - s.positions[j][1]);
      CAPTURE(i, j, straight);
      if (straight < radius - 1e-6) REQUIRE(row[j] == Approx(straight).margin(1e-9));
      if (straight > radius + 1e-6) REQUIRE(std::isinf(row[j]));
    }
  }
}

TEST_CASE("blocks of rows come whole, once, and only those that are wanted") {
  const auto mesh = grid(6, 6).mesh<float>();
  const std::size_t n = mesh.vertex_count();  // 49
  PairsRequest request;
  request.block = 10;
  request.wanted = [](std::size_t block) { return block != 1 && block != 3; };
  for (const int threads : {1, 2, 4}) {
    std::vector<std::atomic<int>> seen(n);
    std::vector<std::size_t> blocks;
    const auto report =
        all_pairs(OpenMP{.threads = threads}, mesh, request,
                  {[&](std::size_t k, DenseRow<float>) { ++seen[k]; },
                   [&](std::size_t block) {
                     blocks.push_back(block);
                     for (std::size_t k = 10 * block; k < std::min(10 * (block + 1), n); ++k)
                       CHECK(seen[k] == 1);
                   }});
    CHECK(report.rows == 29);
    CHECK(report.statistics.expansions > 0);
    std::sort(blocks.begin(), blocks.end());
    CHECK(blocks == std::vector<std::size_t>{0, 2, 4});
    for (std::size_t k = 0; k < n; ++k) CHECK(seen[k] == (k / 10 == 1 || k / 10 == 3 ? 0 : 1));
  }
}

TEST_CASE("a matrix ends where its progress, a row or its sink says so") {
  const auto mesh = grid(6, 6).mesh<float>();
  const PairsSink<DenseRow<float>> nowhere = {[](std::size_t, DenseRow<float>) {}};
  PairsRequest request;
  std::size_t calls = 0;
  request.progress = [&](const PairsProgress& progress) {
    CHECK(progress.rows == 49);
    CHECK(progress.rows_done <= 49);
    CHECK(progress.rows_per_second >= 0);
    return ++calls < 3;
  };
  CHECK_THROWS_AS(all_pairs(Serial{}, mesh, request, nowhere), Cancelled);
  CHECK(calls == 3);
  request.progress = {};
  CHECK_THROWS_AS(all_pairs(OpenMP{.threads = 2}, mesh, request,
                            PairsSink<DenseRow<float>>{
                                [](std::size_t, DenseRow<float>) { throw Error("full"); }}),
                  Error);

  const std::vector<Index> beyond = {0, 49};
  request.columns = beyond;
  CHECK_THROWS_AS(all_pairs(Serial{}, mesh, request, nowhere), UsageError);
  request.columns = {};
  const std::vector<PointSource> nobody, outside = {PointSource::at(49)};
  request.rows = SourceList(nobody);
  CHECK_THROWS_AS(all_pairs(Serial{}, mesh, request, nowhere), UsageError);
  request.rows = SourceList(outside);
  CHECK_THROWS_AS(all_pairs(Serial{}, mesh, request, nowhere), UsageError);
  const PairsSink<SparseRow<float>> away = {[](std::size_t, SparseRow<float>) {}};
  CHECK_THROWS_AS(near_pairs(Serial{}, mesh, request, {.radius = 1}, away), UsageError);
  request.rows.reset();
  CHECK_THROWS_AS(near_pairs(Serial{}, mesh, request, {.radius = -1}, away), UsageError);
  CHECK_THROWS_AS(near_pairs(Serial{}, mesh, request, {.nearest = 0}, away), UsageError);
  request.block = 0;
  CHECK_THROWS_AS(all_pairs(Serial{}, mesh, request, nowhere), UsageError);
}

TEST_CASE("rows of a matrix may start from sets, balls and curves") {
  const auto mesh = grid(8, 8).mesh<double>();
  const std::vector<Source> sources = {
      VertexSource{.vertices = {0, 80}}, PointSource::at(3),
      CurveSource{.points = {PointSource::at(0), PointSource::at(1)}}};
  PairsRequest request;
  request.rows = SourceList(sources);
  request.solve.accuracy = Accuracy::fast();
  const auto rows = dense(OpenMP{.threads = 2}, mesh, request);
  const auto few = near(Serial{}, mesh, request, {.radius = 0.4});
  for (std::size_t k = 0; k < sources.size(); ++k) {
    CHECK(rows[k] == solve(Serial{}, mesh, sources[k], request.solve).distance);
    for (const auto& [column, distance] : few[k]) CHECK(distance == rows[k][column]);
    CHECK(few[k].size() == static_cast<std::size_t>(std::count_if(
                               rows[k].begin(), rows[k].end(), [](double d) { return d <= 0.4; })));
  }
}

}  // namespace plexway::testing::all_pairs_test
