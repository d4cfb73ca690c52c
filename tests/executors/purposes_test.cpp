// What is done on a domain besides solving: every cell of that table (support.hpp, Purpose) that a
// program reaches with a complex in its hands. Every yes is right by the closed form, every no says
// its sentence. tests/shape/purposes_test.cpp has the others, which take any domain.

#include <catch2/catch.hpp>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/pairs/distance_matrix.hpp>
#include <plexway/paths/bounded_search.hpp>
#include <plexway/paths/cloud_path_field.hpp>
#include <plexway/paths/mixed_path_field.hpp>
#include <plexway/paths/path_search.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/farthest_points.hpp>
#include <plexway/sampling/poisson_disk.hpp>

#include "executors/check_scene.hpp"

namespace plexway::testing::purposes_test {

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
    const auto cells = centroidal_voronoi(Serial{}, scene.domain, points.points,
                                          VoronoiOptions{.max_iterations = 1});
    CHECK(cells.seeds.size() == 3);
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
#define PLEXWAY_CHECK(...)                                                             \
  visit_scenes<__VA_ARGS__>([&](const auto& scene) {                                   \
    INFO(scene.name);                                                                  \
    check_fields(OpenMP{.threads = 2, .chunk = 8}, scene, Visibility::saddles, count); \
  });
  PLEXWAY_DOMAINS(PLEXWAY_CHECK)
#undef PLEXWAY_CHECK
  CHECK(count.yes > 10);
}

}  // namespace plexway::testing::purposes_test
