// What the intrinsic Delaunay triangulation of the vertices, and a few more vertices, do for time
// and error, and what they cost. Each takes turns with the input's triangles in one process.

#include <cmath>

#include <plexway/surface/intrinsic_delaunay.hpp>

#include "scenes.hpp"
#include "solver.hpp"

namespace bench::triangulation {

using plexway::Retriangulation;
using Mesh = plexway::TriangleMesh<float>;

Row measure(const Surface& surface, Retriangulation kind, const std::vector<Truth>& truths,
            const Effort& effort) {
  const double vertices = static_cast<double>(surface.positions.size());
  const Mesh input(surface.positions, surface.faces);
  const plexway::TriangulationShape shape = plexway::measure_triangulation(input);
  Row row = {{"non_delaunay_share", shape.non_delaunay_share()},
             {"needle_share", shape.needle_share}};
  std::unique_ptr<Mesh> other;
  double flipping = 0;
  if (kind != Retriangulation::keep) {
    const plexway::TriangleMesh<double> exact(surface.positions, surface.faces);
    std::unique_ptr<plexway::IntrinsicDelaunay> delaunay;
    flipping = seconds([&] {
      delaunay = std::make_unique<plexway::IntrinsicDelaunay>(exact, plexway::refinement_for(kind));
    });
    other = std::make_unique<Mesh>(delaunay->mesh<float>());
    row["flips"] = delaunay->summary().flips;
    row["inserted"] = delaunay->summary().inserted_vertices;
  }
  Solver solver(other ? *other : input, one_label()), on_input(input, one_label());
  const Times times = take_turns(
      rotating_sources(surface, effort.sources), effort, [&](Index v) { on_input(v); },
      [&](Index v) { solver(v); });
  row["ns_per_vertex"] = 1e9 * times.second / vertices;
  row["ratio"] = times.ratio;
  if (other) {
    row["flip_ms"] = 1e3 * flipping;
    row["flip_solves"] = flipping / times.first;
  }
  Errors errors;
  for (const Truth& truth : truths) {
    solver(truth.source);
    errors.add(truth, solver.distance());
  }
  add_errors(row, errors);
  return row;
}

void run(Arguments& arguments) {
  Meshes meshes;
  std::vector<std::size_t> sizes = {500000};
  Effort effort;
  meshes.add_options(arguments);
  arguments.option("--sizes", &sizes, "Vertices of generated surfaces besides");
  effort.add_options(arguments);
  arguments.add_limit();
  Table& table = arguments.table(
      "mesh; vertices; triangulation; non_delaunay_share: not Delaunay %.3f;"
      "needle_share: needles %.3f; flips; inserted; flip_ms: to get there ms %.1f;"
      "flip_solves: in solves %.1f; ns_per_vertex: ns/V %.1f; ratio: ratio to input %.2f;"
      "mean: error mean %.2e; p99 %.2e; max %.2e; below: most below %.1e; note");
  const auto on = [&](const Surface& surface, const std::vector<Truth>& truths) {
    constexpr std::pair<Retriangulation, const char*> kinds[] = {
        {Retriangulation::keep, "input"},
        {Retriangulation::flips, "delaunay"},
        {Retriangulation::refined, "refined"}};
    for (const auto& [kind, name] : kinds)
      table.measure(
          {{"mesh", surface.name}, {"vertices", surface.positions.size()}, {"triangulation", name}},
          arguments.limit, [&, kind = kind] { return measure(surface, kind, truths, effort); });
  };
  meshes.each(on);
  for (const std::size_t size : sizes) {
    on(bumpy_surface(size), {});
    Surface wavy = height_field(
        static_cast<Index>(std::sqrt(static_cast<double>(size))) - 1,
        [](double x, double y) { return 0.05 * std::sin(12 * x) * std::cos(9 * y + 3 * x); });
    wavy.name = "wavy_" + std::to_string(wavy.positions.size());
    on(wavy, {});
  }
}
const Command command("triangulation", "the input's triangles, Delaunay flips, refinement", run);

}  // namespace bench::triangulation
