// Coordinates that were never made numbers.
#include <array>
#include <string>
#include <vector>

#include <plexway/solve.hpp>

using namespace plexway;

const std::vector<std::array<std::string, 3>> positions = {{"0", "0", "0"}};
const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}};
const TriangleMesh<float> mesh(positions, triangles);
