// A domain of a user's own (examples/hexagons.hpp): every cell of the table of what goes together,
// as for the library's own, though no file of the library knows it.

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include <plexway/carried.hpp>
#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

#include "examples/hexagons.hpp"
#include "executors/check_scene.hpp"

namespace plexway::testing::carried_test {

namespace {

// Our own domains, each in both precisions: another one is another line.
#define OWN_DOMAINS(X)           \
  X(examples::HexagonMap<float>) \
  X(examples::HexagonMap<double>) X(EveryOther<float>) X(EveryOther<double>)

// The chain of every second vertex of a longer one: vertices that are not the carrier's.
template <class Real>
class EveryOther : public CarriedDomain<EveryOther<Real>, Wireframe<Real>> {
 public:
  explicit EveryOther(Index count)
      : CarriedDomain<EveryOther, Wireframe<Real>>(chain(2 * count), evens(count)) {}

  // A simplex is two of the carrier's edges.
  [[nodiscard]] std::size_t simplex_count() const { return this->vertex_count() - 1; }
  [[nodiscard]] PointSource place(const PointSource& point) const {
    const double along = 2 * point.barycentric[1];
    const Index edge = 2 * point.simplex + (along > 1);
    return PointSource::in(edge, {1 - (along - (along > 1)), along - (along > 1)});
  }
  [[nodiscard]] Source whole(const SimplexSource& simplex) const {
    return VertexSource{.vertices = {2 * simplex.simplex, 2 * simplex.simplex + 2},
                        .offset = simplex.offset};
  }

 private:
  static Wireframe<Real> chain(Index vertices) {
    std::vector<std::array<Index, 2>> edges;
    for (Index v = 1; v < vertices; ++v) edges.push_back({v - 1, v});
    return Wireframe<Real>(vertices, edges, std::vector<double>(edges.size(), 0.015));
  }
  static std::vector<Index> evens(Index count) {
    std::vector<Index> vertices;
    for (Index v = 0; v < count; ++v) vertices.push_back(2 * v);
    return vertices;
  }
};

constexpr double step = 0.05;

// Between the middles of two hexagons, in columns and rows.
double hexagons_between(double columns, double rows) {
  return step * std::max({std::abs(columns), std::abs(rows), std::abs(columns + rows)});
}

// A point on a step is as far as it is from the nearer end, and on from there.
double on_the_map(const Place& a, const Place& b) {
  const auto ends = [](const Place& p) {
    const double q = p[0] - std::floor(p[0]), r = p[1] - std::floor(p[1]);
    const bool in_row = r < 1e-9 || r > 1 - 1e-9, in_column = q < 1e-9 || q > 1 - 1e-9;
    const double q0 = in_column ? std::round(p[0]) : std::floor(p[0]);
    const double r0 = in_row ? std::round(p[1]) : in_column ? std::floor(p[1]) : std::ceil(p[1]);
    const double q1 = in_column ? q0 : q0 + 1, r1 = in_row ? r0 : in_column ? r0 + 1 : r0 - 1;
    const double share = in_column && in_row ? 0 : in_column ? r : q;
    return std::array{std::array{q0, r0, share}, std::array{q1, r1, 1 - share}};
  };
  double best = std::numeric_limits<double>::infinity();
  for (const auto& from : ends(a))
    for (const auto& to : ends(b))
      best = std::min(
          best, step * (from[2] + to[2]) + hexagons_between(from[0] - to[0], from[1] - to[1]));
  return best;
}

template <class D>
Scene<D> scene_of() {
  std::vector<Place> places;
  std::vector<std::vector<Index>> simplices;
  if constexpr (std::is_same_v<D, examples::HexagonMap<RealOf<D>>>) {
    constexpr Index width = 15, height = 12;
    D map(width, height, [](Index, Index) { return step; });
    for (Index v = 0; v < width * height; ++v)
      places.push_back({static_cast<double>(v % width), static_cast<double>(v / width), 0, 0});
    for (const auto& ends : map.steps()) simplices.emplace_back(ends.begin(), ends.end());
    return {"a map of hexagons", std::move(map), places, simplices, on_the_map};
  } else {
    constexpr Index count = 40;
    for (Index v = 0; v < count; ++v) places.push_back({0.03 * v, 0, 0, 0});
    D chain(count);
    for (Index v = 1; v < count; ++v) simplices.push_back({v - 1, v});
    return {"every second of a chain", std::move(chain), places, simplices};
  }
}

template <class E>
Count check_own(const E& executor) {
  Count count;
#define PLEXWAY_CHECK(...)                       \
  static_assert(DomainType<__VA_ARGS__>);        \
  static_assert(CarriedDomainType<__VA_ARGS__>); \
  check_scene(executor, scene_of<__VA_ARGS__>(), count);
  OWN_DOMAINS(PLEXWAY_CHECK)
#undef PLEXWAY_CHECK
  return count;
}

}  // namespace

TEST_CASE("a domain of one's own, in every cell of the table, by one thread") {
  const Count count = check_own(Serial{});
  CHECK(count.yes + count.no == 4 * 7 * ways_count);
  CHECK(count.yes == 4 * 7 * 3 * 3 * 2);  // accuracies fast and usual; no table, no windows
}

TEST_CASE("a domain of one's own, in every cell of the table, by a team", "[threads]") {
  if (!openmp_built()) return;
  const Count count = check_own(OpenMP{.threads = 2});
  CHECK(count.yes + count.no == 4 * 7 * ways_count);
  CHECK(count.yes == 4 * 7 * 3 * 2 * 2);
}

#ifdef PLEXWAY_HAS_GL
TEST_CASE("a domain of one's own, in every cell of the table, on a GL device", "[gl]") {
  try {
    (void)gl_device(GL{});
  } catch (const NotBuiltError& error) {
    WARN("skipped, no GL device: " << error.what());
    return;
  }
  const Count count = check_own(GL{});
  CHECK(count.yes + count.no == 4 * 7 * ways_count);
  CHECK(count.yes == 2 * 7 * 2 * 2);
}
#endif

TEST_CASE("a domain of one's own refuses what is not there") {
  const EveryOther<double> chain(5);
  CHECK_THROWS_WITH(solve(Serial{}, chain, PointSource::at(5)),
                    "source vertex 5 is out of range, there are 5");
  CHECK_THROWS_AS(solve(Serial{}, chain, VertexSource{.vertices = {0, 7}}), UsageError);
  CHECK_THROWS_AS(solve(Serial{}, chain, std::vector<PointSource>{}), UsageError);
  std::vector<double> rows(9);
  Workspace<double> workspace;
  CHECK_THROWS_AS(solve_each(Serial{}, chain, PointSource::at(0), {}, workspace, rows), UsageError);
}

}  // namespace plexway::testing::carried_test
