#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "shapes.hpp"

/// Convex polyhedra in the cube from -1 to 1, whose edges are not parallel to those of others, and
/// shortest ways around them by brute force.
namespace samples {

/// Turns about x, then y, then z.
struct Turn {
  std::array<Point, 3> row = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  Turn() = default;
  Turn(double x, double y, double z) {
    const std::array<double, 3> angle = {x, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double c = std::cos(angle[axis]), s = std::sin(angle[axis]);
      Point &a = row[(axis + 1) % 3], &b = row[(axis + 2) % 3];
      const Point old = a;
      a = c * old - s * b;
      b = s * old + c * b;
    }
  }
  [[nodiscard]] Point operator()(Point p) const {
    return {dot(row[0], p), dot(row[1], p), dot(row[2], p)};
  }
};

struct Polyhedron {
  std::vector<Point> points;
  std::vector<std::vector<Index>> faces;  ///< corners in order, either way around

  struct Plane {
    Point normal;  ///< outward
    double offset;
  };
  std::vector<Plane> planes;
  std::vector<std::array<Point, 2>> edges;
  Point middle{};

  Polyhedron(std::vector<Point> at, std::vector<std::vector<Index>> sides)
      : points(std::move(at)), faces(std::move(sides)) {
    for (const Point& p : points) middle = middle + 1. / static_cast<double>(points.size()) * p;
    std::set<std::pair<Index, Index>> seen;
    for (const auto& face : faces) {
      const Point a = points[face[0]];
      Point normal = unit(cross(points[face[1]] - a, points[face[2]] - a));
      if (dot(normal, a - middle) < 0) normal = -1. * normal;
      planes.push_back({normal, dot(normal, a)});
      for (std::size_t i = 0; i < face.size(); ++i) {
        const auto ends = std::minmax(face[i], face[(i + 1) % face.size()]);
        if (seen.insert(ends).second) edges.push_back({points[ends.first], points[ends.second]});
      }
    }
  }

  /// Does the line from p to q pass within? It may touch.
  [[nodiscard]] bool blocks(Point p, Point q) const {
    double begin = 0, end = 1;
    for (const Plane& plane : planes) {
      const double at_p = dot(plane.normal, p) - plane.offset + 1e-9;
      const double at_q = dot(plane.normal, q) - plane.offset + 1e-9;
      if (at_p >= 0 && at_q >= 0) return false;
      if (at_p > 0) begin = std::max(begin, at_p / (at_p - at_q));
      if (at_q > 0) end = std::min(end, at_p / (at_p - at_q));
    }
    return begin < end;
  }

  /// Half its sides; turned when it has been moved.
  static Polyhedron block(Point half, Point at, const Turn& turn = {}) {
    std::vector<Point> corner;
    for (int i = 0; i < 8; ++i)
      corner.push_back(turn(Point{(i & 1 ? 1 : -1) * half[0], (i & 2 ? 1 : -1) * half[1],
                                  (i & 4 ? 1 : -1) * half[2]} +
                            at));
    return {corner,
            {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  }
  static Polyhedron tetrahedron(std::array<Point, 4> corner, const Turn& turn = {}) {
    for (Point& p : corner) p = turn(p);
    return {{corner.begin(), corner.end()}, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  }
  /// A thin pyramid along z.
  static Polyhedron spike(double half, double foot, double tip, const Turn& turn = {}) {
    std::vector<Point> corner = {{-half, -half, foot},
                                 {half, -half, foot},
                                 {half, half, foot},
                                 {-half, half, foot},
                                 {.03, .02, tip}};
    for (Point& p : corner) p = turn(p);
    return {corner, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  }
};

struct Obstacles {
  std::string name;
  std::vector<Polyhedron> blocks;
};

inline std::vector<Obstacles> convex_obstacles() {
  const Turn one(.4, .7, .3), two(1.1, .35, -.6);
  using P = Polyhedron;
  return {
      {"box", {P::block({.35, .45, .3}, {.05, .02, -.03})}},
      {"turned box", {P::block({.35, .5, .25}, {.05, .02, -.03}, one)}},
      {"plate", {P::block({.6, .5, .03}, {0, .05, .02}, two)}},
      {"tetrahedron",
       {P::tetrahedron({{{.6, .5, .5}, {-.55, -.5, .45}, {-.5, .6, -.5}, {.5, -.45, -.55}}}, one)}},
      {"crossed bars",
       {P::block({.7, .12, .1}, {0, 0, .17}, one), P::block({.1, .75, .13}, {.05, 0, -.17}, one)}},
      {"three bars",
       {P::block({.7, .12, .1}, {0, .1, .3}, two), P::block({.1, .6, .13}, {.25, 0, -.05}, two),
        P::block({.12, .1, .6}, {-.2, -.25, -.1}, two)}},
      {"spike", {P::spike(.12, -.8, .8, one)}}};
}

/// Of all ways over points spread along the edges the best ones, their bends then moved to where
/// the way is shortest.
class WaysAround {
 public:
  WaysAround(std::vector<Polyhedron> blocks, int parts) : blocks_(std::move(blocks)) {
    for (const Polyhedron& block : blocks_)
      for (const auto& edge : block.edges) {
        for (int i = 0; i <= parts; ++i)
          stop_.push_back({edge[0] + double(i) / parts * (edge[1] - edge[0]), edge_.size()});
        edge_.push_back(edge);
      }
    next_.resize(stop_.size());
    for (std::size_t i = 0; i < stop_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (sees(stop_[i].at, stop_[j].at)) {
          const double d = gap(stop_[i].at, stop_[j].at);
          next_[i].push_back({j, d});
          next_[j].push_back({i, d});
        }
  }

  [[nodiscard]] bool sees(Point p, Point q) const {
    return std::none_of(blocks_.begin(), blocks_.end(),
                        [&](const Polyhedron& block) { return block.blocks(p, q); });
  }

  /// From now on all ways start here.
  void start(Point source) {
    source_ = source;
    walked_.assign(stop_.size(), infinity);
    before_.assign(stop_.size(), none);
    std::vector<char> done(stop_.size(), 0);
    for (std::size_t i = 0; i < stop_.size(); ++i)
      if (sees(source, stop_[i].at)) walked_[i] = gap(source, stop_[i].at);
    for (std::size_t round = 0; round < stop_.size(); ++round) {
      std::size_t best = none;
      for (std::size_t i = 0; i < stop_.size(); ++i)
        if (!done[i] && (best == none || walked_[i] < walked_[best])) best = i;
      done[best] = 1;
      for (const auto& [to, d] : next_[best])
        if (walked_[best] + d < walked_[to] - 1e-12) {
          walked_[to] = walked_[best] + d;
          before_[to] = best;
        }
    }
  }

  [[nodiscard]] double to(Point target) const {
    if (sees(source_, target)) return gap(source_, target);
    std::vector<std::pair<double, std::size_t>> last;
    for (std::size_t i = 0; i < stop_.size(); ++i)
      last.push_back({walked_[i] + gap(target, stop_[i].at), i});
    std::sort(last.begin(), last.end());
    double best = infinity;
    std::set<std::vector<std::size_t>> tried;
    for (const auto& [length, i] : last) {
      if (length > best * 1.02 || tried.size() >= 40) break;
      if (!sees(stop_[i].at, target)) continue;
      best = std::min(best, length);
      std::vector<std::size_t> edges;
      std::vector<Point> bends;
      for (std::size_t at = i; at != none; at = before_[at]) {
        if (!edges.empty() && edges.back() == stop_[at].edge) continue;
        edges.push_back(stop_[at].edge);
        bends.push_back(stop_[at].at);
      }
      if (tried.insert(edges).second)
        best = std::min(best, tightened(edges, std::move(bends), target));
    }
    return best;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr std::size_t none = ~std::size_t{0};
  struct Stop {
    Point at;
    std::size_t edge;
  };
  struct Way {
    std::size_t to;
    double length;
  };
  static double gap(Point p, Point q) { return std::sqrt(dot(p - q, p - q)); }

  /// Where the way from p to q over an edge is shortest.
  static Point bend(const std::array<Point, 2>& edge, Point p, Point q) {
    const Point along = unit(edge[1] - edge[0]);
    const double at_p = dot(p - edge[0], along), at_q = dot(q - edge[0], along);
    const double off_p = gap(p, edge[0] + at_p * along), off_q = gap(q, edge[0] + at_q * along);
    const double off = off_p + off_q;
    const double at = off > 0 ? (at_p * off_q + at_q * off_p) / off : at_p;
    return edge[0] + std::clamp(at, 0., gap(edge[0], edge[1])) * along;
  }

  /// The shortest way over these edges, from the last to the first; +inf if it is not free.
  [[nodiscard]] double tightened(const std::vector<std::size_t>& edges, std::vector<Point> bends,
                                 Point target) const {
    const std::size_t count = edges.size();
    const auto from = [&](std::size_t i) { return i + 1 < count ? bends[i + 1] : source_; };
    const auto on = [&](std::size_t i) { return i > 0 ? bends[i - 1] : target; };
    double length = infinity;
    for (int round = 0; round < 2000; ++round) {
      for (std::size_t i = 0; i < count; ++i) bends[i] = bend(edge_[edges[i]], from(i), on(i));
      double now = gap(bends[0], target);
      for (std::size_t i = 0; i < count; ++i) now += gap(bends[i], from(i));
      const bool still = now > length - 1e-14;
      length = std::min(length, now);
      if (still) break;
    }
    for (std::size_t i = 0; i < count; ++i)
      if (!sees(bends[i], from(i))) return infinity;
    return sees(bends[0], target) ? length : infinity;
  }

  std::vector<Polyhedron> blocks_;
  std::vector<std::array<Point, 2>> edge_;
  std::vector<Stop> stop_;
  std::vector<std::vector<Way>> next_;
  Point source_{};
  std::vector<double> walked_;
  std::vector<std::size_t> before_;
};

}  // namespace samples
