#include <plexway/shape/open_simplices.hpp>

#include <array>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

namespace plexway {
namespace {

void check(const Mask& mask, const AnyShape& shape) {
  if (mask.closed_vertices().size() != shape.vertices() ||
      mask.closed_simplices().size() != shape.simplices())
    throw UsageError("a mask of " + std::to_string(mask.closed_vertices().size()) +
                     " vertices and " + std::to_string(mask.closed_simplices().size()) +
                     " simplices for a shape of " + std::to_string(shape.vertices()) + " and " +
                     std::to_string(shape.simplices()));
}

}  // namespace

OpenSimplices::OpenSimplices(const Mask& mask, const AnyShape& shape)
    : inside_(shape.simplices(), none), reached_(shape.vertices(), 0) {
  check(mask, shape);
  for (std::size_t s = 0; s < inside_.size(); ++s) {
    const auto corners = shape.corners(s);
    if (!mask.is_open(corners, s)) continue;
    inside_[s] = static_cast<Index>(outside_.size());
    outside_.push_back(static_cast<Index>(s));
    for (const Index v : corners) reached_[v] = 1;
  }
  if (outside_.empty()) throw InputError("the mask closes all of it");
}

void OpenSimplices::outside(Path& path) const {
  for (PathPoint& at : path.points)
    if (at.simplex != none) at.simplex = outside_[at.simplex];
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

AnyShape AnyShape::open_part(const Mask& mask) const {
  if (kind() != DomainKind::mixed) support(Purpose::masks, kind()).require();
  check(mask, *this);
  const std::vector<std::array<double, 3>> places(positions().begin(), positions().end());
  const MeasuredLengths* const own = lengths();
  const auto rows = [&](const auto& corners_of, const auto& all) {
    using Corners = typename std::decay_t<decltype(corners_of)>::value_type;
    return mask.open_rows(std::span<const Corners>(corners_of), all);
  };
  if (const auto* surface = std::get_if<io::Triangles>(&data())) {
    const auto& all = surface->triangles;
    return own == nullptr
               ? AnyShape::surface(places, mask.open(all))
               : AnyShape::surface(vertices(), mask.open(all), rows(all, own->triangles));
  }
  if (const auto* solid = std::get_if<io::Tets>(&data())) {
    const auto& all = solid->tets;
    return own == nullptr ? AnyShape::solid(places, mask.open(all))
                          : AnyShape::solid(vertices(), mask.open(all), rows(all, own->tets));
  }
  if (const auto* given = std::get_if<SimplexShape>(&data())) {
    SimplexShape open = *given;
    open.corners.clear(), open.lengths.clear();
    const std::size_t edges = given->lengths.size() / simplices();
    for (std::size_t s = 0; s < simplices(); ++s) {
      const auto row = this->corners(s);
      if (!mask.is_open(row, s)) continue;
      open.corners.insert(open.corners.end(), row.begin(), row.end());
      const auto first = given->lengths.begin() + static_cast<std::ptrdiff_t>(s * edges);
      open.lengths.insert(open.lengths.end(), first, first + static_cast<std::ptrdiff_t>(edges));
    }
    return AnyShape::simplices(std::move(open));
  }
  if (const auto* parts = std::get_if<MixedShape>(&data())) {
    MixedShape open = *parts;
    std::size_t number = 0;
    const auto leave = [&](auto& simplices) {
      std::erase_if(simplices,
                    [&](const auto& corners) { return !mask.is_open(corners, number++); });
    };
    for (MixedShape::Part& part : open.parts)
      leave(part.edges), leave(part.triangles), leave(part.tets);
    return AnyShape::mixed(std::move(open));
  }
  const io::Edges& wire = std::get<io::Edges>(data());
  return wire.lengths.empty() ? AnyShape::wireframe(places, mask.open(wire.edges))
                              : AnyShape::wireframe(wire.vertices, mask.open(wire.edges),
                                                    rows(wire.edges, wire.lengths));
}

}  // namespace plexway
