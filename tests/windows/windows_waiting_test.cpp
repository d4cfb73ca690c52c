#include <catch2/catch.hpp>
#include <cstddef>

#include <plexway/solve.hpp>

#include "data/shapes.hpp"

namespace plexway::windows_waiting_test {

TEMPLATE_TEST_CASE("merged windows hold few bytes a vertex", "[windows]", float, double) {
  const auto shape = samples::bumpy(50);
  const TriangleMesh<TestType> mesh(shape.points, shape.faces);
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  PropagateOptions options;
  options.accuracy = Accuracy::accurate();
  std::size_t first = 0;
  for (const Index source : {Index{0}, Index{7}, Index{20000}}) {
    solve(Serial{}, mesh, PointSource::at(source), options, workspace, field);
    if (first == 0) first = workspace.bytes();
  }
  const double bytes =
      static_cast<double>(workspace.bytes()) / static_cast<double>(mesh.vertex_count());
  CAPTURE(bytes);
  CHECK(bytes < (sizeof(TestType) == 4 ? 36 : 48));
  CHECK(2 * workspace.bytes() < 3 * first);
}

}  // namespace plexway::windows_waiting_test
