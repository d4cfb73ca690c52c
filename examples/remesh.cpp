// A surface made anew from few, even triangles: Poisson disks, moved to the middle of their cells,
// joined where cells meet. Writes what came out:
//   example_remesh remeshed.obj
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/poisson_disk.hpp>

int main(int argc, char** argv) {
  // A torus of long thin triangles.
  constexpr plexway::Index around = 400, across = 40, seeds = 300;
  constexpr double turn = 2 * std::numbers::pi;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<plexway::Index, 3>> faces;
  for (plexway::Index i = 0; i < around; ++i)
    for (plexway::Index j = 0; j < across; ++j) {
      const double u = turn * i / around, v = turn * j / across, r = 1 + 0.4 * std::cos(v);
      positions.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
      const auto at = [&](plexway::Index k, plexway::Index l) {
        return (i + k) % around * across + (j + l) % across;
      };
      faces.push_back({at(0, 0), at(1, 0), at(1, 1)});
      faces.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  const plexway::TriangleMesh<float> torus(positions, faces);

  const auto darts = plexway::poisson_disks(plexway::Serial{}, torus, {.count = seeds});
  const auto cells =
      plexway::centroidal_voronoi(plexway::Serial{}, torus, darts.darts, {.max_iterations = 30});
  const auto field =
      plexway::solve(plexway::Serial{}, torus, std::span<const plexway::PointSource>(cells.seeds));
  const auto dual = plexway::dual_triangulation(faces, field.label, seeds);

  std::printf("%zu triangles became %zu; energy %.4f, then %.4f after %zu iterations\n",
              faces.size(), dual.triangles.size(), cells.steps.front().energy, cells.energy,
              cells.steps.size());
  std::printf("%s\n", dual.manifold ? "a manifold" : "not a manifold everywhere");
  if (argc > 1) {
    std::ofstream obj(argv[1]);
    for (const auto& seed : cells.seeds) {
      obj << "v";
      for (std::size_t k = 0; k < 3; ++k) {
        double x = 0;
        for (std::size_t i = 0; i < 3; ++i)
          x += seed.barycentric[i] * positions[faces[seed.simplex][i]][k];
        obj << ' ' << x;
      }
      obj << '\n';
    }
    for (const auto& [a, b, c] : dual.triangles)
      obj << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  }
  // Euler: as many corners as half the triangles.
  const bool torus_again = dual.manifold && dual.triangles.size() == 2 * seeds;
  return torus_again && cells.energy < cells.steps.front().energy ? 0 : 1;
}
