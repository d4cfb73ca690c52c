// No distance on a surface is below the straight line through space: over many sources of each
// mesh, how often and by how much that is broken, and how many vertices are farther than a
// neighbour and the edge between. Cheap to see, and always wrong.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <plexway/complex/intrinsic_delaunay.hpp>
#include <plexway/solve.hpp>

#include "harness.hpp"
#include "table.hpp"

namespace {

using plexway::Retriangulation;

double straight(const bench::Surface& surface, std::size_t v, std::size_t w) {
  const auto &a = surface.positions[v], &b = surface.positions[w];
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

template <class Real>
nlohmann::ordered_json measure(const bench::Surface& surface, Retriangulation kind,
                               std::size_t sources, double slack) {
  using Mesh = plexway::TriangleMesh<Real>;
  Mesh mesh(surface.positions, surface.faces);
  if (kind != Retriangulation::keep)
    mesh =
        plexway::IntrinsicDelaunay(plexway::TriangleMesh<double>(surface.positions, surface.faces),
                                   plexway::refinement_for(kind))
            .template mesh<Real>();
  plexway::Workspace<Real> workspace;
  plexway::DistanceField<Real> field;
  std::size_t below = 0, fields = 0, long_edges = 0;
  double most_below = 0, most_long = 0;
  bench::Index where = 0, from = 0;
  for (const bench::Index source : bench::rotating_sources(surface, sources)) {
    const auto point = plexway::PointSource::at(source);
    solve(plexway::Serial{}, mesh, {&point, 1}, {}, workspace, field);
    bool any = false;
    for (bench::Index v = 0; v < surface.positions.size(); ++v) {
      const double line = straight(surface, source, v);
      const double error = static_cast<double>(field.distance[v]) / line - 1;
      if (!(error < -slack)) continue;
      any = true;
      ++below;
      if (error < most_below) most_below = error, where = v, from = source;
    }
    fields += any;
    for (const auto& corners : surface.faces)
      for (std::size_t i = 0; i < 3; ++i) {
        const bench::Index v = corners[i], w = corners[(i + 1) % 3];
        const double d = static_cast<double>(field.distance[v]);
        const double e = static_cast<double>(field.distance[w]);
        const double gap = (std::abs(d - e) - straight(surface, v, w)) / std::max(d, e);
        if (!(gap > slack)) continue;
        ++long_edges;
        most_long = std::max(most_long, gap);
      }
  }
  nlohmann::ordered_json row = {{"fields_below", fields},
                                {"below", below},
                                {"most_below", most_below},
                                {"long_edges", long_edges},
                                {"most_long", most_long}};
  if (below > 0) row["worst"] = std::to_string(from) + " to " + std::to_string(where);
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::size_t sources = 200;
  double slack = 1e-6;
  bool double_precision = false;
  bool all = false;
  bench::Report report;
  CLI::App app("Distances below the straight line, or beyond a neighbour and an edge: one table");
  app.add_option("MESH", meshes, "Surfaces (.obj .off .ply .stl)")->required();
  app.add_option("--sources", sources, "Of each, all over it")->capture_default_str();
  app.add_option("--slack", slack, "Relative errors up to this are rounding")
      ->capture_default_str();
  app.add_flag("--double", double_precision, "Double instead of float");
  app.add_flag("--all", all, "Each on three triangulations, not only on what `auto` takes");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table({{"mesh", "mesh"},
                      {"triangulation", "triangulation"},
                      {"sources", "sources"},
                      {"fields_below", "fields with a distance below"},
                      {"below", "distances below"},
                      {"most_below", "most below", "%.1e"},
                      {"long_edges", "edges too short"},
                      {"most_long", "most", "%.1e"},
                      {"worst", "worst below"}});
  return report.write(table, [&] {
    for (const std::string& mesh : meshes) {
      const bench::Surface surface = bench::read_surface(mesh);
      const auto chosen = plexway::what_pays(plexway::measure_triangulation(
          plexway::TriangleMesh<float>(surface.positions, surface.faces)));
      constexpr std::pair<Retriangulation, const char*> kinds[] = {
          {Retriangulation::keep, "input"},
          {Retriangulation::flips, "delaunay"},
          {Retriangulation::refined, "refined"}};
      for (const auto& [kind, name] : kinds) {
        if (!all && kind != chosen) continue;
        nlohmann::ordered_json row = {
            {"mesh", surface.name}, {"triangulation", name}, {"sources", sources}};
        row.update(double_precision ? measure<double>(surface, kind, sources, slack)
                                    : measure<float>(surface, kind, sources, slack));
        table.add(std::move(row));
      }
    }
  });
}
