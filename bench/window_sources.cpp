// Merged windows from many random sources beside exact ones: the worst vertex, how much the two
// ways of a pair differ, and what lies below the straight line in space. Labels beside them.

#include <cmath>
#include <random>

#include "solver.hpp"

namespace bench::window_sources {

/// Fields of one accuracy, judged one after the other.
struct Judged {
  double mean = 0, worst = 0, below = 0;
  std::size_t fields = 0, beyond = 0, vertices = 0;
  std::vector<std::vector<double>> between;  ///< the sources

  void add(const std::vector<float>& found, const std::vector<double>& exact,
           const std::vector<std::array<double, 3>>& places, Index source) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < exact.size(); ++v) {
      if (!(exact[v] > 0) || !std::isfinite(exact[v])) continue;
      const double d = static_cast<double>(found[v]), off = std::abs(d / exact[v] - 1);
      const auto &p = places[v], &q = places[source];
      const double line = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      sum += off;
      worst = std::max(worst, off);
      beyond += off > 5e-3;
      if (line > 0) below = std::min(below, d / line - 1);
      ++count;
    }
    vertices += count;
    mean += sum / static_cast<double>(std::max<std::size_t>(count, 1));
    ++fields;
  }
  [[nodiscard]] double asymmetry() const {
    double most = 0;
    for (std::size_t i = 0; i < between.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double there = between[i][j], back = between[j][i], least = std::min(there, back);
        if (least > 0 && std::isfinite(std::max(there, back)))
          most = std::max(most, std::abs(there - back) / least);
      }
    return most;
  }
};

void measure(const Surface& surface, std::size_t count, unsigned seed, Table& table) {
  const plexway::TriangleMesh<float> mesh(surface.positions, surface.faces);
  const plexway::TriangleMesh<double> exact_mesh(surface.positions, surface.faces);
  std::mt19937 random(seed);
  std::vector<Index> sources;
  for (std::size_t k = 0; k < count; ++k)
    sources.push_back(surface.faces[random() % surface.faces.size()][random() % 3]);
  Solver exact(exact_mesh, by_accuracy("exact"));
  Solver solver(mesh);
  Judged judged[2];
  const plexway::PropagateOptions accuracies[2] = {{}, one_label()};
  for (const Index source : sources) {
    exact(source);
    for (std::size_t a = 0; a < 2; ++a) {
      solver.solve(source, accuracies[a]);
      judged[a].add(solver.distance(), exact.distance(), surface.positions, source);
      std::vector<double>& row = judged[a].between.emplace_back();
      for (const Index other : sources)
        row.push_back(static_cast<double>(solver.distance()[other]));
    }
  }
  for (std::size_t a = 0; a < 2; ++a)
    table.add({{"mesh", surface.name},
               {"vertices", surface.positions.size()},
               {"accuracy", a == 0 ? "accurate" : "fast"},
               {"sources", sources.size()},
               {"mean", judged[a].mean / static_cast<double>(judged[a].fields)},
               {"max", judged[a].worst},
               {"beyond", static_cast<double>(judged[a].beyond) /
                              static_cast<double>(std::max<std::size_t>(judged[a].vertices, 1))},
               {"asymmetry", judged[a].asymmetry()},
               {"below", judged[a].below}});
}

void run(Arguments& arguments) {
  std::vector<std::string> meshes;
  std::size_t sources = 200;
  unsigned seed = 1;
  arguments.required("MESH", &meshes, "Surfaces (.obj .off .ply .stl)");
  arguments.positive("--sources", &sources, "Of each");
  arguments.option("--seed", &seed, "Of the random sources");
  Table& table = arguments.table(
      "mesh; vertices; accuracy; sources; mean %.1e; max: worst vertex %.1e;"
      "beyond: share beyond 5e-3 %.1e; asymmetry: two ways differ by %.1e;"
      "below: below the line %.1e");
  for (const std::string& mesh : meshes) measure(read_surface(mesh), sources, seed, table);
}
const Command command("window_sources", "windows from random sources beside exact ones", run);

}  // namespace bench::window_sources
