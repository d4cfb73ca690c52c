#include "paths/window_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "complexes/common/number_range.hpp"

namespace plexway::detail {
namespace {

constexpr auto later = [](const auto& a, const auto& b) { return a.bound > b.bound; };

// The place on an edge of this length (from 0) where a path from `from`, below it, to a point as
// far from its ends as `left_first` and `left_second` crosses it, if only it may do so in
// [begin, end]; and the path's length.
double shortest_over(const Vector2& from, double length, double left_first, double left_second,
                     double begin, double end, double share) {
  if (!(left_first < infinity)) left_first = left_second + length;
  if (!(left_second < infinity)) left_second = left_first + length;
  if (!(left_first < infinity)) return infinity;
  double x = 0, h = left_first;
  if (length > 0) {
    x = (left_first * left_first - left_second * left_second) / (2 * length) + length / 2;
    h = std::sqrt(std::max(left_first * left_first - x * x, 0.));
  }
  const double low = -from.y, sum = low + h;
  const double straight = sum > 0 ? (from.x * h + x * low) / sum : from.x;
  const double at = std::clamp(straight, begin, end);
  return std::hypot(at - from.x, low) + share * std::hypot(at - x, h);
}

}  // namespace

template <class Real>
WindowSearch<Real>::WindowSearch(const TriangleMesh<Real>& mesh, const SurfaceShape<Real>& shape,
                                 std::function<double(Index)> left,
                                 std::span<const WindowGoal> goals)
    : mesh_(mesh),
      shape_(shape),
      left_(std::move(left)),
      goals_(goals),
      next_goal_(goals.size(), none) {
  for (Index n = 0; n < goals.size(); ++n) {
    const WindowGoal& goal = goals[n];
    if (goal.vertex != none) {
      const auto [known, fresh] = goal_at_.get(goal.vertex);
      if (fresh || goal.left < goals[known].left) known = n;
    } else {
      const auto [first, fresh] = goals_in_.get(goal.face);
      next_goal_[n] = fresh ? none : first;
      first = n;
      goals_inside_ = true;
    }
  }
}

template <class Real>
typename WindowSearch<Real>::Vertex& WindowSearch<Real>::vertex(Index v) {
  const auto [known, fresh] = vertices_.get(v);
  if (!fresh) return known;
  known.distance = infinity;
  known.left = left_(v);
  return known;
}

template <class Real>
const typename WindowSearch<Real>::Face& WindowSearch<Real>::face(Index f) {
  const auto [known, fresh] = faces_.get(f);
  for (std::size_t i = 0; i < 3 && fresh; ++i)
    known.length[i] = shape_.length(f, i), known.apex[i] = shape_.apex(f, i);
  return known;
}

template <class Real>
bool WindowSearch<Real>::may_bend(Index v) {
  const auto pinched = mesh_.pinched();
  if (std::binary_search(pinched.begin(), pinched.end(), v)) return true;
  mesh_.corners_at(v, corners_);
  double angle = 0;
  std::size_t rims = 0;
  for (const Index c : corners_) {
    angle += shape_.angle(c / 3, c % 3);
    for (const std::size_t e : {std::size_t{c % 3}, edge_before(c % 3)}) {
      const Index across = mesh_.triangles()[c / 3].across[e];
      rims += (across >> Across::face_shift) == shape_.sentinel();
      if (across & Across::fan) return true;
    }
  }
  constexpr double rounding = 1e-6;
  return rims > 2 || angle > (rims > 0 ? 1 : 2) * std::numbers::pi + rounding;
}

template <class Real>
void WindowSearch<Real>::wait(const Waiting& waiting) {
  waiting_.push_back(waiting);
  std::push_heap(waiting_.begin(), waiting_.end(), later);
}

/// Offers a way to a vertex.
template <class Real>
void WindowSearch<Real>::arrive(const Arrival& arrival) {
  Vertex& v = vertex(arrival.vertex);
  if (!(arrival.distance < v.distance * (1 - 1e-14))) return;
  v.distance = arrival.distance;
  const Index number = static_cast<Index>(arrivals_.size());
  const double bound = arrival.distance + share_ * v.left;
  if (bound < bound_) {
    if (v.bends < 0) v.bends = may_bend(arrival.vertex) ? 1 : 0;
    if (v.bends > 0) wait({bound, number, true});
  }
  v.arrival = number;
  arrivals_.push_back(arrival);
  if (const auto [goal, fresh] = goal_at_.get(arrival.vertex); !fresh && goal != none) {
    const double whole = arrival.distance + goals_[goal].left;
    if (whole < bound_) {
      bound_ = whole;
      found_.goal = goal;
      last_window_ = none, last_arrival_ = number;
    }
  } else {
    goal = none;
  }
}

/// A fan of rays from a vertex into all triangles there, and the ways along edges.
template <class Real>
void WindowSearch<Real>::leave_vertex(Index number) {
  const Arrival arrival = arrivals_[number];
  std::vector<Index> corners;
  mesh_.corners_at(arrival.vertex, corners);
  for (const Index c : corners) {
    const Index f = c / 3;
    const std::size_t i = c % 3;
    for (const std::size_t k : {edge_after(i), edge_before(i)}) {
      const double length = shape_.length(f, k == edge_after(i) ? i : k);
      arrive({mesh_.triangles()[f].corner[k], arrival.distance + length, f, k, none, number, i});
    }
    const std::size_t opposite = edge_after(i);
    leave_point(f, shape_.apex(f, opposite), arrival.distance, number, i, opposite);
    if (!goals_inside_) continue;
    const auto [first, fresh] = goals_in_.get(f);
    if (fresh) first = none;
    for (Index n = first; n != none; n = next_goal_[n]) {
      const double whole =
          arrival.distance + shape_.distance(f, at_corner(i), goals_[n].at) + goals_[n].left;
      if (!(whole < bound_)) continue;
      // As an arrival of its own: straight from the vertex to the goal.
      bound_ = whole;
      found_.goal = n;
      last_window_ = none, last_arrival_ = static_cast<Index>(arrivals_.size());
      arrivals_.push_back({none, whole, f, 3, none, number, i});
    }
  }
}

/// A fan of rays from a point of f, `at` in the plane of one of its edges, out over that edge.
template <class Real>
void WindowSearch<Real>::leave_point(Index f, const Vector2& at, double sigma, Index root,
                                     std::size_t corner, std::size_t edge) {
  const double length = shape_.length(f, edge);
  across_edge(mesh_, f, edge, [&](const Crossing& c) {
    add({c, 0, length, {c.flip ? at.x : length - at.x, -at.y}, sigma, none, root, f, corner});
  });
}

/// Keeps a window where paths through it may be the shortest.
template <class Real>
void WindowSearch<Real>::add(const Window& w) {
  const TriangleRecord<Real>& t = mesh_.triangles()[w.in.face];
  const double length = face(w.in.face).length[w.in.edge];
  if (!(w.end - w.begin > 1e-13 * length)) return;
  const Vertex first = vertex(t.corner[w.in.edge]);
  const Vertex second = vertex(t.corner[edge_after(w.in.edge)]);
  const double near = std::hypot(w.begin - w.source.x, w.source.y) + w.sigma;
  const double far = std::hypot(w.end - w.source.x, w.source.y) + w.sigma;
  constexpr double rounding = 1 + 1e-12;
  if (far > (first.distance + w.end) * rounding ||
      near > (second.distance + length - w.begin) * rounding)
    return;
  const double bound =
      w.sigma + shortest_over(w.source, length, first.left, second.left, w.begin, w.end, share_);
  if (!(bound < bound_)) return;
  wait({bound, static_cast<Index>(windows_.size()), false});
  windows_.push_back(w);
}

/// Over the triangle that a window leads into.
template <class Real>
void WindowSearch<Real>::spread(Index number) {
  const Window w = windows_[number];
  const Index f = w.in.face;
  const std::size_t e = w.in.edge;
  const Face& measures = face(f);
  const double length = measures.length[e];
  const Vector2 apex = measures.apex[e], second = {length, 0};
  if (!(apex.y - w.source.y > 0)) return;
  const double over = w.source.x + (apex.x - w.source.x) * (-w.source.y / (apex.y - w.source.y));
  bool left = w.begin < over, right = over < w.end;
  if (left && right) {
    const double distance = w.sigma + norm(apex - w.source);
    Split& split = splits_.get(3 * f + static_cast<Index>(e)).first;
    if (!split.known || distance < split.distance) {
      split = {distance, over, true};
    } else if (over < split.crossing) {
      right = false;
    } else {
      left = false;
    }
    arrive({mesh_.triangles()[f].corner[edge_before(e)], distance, f, edge_before(e), number});
  }
  const TriangleRecord<Real>& t = mesh_.triangles()[f];
  const auto on = [&](std::size_t out, const Vector2& from, const Vector2& to, double begin,
                      double end) {
    // Where the rays through two places of the edge meet the other one, as shares of it.
    const Vector2 along = to - from;
    const double whole = norm(along);
    if (!(whole > 0)) return;
    const auto meet = [&](double x) {
      const Vector2 ray = {x - w.source.x, -w.source.y};
      const double across = cross(ray, along);
      return across != 0 ? std::clamp(-cross(ray, from - w.source) / across, 0., 1.) : 0.;
    };
    double low = meet(begin), high = meet(end);
    if (high < low) std::swap(low, high);
    // What comes by the vertex across is shorter all over, if it is at the end away from it.
    const bool to_left = out == edge_before(e);
    const Vector2 end_away = from + (to_left ? high : low) * along;
    const Vector2 opposite = to_left ? second : Vector2{0, 0};
    const double by_vertex =
        vertex(t.corner[to_left ? edge_after(e) : e]).distance + norm(end_away - opposite);
    if (w.sigma + norm(end_away - w.source) > by_vertex * (1 + 1e-12)) return;
    const Vector2 u = 1 / whole * along;
    const Vector2 source = {dot(w.source - from, u), cross(u, w.source - from)};
    across_edge(mesh_, f, out, [&](const Crossing& c) {
      Window next = {c,
                     (c.flip ? low : 1 - high) * whole,
                     (c.flip ? high : 1 - low) * whole,
                     {c.flip ? source.x : whole - source.x, -source.y},
                     w.sigma,
                     number,
                     w.root,
                     w.first,
                     w.first_corner};
      add(next);
    });
  };
  // Edge e + 1 runs from the second corner to the apex, e + 2 on to the first.
  if (left) on(edge_before(e), apex, {0, 0}, w.begin, std::min(w.end, over));
  if (right) on(edge_after(e), second, apex, std::max(w.begin, over), w.end);
}

/// Goals inside the triangle that a window leads into.
template <class Real>
void WindowSearch<Real>::try_goals(Index number) {
  const Window& w = windows_[number];
  const auto [first, fresh] = goals_in_.get(w.in.face);
  if (fresh) first = none;
  const std::size_t e = w.in.edge;
  const double length = shape_.length(w.in.face, e);
  for (Index n = first; n != none; n = next_goal_[n]) {
    const auto& b = goals_[n].at;
    const Vector2 at =
        Vector2{b[edge_after(e)] * length, 0} + b[edge_before(e)] * shape_.apex(w.in.face, e);
    if (!(at.y - w.source.y > 0)) continue;
    const double over = w.source.x + (at.x - w.source.x) * (-w.source.y / (at.y - w.source.y));
    if (over < w.begin || over > w.end) continue;
    const double whole = w.sigma + norm(at - w.source) + goals_[n].left;
    if (!(whole < bound_)) continue;
    bound_ = whole;
    found_.goal = n;
    last_window_ = number, last_arrival_ = none;
  }
}

template <class Real>
Strip WindowSearch<Real>::strip_of(Index number) const {
  Strip strip;
  const Window& last = windows_[number];
  strip.first = last.first;
  strip.start = last.root == none ? start_at_ : at_corner(last.first_corner);
  for (Index w = number; w != none; w = windows_[w].before)
    strip.crossings.push_back(windows_[w].in);
  std::reverse(strip.crossings.begin(), strip.crossings.end());
  return strip;
}

template <class Real>
std::vector<Strip> WindowSearch<Real>::strips_to(Index window, Index arrival,
                                                 const std::array<double, 3>& end) const {
  std::vector<Strip> strips;
  if (window != none) {
    strips.push_back(strip_of(window));
    strips.back().end = end;
    arrival = windows_[window].root;
  }
  while (arrival != none) {
    const Arrival& a = arrivals_[arrival];
    Strip strip;
    Index before = a.before;
    if (a.window != none) {
      strip = strip_of(a.window);
      before = windows_[a.window].root;
    } else if (before == none && a.before_corner == 3 && start_ == a.face &&
               corner_of(start_at_) == a.corner) {
      break;  // the start itself
    } else {
      strip.first = a.face;
      strip.start = before == none ? start_at_ : at_corner(a.before_corner);
    }
    strip.end = a.corner < 3 ? at_corner(a.corner) : end;
    strips.push_back(std::move(strip));
    arrival = before;
  }
  std::reverse(strips.begin(), strips.end());
  return strips;
}

template <class Real>
typename WindowSearch<Real>::Found WindowSearch<Real>::find(Index f, const std::array<double, 3>& b,
                                                            double bound, double margin,
                                                            std::size_t most) {
  vertices_ = {};
  splits_ = {};
  faces_ = {};
  arrivals_.clear();
  windows_.clear();
  waiting_.clear();
  found_ = {};
  last_window_ = last_arrival_ = none;
  start_ = f;
  start_at_ = b;
  bound_ = bound;
  share_ = 1 - margin;
  if (const std::size_t i = corner_of(b); i < 3) {
    const Index v = mesh_.triangles()[f].corner[i];
    vertex(v).bends = 1;
    arrive({v, 0, f, i});
  } else {
    const Vector2 corner[3] = {{0, 0}, {shape_.length(f, 0), 0}, shape_.apex(f, 0)};
    const Vector2 at = shape_.in_plane(f, b);
    for (std::size_t k = 0; k < 3; ++k)
      arrive({mesh_.triangles()[f].corner[k], norm(corner[k] - at), f, k});
    for (std::size_t e = 0; e < 3; ++e) {
      const Vector2 along = corner[edge_after(e)] - corner[e];
      const double length = norm(along);
      if (!(length > 0)) continue;
      const Vector2 u = 1 / length * along;
      leave_point(f, {dot(at - corner[e], u), cross(u, at - corner[e])}, 0, none, 3, e);
    }
    const auto [first, fresh] = goals_in_.get(f);
    if (fresh) first = none;
    for (Index n = first; n != none; n = next_goal_[n])
      if (shape_.distance(f, b, goals_[n].at) + goals_[n].left < bound_) return found_;  // one line
  }
  while (!waiting_.empty() && waiting_.front().bound < bound_) {
    if (windows_.size() > most) {
      found_.complete = false;
      break;
    }
    std::pop_heap(waiting_.begin(), waiting_.end(), later);
    const auto [least, next, is_arrival] = waiting_.back();
    waiting_.pop_back();
    const Index root = is_arrival ? next : windows_[next].root;
    if (root != none && vertex(arrivals_[root].vertex).arrival != root) continue;  // out of date
    if (is_arrival) {
      leave_vertex(next);
      continue;
    }
    if (goals_inside_) try_goals(next);
    spread(next);
  }
  found_.windows = windows_.size();
  found_.length = bound_;
  if (found_.goal != none)
    found_.strips = strips_to(
        last_window_, last_arrival_,
        goals_[found_.goal].vertex == none ? goals_[found_.goal].at : std::array<double, 3>{});
  // An end at a vertex is a corner of the last triangle already.
  return std::move(found_);
}

template class WindowSearch<float>;
template class WindowSearch<double>;

}  // namespace plexway::detail
