// A source as the tool's options have it.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

auto field(const TriangleMesh<float>& mesh) { return solve(Serial{}, mesh, "vertex:0"); }
