#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include <plexway/io/triangles.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/geometry.hpp"
#include "shape/boundary.hpp"
#include "shape/info/info_report.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/warnings/survey.hpp"
#include "shape/words.hpp"

namespace plexway::detail {
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

InfoReport info_of(const AnyShape& domain, const io::Tets& solid) {
  const AnyDomain built = measured_domain(domain);
  SolidSummary summary = complex_as<TetMesh<double>>(built).summary();
  summary.unreferenced_vertices -= domain.merged_count();
  const SolidSurvey survey = survey_solid(domain);

  InfoReport report;
  Json& json = report.json;
  Table& table = report.table;
  table.add("solid", counted(summary.vertices, "vertices") + ", " +
                         counted(summary.edges, "edges") + ", " + counted(summary.faces, "faces") +
                         ", " + counted(summary.tets, domain.simplex_name()) + ", " +
                         counted(summary.components, "components"));
  json["vertices"] = summary.vertices;
  json["simplices"] = summary.tets;
  json["faces"] = summary.faces;
  json["edges"] = summary.edges;
  report.add_components(summary.components, component_sizes(domain));
  table.add("boundary", counted(summary.boundary_faces, "triangles") + ", " +
                            counted(summary.reflex_edges, "reflex edges") +
                            " where paths may bend");
  json["boundary_faces"] = summary.boundary_faces;
  json["reflex_edges"] = summary.reflex_edges;
  json["reflex_vertices"] = summary.reflex_vertices;
  report.add_count(
      "pinched_edges", summary.pinched_edges, "pinched edges",
      " where separate parts of the solid touch in the edge only: paths may pass along "
      "them");
  report.add_count("pinched_vertices", summary.pinched_vertices, "pinched vertices",
                   " where separate parts of the solid touch in one point only");
  if (summary.components > 1) report.warnings.push_back(components_warning(summary.components));
  report.add_count("unreferenced_vertices", summary.unreferenced_vertices, "unreferenced vertices",
                   " in no tetrahedron: unreachable (inf)");
  report.add_count("coincident_vertices", survey.coincident_vertices, "vertices",
                   " exactly where another one lies: if the two sides of a cut have their own "
                   "vertices, paths go round it; --merge 0 joins them");
  const auto first = [](Index tet) { return ", tetrahedron " + std::to_string(tet) + " first"; };
  report.add_count("degenerate_simplices", summary.degenerate_tets, "degenerate tetrahedra",
                   " without volume" + first(summary.first_degenerate));
  report.add_count("inverted_simplices", summary.inverted_tets, "inverted tetrahedra",
                   " with negative volume" + first(summary.first_inverted) + ": turned over");
  json["volume"] = json_number(survey.volume);
  table.add("volume", short_number(survey.volume));
  report.add_space(solid.positions, survey.edge);
  report.add_slender(survey.slender_share, "tetrahedra");
  return report;
}

namespace {

/// What `info` measures on a surface beside SurfaceSummary. Lengths in the file's unit.
struct SurfaceSurvey {
  Spread edge;  ///< over the sides of all triangles
  /// Share of triangles whose longest side is more than 10 times sqrt(4/3) their lowest height.
  double slender_share = 0;
};

// Longest side over lowest height, 1 for an equilateral triangle. The sides are compared with the
// longest one first, so that no unit makes the area underflow.
bool is_slender(const std::array<double, 3>& side) {
  constexpr double most = 10;
  const double longest = std::max({side[0], side[1], side[2]});
  if (!(longest > 0)) return true;
  std::array<double, 3> s = {side[0] / longest, side[1] / longest, side[2] / longest};
  std::sort(s.begin(), s.end());  // Kahan's form of Heron's formula wants this order
  const double square = (s[2] + (s[1] + s[0])) * (s[0] - (s[2] - s[1])) * (s[0] + (s[2] - s[1])) *
                        (s[2] + (s[1] - s[0]));
  const double height = std::sqrt(std::max(square, 0.0)) / 2;  // 2 area / longest
  return !(std::sqrt(0.75) <= most * height);
}

/// Cost: linear.
SurfaceSurvey survey_surface(const io::Triangles& surface) {
  SurfaceSurvey survey;
  std::vector<double> sides;
  std::size_t slender = 0;
  for (const auto& corners : surface.triangles) {
    const auto& [a, b, c] = corners;
    if (a == b || b == c || c == a) continue;  // left out
    std::array<double, 3> side;
    for (std::size_t i = 0; i < 3; ++i)
      side[i] =
          length_of(minus(surface.positions[corners[(i + 1) % 3]], surface.positions[corners[i]]));
    sides.insert(sides.end(), side.begin(), side.end());
    if (is_slender(side)) ++slender;
  }
  survey.edge = spread_of(sides);
  survey.slender_share = static_cast<double>(3 * slender) / static_cast<double>(sides.size());
  return survey;
}

}  // namespace

InfoReport info_of(const AnyShape& domain, const io::Triangles& surface) {
  const AnyDomain built = measured_domain(domain);
  const auto& mesh = complex_as<TriangleMesh<double>>(built);
  SurfaceSummary summary = mesh.summary();
  summary.unreferenced_vertices -= domain.merged_count();
  const SurfaceSurvey survey = survey_surface(surface);

  InfoReport report;
  Json& json = report.json;
  report.table.add(std::string(domain.kind_name()),
                   counted(summary.vertices, "vertices") + ", " + counted(summary.edges, "edges") +
                       ", " + counted(summary.faces, domain.simplex_name()) + ", " +
                       counted(summary.components, "components"));
  json["vertices"] = summary.vertices;
  json["simplices"] = summary.faces;
  json["edges"] = summary.edges;
  report.add_components(summary.components, component_sizes(domain));
  report.add_count("boundary_edges", summary.boundary_edges, "boundary edges",
                   ": the surface is open, paths run along its border");
  report.add_count("non_manifold_edges", summary.non_manifold_edges, "non-manifold edges",
                   " with more than two triangles: paths may leave into any of them");
  report.add_count("pinched_vertices", summary.pinched_vertices, "pinched vertices",
                   " where separate parts of the surface touch in one point only");
  if (summary.components > 1) report.warnings.push_back(components_warning(summary.components));
  report.add_count("unreferenced_vertices", summary.unreferenced_vertices, "unreferenced vertices",
                   " in no triangle: unreachable (inf)");
  report.add_count(
      "coincident_vertices", count_coincident(domain), "vertices",
      " exactly where another one lies: if the two sides of a seam have their own "
      "vertices, the surface is cut along it and paths go round; --merge 0 joins them");
  report.add_count("degenerate_simplices", summary.degenerate_faces, "degenerate triangles",
                   " without area");
  json["orientable"] = summary.orientable;
  report.add_space(surface.positions, survey.edge);
  if (!summary.orientable) report.warnings.emplace_back("not orientable: no harm to distances");
  report.add_slender(survey.slender_share, "triangles");
  add_shape(measure_triangulation(mesh), json, report.table);
  return report;
}

}  // namespace plexway::detail
