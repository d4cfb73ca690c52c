#include <plexway/shape/open_simplices.hpp>

#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/support.hpp>

#include "shape/inside.hpp"
#include "shape/shape_state.hpp"

namespace plexway {
using namespace detail;
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
    : inside_(shape.simplices(), none),
      first_(shape.merged_vertices().begin(), shape.merged_vertices().end()),
      reached_(shape.vertices(), 0) {
  check(mask, shape);
  for (std::size_t s = 0; s < inside_.size(); ++s) {
    const auto corners = shape.corners(s);
    if (!mask.is_open(corners, s)) continue;
    inside_[s] = static_cast<Index>(outside_.size());
    outside_.push_back(static_cast<Index>(s));
    for (const Index v : corners) reached_[v] = 1;
  }
  if (outside_.empty()) throw InputError("the mask closes all of it");
  spread(reached_);
}

void OpenSimplices::outside(Path& path) const {
  for (PathPoint& at : path.points)
    if (at.simplex != none) at.simplex = outside_[at.simplex];
}

PointSource OpenSimplices::outside(const PointSource& point) const {
  PointSource there = point;
  if (point.simplex != none) there.simplex = outside_[point.simplex];
  return there;
}

std::vector<Index> OpenSimplices::columns(std::span<const Index> columns) const {
  if (first_.empty()) return {columns.begin(), columns.end()};
  if (columns.empty()) return first_;
  std::vector<Index> there;
  there.reserve(columns.size());
  for (const Index v : columns) there.push_back(first_[v]);
  return there;
}

void OpenSimplices::spread(AnyField& field) const {
  std::visit([&](auto& f) { spread(f.distance), spread(f.label), spread(f.error); }, field.data);
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
  if (point.vertex < first_.size()) there.vertex = first_[point.vertex];
  return there;
}

Source OpenSimplices::inside(const Source& source) const {
  Source there = source;
  each_place(
      there, [&](PointSource& point) { point = inside(point); },
      [&](Index& v) { v = v < first_.size() ? first_[v] : v; },
      [&](Index& simplex) { simplex = numbered(simplex); });
  return there;
}

void OpenSimplices::require(const Source& source) const {
  const auto check = [&](Index v) {
    if (v < reached_.size() && !reached(v))
      throw UsageError("vertex " + std::to_string(v) +
                       " is masked, or in no simplex that is open: no path passes there");
  };
  const auto number = [&](Index simplex) { static_cast<void>(numbered(simplex)); };
  each_place(
      source,
      [&](const PointSource& point) {
        check(point.vertex);
        if (point.vertex == none && point.simplex != none) number(point.simplex);
      },
      check, number);
}

AnyShape AnyShape::open_part(const Mask& mask) const {
  if (kind() != DomainKind::mixed) support(Purpose::masks, kind()).require();
  check(mask, *this);
  std::vector<char> is_open(simplices());
  for (std::size_t s = 0; s < is_open.size(); ++s) is_open[s] = mask.is_open(corners(s), s) ? 1 : 0;
  // Of so many numbers a simplex, from simplex `first` on.
  const auto leave_open = [&](auto& numbers, std::size_t first = 0, std::size_t width = 1) {
    std::size_t at = 0;
    std::erase_if(numbers, [&](const auto&) { return is_open[first + at++ / width] == 0; });
    return first + at / width;
  };
  State open;
  open.vertices = vertices();
  open.data = data();
  open.merged = state_->merged;
  open.merge_tolerance = state_->merge_tolerance;
  std::size_t first = 0;
  each_list(open.data, [&](auto& list) { first = leave_open(list, first); });
  if (auto* simplices = std::get_if<SimplexShape>(&open.data)) {
    const std::size_t width = static_cast<std::size_t>(simplices->dimension) + 1;
    leave_open(simplices->corners, 0, width);
    leave_open(simplices->lengths, 0, width * (width - 1) / 2);
  } else if (auto* wires = std::get_if<io::Edges>(&open.data)) {
    leave_open(wires->lengths);
  }
  if (lengths() != nullptr) {
    open.lengths = *lengths();
    leave_open(open.lengths->triangles), leave_open(open.lengths->tets);
    open.lengths->violations = violations_in(*open.lengths);
  }
  return of(std::move(open));
}

}  // namespace plexway
