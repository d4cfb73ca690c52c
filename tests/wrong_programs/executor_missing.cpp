// No executor.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

auto field(const TriangleMesh<float>& mesh) { return solve(mesh, 0); }
