// An accuracy where all options stand.
#include <plexway/solve.hpp>

using namespace plexway;

auto field(const TriangleMesh<double>& mesh) { return solve(Serial{}, mesh, 0, Accuracy::exact()); }
