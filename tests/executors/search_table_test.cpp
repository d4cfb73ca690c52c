// Searches, and fields that samples grow, ask the table (support_of_searches): every yes finds what
// the closed form says, every no says its sentence.

#include <catch2/catch.hpp>
#include <vector>

#include <plexway/apps/bounded_search.hpp>
#include <plexway/apps/farthest_points.hpp>
#include <plexway/apps/path_search.hpp>
#include <plexway/error.hpp>

#include "executors/check_scene.hpp"

using namespace plexway;
using namespace plexway::testing;

TEMPLATE_TEST_CASE("the table of searches", "", float, double) {
  using Mesh = TriangleMesh<TestType>;
  Count count;
  visit_scenes<Mesh>([&](const auto& scene) {
    INFO(scene.name);
    const Mesh& mesh = scene.domain;
    const auto straight = [&](Index v) { return scene.distance(scene.places[0], scene.places[v]); };
    for (const Visibility visibility : visibilities) {
      const Support found = support_of_searches(mesh.metric(), visibility);
      PropagateOptions options;
      options.visibility = visibility;
      options.radius = 0.5;
      const PointSource source = PointSource::at(0);
      const auto search = [&] {
        BoundedSearch<TestType> near(mesh);
        return near.find(Serial{}, std::span<const PointSource>(&source, 1), options);
      };
      if (!found) {
        CHECK_THROWS_WITH(search(), found.sentence());
        ++count.no;
        continue;
      }
      const auto near = search();
      CHECK(near.vertices.size() > 3);
      for (const auto& [vertex, distance, label] : near.vertices) {
        CHECK(distance == Approx(straight(vertex)).epsilon(1e-5).margin(1e-12));
        CHECK(label == 0);
      }
      ++count.yes;
    }
    const Support found = support_of_searches(mesh.metric());
    const Index far = static_cast<Index>(mesh.vertex_count() - 1);
    const auto path = [&] {
      return PathSearch<TestType>(mesh).find(Serial{}, PointSource::at(0), PointSource::at(far));
    };
    const PointSource from[] = {PointSource::at(0)};
    const auto grown = [&] { return farthest_points(Serial{}, mesh, from, {.count = 3}); };
    if (!found) {
      CHECK_THROWS_WITH(path(), found.sentence());
      CHECK_THROWS_WITH(grown(), found.sentence());
    } else {
      CHECK(path().distance[0] == Approx(straight(far)).epsilon(1e-5));
      CHECK(grown().points.size() == 3);
    }
  });
  CHECK(count.yes > 0);
  CHECK(count.no > 4);
}
