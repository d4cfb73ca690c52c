#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <ranges>
#include <span>
#include <utility>

#include <plexway/source/source.hpp>

namespace plexway {

/// The sources of a solve: one or many, points or of any kind. A view, but for a single curve, set
/// or the like, which it keeps; made where a function is called, so it need not be named:
///
/// @code
///   solve(executor, domain, PointSource::at(7));
///   solve(executor, domain, points);                        // std::vector<PointSource>
///   solve(executor, domain, VertexSource{.vertices = rim});
///   solve(executor, domain, sources);                       // std::vector<Source>
/// @endcode
class SourceList {
 public:
  /// One point; referred to.
  SourceList(const PointSource& one) : points_(&one, 1) {}
  /// One source of any kind; referred to.
  SourceList(const Source& one) : any_(&one, 1), is_any_(true) {}
  /// One set, ball, curve or simplex, which is copied.
  template <class Kind>
  requires std::convertible_to<Kind, Source> &&
      (!std::same_as<Kind, Source>)&&(!std::same_as<Kind, PointSource>)SourceList(const Kind& one)
      : own_(one), is_any_(true) {}
  /// Rows of points.
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const PointSource>> SourceList(
      const Range& points)
      : points_(std::span<const PointSource>(points)) {}
  /// Rows of sources of any kind.
  template <class Range>
  requires std::convertible_to<const Range&, std::span<const Source>> SourceList(
      const Range& sources)
      : any_(std::span<const Source>(sources)), is_any_(true) {}
  /// So many points, one after another in memory; referred to.
  SourceList(const PointSource* first, std::size_t count) : points_(first, count) {}

  /// Only points, given as such?
  [[nodiscard]] bool only_points() const { return !is_any_; }
  /// Where there are only points.
  [[nodiscard]] std::span<const PointSource> points() const { return points_; }
  /// Where there are not only points.
  [[nodiscard]] std::span<const Source> sources() const {
    return own_ ? std::span<const Source>(&*own_, 1) : any_;
  }
  /// How many sources.
  [[nodiscard]] std::size_t size() const { return is_any_ ? sources().size() : points_.size(); }
  /// Source k alone.
  [[nodiscard]] SourceList only(std::size_t k) const {
    if (is_any_) return SourceList(sources()[k]);
    return SourceList(points_[k]);
  }

 private:
  std::span<const PointSource> points_;
  std::span<const Source> any_;
  std::optional<Source> own_;
  bool is_any_ = false;
};

}  // namespace plexway
