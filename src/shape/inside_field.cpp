#include "shape/inside_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include <plexway/shape/support.hpp>

#include "shape/warnings/survey.hpp"

namespace plexway {
namespace {

struct Extent {
  double diagonal = 0;  ///< of the box around the shape
  bool flat = false;
};

Extent extent_of(const AnyShape& shape) {
  const auto [low, high] = bounding_box(shape.positions());
  const std::array<double, 3> size = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  const double diagonal = std::hypot(size[0], size[1], size[2]);
  return {diagonal, *std::min_element(size.begin(), size.end()) < 1e-3 * diagonal};
}

constexpr double pixels = 600;  // of a picture, about: the diagonal

}  // namespace

bool is_known_inside(const AnyDomain& domain, const AnyExecutor& executor,
                     const SourceList& sources, const PropagateOptions& options) {
  const PropagateOptions unbounded;
  return support(Purpose::arcs, domain.shape()) && sources.only_points() &&
         !std::holds_alternative<GL>(executor) && domain.lengths() == nullptr &&
         domain.open_simplices() == nullptr && options.radius == unbounded.radius &&
         options.max_expansions == unbounded.max_expansions;
}

bool shows_inside(const AnyDomain& domain) {
  const Extent extent = extent_of(domain.shape());
  return domain.mean_edge() > 4 * extent.diagonal / pixels && extent.flat;
}

FineField field_for_picture(const AnyShape& shape, const AnyPathField& field) {
  return fine_field(shape, field, extent_of(shape).diagonal / pixels / 4);
}

}  // namespace plexway
