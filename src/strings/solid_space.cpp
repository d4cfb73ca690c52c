#include "strings/solid_space.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace plexway::detail::strings {

template <class Real>
SolidSpace::SolidSpace(const TetMesh<Real>& mesh)
    : SolidSpace(mesh, {mesh.points().begin(), mesh.points().end()}) {}

template <class Real>
SolidSpace::SolidSpace(const TetMesh<Real>& mesh, std::vector<Point> points)
    : points_(std::move(points)),
      boundary_(find_boundary(mesh, points_)),
      sight_(boundary_, points_) {
  join(mesh);
  find_sharp();
  find_inside(mesh);
}

template <class Real>
void SolidSpace::join(const TetMesh<Real>& mesh) {
  std::vector<Index> seen(points_.size(), none);
  begin_.assign(1, 0);
  begin_.reserve(points_.size() + 1);
  for (Index v = 0; v < points_.size(); ++v) {
    seen[v] = v;
    for (const Index corner : mesh.corners_at(v))
      for (const Index w : mesh.tets()[corner / 4].corner)
        if (std::exchange(seen[w], v) != v) neighbours_.push_back(w);
    begin_.push_back(static_cast<Index>(neighbours_.size()));
  }
}

void SolidSpace::find_sharp() {
  constexpr double sharp = 1;  // radian
  sharp_.assign(points_.size(), 0);
  for (const auto& [v, row] : boundary_.rows_at) {
    if (!(boundary_.places[row].angle > std::numbers::pi + sharp)) continue;
    sharp_[v] = 1;
    for (const Index w : neighbours(v)) sharp_[w] = 1;
  }
}

template <class Real>
void SolidSpace::find_inside(const TetMesh<Real>& mesh) {
  constexpr double clear = .05;  // of a cosine
  auto& at = faces_at_;
  for (Index f = 0; f < boundary_.faces.size(); ++f)
    for (const Index v : boundary_.faces[f].corner) at.push_back({v, f});
  std::sort(at.begin(), at.end());
  slot_.assign(points_.size(), none);
  for (std::size_t first = 0, last = 0; first < at.size(); first = last) {
    const Index v = at[first].first;
    while (last < at.size() && at[last].first == v) ++last;
    const auto normal = [&](std::size_t i) { return boundary_.faces[at[i].second].normal; };
    Point sum = {0, 0, 0};
    for (std::size_t i = first; i < last; ++i) sum = sum + normal(i);
    sum = unit(sum);
    double least = 0;
    for (int tries = 0; tries < 16 && least <= clear; ++tries) {
      std::size_t worst = first;
      for (std::size_t i = first; i < last; ++i)
        if (dot(normal(i), sum) < dot(normal(worst), sum)) worst = i;
      least = dot(normal(worst), sum);
      if (least <= clear) sum = unit(sum + (2 * clear - least) * normal(worst));
    }
    slot_[v] = static_cast<Index>(inside_.size());
    inside_.push_back({sum, 0, 0, static_cast<Index>(first)});
    if (least > clear) continue;
    Inside& inside = inside_.back();
    inside.begin = static_cast<Index>(cones_.size());
    for (const Index corner : mesh.corners_at(v)) {
      const auto& tet = mesh.tets()[corner / 4];
      Cone cone{};
      Point side[3];
      for (Index k = 1; k < 4; ++k)
        side[k - 1] = points_[tet.corner[(corner % 4 + k) % 4]] - points_[v];
      for (std::size_t k = 0; k < 3; ++k) {
        const Point n = unit(cross(side[(k + 1) % 3], side[(k + 2) % 3]));
        cone.plane[k] = dot(n, side[k]) < 0 ? -1. * n : n;
        cone.middle = cone.middle + unit(side[k]);
      }
      cone.middle = unit(cone.middle);
      cones_.push_back(cone);
    }
    inside.end = static_cast<Index>(cones_.size());
  }
}

template <class Part>
Point SolidSpace::into(std::span<const Part> parts, const Point& p, const Point& toward,
                       const Point& free) const {
  const Point first = unit(toward - p), second = unit(free - p);
  const auto depth = [](const Part& part, const Point& d) {
    double least = 1;
    for (const Point& plane : part.plane) least = std::min(least, dot(plane, d));
    return least;
  };
  const Part* best = nullptr;
  double deepest = 0;
  bool held = false;
  for (const Part& part : parts) {
    const bool holds = depth(part, first) >= -Tolerances::on;
    const double now = depth(part, second);
    if (best != nullptr && (held > holds || (held == holds && now <= deepest))) continue;
    best = &part;
    deepest = now;
    held = holds;
  }
  return p + Tolerances::aside * best->middle;
}

Point SolidSpace::beside_boundary(Index slot, Index vertex, const Point& toward,
                                  const Point& free) const {
  const Inside& inside = inside_[slot];
  const Point& p = points_[vertex];
  if (inside.begin == inside.end) return p + Tolerances::aside * inside.direction;
  return into(std::span<const Cone>(cones_).subspan(inside.begin, inside.end - inside.begin), p,
              toward, free);
}

Point SolidSpace::beside(const Place& place, double t, const Point& toward,
                         const Point& free) const {
  return into(std::span<const Boundary::Wedge>(boundary_.wedges)
                  .subspan(place.first_wedge, place.last_wedge - place.first_wedge),
              place.off_ends(t, Tolerances::aside), toward, free);
}

bool SolidSpace::are_on_face(Index row, const Point& at, Index next, const Point& to) const {
  const Place &p = boundary_.places[row], &q = boundary_.places[next];
  for (const Index v : p.end) {
    if (v == none || (v != q.end[0] && v != q.end[1])) continue;
    for (const auto& [vertex, f] : faces_at(v)) {
      const Boundary::Face& face = boundary_.faces[f];
      int on = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index i = face.corner[(k + 1) % 3], j = face.corner[(k + 2) % 3];
        if (i != v && j != v) continue;
        const bool is_row = face.place[k] == row;
        if (!is_row && face.place[k] != next) continue;
        const Point edge = points_[i == v ? j : i] - points_[v],
                    d = (is_row ? at : to) - points_[v];
        on += dot(d, d) <= dot(edge, edge) ? 1 : 0;
      }
      if (on == 2) return true;
    }
  }
  return false;
}

std::size_t SolidSpace::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return sizeof(*this) + of(points_) + of(boundary_.faces) + of(boundary_.places) +
         of(boundary_.rows_at) + of(boundary_.wedges) + sight_.bytes() + of(begin_) +
         of(neighbours_) + of(sharp_) + of(faces_at_) + of(slot_) + of(inside_) + of(cones_);
}

template Point SolidSpace::into(std::span<const Boundary::Wedge>, const Point&, const Point&,
                                const Point&) const;
template SolidSpace::SolidSpace(const TetMesh<float>&);
template SolidSpace::SolidSpace(const TetMesh<double>&);
template SolidSpace::SolidSpace(const TetMesh<float>&, std::vector<Point>);
template SolidSpace::SolidSpace(const TetMesh<double>&, std::vector<Point>);

}  // namespace plexway::detail::strings
