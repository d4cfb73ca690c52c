// Writes the exact answers NAME.vID.txt beside surfaces, for `plexway tune` and `plexway bench`, by
// CGAL's exact shortest paths. What comes out is checked before it is believed: never shorter than
// the straight line through space, never longer than a path that plexway has found.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "cgal_exact.hpp"
#include "isolate.hpp"

namespace {

void check(const bench::Surface& surface, bench::Index source, const std::vector<double>& exact) {
  plexway::PropagateOptions options = bench::one_label();
  options.visibility = plexway::Visibility::upper_bound;
  bench::PlexwayPeer<double> above(surface, options);
  above.solve(source);
  const std::vector<double> longest = above.distance();
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

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> meshes;
  std::size_t sources = 2;
  double limit = 300;
  CLI::App app("Exact answers beside surfaces, by CGAL's exact shortest paths");
  app.add_option("MESH", meshes, "Surfaces (.obj .off .ply .stl)")->required();
  app.add_option("--sources", sources, "Sources a surface, spread out and always the same")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--limit", limit, "Seconds after which a surface is given up")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  bool all = true;
  for (const std::filesystem::path& file : meshes) {
    const auto done = bench::isolated(limit, [&]() -> nlohmann::ordered_json {
      const bench::Surface surface = bench::read_surface(file);
      bench::cgal::ExactPaths paths(surface);
      for (const bench::Index source : bench::rotating_sources(surface, sources)) {
        paths.solve(source);
        check(surface, source, paths.distance());
        write(file.parent_path() / (surface.name + ".v" + std::to_string(source) + ".txt"),
              paths.distance());
      }
      return {{"vertices", surface.positions.size()}};
    });
    all = all && !done.contains("note");
    std::cerr << file.string() << ": "
              << (done.contains("note") ? done["note"].get<std::string>() : "done") << std::endl;
  }
  return all ? 0 : 1;
}
