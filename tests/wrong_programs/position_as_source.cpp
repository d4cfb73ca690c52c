// A position in space as a source.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

auto field(const TriangleMesh<float>& mesh) {
  return solve(Serial{}, mesh, std::array<double, 3>{.5, .5, 0});
}
