#include "shape/prepared.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>

#include "complexes/common/geometry.hpp"
#include "executors/checks.hpp"

namespace plexway::detail {

LinearField::LinearField(std::shared_ptr<const Prepared> domain, const AnyShape& shape,
                         const AnyExecutor& executor, std::span<const PointSource> sources,
                         const PropagateOptions& options)
    : domain_(std::move(domain)), shape_(shape) {
  domain_->solve(executor, SourceList(sources), options, field);
}

Path LinearField::trace(const PointSource&, const TraceOptions& options) const {
  if (options.margin) support(Purpose::margins, shape_.kind()).require();
  support(Purpose::paths, shape_.kind()).require();
  return {};
}

double LinearField::at(const PointSource& point, ReadOut level) const {
  if (level != ReadOut::linear) support(Purpose::read_out, shape_.kind()).require();
  PointSource where = point;
  where.offset = 0;
  check_source(where, {shape_.vertices(), shape_.simplices(), "simplex", 4});
  if (where.vertex != none) return field[where.vertex];
  if (const OpenSimplices* const open = domain_->open()) static_cast<void>(open->inside(where));
  return level == ReadOut::linear ? LinearField::read(where) : read(where);
}

double LinearField::read(const PointSource& where) const {
  const auto corners = shape_.corners(where.simplex);
  double sum = 0;
  for (std::size_t i = 0; i < where.barycentric.size(); ++i) {
    if (where.barycentric[i] == 0) continue;
    if (i >= corners.size())
      throw UsageError("simplex " + std::to_string(where.simplex) + " has only " +
                       std::to_string(corners.size()) + " corners");
    sum += where.barycentric[i] * field[corners[i]];
  }
  return sum;
}

// Of the linear field in each simplex. Gram-Schmidt: along each new direction the rest of the
// rise is the gradient's component.
std::vector<std::array<double, 3>> LinearField::gradient() const {
  const auto positions = shape_.positions();
  support(Purpose::directions, shape_).require();
  std::vector<std::array<double, 3>> all(shape_.simplices(), {0, 0, 0});
  const OpenSimplices* const open = domain_->open();
  for (std::size_t s = 0; s < all.size(); ++s) {
    if (open != nullptr && open->inside(static_cast<Index>(s)) == none) continue;
    const auto corners = shape_.corners(s);
    std::array<Point3, 3> axis{};
    Point3 sum{};
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      Point3 e = minus(positions[corners[i + 1]], positions[corners[0]]);
      const Point3 edge = e;
      double rise = field[corners[i + 1]] - field[corners[0]];
      for (std::size_t j = 0; j < i; ++j) {
        const double along = dot(e, axis[j]);
        for (std::size_t k = 0; k < 3; ++k) e[k] -= along * axis[j][k];
      }
      rise -= dot(edge, sum);
      const double length = std::sqrt(dot(e, e));
      for (std::size_t k = 0; k < 3; ++k) {
        axis[i][k] = e[k] / length;
        sum[k] += rise / length * axis[i][k];
      }
    }
    const double slope = std::sqrt(dot(sum, sum));
    if (!(slope > 0) || !std::isfinite(slope)) continue;  // not reached, or the source is there
    for (std::size_t k = 0; k < 3; ++k) all[s][k] = sum[k] / slope;
  }
  return all;
}

}  // namespace plexway::detail
