#include "strings/sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace plexway::detail::strings {
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
