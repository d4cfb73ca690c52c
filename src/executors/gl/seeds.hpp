#pragma once

#include <vector>

#include "executors/gl/front.hpp"
#include "executors/gl/functions.hpp"

namespace plexway::gl {

/// What a source itself offers to a vertex (shaders/claim.comp).
struct VertexOffer {
  GLuint vertex, distance, source, spare;
};

/// What propagations on the device start from, field by field: labels that wait, and distances of
/// the vertices next to sources.
template <class CellLabel>
struct SeedsOf {
  using Label = CellLabel;

  std::vector<Waiting> waiting;
  std::vector<Label> labels;
  std::vector<VertexOffer> offers;

  void clear() {
    waiting.clear();
    labels.clear();
    offers.clear();
  }
};

}  // namespace plexway::gl
