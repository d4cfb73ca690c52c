#include "strings/media_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "strings/media_builder.hpp"

namespace plexway::detail::strings {
std::vector<Index> covered_by(const Parts& parts) {
  std::vector<std::pair<Triple, Index>> faces;
  for (Index f = 0; f < parts.faces.size(); ++f) faces.push_back({sorted(parts.faces[f]), f});
  std::sort(faces.begin(), faces.end());
  std::vector<Index> by(parts.faces.size(), none);
  if (faces.empty()) return by;
  constexpr double rounding = 1e-9;
  for (Index t = 0; t < parts.tets.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& c = parts.tets[t];
      const std::pair<Triple, Index> key = {
          sorted({c[(i + 1) % 4], c[(i + 2) % 4], c[(i + 3) % 4]}), 0};
      for (auto f = std::lower_bound(faces.begin(), faces.end(), key);
           f != faces.end() && f->first == key.first; ++f) {
        Index& best = by[f->second];
        const double least =
            best == none ? parts.slow_faces[f->second] * (1 + rounding) : parts.slow_tets[best];
        if (best == none ? parts.slow_tets[t] <= least : parts.slow_tets[t] < least) best = t;
      }
    }
  return by;
}

MediaSpace::MediaSpace(const Parts& parts) {
  Builder builder(*this, parts);
  builder.build();
}

MediaSpace::MediaSpace(std::shared_ptr<const SolidSpace> solid) : places_(solid->places()) {
  const std::size_t count = solid->vertices();
  Medium medium{1, true, std::move(solid), {}, 0, 0, {}, {}, {}};
  points_.reserve(count);
  for (Index v = 0; v < count; ++v) points_.push_back(medium.room->point(v));
  nodes_.resize(count);
  std::iota(nodes_.begin(), nodes_.end(), Index{0});
  nodes_begin_ = nodes_;
  nodes_begin_.push_back(static_cast<Index>(count));
  medium.points = nodes_;
  medium_of_.assign(count, 0);
  media_.push_back(std::move(medium));
  first_patch_ = first_row_ = static_cast<Index>(places_.size());
  for (Index p = 0; p < places_.size(); ++p) {
    first_door_.push_back(p);
    doors_.push_back({p, 0});
  }
  first_door_.push_back(first_row_);
}

std::vector<Index> MediaSpace::simplices_around(Index simplex,
                                                const std::array<double, 4>& weight) const {
  const auto& corner = simplices_[simplex].corner;
  Index first = none;
  for (std::size_t i = 0; i < 4; ++i)
    if (corner[i] != none && weight[i] > 0) first = corner[i];
  std::vector<Index> found;
  for (const Index s : simplices_at(first)) {
    const auto& other = simplices_[s].corner;
    bool has_all = true;
    for (std::size_t i = 0; i < 4; ++i)
      has_all = has_all && (corner[i] == none || !(weight[i] > 0) ||
                            std::find(other.begin(), other.end(), corner[i]) != other.end());
    if (has_all) found.push_back(s);
  }
  return found;
}

Point MediaSpace::at(Index simplex, const std::array<double, 4>& weight) const {
  Point at = {0, 0, 0};
  for (std::size_t i = 0; i < 4; ++i)
    if (const Index v = simplices_[simplex].corner[i]; v != none) at = at + weight[i] * points_[v];
  return at;
}

Point MediaSpace::beside(Index simplex, const Point& at) const {
  const Medium& m = media_[simplices_[simplex].medium];
  if (!m.room) return at;
  Point middle = {0, 0, 0};
  double count = 0;
  for (const Index v : simplices_[simplex].corner)
    if (v != none) middle = middle + points_[v], ++count;
  return at + aside() * strings::unit(strings::unit(1 / count * middle - at) + m.up);
}

std::size_t MediaSpace::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t sum = sizeof(*this) + of(points_) + of(media_) + of(simplices_) + of(around_) +
                    of(around_begin_) + of(medium_of_) + of(nodes_) + of(nodes_begin_) +
                    of(places_) + of(patches_) + of(ends_) + of(patches_of_) + of(at_) +
                    of(doors_) + of(first_door_) + of(wedges_);
  for (const Medium& m : media_)
    sum += (m.room ? m.room->bytes() : 0) + of(m.points) + of(m.begin) + of(m.neighbours) +
           of(m.vertex);
  for (const Patch& p : patches_) sum += of(p.rows) + of(p.sides);
  return sum;
}

bool MediaSpace::holds(const Patch& patch, double t, double u, double near) const {
  bool inside = false;
  for (const auto& [at, au, bt, bu] : patch.sides) {
    const double wt = bt - at, wu = bu - au;
    const double share = std::clamp(((t - at) * wt + (u - au) * wu) / (wt * wt + wu * wu), 0., 1.);
    const double dt = t - at - share * wt, du = u - au - share * wu;
    if (dt * dt + du * du <= near * near) return true;
    if ((au > u) != (bu > u) && t < at + (u - au) / wu * wt) inside = !inside;
  }
  return inside;
}

Index MediaSpace::leaves(const Patch& patch, const std::array<double, 2>& from,
                         const std::array<double, 2>& to) const {
  Index best = none;
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  double first = unbounded, nearest = unbounded;
  const double vt = to[0] - from[0], vu = to[1] - from[1];
  for (std::size_t i = 0; i < patch.sides.size(); ++i) {
    const auto& [at, au, bt, bu] = patch.sides[i];
    const double wt = bt - at, wu = bu - au;
    // from + x v = a + y w
    const double det = wt * vu - wu * vt;
    if (det != 0) {
      const double x = (wt * (au - from[1]) - wu * (at - from[0])) / det,
                   y = (vt * (au - from[1]) - vu * (at - from[0])) / det;
      if (x >= -1e-9 && x <= 1 + 1e-9 && y >= -1e-9 && y <= 1 + 1e-9) {
        // It may start on one side: the last one that it crosses outward from there.
        if (x < first) first = x, best = patch.rows[i];
        continue;
      }
    }
  }
  if (best != none && first > 1e-9) return best;
  for (std::size_t i = 0; i < patch.sides.size(); ++i) {
    const auto& [at, au, bt, bu] = patch.sides[i];
    const double wt = bt - at, wu = bu - au;
    const double share =
        std::clamp(((to[0] - at) * wt + (to[1] - au) * wu) / (wt * wt + wu * wu), 0., 1.);
    const double off = std::hypot(to[0] - at - share * wt, to[1] - au - share * wu);
    if (off < nearest) nearest = off, best = patch.rows[i];
  }
  return best;
}

Point MediaSpace::inward(Index patch, Index row) const {
  const Place &plane = places_[patch], &line = places_[row];
  Point d = cross(this->patch(patch).normal, line.along);
  const Point q = line.at((line.low + line.high) / 2) +
                  1e-3 * std::min(1., line.high - line.low) * d - plane.origin;
  return holds(this->patch(patch), dot(q, plane.along), dot(q, plane.wide), 0) ? d : -1. * d;
}

Point MediaSpace::beside(Index place, Index medium, const Point& at, const Point& toward,
                         const Point& free) const {
  const Medium& m = media_[medium];
  if (!m.room) return at;
  switch (kind(place)) {
    case Kind::bend: {
      const Place& p = places_[place];
      const double t = dot(at - p.origin, p.along);
      return p.holds() ? m.room->beside(p, t, toward, free) : p.beside(t, aside());
    }
    case Kind::corner:
      return m.room->beside(m.in_room(node(point_of_corner(place), medium)), toward, free);
    case Kind::patch: {
      const Patch& p = patch(place);
      const Place& plane = places_[place];
      Point in = at;
      // Off its sides, where other faces begin.
      const double t = dot(at - plane.origin, plane.along), u = dot(at - plane.origin, plane.wide);
      for (const auto& [at0, au, bt, bu] : p.sides) {
        const double wt = bt - at0, wu = bu - au, length = std::hypot(wt, wu);
        const double off = ((t - at0) * wu - (u - au) * wt) / length,
                     share = ((t - at0) * wt + (u - au) * wu) / length;
        if (std::abs(off) > 3 * aside() || share < -3 * aside() || share > length + 3 * aside())
          continue;
        const double st = wu / length, su = -wt / length;
        const double step = 1e-4 * std::min(1., length);
        const double middle_t = at0 + wt / 2, middle_u = au + wu / 2;
        const auto is_patch = [&](double by) {
          return holds(p, middle_t + by * st, middle_u + by * su, 0);
        };
        const Point across = st * plane.along + su * plane.wide;
        const bool ahead = is_patch(step);
        // At a crack it is on both sides.
        const bool forward = ahead && is_patch(-step) ? dot(free - at, across) > 0 : ahead;
        in = in + (forward ? 3 : -3) * aside() * across;
      }
      const double side = !m.is_solid ? (dot(m.up, p.normal) >= 0 ? 1 : -1)
                          : p.above == medium && p.below == medium
                              ? (dot(toward - at, p.normal) >= 0 ? 1 : -1)
                              : (p.above == medium ? 1 : -1);
      return in + side * aside() * p.normal;
    }
    case Kind::row: {
      const Door& d = doors_[door(place, medium)];
      const Place& p = places_[place];
      return m.room->into(std::span<const Boundary::Wedge>(wedges_).subspan(
                              d.first_wedge, d.last_wedge - d.first_wedge),
                          p.off_ends(dot(at - p.origin, p.along), aside()), toward, free);
    }
  }
  return at;
}

}  // namespace plexway::detail::strings
