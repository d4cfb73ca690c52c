// Solids by lengths alone whose speed changes evenly: rays are arcs of circles, and times known in
// closed form. Cut by Kuhn's grid, where rays pass exactly through edges and corners of faces.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include <plexway/metric/edge_lengths.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>

namespace plexway::testing::solid_media_test {

namespace {

struct Errors {
  double mean = 0, most = 0, least = 0;  // relative
};

// In a cube of n cells a side, whose speed is 1 + slope x, from the place `from` n along each axis.
template <class Real>
Errors errors(Index n, double slope, double from) {
  const KuhnGrid<3> grid({n, n, n}, {1. / n, 1. / n, 1. / n});
  std::vector<std::array<double, 3>> at;
  metric::VertexTensors tensors;
  for (Index v = 0; v < grid.vertex_count(); ++v) {
    at.push_back(grid.position(v));
    tensors.tensor.push_back(metric::Tensor::of_speed(1 + slope * at[v][0]));
  }
  const auto tets = grid.simplices();
  const TetMesh<Real> mesh(at.size(), tets, metric::tet_lengths(at, tets, tensors));
  Index source = 0;
  for (Index v = 0; v < at.size(); ++v)
    if (std::hypot(at[v][0] - from, at[v][1] - from, at[v][2] - from) < .1 / n) source = v;
  const auto field = solve(Serial{}, mesh, source);
  Errors found;
  for (Index v = 0; v < at.size(); ++v) {
    if (v == source) continue;
    const auto &p = at[v], &q = at[source];
    const double apart = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    const double z = std::pow(slope * apart, 2) / (2 * (1 + slope * p[0]) * (1 + slope * q[0]));
    const double time = std::log1p(z + std::sqrt(z * (z + 2))) / slope;
    const double off = (static_cast<double>(field[v]) - time) / time;
    found.mean += std::abs(off) / static_cast<double>(at.size() - 1);
    found.most = std::max(found.most, off);
    found.least = std::min(found.least, off);
  }
  return found;
}

}  // namespace

TEMPLATE_TEST_CASE("solids whose speed changes slowly have the times of bent rays", "", float,
                   double) {
  for (const double from : {0., .5})
    for (const Index n : {10u, 20u}) {
      CAPTURE(from, n);
      // No ray is lost because space is bent: without the tolerance 2.5e-2 too long.
      const Errors slow = errors<TestType>(n, .01, from);
      CHECK(slow.mean < 1e-6);
      CHECK(slow.most < 3e-6);
      CHECK(slow.least > -3e-6);
      // Twice as fast at the far side. Tetrahedra hand on one source each: lines that cannot be
      // straight are too short by up to a hundredth.
      const Errors fast = errors<TestType>(n, 1, from);
      CHECK(fast.mean < 1.5e-3);
      CHECK(fast.most < 4e-3);
      CHECK(fast.least > -1.3e-2);
    }
}

}  // namespace plexway::testing::solid_media_test
