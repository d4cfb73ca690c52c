// What the intrinsic Delaunay triangulation of the vertices, and a few more vertices, do for time
// and error, and what they cost. Each takes turns with the input's triangles in one process.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <plexway/complex/intrinsic_delaunay.hpp>
#include <plexway/solve.hpp>

#include "compare.hpp"

namespace {

using plexway::Retriangulation;

nlohmann::ordered_json measure(const bench::Surface& surface, Retriangulation kind,
                               const std::vector<bench::Truth>& truths,
                               const bench::Effort& effort) {
  using Mesh = plexway::TriangleMesh<float>;
  const double vertices = static_cast<double>(surface.positions.size());
  const Mesh input(surface.positions, surface.faces);
  const plexway::TriangulationShape shape = plexway::measure_triangulation(input);
  nlohmann::ordered_json row = {{"non_delaunay_share", shape.non_delaunay_share()},
                                {"needle_share", shape.needle_share}};
  std::unique_ptr<Mesh> other;
  double flipping = 0;
  if (kind != Retriangulation::keep) {
    const plexway::TriangleMesh<double> exact(surface.positions, surface.faces);
    const plexway::Refinement refinement = plexway::refinement_for(kind);
    std::unique_ptr<plexway::IntrinsicDelaunay> delaunay;
    flipping = bench::seconds(
        [&] { delaunay = std::make_unique<plexway::IntrinsicDelaunay>(exact, refinement); });
    other = std::make_unique<Mesh>(delaunay->mesh<float>());
    row["flips"] = delaunay->summary().flips;
    row["inserted"] = delaunay->summary().inserted_vertices;
  }
  const Mesh& mesh = other ? *other : input;
  plexway::Workspace<float> workspace, input_workspace;
  plexway::DistanceField<float> field, input_field;
  const auto sources = bench::rotating_sources(surface, effort.sources);
  const auto solve = [&](bench::Index v) {
    const auto source = plexway::PointSource::at(v);
    plexway::solve(plexway::Serial{}, mesh, {&source, 1}, bench::one_label(), workspace, field);
  };
  const auto on_input = [&](bench::Index v) {
    const auto source = plexway::PointSource::at(v);
    plexway::solve(plexway::Serial{}, input, {&source, 1}, bench::one_label(), input_workspace,
                   input_field);
  };
  const auto times = bench::take_turns(sources, effort, on_input, solve);
  row["ns_per_vertex"] = 1e9 * times.second / vertices;
  row["ratio"] = times.ratio;
  if (other) {
    row["flip_ms"] = 1e3 * flipping;
    row["flip_solves"] = flipping / times.first;
  }
  bench::Errors errors;
  for (const auto& truth : truths) {
    solve(truth.source);
    std::vector<double> found(
        field.distance.begin(),
        field.distance.begin() + static_cast<std::ptrdiff_t>(surface.positions.size()));
    errors.add(truth, found);
  }
  if (const auto summary = errors.summary()) {
    row["mean"] = summary->mean;
    row["p99"] = summary->p99;
    row["max"] = summary->max;
    row["below"] = summary->most_below;
  }
  return row;
}

bench::Table triangulation_table() {
  return bench::Table({{"mesh", "mesh"},
                       {"vertices", "vertices"},
                       {"triangulation", "triangulation"},
                       {"non_delaunay_share", "not Delaunay", "%.3f"},
                       {"needle_share", "needles", "%.3f"},
                       {"flips", "flips"},
                       {"inserted", "inserted"},
                       {"flip_ms", "to get there ms", "%.1f"},
                       {"flip_solves", "in solves", "%.1f"},
                       {"ns_per_vertex", "ns/V", "%.1f"},
                       {"ratio", "ratio to input", "%.2f"},
                       {"mean", "error mean", "%.2e"},
                       {"p99", "p99", "%.2e"},
                       {"max", "max", "%.2e"},
                       {"below", "most below", "%.1e"},
                       {"note", "note"}});
}

// A height field on a square grid, all cells cut the same way.
bench::Surface wavy(bench::Index n) {
  bench::Surface s;
  s.name = "wavy_" + std::to_string((n + 1) * (n + 1));
  for (bench::Index j = 0; j <= n; ++j)
    for (bench::Index i = 0; i <= n; ++i) {
      const double x = i * 1.0 / n, y = j * 1.0 / n;
      s.positions.push_back({x, y, 0.05 * std::sin(12 * x) * std::cos(9 * y + 3 * x)});
    }
  for (bench::Index j = 0; j < n; ++j)
    for (bench::Index i = 0; i < n; ++i) {
      const bench::Index a = j * (n + 1) + i, b = a + n + 1;
      s.faces.push_back({a, a + 1, b + 1});
      s.faces.push_back({a, b + 1, b});
    }
  return s;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::vector<std::size_t> sizes = {500000};
  std::filesystem::path truth_folder;
  bench::Effort effort;
  double limit = 600;
  bench::Report report;
  CLI::App app("The input's triangles, their intrinsic Delaunay flips, and refinement: one table");
  app.add_option("MESH", meshes, "Surfaces (.obj .off .ply .stl)");
  app.add_option("--truth-dir", truth_folder,
                 "Folder of the exact answers NAME.vID.txt (default: beside each mesh)");
  app.add_option("--sizes", sizes, "Vertices of generated surfaces besides")->delimiter(',');
  bench::add_effort_options(app, effort);
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table = triangulation_table();
  const auto measure_on = [&](const bench::Surface& surface, const std::filesystem::path& folder) {
    const auto truths =
        folder.empty() ? std::vector<bench::Truth>{} : bench::read_truths(folder, surface);
    constexpr std::pair<Retriangulation, const char*> kinds[] = {
        {Retriangulation::keep, "input"},
        {Retriangulation::flips, "delaunay"},
        {Retriangulation::refined, "refined"}};
    for (const auto& [kind, name] : kinds) {
      std::cerr << surface.name << ": " << name << std::endl;
      nlohmann::ordered_json row = {
          {"mesh", surface.name}, {"vertices", surface.positions.size()}, {"triangulation", name}};
      row.update(bench::isolated(
          limit, [&, kind = kind] { return measure(surface, kind, truths, effort); }));
      table.add(std::move(row));
    }
  };
  return report.write(table, [&] {
    for (const std::filesystem::path mesh : meshes)
      measure_on(bench::read_surface(mesh),
                 truth_folder.empty() ? mesh.parent_path() : truth_folder);
    for (const std::size_t size : sizes) {
      measure_on(bench::bumpy_surface(size), {});
      measure_on(wavy(static_cast<bench::Index>(std::sqrt(static_cast<double>(size))) - 1), {});
    }
  });
}
