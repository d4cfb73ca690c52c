#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include <plexway/error.hpp>

#include "labels/solid_solving.hpp"

namespace plexway::testing::serial_solid_test {

namespace {
const double infinity = std::numeric_limits<double>::infinity();

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
  DistanceField<TestType> field;
  const PointSource one[] = {PointSource::at(0)}, other[] = {PointSource::in(40, {.1, .2, .3, .4})};
  for (const Visibility visibility : solid_visibilities)
    for (const Schedule schedule : schedules) {
      PropagateOptions options;
      options.visibility = visibility;
      options.schedule = schedule;
      plexway::solve(Serial{}, mesh, one, options, workspace, field);
      const auto first = field.distance;
      plexway::solve(Serial{}, mesh, other, options, workspace, field);
      plexway::solve(Serial{}, mesh, one, options, workspace, field);
      CHECK(first == field.distance);
      CHECK(first == plexway::solve(Serial{}, mesh, one[0], options).distance);
    }
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

}  // namespace plexway::testing::serial_solid_test
