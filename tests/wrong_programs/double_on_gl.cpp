// Double precision on an executor that has none.
#include <plexway/solve.hpp>

using namespace plexway;

auto fields(const TriangleMesh<double>& mesh) { return solve_each(GL{}, mesh, {0, 1}); }
