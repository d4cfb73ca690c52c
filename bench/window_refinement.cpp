// Merged windows on a smooth torus cut finer and finer: do errors go on falling, and does a vertex
// cost the same? The truth are exact windows on the same triangles, as far as one can wait for
// them.

#include <cmath>
#include <numbers>
#include <random>

#include "solver.hpp"

namespace bench::window_refinement {

/// A torus of about so many vertices, twice as many around as across, each moved along the surface
/// by up to a fifth of an edge.
Surface jittered_torus(std::size_t vertices) {
  const auto across = static_cast<Index>(std::sqrt(static_cast<double>(vertices) / 2));
  const Index around = 2 * across;
  std::mt19937 random(1);
  const auto jitter = [&] { return .4 * (static_cast<double>(random()) / 4294967296. - .5); };
  Surface s;
  for (Index i = 0; i < around; ++i)
    for (Index j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * (i + jitter()) / around;
      const double b = 2 * std::numbers::pi * (j + jitter()) / across;
      const double r = 1 + .4 * std::cos(b);
      s.positions.push_back({r * std::cos(a), r * std::sin(a), .4 * std::sin(b)});
      const Index right = (i + 1) % around, up = (j + 1) % across;
      const Index at[4] = {i * across + j, right * across + j, right * across + up,
                           i * across + up};
      s.faces.push_back({at[0], at[1], at[2]});
      s.faces.push_back({at[0], at[2], at[3]});
    }
  return s;
}

Row measure(std::size_t vertices, std::size_t most_exact) {
  const Surface surface = jittered_torus(vertices);
  const std::size_t count = surface.positions.size();
  const plexway::TriangleMesh<float> mesh(surface.positions, surface.faces);
  Solver solver(mesh);
  double best = 1e300, mean = 0, worst = 0;
  for (const std::size_t at : {std::size_t{0}, count / 3, count / 2 + 7}) {
    const auto source = static_cast<Index>(at);
    for (std::size_t k = 0; k < (count < 1000000 ? 3 : 1); ++k)
      best = std::min(best, processor_seconds([&] { solver(source); }));
    if (count > most_exact) continue;
    const auto exact = distances(plexway::TriangleMesh<double>(surface.positions, surface.faces),
                                 plexway::PointSource::at(source), by_accuracy("exact"));
    for (std::size_t v = 0; v < count; ++v) {
      if (!(exact[v] > 0)) continue;
      const double off = std::abs(static_cast<double>(solver.distance()[v]) / exact[v] - 1);
      mean += off / static_cast<double>(3 * count);
      worst = std::max(worst, off);
    }
  }
  const double n = static_cast<double>(count);
  Row row = {{"vertices", count},
             {"ns", 1e9 * best / n},
             {"turns", static_cast<double>(solver.statistics().expansions) / n},
             {"bytes", static_cast<double>(solver.workspace().bytes()) / n}};
  if (count <= most_exact) row.update({{"mean", mean}, {"max", worst}});
  return row;
}

void run(Arguments& arguments) {
  std::size_t least = 800, most = 819200, exact = 204800;
  arguments.positive("--least", &least, "Vertices of the first");
  arguments.option("--most", &most, "Vertices of the last");
  arguments.option("--exact", &exact, "Up to so many beside exact windows");
  Table& table = arguments.table(
      "vertices; ns: ns/V %.0f; turns: turns/V %.2f; bytes: bytes/V %.0f; mean: error mean %.1e;"
      "max %.1e");
  for (std::size_t n = least; n <= most; n *= 4) table.add(measure(n, exact));
}
const Command command("window_refinement", "windows on a torus cut finer, beside exact ones", run);

}  // namespace bench::window_refinement
