#include <plexway/any/open_simplices.hpp>

#include <string>
#include <type_traits>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

namespace plexway {

OpenSimplices::OpenSimplices(const Mask& mask, const AnyShape& shape)
    : inside_(shape.simplices(), none), reached_(shape.vertices(), 0) {
  support(Purpose::masks, shape.kind()).require();
  if (mask.closed_vertices().size() != shape.vertices() ||
      mask.closed_simplices().size() != shape.simplices())
    throw UsageError("a mask of " + std::to_string(mask.closed_vertices().size()) +
                     " vertices and " + std::to_string(mask.closed_simplices().size()) +
                     " simplices for a shape of " + std::to_string(shape.vertices()) + " and " +
                     std::to_string(shape.simplices()));
  for (std::size_t s = 0; s < inside_.size(); ++s) {
    const auto corners = shape.corners(s);
    if (!mask.is_open(corners, s)) continue;
    inside_[s] = static_cast<Index>(outside_.size());
    outside_.push_back(static_cast<Index>(s));
    for (const Index v : corners) reached_[v] = 1;
  }
  if (outside_.empty()) throw InputError("the mask closes all of it");
}

Index OpenSimplices::numbered(Index simplex) const {
  if (simplex >= inside_.size())
    throw UsageError("simplex " + std::to_string(simplex) + " is out of range, there are " +
                     std::to_string(inside_.size()));
  if (inside_[simplex] == none)
    throw UsageError("simplex " + std::to_string(simplex) + " is masked: no path passes there");
  return inside_[simplex];
}

PointSource OpenSimplices::inside(const PointSource& point) const {
  PointSource there = point;
  if (point.vertex == none && point.simplex != none) there.simplex = numbered(point.simplex);
  return there;
}

Source OpenSimplices::inside(const Source& source) const {
  Source there = source;
  std::visit(
      [&](auto& one) {
        using Kind = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<Kind, PointSource>)
          one = inside(one);
        else if constexpr (std::is_same_v<Kind, BallSource>)
          one.centre = inside(one.centre);
        else if constexpr (std::is_same_v<Kind, CurveSource>)
          for (PointSource& point : one.points) point = inside(point);
        else if constexpr (std::is_same_v<Kind, SimplexSource>)
          one.simplex = numbered(one.simplex);
      },
      there);
  return there;
}

}  // namespace plexway
