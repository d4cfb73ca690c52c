#include "shape/warnings/surface_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shape/warnings/survey.hpp"
#include "shape/words.hpp"

namespace plexway {
namespace {

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

}  // namespace

SurfaceSurvey survey_surface(const io::Triangles& surface) {
  SurfaceSurvey survey;
  const Bounds box = bounding_box(surface.positions);
  survey.low = box.low;
  survey.high = box.high;
  survey.shortest_edge = std::numeric_limits<double>::infinity();
  double sum = 0;
  std::size_t slender = 0;
  for (const auto& corners : surface.triangles) {
    std::array<double, 3> side;
    for (std::size_t i = 0; i < 3; ++i) {
      side[i] = length(surface.positions[corners[i]], surface.positions[corners[(i + 1) % 3]]);
      survey.shortest_edge = std::min(survey.shortest_edge, side[i]);
      survey.longest_edge = std::max(survey.longest_edge, side[i]);
      sum += side[i];
    }
    if (is_slender(side)) ++slender;
  }
  const auto triangles = static_cast<double>(surface.triangles.size());
  survey.mean_edge = sum / (3 * triangles);
  survey.slender_share = static_cast<double>(slender) / triangles;
  survey.coincident_vertices = count_coincident(surface.positions, surface.triangles);
  return survey;
}

std::vector<std::string> surface_warnings(const SurfaceSummary& summary,
                                          const SurfaceSurvey& survey) {
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
  warn(summary.unreferenced_vertices, "unreferenced vertices", " in no triangle, so they get inf");
  warn(survey.coincident_vertices, "vertices",
       " exactly where another one lies: if the two sides of a seam have their own vertices, the "
       "surface is cut along it and paths go round");
  warn(summary.degenerate_faces, "degenerate triangles", " without area");
  if (!summary.orientable) warnings.emplace_back("not orientable: no harm to distances");
  if (survey.slender_share > 0.01) {
    warnings.push_back("slender triangles (" + short_number(100 * survey.slender_share) +
                       " % have an aspect ratio above 10): distances are less accurate and slower");
  }
  return warnings;
}

}  // namespace plexway
