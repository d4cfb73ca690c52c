#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "strings/solid_space.hpp"

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

namespace {

std::array<double, 3> coordinates(const Point& p) { return {p.x, p.y, p.z}; }

}  // namespace

Sight::Sight(const Boundary& boundary, std::span<const Point> points)
    : boundary_(&boundary), points_(points) {
  std::vector<char> seen(points.size(), 0);
  std::vector<Box<3>> boxes;
  for (const auto& face : boundary.faces)
    for (const Index v : face.corner)
      if (seen[v]++ == 0) boxes.push_back({coordinates(points[v]), coordinates(points[v])});
  const BoxTree<3> vertices(boxes);
  // A vertex behind the last face is likely to be behind the next as well.
  std::array<double, 3> last = boxes.empty() ? std::array<double, 3>{} : boxes[0].low;
  const auto hides = [&](const Plane& plane) {
    const auto height = [&](const std::array<double, 3>& p) {
      return plane.height({p[0], p[1], p[2]});
    };
    if (height(last) < -Tolerances::on) return true;
    bool found = false;
    vertices.search(
        [&](const Box<3>& box) {
          const std::array<double, 3> n = coordinates(plane.normal);
          std::array<double, 3> lowest;
          for (std::size_t d = 0; d < 3; ++d) lowest[d] = n[d] > 0 ? box.low[d] : box.high[d];
          return !found && height(lowest) < -Tolerances::on;
        },
        [&](Index v) {
          if (found || !(height(boxes[v].low) < -Tolerances::on)) return;
          found = true;
          last = boxes[v].low;
        });
    return found;
  };
  std::vector<Box<3>> walls;
  for (Index f = 0; f < boundary.faces.size(); ++f) {
    const auto& face = boundary.faces[f];
    const Point& n = face.normal;
    Wall wall{{n, dot(n, points[face.corner[0]])}, {}, f};
    if (!hides(wall.plane)) continue;
    Box<3> box = Box<3>::empty();
    for (std::size_t k = 0; k < 3; ++k) {
      const Point &a = points[face.corner[(k + 1) % 3]], &b = points[face.corner[(k + 2) % 3]];
      const Point inward = unit(cross(n, b - a));
      wall.side[k] = {inward, dot(inward, a)};
      box.add(coordinates(a));
    }
    box.widen(Tolerances::on);
    walls_.push_back(wall);
    walls.push_back(box);
  }
  tree_ = BoxTree<3>(walls);
}

bool Sight::is_between(const Wall& wall, const Point& from, const Point& to) const {
  const double before = wall.plane.height(from), behind = wall.plane.height(to);
  if (!(before > -Tolerances::on && behind < -Tolerances::on)) return false;
  const double share = std::max(before, 0.) / (std::max(before, 0.) - behind);
  const Point at = from + share * (to - from);
  for (const Plane& side : wall.side)
    if (side.height(at) < -Tolerances::on) return false;
  return true;
}

template <class Visit>
void Sight::along(const Point& from, const Point& to, const Visit& visit) const {
  const std::array<double, 3> a = coordinates(from), b = coordinates(to);
  std::array<double, 3> inverse, low, high;
  for (std::size_t d = 0; d < 3; ++d) {
    const double way = b[d] - a[d];
    inverse[d] = 1 / (std::abs(way) < 1e-30 ? 1e-30 : way);
    low[d] = std::min(a[d], b[d]);
    high[d] = std::max(a[d], b[d]);
  }
  bool done = false;
  tree_.search(
      [&](const Box<3>& box) {
        if (done) return false;
        double begin = 0, end = 1;
        for (std::size_t d = 0; d < 3; ++d) {
          if (box.low[d] > high[d] || box.high[d] < low[d]) return false;
          const double s = (box.low[d] - a[d]) * inverse[d], t = (box.high[d] - a[d]) * inverse[d];
          begin = std::max(begin, std::min(s, t));
          end = std::min(end, std::max(s, t));
        }
        return begin <= end;
      },
      [&](Index w) { done = done || (is_between(walls_[w], from, to) && visit(walls_[w])); });
}

bool Sight::is_blocked(const Point& from, const Point& to) const {
  bool blocked = false, grazing = false;
  Point off{};
  along(from, to, [&](const Wall& wall) {
    const double before = std::max(wall.plane.height(from), 0.);
    const Point at = from + before / (before - wall.plane.height(to)) * (to - from);
    bool inside = true;
    for (const Plane& side : wall.side) {
      if (side.height(at) > Tolerances::on) continue;
      inside = false;
      if (!grazing) off = -0.01 * Tolerances::aside * side.normal;  // less than ends are off faces
    }
    grazing = true;
    return blocked = inside;
  });
  if (blocked || !grazing) return blocked;
  // It only touches edges: is it free beside them?
  along(from + off, to + off, [&](const Wall&) { return blocked = true; });
  return blocked;
}

std::optional<Sight::Touch> Sight::touch(const Point& from, const Point& to, const Point& free,
                                         const std::array<Index, 2>& known) const {
  if (const auto found = highest(from, to, free - from, known)) return found;
  // It hardly turned, or along what it touches: straight off the first face between.
  Point off{};
  along(from, to, [&](const Wall& wall) {
    off = wall.plane.normal;
    return true;
  });
  return highest(from, to, off, known);
}

std::optional<Sight::Touch> Sight::highest(const Point& from, const Point& to, const Point& rise,
                                           const std::array<Index, 2>& known) const {
  const Point ahead = unit(to - from), off = rise - dot(rise, ahead) * ahead;
  if (norm(off) < Tolerances::aside) return {};
  const Point up = unit(off), normal = cross(ahead, up);
  std::optional<Touch> best;
  double steepest = -1e300;
  const auto side = [&](Index v) { return dot(normal, points_[v] - from); };
  const auto follow = [&](const Wall& wall) {
    constexpr int most = 4096;  // faces; far more than between neighbours
    Index face = wall.face, entered = 3;
    double before[3];  // of the corners of the face, across the plane
    for (Index k = 0; k < 3; ++k) before[k] = side(boundary_->faces[face].corner[k]);
    for (int n = 0; n < most; ++n) {
      const auto& f = boundary_->faces[face];
      // Of the two edges that the plane cuts, the one not entered by; at first the higher one.
      Index leave = 3;
      Point at{};
      double height = 0;
      for (Index k = 0; k < 3; ++k) {
        const double s = before[(k + 1) % 3], t = before[(k + 2) % 3];
        if (k == entered || (s < 0) == (t < 0)) continue;
        const Point &a = points_[f.corner[(k + 1) % 3]], &b = points_[f.corner[(k + 2) % 3]];
        const Point p = a + s / (s - t) * (b - a);
        const double y = dot(up, p - from);
        if (leave < 3 && y < height) continue;
        leave = k;
        at = p;
        height = y;
      }
      if (leave == 3) return;
      const double x = dot(ahead, at - from);
      const Index bend = f.place[leave];
      if (x > 0 && bend != none && bend != known[0] && bend != known[1] && height > steepest * x) {
        steepest = height / x;
        const Place& place = boundary_->places[bend];
        best = {bend, dot(at - place.origin, place.along)};
      }
      if (height < -Tolerances::on && n > 0) return;
      const Index next = f.across[leave];
      if (next == wall.face) return;
      const auto& g = boundary_->faces[next];
      const Index one = (leave + 1) % 3, two = (leave + 2) % 3;
      entered = 0;
      while (g.across[entered] != face || g.corner[entered] == f.corner[one] ||
             g.corner[entered] == f.corner[two])
        if (++entered == 3) return;
      const bool same = g.corner[(entered + 1) % 3] == f.corner[one];
      const double first = before[same ? one : two], second = before[same ? two : one];
      before[(entered + 1) % 3] = first;
      before[(entered + 2) % 3] = second;
      before[entered] = side(g.corner[entered]);
      face = next;
    }
  };
  along(from, to, [&](const Wall& wall) {
    follow(wall);
    return false;
  });
  return best;
}

}  // namespace plexway::detail::strings
