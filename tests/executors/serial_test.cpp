#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include <plexway/error.hpp>

#include "labels/solid_solving.hpp"
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

namespace {

template <class Real>
DistanceField<Real> several(const TetMesh<Real>& mesh, const std::vector<PointSource>& sources,
                            const PropagateOptions& options = {}) {
  return plexway::solve(Serial{}, mesh, std::span<const PointSource>(sources), options);
}

}  // namespace

TEMPLATE_TEST_CASE("solids: a workspace is reused, bit for bit", "", float, double) {
  const Solid s = walled(8);
  const auto mesh = s.mesh<TestType>();
  Workspace<TestType> workspace;
  const PointSource one[] = {PointSource::at(0)}, other[] = {PointSource::in(40, {.1, .2, .3, .4})};
  for (const Visibility visibility : solid_visibilities)
    for (const Schedule schedule : schedules)
      check_again(workspace, mesh, one, other, {.visibility = visibility, .schedule = schedule});
}

TEST_CASE("solids: what no path reaches is infinite") {
  Solid s = solid_cube(3);
  const Index first = static_cast<Index>(s.positions.size());
  const Solid other = moved(solid_cube(2), 1, {9, 0, 0});
  s.positions.insert(s.positions.end(), other.positions.begin(), other.positions.end());
  for (Tet t : other.tets) {
    for (Index& v : t) v += first;
    s.tets.push_back(t);
  }
  s.positions.push_back({50, 50, 50});
  const auto mesh = s.mesh<double>();
  CHECK(mesh.summary().components == 2);
  CHECK(mesh.summary().unreferenced_vertices == 1);
  for (const Visibility visibility : solid_visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    const auto d = solve(mesh, PointSource::at(0), options);
    for (Index v = 0; v < d.size(); ++v) CHECK(std::isinf(d[v]) == (v >= first));
    const auto alone = solve(mesh, PointSource::at(static_cast<Index>(d.size() - 1)), options);
    CHECK(alone.back() == 0);
    CHECK(std::isinf(alone[0]));
  }
}

TEST_CASE("solids: the nearest of several sources, with offsets") {
  const Solid s = solid_cube(6);
  const Index a = s.nearest(0, 0, 0), b = s.nearest(1, 1, 1);
  PointSource late = PointSource::at(b);
  late.offset = 0.5;
  const auto field = several(s.mesh<double>(), {PointSource::at(a), late});
  const auto from_a = straight(s, s.positions[a]), from_b = straight(s, s.positions[b]);
  for (std::size_t v = 0; v < from_a.size(); ++v) {
    CHECK(field.distance[v] == Approx(std::min(from_a[v], from_b[v] + 0.5)).epsilon(1e-9));
    if (std::abs(from_a[v] - from_b[v] - 0.5) > 0.2)
      CHECK(field.label[v] == (from_a[v] < from_b[v] + 0.5 ? 0 : 1));
  }
  CHECK(field.distance[b] == 0.5);
  CHECK(field.distance[a] == 0);
}

TEST_CASE("solids: radius, budget, progress") {
  const Solid s = solid_cube(8);
  const auto mesh = s.mesh<double>();
  const auto all = plexway::solve(Serial{}, mesh, PointSource::at(0));
  PropagateOptions options;
  options.radius = 0.4;
  const auto near = plexway::solve(Serial{}, mesh, PointSource::at(0), options);
  for (std::size_t v = 0; v < all.distance.size(); ++v)
    CHECK(near.distance[v] == (all.distance[v] <= 0.4 ? all.distance[v] : infinity));
  CHECK(near.statistics.expansions < all.statistics.expansions / 4);
  options = {};
  options.max_expansions = 100;
  const auto some = plexway::solve(Serial{}, mesh, PointSource::at(0), options);
  CHECK(!some.complete);
  CHECK(some.statistics.expansions == 100);
  CHECK(all.complete);
  options = {};
  options.progress = [](const Progress&) { return false; };
  const auto big = solid_cube(24).mesh<float>();
  CHECK_THROWS_AS(plexway::solve(Serial{}, big, PointSource::at(0), options), Cancelled);
}

TEST_CASE("solids: calls that make no sense are refused") {
  const auto mesh = solid_cube(2).mesh<double>();
  const auto refuse = [&](const PointSource& source, const PropagateOptions& options = {}) {
    CHECK_THROWS_AS(plexway::solve(Serial{}, mesh, source, options), UsageError);
  };
  CHECK_THROWS_AS(several(mesh, {}), UsageError);
  refuse(PointSource::at(27));
  refuse(PointSource::in(48, {1, 0, 0, 0}));
  refuse(PointSource::in(0, {.5, .2, .1, .1}));
  refuse(PointSource::in(0, {-.5, .5, .5, .5}));
  PointSource source = PointSource::at(0);
  source.offset = -1;
  refuse(source);
  source.offset = infinity;
  refuse(source);
  PropagateOptions options;
  options.step = 0;
  refuse(PointSource::at(0), options);
  options = {};
  options.radius = -1;
  refuse(PointSource::at(0), options);
  options = {};
  options.visibility = Visibility::tuned;
  refuse(PointSource::at(0), options);
}

}  // namespace plexway::testing::serial_test
