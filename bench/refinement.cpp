// The same smooth surface cut finer and finer: does a field stay what it is, and does a vertex cost
// the same? The bumpy sphere, each size in a process of its own, at the points that it has in
// common with one of the sizes (--beside), from three of the points that all of them share.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "data/shapes.hpp"
#include "solver.hpp"

namespace bench::refinement {

using plexway::none, plexway::PropagateOptions;

/// A place on the sphere, told apart from all others at any size.
using Place = std::array<std::int64_t, 3>;

Place place_of(const std::array<double, 3>& p) {
  Place place;
  for (std::size_t d = 0; d < 3; ++d) place[d] = std::llround(p[d] * 1e8);
  return place;
}

struct Point {
  Place place;
  Index vertex;
  bool operator<(const Point& other) const { return place < other.place; }
};

/// The points of the coarser one of two cuttings that the finer one has, ascending.
std::vector<Point> points_of(const Surface& surface) {
  std::vector<Point> points(surface.positions.size());
  for (Index v = 0; v < points.size(); ++v) points[v] = {place_of(surface.positions[v]), v};
  std::sort(points.begin(), points.end());
  return points;
}

/// The vertex there, or none. (A point in a million may lie where rounding tells two places of it.)
Index vertex_at(std::span<const Point> points, const Place& place) {
  const auto at = std::lower_bound(points.begin(), points.end(), Point{place, 0});
  return at != points.end() && at->place == place ? at->vertex : none;
}

struct Reference {
  std::vector<Point> points;
  std::vector<std::vector<double>> distance;  ///< one a source, by vertex
};

Surface cut(Index parts) {
  samples::Shape shape = samples::bumpy(parts);
  return {"bumpy", std::move(shape.points), std::move(shape.faces)};
}

/// Three places of the coarsest cutting that all others refine.
std::vector<Place> sources_in(Index parts) {
  const samples::Shape shape = samples::bumpy(parts);
  std::vector<Place> places;
  for (const Index v : spread_numbers(3, shape.points.size()))
    places.push_back(place_of(shape.points[v]));
  return places;
}

/// Solves from all sources; visit(number of the source, field).
template <class Visit>
Row solve_all(Surface surface, std::span<const Index> sources, const PropagateOptions& options,
              const Visit& visit) {
  const double count = static_cast<double>(surface.positions.size());
  Row row;
  std::unique_ptr<plexway::TriangleMesh<float>> mesh;
  row["build"] =
      1e9 / count * processor_seconds([&] {
        mesh = std::make_unique<plexway::TriangleMesh<float>>(surface.positions, surface.faces);
      });
  surface = {};
  return_free_memory();
  Solver solver(*mesh, options);
  std::vector<double> ns;
  std::size_t lowered = 0, raised = 0, expansions = 0;
  for (std::size_t n = 0; n < sources.size(); ++n) {
    ns.push_back(1e9 / count * processor_seconds([&] { solver(sources[n]); }));
    lowered += solver.statistics().lowered_vertices;
    raised += solver.statistics().raised_vertices;
    expansions += solver.statistics().expansions;
    visit(n, solver.distance());
  }
  row["ns"] = *std::min_element(ns.begin(), ns.end());
  row["expansions"] =
      static_cast<double>(expansions) / static_cast<double>(sources.size() * mesh->face_count());
  row["lowered"] = static_cast<double>(lowered) / count / static_cast<double>(sources.size());
  row["raised"] = static_cast<double>(raised) / count / static_cast<double>(sources.size());
  if (const auto peak = status_bytes("VmHWM")) row["peak"] = *peak / (1 << 30);
  return row;
}

std::vector<Index> vertices_at(std::span<const Point> points, std::span<const Place> places) {
  std::vector<Index> vertices;
  for (const Place& place : places) {
    vertices.push_back(vertex_at(points, place));
    if (vertices.back() == none) throw std::runtime_error("a source is not in all cuttings");
  }
  return vertices;
}

Reference reference(Index parts, const PropagateOptions& options, std::span<const Place> sources) {
  Surface surface = cut(parts);
  Reference r{points_of(surface), {}};
  solve_all(std::move(surface), vertices_at(r.points, sources), options,
            [&](std::size_t, const std::vector<float>& found) {
              r.distance.emplace_back(found.begin(), found.end());
            });
  return r;
}

Row measure(Index parts, const PropagateOptions& options, std::span<const Place> sources,
            const Reference& beside) {
  Surface surface = cut(parts);
  // Vertices here and there, by pairs; the list of all places is large, and goes.
  std::vector<std::array<Index, 2>> common;
  std::vector<Index> from;
  {
    std::vector<Point> own(sources.size(), Point{{}, none});
    for (Index v = 0; v < surface.positions.size(); ++v) {
      const Place place = place_of(surface.positions[v]);
      if (const Index w = vertex_at(beside.points, place); w != none) common.push_back({v, w});
      for (std::size_t n = 0; n < sources.size(); ++n)
        if (place == sources[n]) own[n] = {place, v};
    }
    for (const Point& p : own) {
      if (p.vertex == none) throw std::runtime_error("a source is not in all cuttings");
      from.push_back(p.vertex);
    }
  }
  double sum = 0, worst = 0;
  std::size_t compared = 0;
  auto row = solve_all(std::move(surface), from, options,
                       [&](std::size_t n, const std::vector<float>& found) {
                         for (const auto& [v, w] : common) {
                           const double right = beside.distance[n][w];
                           if (!(right > 0)) continue;
                           const double off = std::abs(static_cast<double>(found[v]) / right - 1);
                           sum += off;
                           worst = std::max(worst, off);
                           ++compared;
                         }
                       });
  row["common"] = common.size();
  row["mean"] = sum / static_cast<double>(compared);
  row["max"] = worst;
  return row;
}

void run(Arguments& arguments) {
  std::vector<Index> parts = {100, 400, 800, 1000, 1280};
  Index beside_parts = 400;
  std::string accuracy = "accurate";
  arguments.positive("--parts", &parts,
                     "Parts an edge of the icosahedron: 10 times their square are the vertices");
  arguments.positive("--beside", &beside_parts, "Compare with the field of so many parts");
  arguments.option("--accuracy", &accuracy, "What is asked for", {"fast", "accurate"});
  arguments.add_limit(1800);
  Table& table = arguments.table(
      "vertices; build: build ns/V %.0f; ns: solve ns/V %.0f; growth: of --beside %.2f;"
      "expansions: expansions/triangle %.2f; lowered %.1e; raised %.1e; peak: peak GB %.1f;"
      "common: common points; mean: off in the mean %.1e; max: at worst %.1e; note");
  const PropagateOptions options = accuracy == "fast" ? one_label() : PropagateOptions();
  const std::vector<Place> sources = sources_in(std::accumulate(
      parts.begin(), parts.end(), beside_parts, [](Index a, Index b) { return std::gcd(a, b); }));
  std::sort(parts.begin(), parts.end());
  const Reference beside = reference(beside_parts, options, sources);
  return_free_memory();
  double unit = 0;
  for (const Index n : parts) {
    const Row& row =
        table.measure({{"vertices", 10 * static_cast<std::size_t>(n) * n + 2}}, arguments.limit,
                      [&] { return measure(n, options, sources, beside); });
    if (const Value* ns = row.find("ns"); ns != nullptr && n == beside_parts) unit = ns->number();
  }
  for (Row& row : table.rows())
    if (const Value* ns = row.find("ns"); ns != nullptr && unit > 0)
      row["growth"] = ns->number() / unit;
}
const Command command("refinement", "one smooth surface cut finer, at common points", run);

}  // namespace bench::refinement
