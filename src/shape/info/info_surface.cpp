#include <plexway/surface/triangle_mesh.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <plexway/io/triangles.hpp>
#include <plexway/shape/complex.hpp>
#include <string>
#include <vector>

#include "shape/info/info_report.hpp"
#include "shape/info/solve_words.hpp"
#include "shape/warnings/survey.hpp"
#include "shape/words.hpp"

namespace plexway {

namespace {

/// What `info` measures on a surface beside SurfaceSummary. Lengths in the file's unit.
struct SurfaceSurvey {
  Bounds box;   ///< of all vertices
  Spread edge;  ///< over the sides of all triangles
  /// Share of triangles whose longest side is more than 10 times sqrt(4/3) their lowest height.
  double slender_share = 0;
};

using Vector = std::array<double, 3>;

double length(const Vector& from, const Vector& to) {
  return std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
}

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
  survey.box = bounding_box(surface.positions);
  double sum = 0;
  std::size_t slender = 0, measured = 0;
  for (const auto& corners : surface.triangles) {
    const auto& [a, b, c] = corners;
    if (a == b || b == c || c == a) continue;  // left out
    ++measured;
    std::array<double, 3> side;
    for (std::size_t i = 0; i < 3; ++i) {
      side[i] = length(surface.positions[corners[i]], surface.positions[corners[(i + 1) % 3]]);
      survey.edge.min = std::min(survey.edge.min, side[i]);
      survey.edge.max = std::max(survey.edge.max, side[i]);
      sum += side[i];
    }
    if (is_slender(side)) ++slender;
  }
  const auto triangles = static_cast<double>(measured);
  survey.edge.mean = sum / (3 * triangles);
  survey.slender_share = static_cast<double>(slender) / triangles;
  return survey;
}

/// What may surprise the user of this surface, a sentence each.
std::vector<std::string> surface_warnings(const SurfaceSummary& summary,
                                          const SurfaceSurvey& survey, std::size_t coincident) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t count, std::string_view plural, const char* meaning) {
    if (count > 0) warnings.push_back(counted(count, plural) + meaning);
  };
  warn(summary.boundary_edges, "boundary edges",
       ": the surface is open, paths run along its border");
  warn(summary.non_manifold_edges, "non-manifold edges",
       " with more than two triangles: paths may leave into any of them");
  warn(summary.pinched_vertices, "pinched vertices",
       " where separate parts of the surface touch in one point only");
  if (summary.components > 1) warnings.push_back(components_warning(summary.components));
  warn(summary.unreferenced_vertices, "unreferenced vertices",
       " in no triangle: unreachable (inf)");
  warn(coincident, "vertices",
       " exactly where another one lies: if the two sides of a seam have their own vertices, the "
       "surface is cut along it and paths go round; --merge 0 joins them");
  warn(summary.degenerate_faces, "degenerate triangles", " without area");
  if (!summary.orientable) warnings.emplace_back("not orientable: no harm to distances");
  if (survey.slender_share > 0.01) {
    warnings.push_back("slender triangles (" + short_number(100 * survey.slender_share) +
                       " % have an aspect ratio above 10): distances are less accurate and slower");
  }
  return warnings;
}

}  // namespace

InfoReport info_of(const AnyShape& domain, const io::Triangles& surface) {
  const AnyDomain built = measured_domain(domain);
  const auto& mesh = complex_as<TriangleMesh<double>>(built);
  SurfaceSummary summary = mesh.summary();
  summary.unreferenced_vertices -= domain.merged_count();
  const TriangulationShape shape = measure_triangulation(mesh);
  const SurfaceSurvey survey = survey_surface(surface);
  const auto sizes = component_sizes(domain);
  const std::size_t coincident = count_coincident(domain);
  const auto warnings = surface_warnings(summary, survey, coincident);

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
  json["coincident_vertices"] = coincident;
  json["degenerate_simplices"] = summary.degenerate_faces;
  json["slender_share"] = survey.slender_share;
  json["orientable"] = summary.orientable;
  json["bounding_box"] = to_json(survey.box);
  json["edge_length"] = to_json(survey.edge);
  json["warnings"] = warnings;

  Table& table = report.table;
  table.add(std::string(domain.kind_name()), counted(summary.vertices, "vertices") + ", " +
                                                 counted(summary.edges, "edges") + ", " +
                                                 counted(summary.faces, domain.simplex_name()) +
                                                 ", " + counted(summary.components, "components"));
  add_sizes(table, sizes);
  table.add("bounding box", to_text(survey.box));
  table.add("edge length", to_text(survey.edge));
  table.add("slender", short_number(100 * survey.slender_share) +
                           " % of the triangles have an aspect ratio above 10");
  add_shape(shape, json, table);
  return report;
}

}  // namespace plexway
