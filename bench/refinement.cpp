// The same smooth surface cut finer and finer: does a field stay what it is, and does a vertex cost
// the same? The bumpy sphere, each size in a process of its own, at the points that it has in
// common with one of the sizes (--beside), from three of the points that all of them share.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <plexway/solve.hpp>

#include "compare.hpp"

namespace {

using namespace plexway;

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
std::vector<Point> points_of(const bench::Surface& surface) {
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

bench::Surface cut(Index parts) {
  samples::Shape shape = samples::bumpy(parts);
  return {"bumpy", std::move(shape.points), std::move(shape.faces)};
}

/// Three places of the coarsest cutting that all others refine.
std::vector<Place> sources_in(Index parts) {
  const samples::Shape shape = samples::bumpy(parts);
  std::vector<Place> places;
  for (const Index v : bench::spread_numbers(3, shape.points.size()))
    places.push_back(place_of(shape.points[v]));
  return places;
}

struct Options {
  std::vector<Index> parts = {100, 400, 800, 1000, 1280};
  Index beside = 400;
  std::string accuracy = "accurate";
  double limit = 1800;
  bench::Report report;
};

PropagateOptions asked(const Options& options) {
  PropagateOptions o;
  if (options.accuracy == "fast") o.accuracy = Accuracy::fast();
  return o;
}

/// Solves from all sources; visit(number of the source, field).
template <class Visit>
nlohmann::ordered_json solve_all(bench::Surface surface, std::span<const Index> sources,
                                 const Options& options, const Visit& visit) {
  const double count = static_cast<double>(surface.positions.size());
  nlohmann::ordered_json row;
  const std::clock_t begin = std::clock();
  const TriangleMesh<float> mesh(surface.positions, surface.faces);
  row["build"] = 1e9 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / count;
  surface = {};
  bench::return_free_memory();
  Workspace<float> workspace;
  DistanceField<float> field;
  std::vector<double> ns;
  std::size_t lowered = 0, raised = 0, expansions = 0;
  for (std::size_t n = 0; n < sources.size(); ++n) {
    const PointSource source = PointSource::at(sources[n]);
    ns.push_back(1e9 / count * bench::processor_seconds([&] {
                   solve(Serial{}, mesh, std::span(&source, 1), asked(options), workspace, field);
                 }));
    lowered += field.statistics.lowered_vertices;
    raised += field.statistics.raised_vertices;
    expansions += field.statistics.expansions;
    visit(n, field);
  }
  row["ns"] = *std::min_element(ns.begin(), ns.end());
  row["expansions"] =
      static_cast<double>(expansions) / static_cast<double>(sources.size() * mesh.face_count());
  row["lowered"] = static_cast<double>(lowered) / count / static_cast<double>(sources.size());
  row["raised"] = static_cast<double>(raised) / count / static_cast<double>(sources.size());
  if (const auto peak = bench::status_bytes("VmHWM")) row["peak"] = *peak / (1 << 30);
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

Reference reference(const Options& options, std::span<const Place> sources) {
  bench::Surface surface = cut(options.beside);
  Reference r{points_of(surface), {}};
  solve_all(std::move(surface), vertices_at(r.points, sources), options,
            [&](std::size_t, const DistanceField<float>& field) {
              r.distance.emplace_back(field.distance.begin(), field.distance.end());
            });
  return r;
}

nlohmann::ordered_json measure(Index parts, const Options& options, std::span<const Place> sources,
                               const Reference& beside) {
  bench::Surface surface = cut(parts);
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
  auto row = solve_all(
      std::move(surface), from, options, [&](std::size_t n, const DistanceField<float>& field) {
        for (const auto& [v, w] : common) {
          const double right = beside.distance[n][w];
          if (!(right > 0)) continue;
          const double off = std::abs(static_cast<double>(field.distance[v]) / right - 1);
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

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("The bumpy sphere cut finer, at common points");
  app.add_option("--parts", options.parts,
                 "Parts an edge of the icosahedron: 10 times their square are the vertices")
      ->delimiter(',')
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--beside", options.beside, "Compare with the field of so many parts")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_option("--accuracy", options.accuracy, "fast or accurate")
      ->check(CLI::IsMember({"fast", "accurate"}))
      ->capture_default_str();
  app.add_option("--limit", options.limit, "Seconds after which a row is given up")
      ->capture_default_str();
  options.report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table({{"vertices", "vertices"},
                      {"build", "build ns/V", "%.0f"},
                      {"ns", "solve ns/V", "%.0f"},
                      {"growth", "of --beside", "%.2f"},
                      {"expansions", "expansions/triangle", "%.2f"},
                      {"lowered", "lowered", "%.1e"},
                      {"raised", "raised", "%.1e"},
                      {"peak", "peak GB", "%.1f"},
                      {"common", "common points"},
                      {"mean", "off in the mean", "%.1e"},
                      {"max", "at worst", "%.1e"},
                      {"note", "note"}});
  return options.report.write(table, [&] {
    Index shared = options.beside;
    for (const Index parts : options.parts) shared = std::gcd(shared, parts);
    const std::vector<Place> sources = sources_in(shared);
    std::vector<Index> sizes = options.parts;
    std::sort(sizes.begin(), sizes.end());
    const Reference beside = reference(options, sources);
    bench::return_free_memory();
    std::vector<nlohmann::ordered_json> rows;
    double unit = 0;
    for (const Index parts : sizes) {
      const std::size_t vertices = 10 * static_cast<std::size_t>(parts) * parts + 2;
      std::cerr << vertices << std::endl;
      rows.push_back({{"vertices", vertices}});
      rows.back().update(
          bench::isolated(options.limit, [&] { return measure(parts, options, sources, beside); }));
      if (parts == options.beside && rows.back().contains("ns"))
        unit = rows.back()["ns"].get<double>();
    }
    for (auto& row : rows) {
      if (unit > 0 && row.contains("ns")) row["growth"] = row["ns"].get<double>() / unit;
      table.add(std::move(row));
    }
  });
}
