#include "any/linear_field.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

#include "complex/point3.hpp"
#include "executors/checks.hpp"

namespace plexway {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class LinearField final : public AnyPathField::State {
 public:
  LinearField(std::shared_ptr<const Prepared> domain, const AnyShape& shape)
      : domain_(std::move(domain)), shape_(shape) {}

  void solve(const AnyExecutor& executor, std::span<const PointSource> sources,
             const PropagateOptions& options, const MakeTrace& make) {
    domain_->solve(executor, SourceList(sources), options, field);
    sources_.assign(sources.begin(), sources.end());
    if (make) trace_ = make(field);
  }

  Path trace(const PointSource& point, const TraceOptions& options) const override {
    if (!trace_) support_of_paths(shape_.kind()).require();
    return trace_(point, options);
  }

  double at(const PointSource& point, ReadOut level) const override {
    if (level != ReadOut::linear && !trace_)
      throw UsageError("within a " + std::string(kind_noun(shape_.kind())) +
                       " distances are read linearly: ask for ReadOut::linear");
    PointSource where = point;
    where.offset = 0;
    check_source(where, {shape_.vertices(), shape_.simplices(), "simplex", 4});
    if (where.vertex != none) return field[where.vertex];
    if (level != ReadOut::linear) {
      const Path path = trace_(where, {});
      return path.source == none ? infinity : path.length + sources_[path.source].offset;
    }
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
  std::vector<std::array<double, 3>> gradient() const override {
    const auto positions = shape_.positions();
    if (positions.empty()) throw UsageError("directions in space need positions");
    std::vector<std::array<double, 3>> all(shape_.simplices(), {0, 0, 0});
    for (std::size_t s = 0; s < all.size(); ++s) {
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
      if (!(slope > 0) || !(slope < infinity)) continue;  // not reached, or the source is there
      for (std::size_t k = 0; k < 3; ++k) all[s][k] = sum[k] / slope;
    }
    return all;
  }

  std::size_t bytes() const override { return field.size() * sizeof(double); }

 private:
  std::shared_ptr<const Prepared> domain_;
  AnyShape shape_;
  std::vector<PointSource> sources_;
  TraceFrom trace_;
};

}  // namespace

std::shared_ptr<const AnyPathField::State> linear_field(
    std::shared_ptr<const Prepared> domain, const AnyShape& shape, const AnyExecutor& executor,
    std::span<const PointSource> sources, const PropagateOptions& options, const MakeTrace& trace) {
  auto state = std::make_shared<LinearField>(std::move(domain), shape);
  state->solve(executor, sources, options, trace);
  return state;
}

}  // namespace plexway
