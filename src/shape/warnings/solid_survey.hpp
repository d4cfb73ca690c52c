#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "shape/warnings/survey.hpp"

namespace plexway {

/// What is measured on a solid beside SolidSummary, in the file's unit.
struct SolidSurvey {
  Bounds box;
  Spread edge;                            ///< over all edges, each once
  double volume = 0, largest_volume = 0;  ///< of all tetrahedra, and of one
  /// Share of tetrahedra whose longest edge is more than 10 times sqrt(3/2) their lowest height.
  double slender_share = 0;
  std::size_t coincident_vertices = 0;
};

/// Cost: O(n log n).
SolidSurvey survey_solid(const io::Tets& solid);

/// What may surprise the user of this solid, a sentence each.
std::vector<std::string> solid_warnings(const SolidSummary& summary, const SolidSurvey& survey);

}  // namespace plexway
