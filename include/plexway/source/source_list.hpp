#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <ranges>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/source/source.hpp>

namespace plexway {

/// The sources of a solve: one or many, points or of any kind. A single one is copied, and so are
/// what stands in braces and rows that would be gone after this line; other rows are referred to,
/// and must stay:
///
/// @code
///   solve(executor, domain, 7);                             // a vertex
///   solve(executor, domain, {7, 9});                        // the nearer of two
///   solve(executor, domain, rim);                           // std::vector<int>
///   solve(executor, domain, PointSource::at(7));
///   solve(executor, domain, {PointSource::in(3, {.5, .5, 0}), BallSource{...}});
///   solve(executor, domain, points);                        // std::vector<PointSource>
///   solve(executor, domain, VertexSource{.vertices = rim});
///   solve(executor, domain, sources);                       // std::vector<Source>
/// @endcode
class SourceList {
  template <class Range, class Element>
  static constexpr bool is_row =
      std::convertible_to<const std::remove_reference_t<Range>&, std::span<const Element>>;
  // An integer, but no letter and no truth value.
  template <class T>
  static constexpr bool is_vertex =
      std::integral<T> && !std::same_as<T, bool> && !std::same_as<T, char>;
  // Does what it holds stay where it is when it goes?
  template <class Range>
  static constexpr bool stays =
      std::is_lvalue_reference_v<Range> || std::ranges::borrowed_range<Range>;

 public:
  /// A vertex. UsageError for a number below 0.
  template <std::integral Vertex>
  requires(!std::same_as<Vertex, bool>) SourceList(Vertex vertex) : held_(vertex_at(vertex)) {}
  ///@{
  /// What stands in braces, copied: vertices, points, sources of any kind.
  SourceList(std::initializer_list<int> vertices) : held_(std::vector<PointSource>()) {
    for (const int v : vertices) std::get<std::vector<PointSource>>(held_).push_back(vertex_at(v));
  }
  SourceList(std::initializer_list<PointSource> points) : held_(std::vector(points)) {}
  SourceList(std::initializer_list<Source> sources) : held_(std::vector(sources)) {}
  ///@}
  /// Vertices in a row, such as std::vector<int>; copied.
  template <std::ranges::input_range Range>
  requires(is_vertex<std::ranges::range_value_t<const Range>>) SourceList(const Range& vertices)
      : held_(std::vector<PointSource>()) {
    for (const auto v : vertices) std::get<std::vector<PointSource>>(held_).push_back(vertex_at(v));
  }
  /// One point.
  SourceList(const PointSource& one) : held_(one) {}
  /// One source of any kind: a set, ball, curve or simplex.
  template <class Kind>
  requires(std::convertible_to<Kind, Source> && !std::same_as<Kind, PointSource>)
      SourceList(Kind one)
      : held_(std::in_place_type<Source>, std::move(one)) {}
  /// Rows of points.
  template <class Range>
  requires(is_row<Range, PointSource>) SourceList(Range&& points) {
    take<PointSource>(std::forward<Range>(points));
  }
  /// Rows of sources of any kind.
  template <class Range>
  requires(is_row<Range, Source>) SourceList(Range&& sources) {
    take<Source>(std::forward<Range>(sources));
  }
  /// So many points, one after another in memory; referred to.
  SourceList(const PointSource* first, std::size_t count) : held_(std::span(first, count)) {}

  /// Only points, given as such?
  [[nodiscard]] bool only_points() const {
    return std::holds_alternative<std::span<const PointSource>>(held_) ||
           std::holds_alternative<PointSource>(held_) ||
           std::holds_alternative<std::vector<PointSource>>(held_);
  }
  /// Where there are only points.
  [[nodiscard]] std::span<const PointSource> points() const { return row<PointSource>(); }
  /// Where there are not only points.
  [[nodiscard]] std::span<const Source> sources() const { return row<Source>(); }
  /// How many sources.
  [[nodiscard]] std::size_t size() const {
    return only_points() ? points().size() : sources().size();
  }
  /// Source k alone.
  [[nodiscard]] SourceList only(std::size_t k) const {
    if (only_points()) return SourceList(points()[k]);
    return SourceList(sources()[k]);
  }

 private:
  template <std::integral Vertex>
  static PointSource vertex_at(Vertex vertex) {
    if (!std::in_range<Index>(vertex) || static_cast<Index>(vertex) == none)
      throw UsageError("source vertex " + std::to_string(vertex) + " is out of range");
    return PointSource::at(static_cast<Index>(vertex));
  }
  template <class Element>
  [[nodiscard]] std::span<const Element> row() const {
    if (const auto* one = std::get_if<Element>(&held_)) return {one, 1};
    if (const auto* kept = std::get_if<std::vector<Element>>(&held_)) return *kept;
    const auto* rows = std::get_if<std::span<const Element>>(&held_);
    return rows != nullptr ? *rows : std::span<const Element>();
  }
  template <class Element, class Range>
  void take(Range&& rows) {
    if constexpr (stays<Range>)
      held_ = std::span<const Element>(rows);
    else if constexpr (std::same_as<std::remove_cvref_t<Range>, std::vector<Element>>)
      held_ = std::forward<Range>(rows);
    else
      held_ = std::vector<Element>(std::ranges::begin(rows), std::ranges::end(rows));
  }

  std::variant<std::span<const PointSource>, std::span<const Source>, PointSource, Source,
               std::vector<PointSource>, std::vector<Source>>
      held_;
};

}  // namespace plexway
