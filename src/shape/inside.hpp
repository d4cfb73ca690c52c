#pragma once

#include <span>
#include <variant>
#include <vector>

#include <plexway/shape/complex.hpp>
#include <plexway/shape/open_simplices.hpp>
#include <plexway/source/point_source.hpp>
#include <plexway/source/source_list.hpp>

namespace plexway::detail {

/// Calls point(p), vertex(v) and simplex(s) with all places that a source names, which may change
/// them; points of simplices and balls have theirs in `point`.
template <class Source, class Point, class Vertex, class Simplex>
void each_place(Source& source, const Point& point, const Vertex& vertex, const Simplex& simplex) {
  std::visit(
      [&](auto& one) {
        if constexpr (requires { one.barycentric; })
          point(one);
        else if constexpr (requires { one.centre; })
          point(one.centre);
        else if constexpr (requires { one.points; })
          for (auto& at : one.points) point(at);
        else if constexpr (requires { one.vertices; })
          for (auto& v : one.vertices) vertex(v);
        else
          simplex(one.simplex);
      },
      source);
}

/// Sources as the complex has them: behind a mask simplices have other numbers there.
class Inside {
 public:
  Inside(const OpenSimplices* open, const SourceList& sources) : sources_(sources) {
    if (open == nullptr) return;
    if (sources.only_points()) {
      for (const PointSource& point : sources.points()) points_.push_back(open->inside(point));
      sources_ = SourceList(points_);
    } else {
      for (const Source& source : sources.sources()) any_.push_back(open->inside(source));
      sources_ = SourceList(any_);
    }
  }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

  [[nodiscard]] const SourceList& list() const { return sources_; }

 private:
  std::vector<PointSource> points_;
  std::vector<Source> any_;
  SourceList sources_;
};

/// What fields of points are solved on, one by one.
struct RowComplex {
  AnyComplex complex;  ///< as long as the domain lives; std::monostate where vertices have other
                       ///< numbers there: then ask the domain itself
  std::vector<PointSource> rows;  ///< as the complex has them
};

/// The complex that AnyDomain::solve takes, with the bits of that, for points of the shape. Its
/// first vertices are those of the shape.
[[nodiscard]] RowComplex row_complex(const AnyDomain& domain, std::span<const PointSource> rows);

}  // namespace plexway::detail
