#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/version.hpp>

static_assert(PLEXWAY_VERSION == plexway::version_major * 10000 + plexway::version_minor * 100 +
                                     plexway::version_patch);

/// A unit square folded along its diagonal: the way from corner to corner unfolds it again.
int main() {
  try {
    const double half = std::sqrt(0.5);
    const std::vector<std::array<double, 3>> positions = {
        {0, -half, 0}, {half, 0, 0}, {0, half, 0}, {0, 0, half}};
    const std::vector<std::array<plexway::Index, 3>> faces = {{0, 1, 2}, {0, 2, 3}};
    const plexway::TriangleMesh<float> mesh(positions, faces);
    const auto field = plexway::solve(plexway::Serial{}, mesh, plexway::PointSource::at(1));
    std::printf("plexway %s: distance over the fold %.6f\n", plexway::version_string,
                static_cast<double>(field.distance[3]));
    return std::abs(static_cast<double>(field.distance[3]) - std::sqrt(2.0)) < 1e-5 ? 0 : 1;
  } catch (const plexway::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
