#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <plexway/apps/cloud_path_field.hpp>
#include <plexway/apps/path_field.hpp>
#include <plexway/error.hpp>

#include "any/prepared.hpp"
#include "any/with_executor.hpp"

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

  PathsOf(std::shared_ptr<const Prepared> keep, AnyShape shape, const Complex& complex,
          bool measured)
      : keep_(std::move(keep)),
        shape_(std::move(shape)),
        complex_(complex),
        measured_(measured),
        paths_(complex, path_places(shape_, measured)) {}

  /// On the complex that paths lie in.
  void solve(const AnyExecutor& executor, std::span<const PointSource> sources,
             const PropagateOptions& options) {
    remember(executor, sources, options);
    solve_in(paths_, sources_, options);
    field.data = paths_.distances();
  }

  /// Other triangles over the same surface, and where a point is there.
  struct Elsewhere {
    const Complex* complex = nullptr;
    std::function<PointSource(const PointSource&)> place = {};
  };

  /// Distances found on other triangles.
  void adopt(const AnyExecutor& executor, AnyField found, std::span<const PointSource> sources,
             const PropagateOptions& options, Elsewhere elsewhere) {
    remember(executor, sources, options);
    elsewhere_ = std::move(elsewhere);
    field = std::move(found);
    adopted_ = true;
    if constexpr (Complex::kind == DomainKind::surface)
      paths_.adopt(std::get<DistanceField<Real>>(field.data), sources_);
  }

  Path trace(const PointSource& outside, const TraceOptions& options) const override {
    const PointSource point = inside(outside);
    Path path = paths_.trace(point, options);
    // Labels on the triangles of the path lead closer to it than distances of vertices do.
    if (adopted_ && field.accuracy() == Accuracy::fast() && path.source != none &&
        (path.capped || length(path) > 1.001 * promised(point))) {
      Path other = with_labels().trace(point, options);
      if (other.source != none && length(other) < length(path)) path = std::move(other);
    }
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
      const PointSource point = inside(outside);
      if (level == ReadOut::linear) return paths_.at(point, level);
      // Windows are asked where they are.
      if (adopted_ && field.accuracy() != Accuracy::fast())
        return with_windows().at(elsewhere_.place(point), level);
      return with_labels().at(point, level);
    } else {
      support(Purpose::read_out, complex_).require();
      return 0;
    }
  }

  std::vector<std::array<double, 3>> gradient() const override {
    if constexpr (requires { paths_.gradient(); }) {
      std::vector<std::array<double, 3>> found = with_labels().gradient();
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

  std::size_t bytes() const override {
    return paths_.bytes() + (labels_ ? labels_->bytes() : 0) + (windows_ ? windows_->bytes() : 0);
  }

 private:
  PointSource inside(const PointSource& point) const {
    const OpenSimplices* const open = keep_->open();
    return open == nullptr ? point : open->inside(point);
  }

  void remember(const AnyExecutor& executor, std::span<const PointSource> sources,
                const PropagateOptions& options) {
    executor_ = executor;
    sources_.assign(sources.begin(), sources.end());
    options_ = options;
    options_.progress = {};  // who asks later is not in this call any more
  }

  void solve_in(PathField<Complex>& paths, std::span<const PointSource> sources,
                const PropagateOptions& options) const {
    with_executor<Complex>(executor_,
                           [&](const auto& chosen) { paths.solve(chosen, sources, options); });
  }

  // Solved on the complex itself.
  const PathField<Complex>& with_labels() const {
    if (!adopted_) return paths_;
    std::call_once(labels_once_, [&] {
      labels_.emplace(complex_, path_places(shape_, measured_));
      solve_in(*labels_, sources_, options_);
    });
    return *labels_;
  }

  // Solved on the other triangles.
  const PathField<Complex>& with_windows() const {
    std::call_once(windows_once_, [&] {
      std::vector<PointSource> there;
      for (const PointSource& source : sources_) there.push_back(elsewhere_.place(source));
      windows_.emplace(*elsewhere_.complex);
      solve_in(*windows_, there, options_);
    });
    return *windows_;
  }

  double length(const Path& path) const { return path.length + sources_[path.source].offset; }
  double promised(const PointSource& point) const {
    if (point.vertex != none) return field[point.vertex];
    if constexpr (requires { paths_.at(point, ReadOut::linear); })
      return paths_.at(point, ReadOut::linear);
    else
      return 0;
  }

  std::shared_ptr<const Prepared> keep_;
  AnyShape shape_;
  const Complex& complex_;
  bool measured_, adopted_ = false;
  PathField<Complex> paths_;
  AnyExecutor executor_;
  std::vector<PointSource> sources_;
  PropagateOptions options_;
  mutable std::once_flag labels_once_;
  mutable std::optional<PathField<Complex>> labels_;
  Elsewhere elsewhere_;
  mutable std::once_flag windows_once_;
  mutable std::optional<PathField<Complex>> windows_;
};

}  // namespace plexway
