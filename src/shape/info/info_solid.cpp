#include <algorithm>
#include <cmath>

#include <plexway/shape/complex.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "complexes/common/point3.hpp"
#include "shape/info/info_report.hpp"
#include "shape/simplex_edges.hpp"
#include "shape/words.hpp"

namespace plexway {
namespace {

using Vector = Point3;

double length_of(const Vector& a) { return std::hypot(a[0], a[1], a[2]); }

struct Measure {
  double volume = 0;
  bool slender = true;
};

// The unit is taken out first, so that none makes the volume overflow or underflow before its time.
Measure measure(const std::array<Vector, 4>& corners) {
  constexpr std::array<std::array<std::size_t, 2>, 6> edges = {
      {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  double longest = 0;
  for (const auto& [i, j] : edges)
    longest = std::max(longest, length_of(minus(corners[j], corners[i])));
  Measure found;
  if (!(longest > 0)) return found;
  std::array<Vector, 4> at = corners;
  for (Vector& p : at)
    for (std::size_t k = 0; k < 3; ++k) p[k] = (p[k] - corners[0][k]) / longest;
  const double six_volumes = std::abs(dot(cross(at[1], at[2]), at[3]));
  double largest_face = 0;  // twice its area
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector& p = at[(i + 1) % 4];
    const Vector normal = cross(minus(at[(i + 2) % 4], p), minus(at[(i + 3) % 4], p));
    largest_face = std::max(largest_face, length_of(normal));
  }
  constexpr double most = 10;
  const double lowest_height = six_volumes / largest_face;
  found.slender = !(std::sqrt(2.0 / 3) <= most * lowest_height);
  found.volume = six_volumes / 6 * longest * longest * longest;
  return found;
}

}  // namespace

SolidSurvey survey_solid(const AnyShape& domain) {
  const auto& solid = std::get<io::Tets>(domain.data());
  SolidSurvey survey;
  survey.box = bounding_box(solid.positions);
  survey.edge = spread_of(lengths_of(edges_of(domain)));
  std::size_t slender = 0, measured = 0;
  for (std::array<std::uint32_t, 4> tet : solid.tets) {
    std::sort(tet.begin(), tet.end());
    if (std::adjacent_find(tet.begin(), tet.end()) != tet.end()) continue;  // left out
    ++measured;
    std::array<Vector, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = solid.positions[tet[i]];
    const Measure found = measure(corners);
    survey.volume += found.volume;
    survey.largest_volume = std::max(survey.largest_volume, found.volume);
    if (found.slender) ++slender;
  }
  survey.slender_share = static_cast<double>(slender) / static_cast<double>(measured);
  survey.coincident_vertices = count_coincident(domain);
  return survey;
}

std::vector<std::string> solid_warnings(const SolidSummary& summary, const SolidSurvey& survey) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t count, std::string_view plural, const std::string& meaning) {
    if (count > 0) warnings.push_back(counted(count, plural) + meaning);
  };
  warn(summary.pinched_edges, "pinched edges",
       " where separate parts of the solid touch in the edge only: paths may pass along them");
  warn(summary.pinched_vertices, "pinched vertices",
       " where separate parts of the solid touch in one point only");
  if (summary.components > 1) warnings.push_back(components_warning(summary.components));
  warn(summary.unreferenced_vertices, "unreferenced vertices",
       " in no tetrahedron: unreachable (inf)");
  warn(survey.coincident_vertices, "vertices",
       " exactly where another one lies: if the two sides of a cut have their own vertices, paths "
       "go round it; --merge 0 joins them");
  const auto first = [](Index tet) { return ", tetrahedron " + std::to_string(tet) + " first"; };
  warn(summary.degenerate_tets, "degenerate tetrahedra",
       " without volume" + first(summary.first_degenerate));
  warn(summary.inverted_tets, "inverted tetrahedra",
       " with negative volume" + first(summary.first_inverted) + ": turned over");
  if (survey.slender_share > 0.01) {
    warnings.push_back("slender tetrahedra (" + short_number(100 * survey.slender_share) +
                       " % have an aspect ratio above 10): distances are less accurate and slower");
  }
  return warnings;
}

InfoReport info_of(const AnyShape& domain, const io::Tets&) {
  const AnyDomain built = measured_domain(domain);
  SolidSummary summary = complex_as<TetMesh<double>>(built).summary();
  summary.unreferenced_vertices -= domain.merged_count();
  const SolidSurvey survey = survey_solid(domain);
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
  return report;
}

}  // namespace plexway
