// A domain stays on the device for the next solve. Another one that differs from it in a few
// records only must not be taken for it, and neither must what a move or an assignment left behind.

#include <catch2/catch.hpp>
#include <span>
#include <utility>
#include <vector>

#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "gl/device.hpp"

namespace plexway::testing::identity_test {

namespace {

template <class Domain>
std::vector<float> on_device(const Domain& domain, Index source, GLWorkspace& workspace,
                             double radius = 1e30) {
  const PointSource at = PointSource::at(source);
  DistanceField<float> field;
  PropagateOptions options;
  options.radius = radius;
  solve(GL{}, domain, std::span<const PointSource>(&at, 1), options, workspace, field);
  return field.distance;
}

}  // namespace

TEST_CASE("wireframes that differ in one length only are told apart on a device", "[gl]") {
  if (!device()) return;
  constexpr Index edges = 20000;  // a chain, one edge of which is longer
  std::vector<std::array<Index, 2>> ends;
  for (Index e = 0; e < edges; ++e) ends.push_back({e, e + 1});
  GLWorkspace workspace;
  for (Index longer = 9000; longer < 9020; ++longer) {
    std::vector<double> lengths(edges, 1);
    lengths[longer] = 3;
    const Wireframe<float> chain(edges + 1, ends, lengths);
    const auto distance = on_device(chain, longer - 5, workspace, 20);
    CAPTURE(longer);
    CHECK(distance[longer] == 5);
    CHECK(distance[longer + 1] == 8);
  }
}

TEST_CASE("surfaces that differ around one vertex only are told apart on a device", "[gl]") {
  if (!device()) return;
  constexpr Index n = 150;
  GLWorkspace workspace;
  for (Index k = 0; k < 12; ++k) {
    Surface s = grid(n, n, n, n);  // unit cells, and one vertex in a row of them is a spike
    const Index spike = (n + 1) * (70 + k) + 40 + 3 * k;
    s.positions[spike][2] = 4;
    const auto distance = on_device(s.mesh<float>(), spike, workspace, 8);
    CAPTURE(spike);
    CHECK(double(distance[spike + 1]) == Approx(std::sqrt(17.)).epsilon(1e-5));
  }
}

TEST_CASE("solids that differ in a few vertices only are told apart on a device", "[gl]") {
  if (!device()) return;
  GLWorkspace workspace;
  Solid s = solid_cube(10);
  const Index corner = s.nearest(1, 1, 1);
  for (int k = 0; k < 6; ++k) {
    s.positions[corner] = {1 + 1e-2 * k, 1, 1};
    const auto distance = on_device(s.mesh<float>(), s.nearest(0, 0, 0), workspace);
    CHECK(double(distance[corner]) ==
          Approx(straight(s, s.positions[s.nearest(0, 0, 0)])[corner]).epsilon(1e-5));
  }
}

TEST_CASE("domains on a device after moves, copies and assignments", "[gl]") {
  if (!device()) return;
  GLWorkspace workspace;
  const auto small = grid(4, 4, 4, 4).mesh<float>(), other = grid(4, 4, 8, 8).mesh<float>();
  CHECK(small.identity() != other.identity());
  TriangleMesh<float> mesh = small;  // the same content, the same identity
  CHECK(mesh.identity() == small.identity());
  CHECK(double(on_device(mesh, 0, workspace)[4]) == Approx(4));
  CHECK(double(on_device(small, 0, workspace)[4]) == Approx(4));
  mesh = other;
  CHECK(mesh.identity() == other.identity());
  CHECK(double(on_device(mesh, 0, workspace)[4]) == Approx(8));
  const auto before = mesh.identity();
  TriangleMesh<float> taken = std::move(mesh);
  CHECK(taken.identity() == before);
  CHECK(mesh.identity() != before);  // NOLINT(bugprone-use-after-move): that is the question
  CHECK(double(on_device(taken, 0, workspace)[4]) == Approx(8));
  mesh = small;
  CHECK(double(on_device(mesh, 0, workspace)[4]) == Approx(4));
  taken = std::move(mesh);
  CHECK(taken.identity() == small.identity());
  CHECK(mesh.identity() != small.identity());  // NOLINT(bugprone-use-after-move)
  CHECK(double(on_device(taken, 0, workspace)[4]) == Approx(4));
}

TEST_CASE("a domain that did not fit leaves nothing of itself on a device", "[gl]") {
  const auto context = device();
  if (!context) return;
  const auto side = static_cast<Index>(std::sqrt(double(context->limits().block) / 64 / 2)) + 2;
  if (side > 1200) return;  // this device takes more triangles than a test should make
  GLWorkspace workspace;
  const auto small = grid(4, 4, 4, 4).mesh<float>();
  CHECK(double(on_device(small, 0, workspace)[4]) == Approx(4));
  const auto large = grid(side, side).mesh<float>();
  CHECK_THROWS_AS(on_device(large, 0, workspace), NotBuiltError);
  CHECK(double(on_device(small, 0, workspace)[4]) == Approx(4));
}

}  // namespace plexway::testing::identity_test
