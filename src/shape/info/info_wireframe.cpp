#include <numeric>

#include <plexway/shape/complex.hpp>
#include "shape/info/info_report.hpp"
#include "shape/simplex_edges.hpp"

namespace plexway {
namespace {

std::vector<std::string> wireframe_warnings(const WireframeSummary& summary,
                                            std::size_t coincident) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t count, std::string_view plural, const char* meaning) {
    if (count > 0) warnings.push_back(counted(count, plural) + meaning);
  };
  if (summary.components > 1) warnings.push_back(components_warning(summary.components));
  warn(summary.unreferenced_vertices, "unreferenced vertices", " in no edge: unreachable (inf)");
  warn(coincident, "vertices",
       " exactly where another one lies: edges that meet there are joined only if they name the "
       "same vertex; --merge 0 joins them");
  warn(summary.zero_length_edges, "edges", " without length");
  warn(summary.loops, "loops", " from a vertex to itself: no path gains by one");
  return warnings;
}

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
  const Spread spread = spread_of(lengths);
  const double total = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  const Degrees degrees = degrees_of(wireframe);
  const bool placed = !wireframe.positions.empty();
  const std::size_t coincident = count_coincident(domain);
  const Bounds box = bounding_box(wireframe.positions);
  const auto sizes = component_sizes(domain);
  const auto warnings = wireframe_warnings(summary, coincident);

  InfoReport report;
  Json& json = report.json;
  json["vertices"] = summary.vertices;
  json["simplices"] = summary.edges;
  json["edges"] = summary.edges;
  json["components"] = summary.components;
  json["component_sizes"] = sizes_json(sizes);
  json["ends"] = degrees.ends;
  json["branches"] = degrees.branches;
  json["loops"] = summary.loops;
  json["unreferenced_vertices"] = summary.unreferenced_vertices;
  json["coincident_vertices"] = coincident;
  json["degenerate_simplices"] = summary.zero_length_edges;
  json["length"] = json_number(total);
  json["bounding_box"] = placed ? to_json(box) : Json(nullptr);
  json["edge_length"] = to_json(spread);
  json["warnings"] = warnings;

  Table& table = report.table;
  table.add("wireframe", counted(summary.vertices, "vertices") + ", " +
                             counted(summary.edges, "edges") + ", " +
                             counted(summary.components, "components"));
  add_sizes(table, sizes);
  table.add("shape", counted(degrees.ends, "ends") + ", " + counted(degrees.branches, "vertices") +
                         " with three edges or more");
  table.add("bounding box", placed ? to_text(box) : "none: the file has lengths only");
  table.add("length", short_number(total));
  table.add("edge length", to_text(spread));
  return report;
}

}  // namespace plexway
