#include <plexway/surface/triangle_mesh.hpp>

#include <plexway/shape/complex.hpp>
#include "shape/info/info_report.hpp"
#include "shape/info/triangulation_words.hpp"
#include "shape/warnings/surface_survey.hpp"

namespace plexway {

InfoReport info_of(const AnyShape& domain, const io::Triangles& surface) {
  const AnyDomain built = measured_domain(domain);
  const auto& mesh = complex_as<TriangleMesh<double>>(built);
  const SurfaceSummary& summary = mesh.summary();
  const TriangulationShape shape = measure_triangulation(mesh);
  const SurfaceSurvey survey = survey_surface(surface);
  const Bounds box{survey.low, survey.high};
  const Spread edge{survey.shortest_edge, survey.mean_edge, survey.longest_edge};
  const auto sizes = component_sizes(domain);
  const auto warnings = surface_warnings(summary, survey);

  InfoReport report;
  Json& json = report.json;
  json["vertices"] = summary.vertices;
  json["simplices"] = summary.faces;
  json["edges"] = summary.edges;
  json["components"] = summary.components;
  json["component_sizes"] = sizes_json(sizes);
  json["boundary_edges"] = summary.boundary_edges;
  json["non_manifold_edges"] = summary.non_manifold_edges;
  json["pinched_vertices"] = summary.pinched_vertices;
  json["unreferenced_vertices"] = summary.unreferenced_vertices;
  json["coincident_vertices"] = survey.coincident_vertices;
  json["degenerate_simplices"] = summary.degenerate_faces;
  json["slender_share"] = survey.slender_share;
  json["orientable"] = summary.orientable;
  json["bounding_box"] = to_json(box);
  json["edge_length"] = to_json(edge);
  json["warnings"] = warnings;

  Table& table = report.table;
  table.add(std::string(domain.kind_name()), counted(summary.vertices, "vertices") + ", " +
                                                 counted(summary.edges, "edges") + ", " +
                                                 counted(summary.faces, domain.simplex_name()) +
                                                 ", " + counted(summary.components, "components"));
  add_sizes(table, sizes);
  table.add("bounding box", to_text(box));
  table.add("edge length", to_text(edge));
  table.add("slender", short_number(100 * survey.slender_share) +
                           " % of the triangles have an aspect ratio above 10");
  add_shape(shape, json, table);
  for (const std::string& warning : warnings) table.add("note", warning);
  return report;
}

}  // namespace plexway
