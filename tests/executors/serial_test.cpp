#include <catch2/catch.hpp>

#include <plexway/error.hpp>

#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::serial_test {

namespace {

const double infinity = std::numeric_limits<double>::infinity();

/// Enough faces for several calls of the progress callback.
Surface large() { return grid(200, 200); }

}  // namespace

TEMPLATE_TEST_CASE("options and sources that make no sense are refused", "", float, double) {
  const auto mesh = grid(3, 3).mesh<TestType>();
  const auto refused = [&](const PointSource& source, const PropagateOptions& options = {}) {
    CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, source, options), UsageError);
  };
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, std::span<const PointSource>{}), UsageError);
  refused({});
  refused(PointSource::at(16));
  refused(PointSource::in(18, {1, 0, 0}));
  refused(PointSource::in(0, {.5, .6, -.1}));
  refused(PointSource::in(0, {.5, .6, .1}));
  refused(PointSource::in(0, {nothing, .5, .5}));
  refused(PointSource::in(0, {infinity, 0, 0}));
  for (const double offset : {-1e-9, nothing, infinity}) {
    refused({.vertex = 0, .offset = offset});
    refused({.simplex = 0, .barycentric = {1, 0, 0}, .offset = offset});
  }
  PropagateOptions options;
  for (const double step : {0., -1., nothing}) {
    options.step = step;
    refused(PointSource::at(0), options);
  }
  options = {};
  for (const double radius : {-1., -infinity, nothing}) {
    options.radius = radius;
    refused(PointSource::at(0), options);
  }
  CHECK_THROWS_WITH(plexway::solve(Serial{}, mesh, PointSource::at(16)),
                    Catch::Matchers::Contains("16"));
}

TEMPLATE_TEST_CASE("any step gives the same answers up to rounding", "", float, double) {
  const Surface s = random_polygon(6, 200, 300, 5);
  const auto mesh = s.mesh<TestType>();
  PropagateOptions options = by_labels();
  for (const double step : {1e-3, .1, 1., 2., 50., infinity}) {
    options.step = step;
    const Errors e =
        compare(solve(mesh, PointSource::at(100), options), straight(s, s.positions[100]));
    CHECK(e.fits);
    CHECK(e.max < 2.5e-6);
  }
}

TEST_CASE("options that only labels know bring labels, or are refused beside windows") {
  const auto mesh = sphere(3).mesh<float>();
  const PointSource source = PointSource::at(7);
  const auto check = [&](PropagateOptions options) {
    const auto field = plexway::solve(Serial{}, mesh, source, options);
    CHECK(field.accuracy == Accuracy::fast());
    CHECK(field.error.empty());
    options.accuracy = Accuracy::fast();
    CHECK(plexway::solve(Serial{}, mesh, source, options).distance == field.distance);
    options.accuracy = Accuracy::accurate();
    CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, source, options), UsageError);
  };
  CHECK(plexway::solve(Serial{}, mesh, source).accuracy == Accuracy::accurate());
  PropagateOptions options;
  options.step = 2;
  check(options);
  options = {};
  options.vectorised = false;
  check(options);
  for (const Visibility visibility :
       {Visibility::tuned, Visibility::centroid, Visibility::upper_bound}) {
    options = {};
    options.visibility = visibility;
    check(options);
  }
}

TEMPLATE_TEST_CASE("within the radius nothing changes, beyond is out of reach", "", float, double) {
  const Surface s = sphere(4);
  const auto mesh = s.mesh<TestType>();
  const auto whole = plexway::solve(Serial{}, mesh, PointSource::at(3));
  for (const Visibility visibility : visibilities)
    for (const Schedule schedule : schedules)
      for (const double radius : {0., .3, 1., 2.5, 10.}) {
        PropagateOptions options;
        options.visibility = visibility;
        options.schedule = schedule;
        const auto all = plexway::solve(Serial{}, mesh, PointSource::at(3), options);
        options.radius = radius;
        const auto part = plexway::solve(Serial{}, mesh, PointSource::at(3), options);
        CAPTURE(name(options), radius);
        double worst = 0;
        bool outside = true;
        for (std::size_t v = 0; v < all.distance.size(); ++v) {
          const double d = all.distance[v], e = part.distance[v];
          if (d <= .99 * radius)
            worst = std::max(worst, std::isinf(e) ? infinity : std::abs(e - d));
          if (d > 1.01 * radius) outside &= std::isinf(e);
          outside &= std::isinf(e) || e <= radius * (1 + 1e-6);
        }
        CHECK(worst <= 1e-3 * radius);
        CHECK(outside);
        CHECK(part.distance[3] == 0);
        CHECK(part.complete);
        if (radius < 1) CHECK(part.statistics.expansions < all.statistics.expansions / 2);
      }
}

TEMPLATE_TEST_CASE("an expansion budget ends a propagation early", "", float, double) {
  const auto mesh = large().mesh<TestType>();
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::usual()}) {
    PropagateOptions options = at(accuracy);
    const auto whole = plexway::solve(Serial{}, mesh, PointSource::at(0), options);
    CHECK(whole.complete);
    CHECK(whole.statistics.reached_simplices == mesh.face_count());
    if (accuracy == Accuracy::fast()) CHECK(whole.statistics.updates >= mesh.face_count());
    for (const std::size_t budget : {0ul, 1ul, 1000ul, 70000ul}) {
      options.max_expansions = budget;
      const auto part = plexway::solve(Serial{}, mesh, PointSource::at(0), options);
      CAPTURE(accuracy.error(), budget);
      CHECK_FALSE(part.complete);
      CHECK(part.statistics.expansions <= budget);
      CHECK(part.distance[0] == 0);
      bool valid = true;
      for (std::size_t v = 0; v < part.distance.size(); ++v)
        valid &= part.distance[v] >= whole.distance[v] * TestType(1 - 1e-5);
      CHECK(valid);
      CHECK(std::isinf(part.distance.back()));
    }
    options.max_expansions = whole.statistics.expansions + 1;
    CHECK(plexway::solve(Serial{}, mesh, PointSource::at(0), options).complete);
  }
}

TEMPLATE_TEST_CASE("progress is told and may cancel", "", float, double) {
  const auto mesh = large().mesh<TestType>();
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  const PointSource source[] = {PointSource::at(0)};
  std::vector<Progress> calls;
  PropagateOptions options;
  options.progress = [&](const Progress& p) {
    calls.push_back(p);
    return true;
  };
  plexway::solve(Serial{}, mesh, source, options, workspace, field);
  const auto expected = field.distance;
  REQUIRE(calls.size() >= 1);
  for (std::size_t i = 0; i < calls.size(); ++i) {
    CHECK(calls[i].simplices == mesh.face_count());
    CHECK(calls[i].reached <= mesh.face_count());
    CHECK(calls[i].distance >= 0);
    CHECK(calls[i].distance <= 1.5);
    if (i > 0) CHECK(calls[i].expansions > calls[i - 1].expansions);
  }
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, source, options, workspace, field), Cancelled);
  options.progress = nullptr;
  plexway::solve(Serial{}, mesh, source, options, workspace, field);
  CHECK(field.distance == expected);
}

TEST_CASE("a callback may throw") {
  const auto mesh = large().mesh<float>();
  Workspace<float> workspace;
  DistanceField<float> field;
  const PointSource source[] = {PointSource::at(0)};
  PropagateOptions options;
  options.progress = [](const Progress&) -> bool { throw 5; };
  CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, source, options, workspace, field), int);
  plexway::solve(Serial{}, mesh, source, {}, workspace, field);
  CHECK(field.complete);
}

TEST_CASE("the workspace tells its size") {
  const auto mesh = large().mesh<float>();
  Workspace<float> workspace;
  DistanceField<float> field;
  const PointSource source[] = {PointSource::at(0)};
  const std::size_t empty = workspace.bytes();
  plexway::solve(Serial{}, mesh, source, {}, workspace, field);
  const double faces = static_cast<double>(mesh.face_count());
  CHECK(empty < 2048);                           // lists without entries
  CHECK(double(workspace.bytes()) > 8 * faces);  // measured: 10
  // All in all a closed surface, two faces a vertex, takes at most 274 bytes a vertex.
  CHECK(double(workspace.bytes() + mesh.bytes()) < 274 * double(mesh.vertex_count()));
}

}  // namespace plexway::testing::serial_test
