#include "shape/info/info_report.hpp"

#include <algorithm>
#include <numeric>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/surface/smoothing.hpp>

#include "shape/boundary.hpp"
#include "shape/shape_state.hpp"
#include "shape/warnings/sentences.hpp"
#include "shape/words.hpp"

namespace plexway::detail {
namespace {

std::string point_text(const std::array<double, 3>& point) {
  std::string text;
  for (const double x : point) text.append(text.empty() ? "(" : ", ").append(short_number(x));
  return text.append(")");
}

}  // namespace

void add_file_report(const AnyShape& domain, Json& json, Table& table) {
  const io::FileReport& report = domain.report();
  json["split_polygons"] = report.split_polygons;
  json["split_cells"] = report.split_cells;
  json["dropped_simplices"] = domain.collapsed().size();
  json["merged_vertices"] = domain.merged_count();
  json["passed_over"] = Json::object();
  for (const auto& [what, count] : report.passed_over) json["passed_over"][what] = count;
  std::string split;
  if (report.split_polygons > 0)
    split = counted(report.split_polygons, "polygons") + " into triangles";
  if (report.split_cells > 0)
    split +=
        (split.empty() ? "" : ", ") + counted(report.split_cells, "cells") + " into tetrahedra";
  if (!split.empty()) table.add("split", split);
  if (!report.passed_over.empty()) table.add("passed over", report.passed_over_text());
  if (const std::size_t merged = domain.merged_count(); merged > 0)
    table.add("merged", counted(merged, "vertices") + (merged == 1 ? " is" : " are") +
                            " one with an earlier one within " +
                            short_number(domain.merge_tolerance()));
  if (!domain.collapsed().empty()) table.add("dropped", collapsed_sentence(domain));
}

void InfoReport::add_components(std::size_t count, const std::vector<std::size_t>& sizes) {
  constexpr std::size_t most = 100, most_in_row = 8;
  json["components"] = count;
  json["component_sizes"] = std::vector<std::size_t>(
      sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(std::min(most, sizes.size())));
  if (sizes.size() < 2) return;
  std::string text;
  for (std::size_t i = 0; i < std::min(most_in_row, sizes.size()); ++i)
    text.append(i == 0 ? "" : ", ").append(std::to_string(sizes[i]));
  table.add("components", text + (sizes.size() > most_in_row ? ", ... vertices" : " vertices"));
}

void InfoReport::add_space(std::span<const std::array<double, 3>> positions,
                           const std::optional<Spread>& spread, const std::string& nowhere,
                           const std::string& edges) {
  if (positions.empty()) {
    json["bounding_box"] = nullptr;
    table.add("bounding box", nowhere);
  } else {
    const Box<3> box = bounding_box(positions);
    json["bounding_box"] = {{"min", box.low}, {"max", box.high}};
    table.add("bounding box", point_text(box.low) + " to " + point_text(box.high));
  }
  if (!spread) return;
  json["edge_length"] = {{"min", json_number(spread->min)},
                         {"mean", json_number(spread->mean)},
                         {"max", json_number(spread->max)}};
  table.add(edges, "min " + short_number(spread->min) + ", mean " + short_number(spread->mean) +
                       ", max " + short_number(spread->max));
}

void InfoReport::add_slender(double share, std::string_view simplices) {
  const std::string percent = short_number(100 * share);
  json["slender_share"] = share;
  table.add("slender",
            percent + " % of the " + std::string(simplices) + " have an aspect ratio above 10");
  if (share > 0.01)
    warnings.push_back("slender " + std::string(simplices) + " (" + percent +
                       " % have an aspect ratio above 10): distances are less accurate and slower");
}

namespace {

// Ends of the wireframe, and places where it branches.
struct Degrees {
  std::size_t ends = 0, branches = 0;
};

Degrees degrees_of(const io::Edges& wireframe) {
  std::vector<std::size_t> degree(wireframe.vertices, 0);
  for (const auto& [from, to] : wireframe.edges) {
    ++degree[from];
    ++degree[to];
  }
  Degrees found;
  for (const std::size_t d : degree) {
    if (d == 1) ++found.ends;
    if (d > 2) ++found.branches;
  }
  return found;
}

}  // namespace

InfoReport info_of(const AnyShape& domain, const io::Edges& wireframe) {
  const AnyDomain built = measured_domain(domain);
  WireframeSummary summary = complex_as<Wireframe<double>>(built).summary();
  summary.unreferenced_vertices -= domain.merged_count();
  const std::vector<double> lengths = lengths_of(wireframe);
  const double total = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const Degrees degrees = degrees_of(wireframe);

  InfoReport report;
  Json& json = report.json;
  Table& table = report.table;
  table.add("wireframe", counted(summary.vertices, "vertices") + ", " +
                             counted(summary.edges, "edges") + ", " +
                             counted(summary.components, "components"));
  json["vertices"] = summary.vertices;
  json["simplices"] = summary.edges;
  json["edges"] = summary.edges;
  report.add_components(summary.components, component_sizes(domain));
  table.add("shape", counted(degrees.ends, "ends") + ", " + counted(degrees.branches, "vertices") +
                         " with three edges or more");
  json["ends"] = degrees.ends;
  json["branches"] = degrees.branches;
  json["loops"] = summary.loops;
  if (summary.components > 1) report.warnings.push_back(components_warning(summary.components));
  report.add_count("unreferenced_vertices", summary.unreferenced_vertices, "unreferenced vertices",
                   " in no edge: unreachable (inf)");
  report.add_count("coincident_vertices", count_coincident(domain), "vertices",
                   " exactly where another one lies: edges that meet there are joined only if they "
                   "name the same vertex; --merge 0 joins them");
  report.add_count("degenerate_simplices", summary.zero_length_edges, "edges", " without length");
  json["length"] = json_number(total);
  table.add("length", short_number(total));
  report.add_space(wireframe.positions, spread_of(lengths), "none: the file has lengths only");
  report.warn(summary.loops, "loops", " from a vertex to itself: no path gains by one");
  return report;
}

InfoReport info_of(const AnyShape& domain, const CloudShape& cloud) {
  const AnyDomain built = measured_domain(domain);
  const CloudSummary& summary = *built.cloud();
  const std::vector<double> lengths = lengths_of(edges_of(domain));
  const auto& positions = cloud.points.positions;
  const auto connecting = connecting_k(cloud);
  const double noise = noise_level(cloud.measured(), cloud.neighbours);
  const auto share =
      static_cast<double>(summary.largest_component) / static_cast<double>(positions.size());

  InfoReport report;
  Json& json = report.json;
  Table& table = report.table;
  table.add("cloud", counted(positions.size(), "vertices") + ", " +
                         counted(lengths.size(), "neighbour pairs") + ", " +
                         counted(summary.triangles, domain.simplex_name()) + ", " +
                         counted(summary.components, "components"));
  if (const std::string kept = kept_points(cloud); !kept.empty()) table.add("kept", kept);
  json["vertices"] = positions.size();
  json["simplices"] = summary.triangles;
  json["edges"] = lengths.size();
  report.add_components(summary.components, summary.component_sizes);
  json["largest_share"] = share;
  json["connecting_k"] = connecting ? Json(*connecting) : Json(nullptr);
  table.add("connected", short_number(100 * share) + " % in the largest component; all with " +
                             (connecting ? "--k " + std::to_string(*connecting) + " or more"
                                         : "no --k up to 256"));
  json["points_in_file"] = cloud.points_in_file;
  json["not_finite"] = cloud.not_finite;
  json["outliers"] = cloud.outliers;
  json["coincident_vertices"] = summary.duplicates;
  json["nearly_coincident_vertices"] = summary.near_duplicates;
  json["isolated_vertices"] = summary.isolated_points;
  json["refused_pairs"] = summary.refused_pairs;
  json["bridges"] = summary.bridges;
  json["boundary_vertices"] = summary.boundary_points;
  table.add("boundary", counted(summary.boundary_points, "vertices") + "; " +
                            counted(summary.refused_pairs, "neighbour pairs") +
                            " refused, as not on one sheet");
  json["normals"] = !cloud.points.normals.empty();
  json["mean_spacing"] = json_number(summary.mean_spacing);
  json["noise"] = json_number(noise);
  table.add("spacing", "mean " + short_number(summary.mean_spacing) + ", noise " +
                           short_number(noise) + " of it");
  report.add_space(positions, spread_of(lengths), "", "to neighbours");

  if (summary.components > 1)
    report.warnings.push_back(why_disconnected(cloud, summary.components, Reader::tool));
  report.warn(summary.isolated_points, "points", " connected to no other, so they get inf");
  report.warn(cloud.not_finite, "points",
              " not finite, and dropped: vertices count those that are left");
  report.warn(summary.duplicates - summary.near_duplicates, "points",
              " exactly where an earlier one lies: they count as that one");
  report.warn(summary.near_duplicates, "points",
              " much nearer to an earlier one than all others are: they count as that one");
  if (!cloud.points.normals.empty() && cloud.normals().empty())
    report.warnings.push_back(
        "normals that do not all point to one side, or are 0: they are estimated instead");
  if (noise >= SmoothOptions{}.least_noise && cloud.smoothed.empty())
    report.warnings.push_back("noise of " + short_number(noise) +
                              " spacings may make paths too long: --smooth takes it out, and "
                              "detail of that size with it");
  return report;
}

namespace {

std::string components_text(const AnyShape& domain, std::size_t components) {
  return counted(domain.vertices(), "vertices") + ", " +
         counted(domain.simplices(), domain.simplex_name()) + ", " +
         counted(components, "components");
}

// Where vertices lie nowhere there are no lengths to tell either.
void add_space_of(const AnyShape& domain, InfoReport& report) {
  const bool placed = !domain.positions().empty();
  report.add_space(domain.positions(),
                   placed ? std::optional(spread_of(lengths_of(edges_of(domain)))) : std::nullopt);
}

}  // namespace

InfoReport info_of(const AnyShape& domain, const SimplexShape& simplices) {
  const AnyDomain built = measured_domain(domain);
  InfoReport report;
  Json& json = report.json;
  report.table.add("simplices", components_text(domain, built.components()) + ", of dimension " +
                                    std::to_string(simplices.dimension));
  with_complex(built, [&](const auto& complex) {
    if constexpr (std::decay_t<decltype(complex)>::kind == DomainKind::simplices) {
      const SimplicialSummary& summary = complex.summary();
      json["dimension"] = simplices.dimension;
      json["coordinates"] = simplices.axes;
      json["vertices"] = summary.vertices;
      json["simplices"] = summary.simplices;
      json["facets"] = summary.facets;
      report.add_components(summary.components, component_sizes(domain));
      json["boundary_facets"] = summary.boundary_facets;
      json["pinched_vertices"] = summary.pinched_vertices;
      json["unreferenced_vertices"] = summary.unreferenced_vertices;
      json["degenerate_simplices"] = summary.degenerate_simplices;
      json["violated_simplices"] = summary.violated_simplices;
      json["flat"] = summary.flat;
      json["bending_faces"] = summary.bending_faces;
      report.table.add("boundary", counted(summary.boundary_facets, "facets"));
      report.table.add("flat", summary.flat
                                   ? "yes; paths bend at " + counted(summary.bending_faces, "faces")
                                   : "no: distances are exact where nothing is in the way");
    }
  });
  add_space_of(domain, report);
  return report;
}

InfoReport info_of(const AnyShape& domain, const MixedShape& mixed) {
  const AnyDomain built = measured_domain(domain);
  const auto count = [&](std::size_t corners) {
    std::size_t sum = 0;
    for (const io::Cells& cells : domain.state().cells)
      if (cells.corners == corners) sum += cells.count();
    return sum;
  };
  const std::size_t edges = count(2), triangles = count(3), tets = count(4);
  InfoReport report;
  Json& json = report.json;
  json["vertices"] = domain.vertices();
  json["simplices"] = domain.simplices();
  json["edges"] = edges;
  json["triangles"] = triangles;
  json["tetrahedra"] = tets;
  json["parts"] = mixed.parts.size();
  report.table.add("mixed", components_text(domain, built.components()));
  // The graph of edges knows nothing of welds.
  if (mixed.parts.size() > 1)
    json["components"] = built.components();
  else
    report.add_components(built.components(), component_sizes(domain));
  report.table.add("cells", counted(edges, "edges") + ", " + counted(triangles, "triangles") +
                                ", " + counted(tets, "tetrahedra"));
  with_complex(built, [&](const auto& complex) {
    if constexpr (std::decay_t<decltype(complex)>::kind == DomainKind::mixed) {
      const MixedSummary& summary = complex.summary();
      json["pieces"] = summary.pieces;
      json["welded_vertices"] = summary.welded_vertices;
      json["hinges"] = summary.hinges;
      report.table.add("welds", counted(summary.pieces, "pieces") + ", " +
                                    counted(summary.welded_vertices, "vertices") + " welded; " +
                                    counted(summary.hinges[2], "faces") + ", " +
                                    counted(summary.hinges[1], "edges") + " and " +
                                    counted(summary.hinges[0], "vertices") + " between them");
    }
  });
  add_space_of(domain, report);
  return report;
}

}  // namespace plexway::detail
