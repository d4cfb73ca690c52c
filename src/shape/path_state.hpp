#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/paths/cloud_path_field.hpp>
#include <plexway/paths/path_field.hpp>

#include "shape/prepared.hpp"
#include "shape/with_executor.hpp"

namespace plexway {

/// Where paths are drawn; lengths of their own are not those between positions.
inline std::span<const std::array<double, 3>> path_places(const AnyShape& shape, bool measured) {
  if (measured) return {};
  if (shape.cloud() != nullptr) return shape.cloud()->measured();
  if (const auto* wireframe = std::get_if<io::Edges>(&shape.data()))
    if (!wireframe->lengths.empty()) return {};
  return shape.positions();
}

template <class Complex>
class PathsOf final : public AnyPathField::State {
 public:
  using Real = RealOf<Complex>;

  /// `paths` are made of what follows the places.
  template <class... Other>
  PathsOf(std::shared_ptr<const Prepared> keep, AnyShape shape, bool measured,
          const Complex& complex, const Other&... other)
      : keep_(std::move(keep)),
        shape_(std::move(shape)),
        complex_(complex),
        measured_(measured),
        paths_(complex, other..., path_places(shape_, measured)) {}

  void solve(const AnyExecutor& executor, std::span<const PointSource> sources,
             const PropagateOptions& options) {
    with_executor<Complex>(executor,
                           [&](const auto& chosen) { paths_.solve(chosen, sources, options); });
    field.data = paths_.distances();
  }

  Path trace(const PointSource& outside, const TraceOptions& options) const override {
    Path path = paths_.trace(inside(outside), options);
    if (const OpenSimplices* const open = keep_->open()) open->outside(path);
    if (measured_ && !shape_.positions().empty() && shape_.cloud() == nullptr) {
      path.positions.clear();
      for (const PathPoint& at : path.points)
        path.positions.push_back(
            shape_.position({.simplex = at.simplex, .barycentric = at.barycentric}));
    }
    return path;
  }

  double at(const PointSource& outside, ReadOut level) const override {
    if constexpr (requires { paths_.at(outside, level); }) {
      return paths_.at(inside(outside), level);
    } else {
      support(Purpose::read_out, complex_).require();
      return 0;
    }
  }

  std::vector<std::array<double, 3>> gradient() const override {
    if constexpr (requires { paths_.gradient(); }) {
      std::vector<std::array<double, 3>> found = paths_.gradient();
      const OpenSimplices* const open = keep_->open();
      if (open == nullptr) return found;
      std::vector<std::array<double, 3>> all(shape_.simplices(), {0, 0, 0});
      for (Index s = 0; s < found.size(); ++s) all[open->outside(s)] = found[s];
      return all;
    } else {
      support(Purpose::directions, complex_).require();
      return {};
    }
  }

  std::size_t bytes() const override { return paths_.bytes(); }

 private:
  PointSource inside(const PointSource& point) const {
    const OpenSimplices* const open = keep_->open();
    return open == nullptr ? point : open->inside(point);
  }

  std::shared_ptr<const Prepared> keep_;
  AnyShape shape_;
  const Complex& complex_;
  bool measured_;
  PathField<Complex> paths_;
};

}  // namespace plexway
