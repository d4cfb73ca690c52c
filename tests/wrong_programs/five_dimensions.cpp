// More dimensions than there are.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

auto count(const SimplicialComplex<double, 5>& complex) { return complex.simplex_count(); }
