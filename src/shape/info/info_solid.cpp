#include <plexway/solid/tet_mesh.hpp>

#include <plexway/shape/complex.hpp>
#include "shape/info/info_report.hpp"
#include "shape/warnings/solid_survey.hpp"

namespace plexway {

InfoReport info_of(const AnyShape& domain, const io::Tets& solid) {
  const AnyDomain built = measured_domain(domain);
  const SolidSummary& summary = complex_as<TetMesh<double>>(built).summary();
  const SolidSurvey survey = survey_solid(solid);
  const auto sizes = component_sizes(domain);
  const auto warnings = solid_warnings(summary, survey);

  InfoReport report;
  Json& json = report.json;
  json["vertices"] = summary.vertices;
  json["simplices"] = summary.tets;
  json["faces"] = summary.faces;
  json["edges"] = summary.edges;
  json["components"] = summary.components;
  json["component_sizes"] = sizes_json(sizes);
  json["boundary_faces"] = summary.boundary_faces;
  json["reflex_edges"] = summary.reflex_edges;
  json["reflex_vertices"] = summary.reflex_vertices;
  json["pinched_edges"] = summary.pinched_edges;
  json["pinched_vertices"] = summary.pinched_vertices;
  json["unreferenced_vertices"] = summary.unreferenced_vertices;
  json["coincident_vertices"] = survey.coincident_vertices;
  json["degenerate_simplices"] = summary.degenerate_tets;
  json["inverted_simplices"] = summary.inverted_tets;
  json["slender_share"] = survey.slender_share;
  json["volume"] = json_number(survey.volume);
  json["bounding_box"] = to_json(survey.box);
  json["edge_length"] = to_json(survey.edge);
  json["warnings"] = warnings;

  Table& table = report.table;
  table.add("solid", counted(summary.vertices, "vertices") + ", " +
                         counted(summary.edges, "edges") + ", " + counted(summary.faces, "faces") +
                         ", " + counted(summary.tets, domain.simplex_name()) + ", " +
                         counted(summary.components, "components"));
  add_sizes(table, sizes);
  table.add("boundary", counted(summary.boundary_faces, "triangles") + ", " +
                            counted(summary.reflex_edges, "reflex edges") +
                            " where paths may bend");
  table.add("volume", short_number(survey.volume));
  table.add("bounding box", to_text(survey.box));
  table.add("edge length", to_text(survey.edge));
  table.add("slender", short_number(100 * survey.slender_share) +
                           " % of the tetrahedra have an aspect ratio above 10");
  for (const std::string& warning : warnings) table.add("note", warning);
  return report;
}

}  // namespace plexway
