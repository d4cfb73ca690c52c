// Writes the exact answers NAME.vID.txt beside surfaces, for `plexway tune` and `plexway bench`, by
// CGAL's exact shortest paths. What comes out is checked before it is believed: never shorter than
// the straight line through space, never longer than a path that plexway has found.

#include <cstdio>
#include <fstream>
#include <iostream>

#include "cgal_exact.hpp"
#include "solver.hpp"

namespace bench::cgal_truth {

void check(const Surface& surface, Index source, const std::vector<double>& exact) {
  plexway::PropagateOptions options = one_label();
  options.visibility = plexway::Visibility::upper_bound;
  const plexway::TriangleMesh<double> mesh(surface.positions, surface.faces);
  const auto longest = distances(mesh, plexway::PointSource::at(source), options);
  const auto& from = surface.positions[source];
  for (std::size_t v = 0; v < exact.size(); ++v) {
    const auto& to = surface.positions[v];
    const double straight = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    if (exact[v] < straight * (1 - 1e-9) || exact[v] > longest[v] * (1 + 1e-9) + 1e-12)
      throw std::runtime_error("vertex " + std::to_string(v) + " from " + std::to_string(source) +
                               ": " + std::to_string(exact[v]) + " is not between " +
                               std::to_string(straight) + " and " + std::to_string(longest[v]));
  }
}

void write(const std::filesystem::path& file, const std::vector<double>& exact) {
  std::string text;
  for (const double d : exact) {
    char line[40];
    std::snprintf(line, sizeof line, "%.12g\n", d);
    text += line;
  }
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

void run(Arguments& arguments) {
  std::vector<std::string> meshes;
  std::size_t sources = 2;
  arguments.required("MESH", &meshes, "Surfaces (.obj .off .ply .stl)");
  arguments.positive("--sources", &sources, "Sources a surface, spread out and always the same");
  arguments.add_limit(300);
  arguments.parse();
  bool all = true;
  for (const std::filesystem::path file : meshes) {
    const Row done = isolated(arguments.limit, [&]() -> Row {
      const Surface surface = read_surface(file);
      cgal::ExactPaths paths(surface);
      for (const Index source : rotating_sources(surface, sources)) {
        paths.solve(source);
        check(surface, source, paths.distance());
        write(file.parent_path() / (surface.name + ".v" + std::to_string(source) + ".txt"),
              paths.distance());
      }
      return {{"vertices", surface.positions.size()}};
    });
    const Value* note = done.find("note");
    all = all && note == nullptr;
    std::cerr << file.string() << ": " << (note != nullptr ? note->text() : "done") << std::endl;
  }
  if (!all) throw Exit(1, "not all surfaces have answers");
}
const Command command("truth", "writes exact answers beside surfaces", run);

}  // namespace bench::cgal_truth
