// Vertices as floats.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

const std::vector<std::array<double, 3>> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const TriangleMesh<float> mesh(positions, std::vector<float>{0, 1, 2});
