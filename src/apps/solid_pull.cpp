#include "apps/solid_pull.hpp"

#include <algorithm>
#include <cmath>

#include "propagate/solid_sight.hpp"

namespace plexway {
namespace {

using Point = Vector3<double>;

constexpr double least_gain = 1e-10;
constexpr int most_pulls = 200;

double distance(const Point& a, const Point& b) { return norm(b - a); }

}  // namespace

template <class Real>
SolidPull<Real>::SolidPull(const SolidWalk<Real>& walk) : walk_(walk) {
  all_edges_.reserve(walk.mesh().reflex_edges().size());
  for (const ReflexEdge<Real>& e : walk.mesh().reflex_edges())
    all_edges_.push_back({{walk.vertex(e.vertex[0]), walk.vertex(e.vertex[1])}});
}

template <class Real>
double SolidPull<Real>::length(const std::vector<Knot>& way) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) sum += distance(way[i].at, way[i + 1].at);
  return sum;
}

/// A new knot there.
template <class Real>
bool SolidPull<Real>::sees(const Knot& from, const Point& to, Knot& arrived) const {
  const auto walked = walk_.walk(from.tets, from.at, to);
  if (!walked.arrived) return false;
  arrived.at = to;
  arrived.vertex = none;
  walk_.around(walked.tet, to, arrived.tets);
  return true;
}

/// A line may run between both sides of a crack and choose the wrong one; from there it does not.
template <class Real>
bool SolidPull<Real>::sees(const Knot& from, const Knot& to) const {
  bool arrived = false;
  const auto meets = [&](const Knot& a, const Knot& b) {
    const auto walked = walk_.walk(a.tets, a.at, b.at);
    arrived |= walked.arrived;
    if (!walked.arrived) return false;
    const auto goes_on = [&](Index t) {
      return std::find(b.tets.begin(), b.tets.end(), t) != b.tets.end();
    };
    if (goes_on(walked.tet)) return true;
    std::vector<Index> around;
    walk_.around(walked.tet, b.at, around);
    return std::any_of(around.begin(), around.end(), goes_on);
  };
  return meets(from, to) || (arrived && meets(to, from));
}

/// From each knot to the farthest that it sees.
template <class Real>
void SolidPull<Real>::skip(std::vector<Knot>& way) const {
  std::vector<Knot> kept = {way.front()};
  for (std::size_t i = 0; i + 1 < way.size();) {
    std::size_t next = way.size() - 1;
    if (next > i + 1 && !sees(way[i], way[next])) {
      next = i + 1;
      for (std::size_t reach = 2; i + reach < way.size(); reach *= 2) {
        if (!sees(way[i], way[i + reach])) break;
        next = i + reach;
      }
      // Between the last that is seen and the first that is not.
      for (std::size_t step = (next - i) / 2; step > 0; step /= 2)
        if (next + step < way.size() && sees(way[i], way[next + step])) next += step;
    }
    kept.push_back(way[next]);
    i = next;
  }
  way.swap(kept);
}

/// The tight string from a to c in their triangle with b, without its ends. False where it is not
/// free or no shorter than the way by b. without_b: what touches b does not count.
template <class Real>
bool SolidPull<Real>::chain(const Knot& a, const Point& b, const Knot& c, bool without_b,
                            std::vector<Knot>& between) const {
  between.clear();
  const double base = distance(a.at, c.at), by_b = distance(a.at, b) + distance(b, c.at);
  if (!(base > 0)) return true;
  const Point along = 1 / base * (c.at - a.at);
  Point off = b - a.at - dot(b - a.at, along) * along;
  const double height = norm(off);
  if (!(height > 1e-12 * by_b)) return false;
  off = 1 / height * off;
  const Point normal = cross(along, off);
  const double bx = dot(b - a.at, along), tiny = 1e-10 * by_b;

  // Where reflex edges pierce the triangle, as (x, y): along the base, and off it towards b.
  struct Peg {
    double x, y;
    Point at;
  };
  std::vector<Peg> pegs;
  const auto add = [&](const Point& p) {
    const double x = dot(p - a.at, along), y = dot(p - a.at, off);
    const double slack = 1e-9 * by_b;
    if (y < -slack || y > height + slack) return;
    // Inside of both legs.
    const double left = bx * y / height, right = base + (bx - base) * y / height;
    if (x < left - slack || x > right + slack) return;
    if (distance(p, a.at) < tiny || distance(p, c.at) < tiny) return;
    if (without_b && distance(p, b) < 1e-6 * by_b) return;
    pegs.push_back({x, y, p});
  };
  for (const Edge& e : edges_) {
    const double s0 = dot(e.end[0] - a.at, normal), s1 = dot(e.end[1] - a.at, normal);
    if ((s0 > tiny && s1 > tiny) || (s0 < -tiny && s1 < -tiny)) continue;
    if (std::abs(s0) <= tiny) add(e.end[0]);
    if (std::abs(s1) <= tiny) add(e.end[1]);
    if (s0 * s1 < 0 && std::abs(s0) > tiny && std::abs(s1) > tiny)
      add(e.end[0] + s0 / (s0 - s1) * (e.end[1] - e.end[0]));
  }
  pegs.push_back({base, 0, c.at});

  // Wrapped up from a: always on to the peg that leaves all others on the side of the base.
  std::vector<Point> string;
  double x = 0, y = 0;
  for (std::size_t turns = 0; turns <= pegs.size(); ++turns) {
    const Peg* next = nullptr;
    for (const Peg& p : pegs) {
      if (std::hypot(p.x - x, p.y - y) < tiny) continue;
      if (next == nullptr) {
        next = &p;
        continue;
      }
      const double turn = (next->x - x) * (p.y - y) - (next->y - y) * (p.x - x);
      const double far = std::hypot(p.x - x, p.y - y), known = std::hypot(next->x - x, next->y - y);
      if (turn > 1e-12 * far * known || (turn >= -1e-12 * far * known && far > known)) next = &p;
    }
    if (next == nullptr) return false;
    x = next->x, y = next->y;
    if (next == &pegs.back()) break;
    string.push_back(next->at);
  }

  double sum = 0;
  Knot from = a;
  for (const Point& p : string) {
    Knot knot;
    if (!sees(from, p, knot)) return false;
    sum += distance(from.at, p);
    between.push_back(knot);
    from = std::move(knot);
  }
  sum += distance(from.at, c.at);
  return sum < by_b * (1 - 1e-13) && sees(from, c);
}

/// Tries to do without knot k.
template <class Real>
bool SolidPull<Real>::tighten(std::vector<Knot>& way, std::size_t k) const {
  const Knot &a = way[k - 1], &b = way[k], &c = way[k + 1];
  if (distance(a.at, b.at) == 0 || distance(b.at, c.at) == 0 || sees(a, c)) {
    way.erase(way.begin() + static_cast<std::ptrdiff_t>(k));
    return true;
  }
  std::vector<Knot> between;
  bool found = chain(a, b.at, c, false, between);
  if (!found) {
    // It may hang on an edge that it only touches: is the way free close by?
    const double close = 1e-3 * std::min(distance(a.at, b.at), distance(b.at, c.at));
    const Point before = b.at + close / distance(a.at, b.at) * (a.at - b.at);
    const Point after = b.at + close / distance(b.at, c.at) * (c.at - b.at);
    Knot start, end;
    found = sees(b, before, start) && sees(start, after, end) && chain(a, b.at, c, true, between);
  }
  if (!found) return false;
  const auto at = way.erase(way.begin() + static_cast<std::ptrdiff_t>(k));
  way.insert(at, between.begin(), between.end());
  return true;
}

/// Moves knot k along the reflex edges it lies on.
template <class Real>
bool SolidPull<Real>::slide(std::vector<Knot>& way, std::size_t k) const {
  const Knot a = way[k - 1], b = way[k], c = way[k + 1];
  const double known = distance(a.at, b.at) + distance(b.at, c.at);
  for (const Edge& e : edges_) {
    const Point w = e.end[1] - e.end[0];
    const double l = norm(w);
    if (!(l > 0)) continue;
    const double on = dot(b.at - e.end[0], w) / l;
    if (on < -1e-9 * l || on > l * (1 + 1e-9)) continue;
    if (distance(e.end[0] + on / l * w, b.at) > 1e-9 * (l + known)) continue;
    const Point best = kernel::SolidSight<double>::bend_point(e.end[0], e.end[1], a.at, c.at);
    for (double share = 1; share > 1e-3; share /= 4) {
      const Point to = b.at + share * (best - b.at);
      if (!(distance(a.at, to) + distance(to, c.at) < known * (1 - least_gain))) break;
      Knot moved;
      if (!sees(b, to, moved)) continue;  // it lies in the solid, so the way there does
      if (sees(a, moved) && sees(moved, c)) {
        way[k] = moved;
        return true;
      }
      // Something is in the way: over b first, then tight on both sides.
      std::vector<Knot> first, second;
      if (!sees(a, moved) && !chain(a, b.at, moved, false, first)) continue;
      if (!sees(moved, c) && !chain(moved, b.at, c, false, second)) continue;
      std::vector<Knot> part = {a};
      part.insert(part.end(), first.begin(), first.end());
      part.push_back(moved);
      part.insert(part.end(), second.begin(), second.end());
      part.push_back(c);
      if (!(length(part) < known * (1 - least_gain))) continue;
      const auto at = way.erase(way.begin() + static_cast<std::ptrdiff_t>(k));
      way.insert(at, part.begin() + 1, part.end() - 1);
      return true;
    }
  }
  return false;
}

/// A way of length l from p to q stays within |x - p| + |x - q| <= l, and ways only get shorter.
template <class Real>
void SolidPull<Real>::look_near(const std::vector<Knot>& way) {
  const Point p = way.front().at, q = way.back().at;
  const double most = length(way) * (1 + 1e-9);
  edges_.clear();
  for (const Edge& e : all_edges_) {
    const Point middle = 0.5 * (e.end[0] + e.end[1]);
    if (distance(middle, p) + distance(middle, q) - distance(e.end[0], e.end[1]) <= most)
      edges_.push_back(e);
  }
}

template <class Real>
void SolidPull<Real>::pull(std::vector<Knot>& way) {
  skip(way);
  double before = length(way);
  look_near(way);
  for (int round = 0; round < most_pulls; ++round) {
    if (round == 1) look_near(way);  // the first gains most
    for (std::size_t k = 1; k + 1 < way.size();) {
      const std::size_t size = way.size();
      if (tighten(way, k) && way.size() < size)
        k = std::max(k, std::size_t(2)) - 1;  // the one before may go as well
      else
        ++k;
    }
    for (std::size_t k = 1; k + 1 < way.size(); ++k) slide(way, k);
    const double after = length(way);
    if (!(after < before * (1 - least_gain))) break;
    before = after;
  }
}

template class SolidPull<float>;
template class SolidPull<double>;

}  // namespace plexway
