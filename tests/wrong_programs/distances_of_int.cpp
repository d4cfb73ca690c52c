// Distances in whole numbers.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

const std::vector<std::array<double, 3>> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const TriangleMesh<int> mesh(positions, std::vector<std::array<Index, 3>>{{0, 1, 2}});
