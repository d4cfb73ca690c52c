// Points whose neighbours nobody looked for.
#include <array>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>

using namespace plexway;

const std::vector<std::array<double, 3>> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const PointCloud<float> cloud(points);
