#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

/// Plans of cracks without width that may join, and holes that they may end at, on a square of
/// cells, with a vertex on each side of cracks, the prisms over them, and exact distances: a
/// visibility graph in which each side of a crack is apart from the other.
namespace samples {

/// A square of n by n cells of size 1 / n, cut along straight cracks, without some rectangles.
class CrackPlan {
 public:
  using Number = std::uint32_t;
  using Point2 = std::array<double, 2>;
  /// From one corner of cells to another, in cells, along x or y.
  struct Crack {
    std::array<int, 2> begin, end;
  };
  /// From its lowest corner of cells to its highest. Neither reaches the rim.
  struct Hole {
    std::array<int, 2> begin, end;
  };

  /// Vertices that are on no crack or side of a hole and inside are moved at random by up to
  /// `jitter` of a cell; `random()` is in [0, 1). Those of a row of corners `straight` stay on
  /// their line.
  template <class Random>
  CrackPlan(int cells, std::vector<Crack> cracks, double jitter, Random&& random,
            std::vector<Hole> holes = {}, int straight = -1)
      : n_(cells), cracks_(std::move(cracks)), holes_(std::move(holes)) {
    for (int j = 0; j <= n_; ++j)
      for (int i = 0; i <= n_; ++i) {
        Point2 at = {double(i) / n_, double(j) / n_};
        if (i > 0 && j > 0 && i < n_ && j < n_ && !on_crack({i, j}) && !in_hole({i, j}))
          for (const std::size_t k : {0, 1})
            if (const double by = (2 * random() - 1) * jitter / n_; k == 0 || j != straight)
              at[k] += by;
        corners_.push_back(at);
      }
    std::vector<std::array<Number, 3>> faces;
    for (int j = 0; j < n_; ++j)
      for (int i = 0; i < n_; ++i) {
        const bool left_out = is_left_out(i, j), other_way = random() < .5;
        if (left_out) continue;
        const Number a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                     d = corner(i, j + 1);
        if (other_way) {
          faces.push_back({a, b, c});
          faces.push_back({a, c, d});
        } else {
          faces.push_back({a, b, d});
          faces.push_back({b, c, d});
        }
      }
    split(faces);
  }

  /// A place each; those on two sides of a crack are the same.
  [[nodiscard]] const std::vector<Point2>& places() const { return places_; }
  [[nodiscard]] const std::vector<std::array<Number, 3>>& faces() const { return faces_; }
  /// Is a vertex on a crack? Its ends are.
  [[nodiscard]] bool on_crack(Number vertex) const { return on_crack_[vertex]; }

  /// Exact distances from a vertex off all cracks; +inf where no way leads. As long as 1e-7 a bend.
  [[nodiscard]] std::vector<double> distances(Number from) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> distance(places_.size(), infinity);
    std::vector<Number> bends = {from};
    for (Number v = 0; v < places_.size(); ++v)
      if (may_bend_[v]) bends.push_back(v);
    std::vector<char> done(bends.size(), 0);
    distance[from] = 0;
    for (;;) {
      std::size_t next = bends.size();
      for (std::size_t k = 0; k < bends.size(); ++k)
        if (!done[k] && distance[bends[k]] < infinity &&
            (next == bends.size() || distance[bends[k]] < distance[bends[next]]))
          next = k;
      if (next == bends.size()) return distance;
      done[next] = 1;
      const Number b = bends[next];
      for (Number v = 0; v < places_.size(); ++v) {
        const double by =
            distance[b] + std::hypot(places_[v][0] - places_[b][0], places_[v][1] - places_[b][1]);
        if (by < distance[v] && sees(beside_[b], beside_[v])) distance[v] = by;
      }
    }
  }

  /// The same where the speed is `speed[0]` below a row of corners and `speed[1]` above: also by
  /// points of the line between, `points` of them; too long by about the square of how far these
  /// are apart. Cracks may cross the line, end on it or lie in it. For plans without holes.
  [[nodiscard]] std::vector<double> times(Number from, int row, const std::array<double, 2>& speed,
                                          int points) const {
    constexpr double infinity = std::numeric_limits<double>::infinity(), aside = 1e-8;
    const double middle = double(row) / n_, fast = std::max(speed[0], speed[1]);
    const auto length = [](const Point2& a, const Point2& b) {
      return std::hypot(a[0] - b[0], a[1] - b[1]);
    };
    const auto way = [&](const Point2& a, const Point2& b) {
      const bool below = a[1] <= middle && b[1] <= middle, above = a[1] >= middle && b[1] >= middle;
      if ((!below && !above) || !sees(a, b)) return infinity;
      return length(a, b) / (below && above ? fast : speed[below ? 0 : 1]);
    };
    std::vector<double> along;
    for (int i = 0; i <= points; ++i) along.push_back(double(i) / points);
    for (const Crack& c : cracks_)
      if (std::min(c.begin[1], c.end[1]) <= row && std::max(c.begin[1], c.end[1]) >= row)
        for (const auto& end : {c.begin, c.end})
          for (const double off : {-aside, aside}) along.push_back(double(end[0]) / n_ + off);
    // On a crack a point would be on both of its sides.
    for (const Crack& c : cracks_) {
      const double low = double(std::min(c.begin[0], c.end[0])) / n_;
      const double high = double(std::max(c.begin[0], c.end[0])) / n_;
      if (std::min(c.begin[1], c.end[1]) > row || std::max(c.begin[1], c.end[1]) < row) continue;
      std::erase_if(along, [&](double x) { return x > low - aside / 2 && x < high + aside / 2; });
    }
    std::vector<Point2> nodes = {beside_[from]};
    for (Number v = 0; v < places_.size(); ++v)
      if (on_crack_[v]) nodes.push_back(beside_[v]);
    for (const double x : along)
      if (x >= 0 && x <= 1) nodes.push_back({x, middle});
    std::vector<double> time(nodes.size(), infinity);
    std::vector<char> done(nodes.size(), 0);
    time[0] = 0;
    for (;;) {
      std::size_t next = nodes.size();
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!done[i] && time[i] < infinity && (next == nodes.size() || time[i] < time[next]))
          next = i;
      if (next == nodes.size()) break;
      done[next] = 1;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (time[next] + length(nodes[next], nodes[i]) / fast < time[i])
          time[i] = std::min(time[i], time[next] + way(nodes[next], nodes[i]));
    }
    std::vector<double> found(places_.size(), infinity);
    for (Number v = 0; v < places_.size(); ++v)
      for (std::size_t i = 0; i < nodes.size(); ++i)
        if (time[i] + length(nodes[i], beside_[v]) / fast < found[v])
          found[v] = std::min(found[v], time[i] + way(nodes[i], beside_[v]));
    return found;
  }

  /// One layer over the plan, each prism cut by the order of its vertices' numbers: vertex
  /// v + places().size() is over v.
  struct Solid {
    std::vector<std::array<double, 3>> places;
    std::vector<std::array<Number, 4>> tets;
  };
  [[nodiscard]] Solid solid(double height) const {
    Solid solid;
    const auto n = static_cast<Number>(places_.size());
    for (const double z : {0., height})
      for (const Point2& p : places_) solid.places.push_back({p[0], p[1], z});
    for (std::array<Number, 3> f : faces_) {
      std::sort(f.begin(), f.end());
      solid.tets.push_back({f[0], f[1], f[2], f[2] + n});
      solid.tets.push_back({f[0], f[1], f[1] + n, f[2] + n});
      solid.tets.push_back({f[0], f[0] + n, f[1] + n, f[2] + n});
    }
    return solid;
  }

 private:
  [[nodiscard]] Number corner(int i, int j) const { return static_cast<Number>(j * (n_ + 1) + i); }
  /// Is a point, in half cells, on a crack? And one that is strictly between corners.
  [[nodiscard]] bool on_crack(std::array<int, 2> corner_at) const {
    return std::any_of(cracks_.begin(), cracks_.end(), [&](const Crack& c) {
      for (std::size_t i = 0; i < 2; ++i)
        if (corner_at[i] < std::min(c.begin[i], c.end[i]) ||
            corner_at[i] > std::max(c.begin[i], c.end[i]))
          return false;
      return true;
    });
  }
  /// Is a corner of cells in a hole or on its side?
  [[nodiscard]] bool in_hole(std::array<int, 2> at) const {
    return std::any_of(holes_.begin(), holes_.end(), [&](const Hole& h) {
      return at[0] >= h.begin[0] && at[0] <= h.end[0] && at[1] >= h.begin[1] && at[1] <= h.end[1];
    });
  }
  [[nodiscard]] bool in_one_hole(const std::array<int, 2>& a, const std::array<int, 2>& b) const {
    return std::any_of(holes_.begin(), holes_.end(), [&](const Hole& h) {
      for (std::size_t i = 0; i < 2; ++i)
        if (std::min(a[i], b[i]) < h.begin[i] || std::max(a[i], b[i]) > h.end[i]) return false;
      return true;
    });
  }
  /// Is a cell?
  [[nodiscard]] bool is_left_out(int i, int j) const {
    return std::any_of(holes_.begin(), holes_.end(), [&](const Hole& h) {
      return i >= h.begin[0] && i < h.end[0] && j >= h.begin[1] && j < h.end[1];
    });
  }
  [[nodiscard]] bool is_cut(Number v, Number w) const {
    const auto at = [&](Number c) {
      return std::array<int, 2>{int(c) % (n_ + 1), int(c) / (n_ + 1)};
    };
    const auto a = at(v), b = at(w);
    if (a[0] != b[0] && a[1] != b[1]) return false;
    return std::any_of(cracks_.begin(), cracks_.end(), [&](const Crack& c) {
      const std::size_t along = c.begin[0] == c.end[0] ? 1 : 0, off = 1 - along;
      return a[off] == c.begin[off] && b[off] == c.begin[off] &&
             std::min(a[along], b[along]) >= std::min(c.begin[along], c.end[along]) &&
             std::max(a[along], b[along]) <= std::max(c.begin[along], c.end[along]);
    });
  }

  /// A vertex for each fan of triangles around a corner that cracks leave.
  void split(const std::vector<std::array<Number, 3>>& faces) {
    faces_ = faces;
    std::vector<std::vector<std::size_t>> at(corners_.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const Number v : faces[f]) at[v].push_back(f);
    for (Number v = 0; v < corners_.size(); ++v) {
      std::vector<std::size_t> left = at[v];
      const std::array<int, 2> place = {int(v) % (n_ + 1), int(v) / (n_ + 1)};
      const bool cracked = on_crack(place), bends = cracked || in_hole(place);
      while (!left.empty()) {
        std::vector<std::size_t> fan = {left.back()};
        left.pop_back();
        for (std::size_t k = 0; k < fan.size(); ++k)
          for (std::size_t m = 0; m < left.size();) {
            if (!joined(faces[fan[k]], faces[left[m]], v)) {
              ++m;
              continue;
            }
            fan.push_back(left[m]);
            left.erase(left.begin() + static_cast<std::ptrdiff_t>(m));
          }
        const auto number = static_cast<Number>(places_.size());
        places_.push_back(corners_[v]);
        on_crack_.push_back(cracked);
        may_bend_.push_back(bends);
        beside_.push_back(corners_[v]);
        if (bends) step_aside(v, fan, faces, beside_.back());
        for (const std::size_t f : fan)
          for (std::size_t i = 0; i < 3; ++i)
            if (faces[f][i] == v) faces_[f][i] = number;
      }
    }
  }
  /// Do triangles at v share an edge there that is not cut?
  [[nodiscard]] bool joined(const std::array<Number, 3>& f, const std::array<Number, 3>& g,
                            Number v) const {
    return std::any_of(f.begin(), f.end(), [&](Number w) {
      return w != v && std::find(g.begin(), g.end(), w) != g.end() && !is_cut(v, w);
    });
  }
  /// From a corner a little into the middle of a fan. At the end of a crack straight on from it.
  void step_aside(Number v, const std::vector<std::size_t>& fan,
                  const std::vector<std::array<Number, 3>>& faces, Point2& at) const {
    // Where the fan begins, and how far around it goes.
    constexpr double half_turn = 3.14159265358979323846;
    double begin = 0, angle = 0;
    bool closed = true;
    for (const std::size_t f : fan) {
      const auto& face = faces[f];
      const std::size_t i =
          static_cast<std::size_t>(std::find(face.begin(), face.end(), v) - face.begin());
      const Number first = face[(i + 1) % 3], last = face[(i + 2) % 3];
      const auto direction = [&](Number w) {
        return std::atan2(corners_[w][1] - corners_[v][1], corners_[w][0] - corners_[v][0]);
      };
      angle += std::remainder(direction(last) - direction(first), 2 * half_turn);
      const bool begins =
          is_cut(v, first) || std::none_of(fan.begin(), fan.end(), [&](std::size_t g) {
            return g != f && std::find(faces[g].begin(), faces[g].end(), first) != faces[g].end();
          });
      if (begins) begin = direction(first), closed = false;
    }
    if (closed) return;
    constexpr double aside = 1e-8;
    at[0] += aside * std::cos(begin + angle / 2);
    at[1] += aside * std::sin(begin + angle / 2);
  }

  [[nodiscard]] bool sees(const Point2& p, const Point2& q) const {
    const auto side = [](const Point2& a, const Point2& b, const Point2& c) {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    if (std::any_of(holes_.begin(), holes_.end(), [&](const Hole& h) { return passes(h, p, q); }))
      return false;
    return std::none_of(cracks_.begin(), cracks_.end(), [&](const Crack& c) {
      // One that ends on the rim is longer: lines along the rim do not pass it.
      const auto end = [&](const std::array<int, 2>& corner) {
        Point2 at = {double(corner[0]) / n_, double(corner[1]) / n_};
        for (std::size_t i = 0; i < 2; ++i) {
          if (c.begin[1 - i] == c.end[1 - i])
            at[i] += corner[i] == 0 ? -1 : corner[i] == n_ ? 1 : 0;
          // One that ends at a hole is too: lines through the corner do not pass between.
          const int other = corner == c.begin ? c.end[i] : c.begin[i];
          std::array<int, 2> beyond = corner;
          beyond[i] += (corner[i] > other) - (corner[i] < other);
          if (beyond != corner && in_one_hole(corner, beyond))
            at[i] += .01 * (beyond[i] - corner[i]) / n_;
        }
        return at;
      };
      const Point2 a = end(c.begin), b = end(c.end);
      return side(p, q, a) * side(p, q, b) <= 0 && side(a, b, p) * side(a, b, q) < 0;
    });
  }

  [[nodiscard]] bool passes(const Hole& hole, const Point2& p, const Point2& q) const {
    double begin = 0, end = 1;  // the part of the line within the hole
    for (std::size_t i = 0; i < 2; ++i) {
      const double low = double(hole.begin[i]) / n_, high = double(hole.end[i]) / n_;
      const double way = q[i] - p[i];
      if (std::abs(way) < 1e-14) {
        if (p[i] <= low || p[i] >= high) return false;
        continue;
      }
      const double s = (low - p[i]) / way, t = (high - p[i]) / way;
      begin = std::max(begin, std::min(s, t));
      end = std::min(end, std::max(s, t));
    }
    return begin < end;
  }

  int n_;
  std::vector<Crack> cracks_;
  std::vector<Hole> holes_;
  std::vector<Point2> corners_, places_, beside_;
  std::vector<std::array<Number, 3>> faces_;
  std::vector<char> on_crack_, may_bend_;  // of places_
};

}  // namespace samples
