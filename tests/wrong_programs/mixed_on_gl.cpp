// An executor that does not take the domain.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

auto field(const MixedComplex<float>& mixed) { return solve(GL{}, mixed, 0); }
