#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>

#include <plexway/io/triangles.hpp>

#include "complexes/test_wires.hpp"
#include "exact_data.hpp"
#include "executors/parity.hpp"
#include "labels/simplex_testing.hpp"
#include "labels/solid_solving.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::openmp_parity_test {

namespace fs = std::filesystem;

// OpenMP against Serial, by labels (windows are one thread's: the same bits). Where the step is
// exact, order does not matter, and the two agree to rounding. Elsewhere the order of updates
// decides which of two paths a simplex hears of first: there OpenMP may differ from Serial as much
// as Serial's schedules do from each other, and must be as accurate.

TEMPLATE_TEST_CASE("a team agrees with one thread where the step is exact", "", float, double) {
  const double tolerance = sizeof(TestType) == 4 ? 2e-6 : 1e-13;
  unsigned seed = 0;
  const auto check = [&](const auto& domain, std::size_t count) {
    const auto sources = random_sources(domain, count, ++seed);
    const auto alone = solve(Serial{}, domain, sources, by_labels());
    for (const int threads : {1, 2, 8}) {
      const auto field = solve(team(threads), domain, sources, by_labels());
      const Parity p = parity(alone, field);
      INFO("domain " << seed << ", " << threads << " threads");
      CHECK(p.worst < tolerance);
      CHECK(p.reached_by_one == 0);
      if (p.other_label == 0) continue;
      // Labels differ at ties only: both sources are as near.
      const auto rows =
          solve_each(Serial{}, domain, std::span<const PointSource>(sources), by_labels());
      for (std::size_t v = 0; v < field.label.size(); ++v) {
        if (field.label[v] == alone.label[v]) continue;
        const double a = static_cast<double>(rows.row(field.label[v])[v]);
        const double b = static_cast<double>(rows.row(alone.label[v])[v]);
        CHECK(std::abs(a - b) <= tolerance * a);
      }
    }
  };
  for (const std::size_t count : {1u, 7u}) {
    for (const Surface& s : {grid(30, 30), grid(40, 12, 3, 1), slit_square(16), cube(12),
                             prism(24, 12, 2), bow_tie(12), soup(60, 120, 3), soup(80, 90, 4)})
      check(s.mesh<TestType>(), count);
    check(solid_cube(5, 0.1).template mesh<double>(), 1);
    check(edge_touch(3).template mesh<TestType>(), count);
    check(vertex_touch(3).template mesh<TestType>(), count);
    for (unsigned i = 1; i <= 6; ++i)
      check(random_wires(i, 800, 2000, 0.3 * i).template wireframe<TestType>(), count);
  }
  for (unsigned i = 1; i <= 6; ++i) check(random_polygon(4 + i, 200, 200, i).mesh<TestType>(), 1);
  check(cube_grid<2>(16, 3).template complex<TestType>(), 1);
  check(cube_grid<3>(5, 3).template complex<TestType>(), 1);
  check(cube_grid<4>(3, 3).template complex<TestType>(), 1);
  check(l_shape(4).mesh<double>(), 1);
}

namespace {

// Means over several fields.
struct Tally {
  double team = 0, schedules = 0;
  std::size_t count = 0;

  template <class Domain>
  void add(const Domain& domain, const std::vector<PointSource>& sources) {
    PropagateOptions options = by_labels();
    const auto alone = solve(Serial{}, domain, sources, options);
    team += parity(alone, solve(testing::team(2), domain, sources, options)).mean;
    double largest = 0;
    for (const Schedule schedule : {Schedule::priority, Schedule::fifo}) {
      options.schedule = schedule;
      largest = std::max(largest, parity(alone, solve(Serial{}, domain, sources, options)).mean);
    }
    schedules += largest;
    ++count;
  }
};

}  // namespace

TEST_CASE("a team differs from one thread as schedules of one thread do") {
  Tally surfaces, solids;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    for (const Surface& s :
         {sphere(3), sphere(4), moebius(60, 8), moebius(120, 6), sheets(3, 12)}) {
      const auto mesh = s.mesh<double>();
      surfaces.add(mesh, random_sources(mesh, 1, seed));
      surfaces.add(mesh, random_sources(mesh, 5, seed));
    }
    const auto solid = walled(6, 0.25).mesh<double>();
    solids.add(solid, random_sources(solid, 3, seed));
  }
  const double n = static_cast<double>(surfaces.count), m = static_cast<double>(solids.count);
  INFO("team " << surfaces.team / n << ", schedules " << surfaces.schedules / n);
  INFO("in solids " << solids.team / m << ", " << solids.schedules / m);
  CHECK(surfaces.team <= 1.75 * surfaces.schedules);
  CHECK(surfaces.team / n < 5e-4);
  CHECK(solids.team <= 1.75 * solids.schedules);
  CHECK(solids.team / m < 1e-3);
}

TEST_CASE("a team is as accurate as one thread on a sphere") {
  const Surface s = sphere(5);
  const auto mesh = s.mesh<double>();
  const Position& from = s.positions[0];
  // Of the round sphere: what the mesh is off is the same for both.
  const auto exact = by_rule(s, [&](const Position& p) {
    return 2 *
           std::asin(std::min(std::hypot(p[0] - from[0], p[1] - from[1], p[2] - from[2]) / 2, 1.));
  });
  const Errors alone =
      compare(solve(Serial{}, mesh, PointSource::at(0), by_labels()).distance, exact);
  const Errors several =
      compare(solve(team(8), mesh, PointSource::at(0), by_labels()).distance, exact);
  CHECK(several.fits);
  CHECK(several.mean < 1.1 * alone.mean);
  CHECK(several.max < 1.25 * alone.max);
}

TEST_CASE("a team is as accurate as one thread on real surfaces") {
  double alone_sum = 0, team_sum = 0;
  for (const auto& [name, source] :
       {std::pair("spot", 1357), std::pair("spot", 2367), std::pair("fandisk", 2095),
        std::pair("rocker-arm", 4092), std::pair("rocker-arm", 9152), std::pair("camelhead", 5506),
        std::pair("beetle_car", 1430), std::pair("bunny", 3160), std::pair("bunny", 4292),
        std::pair("armadillo", 4538)}) {
    const fs::path file = exact_file("surfaces", std::string(name) + ".obj");
    if (file.empty()) continue;
    const io::Triangles read = io::read_triangles(file);
    const std::vector<double> exact =
        exact_values(exact_file("surfaces", name + (".v" + std::to_string(source)) + ".txt"));
    const TriangleMesh<float> mesh(read.positions, read.triangles);
    const auto from = PointSource::at(static_cast<Index>(source));
    const Errors alone = compare(solve(Serial{}, mesh, from, by_labels()).distance, exact);
    const Errors several =
        compare(solve(OpenMP{.threads = 2}, mesh, from, by_labels()).distance, exact);
    // On one mesh any order of one thread's is as good: those of beetle_car give .7 to 2.1e-3.
    double poorest = alone.mean;
    PropagateOptions options = by_labels();
    for (const double step : {0.25, 0.5, 2.}) {
      options.step = step;
      poorest =
          std::max(poorest, compare(solve(Serial{}, mesh, from, options).distance, exact).mean);
    }
    INFO(name << " " << source << ": " << alone.mean << " to " << poorest << ", team "
              << several.mean);
    CHECK(several.fits);
    CHECK(several.mean < 1.5 * poorest);
    alone_sum += alone.mean;
    team_sum += several.mean;
  }
  CHECK(alone_sum > 0);
  CHECK(team_sum < 1.1 * alone_sum);
}

}  // namespace plexway::testing::openmp_parity_test
