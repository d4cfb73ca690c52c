// GL against a team in rounds: the same rounds, so the same distances. On a device that rounds as
// the processor does (llvmpipe), solids, wireframes (in whatever order) and labels come out with
// the same bits; on surfaces the read-out adds in another order. (`vectorised` off: the vectorised
// step rounds elsewhere, and rounding decides between equal paths.)

#include <catch2/catch.hpp>
#include <filesystem>

#include <plexway/executors/gl.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "complexes/test_wires.hpp"
#include "exact_data.hpp"
#include "gl/device.hpp"
#include "gl/rounds.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::parity_test {

namespace {

struct Together {
  DistanceField<float> team, device;

  template <class Domain>
  Together(const Domain& domain, std::span<const PointSource> sources) {
    PropagateOptions options = by_labels();
    options.vectorised = false;
    team = solve_in_rounds(domain, sources, options);
    device = solve(GL{}, domain, sources, options);
  }
  /// Relative differences at most these, where the arithmetic is the same.
  void check(const gl::Context& context, double mean, double worst) const {
    const Difference found = difference(team.distance, device.distance);
    CAPTURE(found.mean, found.max);
    CHECK(found.fits);
    CHECK(device.statistics.reached_simplices == team.statistics.reached_simplices);
    // Elsewhere rounding decides now and then which of two paths a simplex keeps. And what lies
    // below the straight line in space a team raises, a device does not.
    const bool alike = exact(context) && team.statistics.raised_vertices == 0;
    CHECK(found.mean <= (alike ? mean : 1e-3));
    CHECK(found.max <= (alike ? worst : 4e-2));
    if (!exact(context)) return;
    CHECK(device.statistics.expansions == team.statistics.expansions);
    std::size_t others = 0;
    for (std::size_t v = 0; v < team.label.size(); ++v) others += team.label[v] != device.label[v];
    CHECK(others <= team.label.size() / 1000 + 2);  // at ties
  }
};

std::vector<PointSource> some_sources(std::size_t vertices, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<PointSource> sources;
  for (std::size_t n = 0; n < count; ++n)
    sources.push_back(PointSource::at(below(random, vertices)));
  return sources;
}

Surface hills(Index n) {
  Surface s = grid(n, n);
  for (Position& p : s.positions) p[2] = 0.2 * std::sin(9 * p[0]) * std::cos(7 * p[1]);
  return s;
}

}  // namespace

TEST_CASE("a device and a team do the same rounds on surfaces", "[gl]") {
  const auto context = device();
  if (!context || !openmp_built()) return;
  const Surface some[] = {
      grid(14, 9),     slit_square(12), random_polygon(7, 60, 200, 5),
      cube(7),         sphere(3),       sphere(4),
      prism(9, 12, 4), moebius(30, 4),  sheets(5, 6),
      hills(24),       hills(70),       renamed(hills(20), 3, true, true).surface};
  for (const Surface& s : some)
    for (const std::size_t count : {1u, 5u, 40u}) {
      CAPTURE(s.faces.size(), count);
      const auto mesh = s.mesh<float>();
      Together(mesh, some_sources(s.positions.size(), count, 3)).check(*context, 1e-7, 1e-4);
    }
}

TEST_CASE("a device and a team do the same rounds on real surfaces", "[gl]") {
  const auto context = device();
  if (!context || !openmp_built()) return;
  for (const char* const name :
       {"spot", "fandisk", "rocker-arm", "camelhead", "beetle_car", "bunny"}) {
    CAPTURE(name);
    const auto file = exact_file("surfaces", std::string(name) + ".obj");
    if (file.empty()) continue;
    const auto t = io::read_triangles(file);
    const TriangleMesh<float> mesh(t.positions, t.triangles);
    for (const std::size_t count : {1u, 20u})
      Together(mesh, some_sources(mesh.vertex_count(), count, 9)).check(*context, 1e-7, 1e-4);
  }
}

TEST_CASE("a device and a team do the same rounds in solids, and agree in wireframes", "[gl]") {
  const auto context = device();
  if (!context || !openmp_built()) return;
  for (const Solid& s : {solid_cube(6), l_shape(10), walled(10), edge_touch(5), vertex_touch(5),
                         pipe(16, 6, 4), pipe(40, 3, 10, 0.1)})
    for (const std::size_t count : {1u, 6u})
      for (unsigned seed = 1; seed < 4; ++seed) {
        CAPTURE(s.tets.size(), count, seed);
        const auto mesh = s.mesh<float>();
        Together(mesh, some_sources(s.positions.size(), count, seed)).check(*context, 1e-9, 1.2e-7);
      }
  for (unsigned seed = 1; seed < 5; ++seed) {
    const auto wires = random_wires(seed, 500, 1200, 0.4 * seed).wireframe<float>();
    CAPTURE(seed);
    const auto sources = some_sources(wires.vertex_count(), 4, seed);
    const Difference found =
        difference(solve(OpenMP{.threads = 2, .piece = 50}, wires, sources).distance,
                   solve(GL{}, wires, sources).distance);
    CHECK(found.fits);
    CHECK(found.max <= (exact(*context) ? 0 : 1e-6));
  }
}

}  // namespace plexway::testing::parity_test
