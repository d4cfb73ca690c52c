// An order that the executor does not know.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

auto field(const TriangleMesh<float>& mesh) { return solve(GL{}, mesh, 0, NearestFirst{}); }
