#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <type_traits>
#include <vector>

#include <plexway/carried.hpp>
#include <plexway/error.hpp>
#include <plexway/pairs/distance_matrix.hpp>
#include <plexway/paths/bounded_search.hpp>
#include <plexway/paths/cloud_path_field.hpp>
#include <plexway/paths/mixed_path_field.hpp>
#include <plexway/paths/path_search.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/farthest_points.hpp>
#include <plexway/sampling/poisson_disk.hpp>
#include <plexway/solve.hpp>

#include "examples/hexagons.hpp"
#include "executors/check_scene.hpp"

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

namespace plexway::testing::matrix_test {

// Every cell of the table of what goes together (support.hpp): every yes runs and is right by a
// closed form, every no says its sentence. What the types alone rule out does not compile; that is
// tests/wrong_programs.

namespace {

#define PLEXWAY_IS_A_DOMAIN(...) static_assert(DomainType<__VA_ARGS__>);
PLEXWAY_DOMAINS(PLEXWAY_IS_A_DOMAIN)
#define PLEXWAY_IS_OF_SIMPLICES(...) static_assert(SimplexDomainType<__VA_ARGS__>);
PLEXWAY_SURFACES(PLEXWAY_IS_OF_SIMPLICES)
PLEXWAY_SOLIDS(PLEXWAY_IS_OF_SIMPLICES)
PLEXWAY_WIREFRAMES(PLEXWAY_IS_OF_SIMPLICES)
PLEXWAY_SIMPLICES(PLEXWAY_IS_OF_SIMPLICES)
static_assert(ExecutorType<Serial> && ExecutorType<OpenMP>);

constexpr std::size_t cells = 22 * 7 * ways_count;  // scenes, sources, ways

template <class E>
Count check_table(const E& executor) {
  Count count;
#define PLEXWAY_CHECK(...) \
  visit_scenes<__VA_ARGS__>([&](const auto& scene) { check_scene(executor, scene, count); });
  PLEXWAY_DOMAINS(PLEXWAY_CHECK)
#undef PLEXWAY_CHECK
  CHECK(count.yes > 0);
  return count;
}

}  // namespace

TEST_CASE("the table, by one thread") {
  const Count count = check_table(Serial{});
  CHECK(count.yes + count.no == cells);
  CHECK(count.yes == 2 * 899 + 72 + 2 * 12);
}

TEST_CASE("the table, by a team", "[threads]") {
  if (!openmp_built()) return;
  const Count count = check_table(OpenMP{.threads = 2});
  CHECK(count.yes + count.no == cells);
  CHECK(count.yes == 2 * 622 + 12 + 8);
}

TEST_CASE("many fields on a mixed domain take one thread a source", "[threads]") {
  if (!openmp_built()) return;
  visit_scenes<MixedComplex<double>>([](const auto& scene) {
    const std::vector<PointSource> sources = {PointSource::at(3), PointSource::at(90)};
    const auto rows = solve_each(OpenMP{.threads = 2}, scene.domain, sources);
    const auto alone = solve_each(Serial{}, scene.domain, sources);
    CHECK(std::equal(rows.values().begin(), rows.values().end(), alone.values().begin()));
  });
}

#ifdef PLEXWAY_HAS_GL
TEST_CASE("the table, on a GL device", "[gl]") {
  try {
    (void)gl_device(GL{});
  } catch (const NotBuiltError& error) {
    WARN("skipped, no GL device: " << error.what());
    return;
  }
  const Count count = check_table(GL{});
  CHECK(count.yes + count.no == cells);
  CHECK(count.yes == 2 * 50);
}
#endif

// A domain of a user's own (examples/hexagons.hpp): every cell of the table of what goes together,
// as for the library's own, though no file of the library knows it.

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

// What is done on a domain besides solving: every cell of that table (support.hpp, Purpose) that a
// program reaches with a complex in its hands. Every yes is right by the closed form, every no says
// its sentence. tests/shape/purposes_test.cpp has the others, which take any domain.

namespace {

template <class D>
std::vector<std::array<double, 3>> points_of(const Scene<D>& scene) {
  std::vector<std::array<double, 3>> points;
  for (const Place& p : scene.places) points.push_back({p[0], p[1], p[2]});
  return points;
}

std::vector<PointSource> some_points(std::size_t simplices, std::size_t corners) {
  std::vector<PointSource> points;
  for (Index k = 1; k <= 6; ++k) {
    PointSource at{.simplex = static_cast<Index>(k * simplices / 7)};
    double left = 1;
    for (std::size_t i = 0; i + 1 < corners; ++i) left -= at.barycentric[i] = 0.15 + 0.02 * k;
    at.barycentric[corners - 1] = left;
    points.push_back(at);
  }
  return points;
}

// What a field of a vertex can tell: ways, distances inside, directions, labels of simplices.
template <class E, class D>
void check_fields(const E& executor, const Scene<D>& scene, Visibility visibility, Count& count) {
  if constexpr (support(Purpose::paths, D::kind) && supports<E, D>) {
    if (!support(combination<E, D>(SourceKind::vertex, visibility, Schedule::dual_queue,
                                   scene.domain.metric())))
      return;
    const auto points = points_of(scene);
    const PointSource source = PointSource::at(static_cast<Index>(scene.places.size() / 3));
    PropagateOptions options;
    options.visibility = visibility;
    PathField<D> field(scene.domain, points);
    field.solve(executor, source, options);
    const auto verdict = [&](Purpose purpose) {
      const Support found = support(purpose, scene.domain, visibility, E::kind);
      ++(found ? count.yes : count.no);
      return found;
    };
    const bool best = visibility == Visibility::saddles || D::kind == DomainKind::wireframe;
    const auto near = [&](double found, double exact) {
      INFO("found " << found << ", exact " << exact);
      CHECK(found >= exact * (1 - 1e-5));
      CHECK(found <= exact * (best ? 1 + 2e-5 : 1.02) + 1e-12);
    };

    REQUIRE(verdict(Purpose::paths));
    for (Index v = 0; v < scene.places.size(); v += 17) {
      const Path path = field.trace(v);
      REQUIRE(path.source == 0);
      near(path.length, scene.distance(scene.place(source), scene.places[v]));
    }
    const std::size_t corners = scene.simplices[0].size();
    const auto inside = some_points(scene.simplices.size(), corners);
    const Support read = verdict(Purpose::read_out);
    if constexpr (requires { field.at(inside[0], ReadOut::neighbours); }) {
      if (read) {
        for (const PointSource& p : inside)
          for (const ReadOut level : {ReadOut::simplex, ReadOut::neighbours, ReadOut::star})
            near(field.at(p, level), scene.distance(scene.place(source), scene.place(p)));
      } else {
        CHECK_THROWS_WITH(field.at(inside[0], ReadOut::neighbours), read.sentence());
      }
    } else {
      CHECK_FALSE(read);
    }
    const Support directions = verdict(Purpose::directions);
    if constexpr (requires { field.gradient(); }) {
      if (directions) {
        const auto found = field.gradient();
        REQUIRE(found.size() == scene.simplices.size());
        for (std::size_t s = 0; s < found.size(); ++s) {
          PointSource centre{.simplex = static_cast<Index>(s)};
          for (std::size_t i = 0; i < corners; ++i)
            centre.barycentric[i] = 1 / static_cast<double>(corners);
          const Place p = scene.place(centre), from = scene.place(source);
          const double r = straight_between(p, from);
          double along = 0;
          for (std::size_t k = 0; k < 3; ++k) along += found[s][k] * (p[k] - from[k]) / r;
          CHECK(along > 1 - 1e-5);
        }
      } else {
        CHECK_THROWS_WITH(field.gradient(), directions.sentence());
      }
    }
    const Support labels = verdict(Purpose::simplex_labels);
    if constexpr (requires { field.simplex_labels(); }) {
      if (labels)
        CHECK(field.simplex_labels() == std::vector<Index>(scene.simplices.size(), 0));
      else
        CHECK_THROWS_WITH(field.simplex_labels(), labels.sentence());
    } else {
      CHECK_FALSE(labels);
    }
  }
}

// A source and a target, and what lies around.
template <class D>
void check_searches(const Scene<D>& scene, Visibility visibility, Count& count) {
  const Support found = support(Purpose::searches, scene.domain, visibility);
  ++(found ? count.yes : count.no);
  if constexpr (D::kind == DomainKind::surface) {
    using Real = RealOf<D>;
    const auto exact = [&](Index v) { return scene.distance(scene.places[0], scene.places[v]); };
    PropagateOptions options;
    options.visibility = visibility;
    options.radius = 0.5;
    const PointSource source = PointSource::at(0);
    const auto search = [&] {
      BoundedSearch<Real> near(scene.domain);
      return near.find(Serial{}, std::span<const PointSource>(&source, 1), options);
    };
    const Index far = static_cast<Index>(scene.places.size() - 1);
    const auto path = [&] {
      return PathSearch<Real>(scene.domain).find(Serial{}, source, PointSource::at(far));
    };
    PropagateOptions windows = options;
    windows.accuracy = Accuracy::accurate();
    const Support by_windows = support(Purpose::searches, scene.domain, windows);
    CHECK_FALSE(static_cast<bool>(by_windows));
    if (!found) {
      CHECK_THROWS_WITH(search(), found.sentence());
      if (visibility == Visibility::saddles) CHECK_THROWS_WITH(path(), found.sentence());
      return;
    }
    BoundedSearch<Real> other(scene.domain);
    CHECK_THROWS_WITH(other.find(Serial{}, std::span<const PointSource>(&source, 1), windows),
                      by_windows.sentence());
    const auto near = search();
    CHECK(near.vertices.size() > 3);
    for (const auto& [vertex, distance, label] : near.vertices) {
      CHECK(distance == Approx(exact(vertex)).epsilon(1e-5).margin(1e-12));
      CHECK(label == 0);
    }
    CHECK(path().distance[0] == Approx(exact(far)).epsilon(1e-5));
  } else {
    CHECK_FALSE(found);
  }
}

// Farthest points, the matrix between them, darts and cells.
template <class D>
void check_samples(const Scene<D>& scene, Count& count) {
  const Support found = support(Purpose::samples, scene.domain);
  ++(found ? count.yes : count.no);
  if constexpr (support(Purpose::samples, D::kind)) {
    const std::vector<PointSource> start = {PointSource::at(0)};
    const FarthestOptions three{.count = 3};
    const PoissonOptions radius{.radius = 0.3};
    const VoronoiOptions once{.max_iterations = 1};
    if (!found) {
      CHECK_THROWS_WITH(farthest_points(Serial{}, scene.domain, start, three), found.sentence());
      CHECK_THROWS_WITH(distance_matrix(Serial{}, scene.domain, start), found.sentence());
      CHECK_THROWS_WITH(poisson_disks(Serial{}, scene.domain, radius), found.sentence());
      CHECK_THROWS_WITH(centroidal_voronoi(Serial{}, scene.domain, start, once), found.sentence());
      return;
    }
    const FarthestPoints points = farthest_points(Serial{}, scene.domain, start, three);
    REQUIRE(points.points.size() == 3);
    const DistanceMatrix matrix = distance_matrix(Serial{}, scene.domain, points.points);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        CHECK(matrix.distance[3 * i + j] ==
              Approx(scene.distance(scene.place(points.points[i]), scene.place(points.points[j])))
                  .epsilon(1e-5)
                  .margin(1e-12));
    const Support darts = support(Purpose::darts, scene.domain);
    const PoissonOptions in_simplices{.radius = 0.3, .order = DartOrder::simplices};
    if (darts)
      CHECK(poisson_disks(Serial{}, scene.domain, in_simplices).darts.size() > 2);
    else
      CHECK_THROWS_WITH(poisson_disks(Serial{}, scene.domain, in_simplices), darts.sentence());
    const PoissonDisks disks = poisson_disks(Serial{}, scene.domain, radius);
    CHECK(disks.darts.size() > 2);
    for (std::size_t i = 0; i < disks.darts.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        CHECK(scene.distance(scene.place(disks.darts[i]), scene.place(disks.darts[j])) >
              0.3 * (1 - 1e-4));
    const auto voronoi = centroidal_voronoi(Serial{}, scene.domain, points.points,
                                            VoronoiOptions{.max_iterations = 1});
    CHECK(voronoi.seeds.size() == 3);
  } else {
    CHECK_FALSE(found);
  }
}

}  // namespace

TEST_CASE("the table of what is done besides solving") {
  Count count;
#define PLEXWAY_CHECK(...)                                                   \
  visit_scenes<__VA_ARGS__>([&](const auto& scene) {                         \
    INFO(scene.name << (sizeof(RealOf<__VA_ARGS__>) == 4 ? ", float" : "")); \
    for (const Visibility visibility : visibilities) {                       \
      INFO("visibility " << static_cast<int>(visibility));                   \
      check_fields(Serial{}, scene, visibility, count);                      \
      check_searches(scene, visibility, count);                              \
    }                                                                        \
    check_samples(scene, count);                                             \
  });
  PLEXWAY_DOMAINS(PLEXWAY_CHECK)
#undef PLEXWAY_CHECK
  CHECK(count.yes == 102);
  CHECK(count.no > 100);
}

TEST_CASE("the table of what is done besides solving, after a team", "[threads]") {
  if (!openmp_built()) return;
  Count count;
#define PLEXWAY_CHECK(...)                                                 \
  visit_scenes<__VA_ARGS__>([&](const auto& scene) {                       \
    INFO(scene.name);                                                      \
    check_fields(OpenMP{.threads = 2}, scene, Visibility::saddles, count); \
  });
  PLEXWAY_DOMAINS(PLEXWAY_CHECK)
#undef PLEXWAY_CHECK
  CHECK(count.yes > 10);
}

}  // namespace plexway::testing::matrix_test
