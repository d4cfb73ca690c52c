// An order that needs one thread.
#include <plexway/solve.hpp>

using namespace plexway;

auto field(const Wireframe<double>& wires) { return solve(OpenMP{}, wires, 0, NearestFirst{}); }
