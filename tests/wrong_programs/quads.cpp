// Quads as triangles.
#include <array>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

const std::vector<std::array<double, 3>> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::vector<std::array<int, 4>> quads = {{0, 1, 2, 0}};
const TriangleMesh<float> mesh(positions, quads);
