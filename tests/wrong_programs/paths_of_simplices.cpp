// Paths where none are traced.
#include <array>
#include <vector>

#include <plexway/paths/path_field.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>

using namespace plexway;

auto paths(const SimplicialComplex<double, 3>& complex,
           const std::vector<std::array<double, 3>>& positions) {
  return PathField(complex, positions);
}
