// An accuracy as Python has it.
#include <plexway/solve.hpp>

using namespace plexway;

auto field(const TriangleMesh<float>& mesh) {
  return solve(Serial{}, mesh, 0, {.accuracy = "exact"});
}
