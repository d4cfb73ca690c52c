#include "strings/pull.hpp"

#include <algorithm>

namespace plexway::detail::strings {

namespace {

bool has(const Place& row, Index vertex) {
  return vertex != none && (row.end[0] == vertex || row.end[1] == vertex);
}

bool joins(const Place& row, const Place& next) {
  return &row != &next && (has(next, row.end[0]) || has(next, row.end[1]));
}

}  // namespace

// The next row, turned about the vertex that both have.
void Strip::unfold(const Place& row, const Place& next) {
  const Portal& last = portals_.back();
  const bool low = has(next, row.end[0]);  // of the row
  const bool from_low = next.end[0] == row.end[low ? 0 : 1];
  const bool left = low == last.rises;
  const Flat &at = left ? last.left : last.right, &other = left ? last.right : last.left;
  const Point a = low ? row.along : -1. * row.along, b = from_low ? next.along : -1. * next.along;
  const double cosine = dot(a, b), sine = left ? norm(cross(a, b)) : -norm(cross(a, b));
  const double scale = (next.high - next.low) / (row.high - row.low);
  const Flat d = other - at;
  const Flat end = at + scale * Flat{cosine * d.x - sine * d.y, sine * d.x + cosine * d.y};
  portals_.push_back(left ? Portal{at, end, from_low} : Portal{end, at, !from_low});
}

// The first vertex of portals from one on that the shortest way to the end turns at, or the end;
// returns the portal of that, or as many as there are.
std::size_t Strip::turn(Flat& from, std::size_t first, const Flat& end, Flat& to) const {
  const std::size_t n = portals_.size();
  std::size_t l = first, r = first;
  for (std::size_t i = first + 1; i <= n; ++i) {
    const Flat left = portals_[l].left - from, right = portals_[r].right - from;
    const Flat a = (i < n ? portals_[i].left : end) - from,
               b = (i < n ? portals_[i].right : end) - from;
    if (cross(left, a) <= 0) {
      if (cross(right, a) < 0) return to = portals_[r].right, r;
      l = i;
    }
    if (cross(right, b) >= 0) {
      if (cross(left, b) > 0) return to = portals_[l].left, l;
      r = i;
    }
  }
  to = end;
  return n;
}

// Where a way passes a portal, 0 at its left end.
double Strip::share(const Portal& p, const Flat& from, const Flat& to) {
  if (p.left == from || p.left == to) return 0;
  if (p.right == from || p.right == to) return 1;
  const Flat way = to - from;
  const double left = cross(way, p.left - from), right = cross(p.right - from, way);
  return left + right > 0 ? std::clamp(left / (left + right), 0., 1.) : .5;
}

std::size_t Strip::pull(String& string, std::size_t first) {
  auto& knots = string.knots;
  std::size_t last = first;
  while (last + 2 < knots.size() && joins(*knots[last].place, *knots[last + 1].place)) ++last;
  const Place &row = *knots[first].place, &final = *knots[last].place;
  const auto across = [](const Place& p, const Point& point) {
    const Point d = point - p.origin;
    const double along = dot(d, p.along);
    return Flat{along, norm(d - along * p.along)};
  };
  const Flat in = across(row, knots[first - 1].at), out = across(final, knots[last + 1].at);
  if (last == first) {
    Knot& knot = knots[first];
    if (in.y + out.y > 0)
      knot.t = std::clamp(in.x + in.y / (in.y + out.y) * (out.x - in.x), row.low, row.high);
    knot.at = row.at(knot.t);
    return last + 1;
  }
  portals_.assign(1, {{row.low, 0}, {row.high, 0}, true});
  for (std::size_t k = first; k < last; ++k) unfold(*knots[k].place, *knots[k + 1].place);
  const Portal& p = portals_.back();
  const Flat up = 1 / (final.high - final.low) * (p.right - p.left);
  const double from_left = p.rises ? out.x - final.low : final.high - out.x;
  const Flat end = p.left + from_left * up + out.y * Flat{-up.y, up.x};
  Flat from = {in.x, -in.y}, to;
  for (std::size_t done = 0; done < portals_.size(); from = to) {
    const std::size_t next = turn(from, done, end, to);
    for (; done < portals_.size() &&
           (done <= next || portals_[done].left == to || portals_[done].right == to);
         ++done) {
      Knot& knot = knots[first + done];
      const Place& place = *knot.place;
      const double by = share(portals_[done], from, to), up_by = portals_[done].rises ? by : 1 - by;
      knot.t = up_by >= 1 ? place.high : place.low + up_by * (place.high - place.low);
      knot.at = place.at(knot.t);
    }
  }
  return last + 1;
}

}  // namespace plexway::detail::strings
