#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>

#include "complexes/test_clouds.hpp"

// Lattices of points that something rounded: whether four points lie on one circle is then a matter
// of noise, and all four must decide alike.
namespace cloud_lattices_test {

TEST_CASE("a turned lattice becomes one flat sheet whatever its points are rounded to") {
  using plexway::PointCloud;
  constexpr int side = 24;
  for (const double noise : {0., 1e-9, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4, 3e-4, 1e-3})
    for (unsigned seed = 0; seed < 3; ++seed) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> one(-1, 1);
      const double turn = 3 * one(random), tilt = one(random);
      std::vector<std::array<double, 3>> points;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
          const double x = i + noise * one(random), y = j + noise * one(random),
                       z = noise * one(random);
          const double u = std::cos(turn) * x - std::sin(turn) * y,
                       v = std::sin(turn) * x + std::cos(turn) * y;
          points.push_back({u, std::cos(tilt) * v - std::sin(tilt) * z,
                            std::sin(tilt) * v + std::cos(tilt) * z});
        }
      const PointCloud<double> cloud(points, test_clouds::near_pairs(points));
      CAPTURE(noise, seed);
      // Nothing is missing: not a triangle inside, nor one at the rim, where noise may add some.
      CHECK(cloud.summary().triangles >= 2 * (side - 1) * (side - 1));
      CHECK(cloud.surface().summary().components == 1);
      CHECK(cloud.surface().summary().boundary_edges <= 4 * (side - 1));
      CHECK(cloud.surface().summary().boundary_edges >= 4 * (side - 1) - 8);
    }
}

}  // namespace cloud_lattices_test
