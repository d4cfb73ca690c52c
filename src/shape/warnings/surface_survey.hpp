#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <plexway/io/triangles.hpp>
#include <plexway/surface/triangle_mesh.hpp>

namespace plexway {

/// What `info` measures on a surface beside SurfaceSummary. Lengths in the file's unit.
struct SurfaceSurvey {
  std::array<double, 3> low = {0, 0, 0}, high = {0, 0, 0};    ///< bounding box of all vertices
  double shortest_edge = 0, mean_edge = 0, longest_edge = 0;  ///< over the sides of all triangles
  /// Share of triangles whose longest side is more than 10 times sqrt(4/3) their lowest height.
  double slender_share = 0;
  /// Vertices in use that lie exactly where another one does.
  std::size_t coincident_vertices = 0;
};

/// Cost: O(n log n) for the coincident vertices, else linear.
SurfaceSurvey survey_surface(const io::Triangles& surface);

/// What may surprise the user of this surface, a sentence each.
std::vector<std::string> surface_warnings(const SurfaceSummary& summary,
                                          const SurfaceSurvey& survey);

}  // namespace plexway
