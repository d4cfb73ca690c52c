#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>

#include "shape/info/info_report.hpp"
#include "shape/shape_state.hpp"
#include "shape/simplex_edges.hpp"

namespace plexway {
namespace {

// What both kinds tell of their vertices.
void add_sizes_of(const AnyShape& domain, bool welded, InfoReport& report) {
  if (!welded) {  // the graph of edges knows nothing of welds
    const auto sizes = component_sizes(domain);
    report.json["component_sizes"] = sizes_json(sizes);
    add_sizes(report.table, sizes);
  }
  const bool placed = !domain.positions().empty();
  const Bounds box = bounding_box(domain.positions());
  report.json["bounding_box"] = placed ? to_json(box) : Json(nullptr);
  report.table.add("bounding box", placed ? to_text(box) : "none: not in space");
  if (!placed) return;
  const Spread spread = spread_of(lengths_of(edges_of(domain)));
  report.json["edge_length"] = to_json(spread);
  report.table.add("edge length", to_text(spread));
}

std::string size_text(const AnyShape& domain, std::size_t components) {
  return counted(domain.vertices(), "vertices") + ", " +
         counted(domain.simplices(), domain.simplex_name()) + ", " +
         counted(components, "components");
}

}  // namespace

InfoReport info_of(const AnyShape& domain, const SimplexShape& simplices) {
  const AnyDomain built = measured_domain(domain);
  InfoReport report;
  Json& json = report.json;
  report.table.add("simplices", size_text(domain, built.components()) + ", of dimension " +
                                    std::to_string(simplices.dimension));
  with_complex(built, [&](const auto& complex) {
    if constexpr (std::decay_t<decltype(complex)>::kind == DomainKind::simplices) {
      const SimplicialSummary& summary = complex.summary();
      json["dimension"] = simplices.dimension;
      json["coordinates"] = simplices.axes;
      json["vertices"] = summary.vertices;
      json["simplices"] = summary.simplices;
      json["facets"] = summary.facets;
      json["components"] = summary.components;
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
  add_sizes_of(domain, false, report);
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
  json["components"] = built.components();
  report.table.add("mixed", size_text(domain, built.components()));
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
  add_sizes_of(domain, mixed.parts.size() > 1, report);
  return report;
}

}  // namespace plexway
