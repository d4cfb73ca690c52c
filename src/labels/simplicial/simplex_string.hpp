#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "complexes/simplicial/flat_domain.hpp"
#include "labels/simplicial/simplex_taut.hpp"

namespace plexway {

/// A path in a flat domain as a string from a source over bends to an end, changed in such a way
/// that it never leaves the domain.
///
/// All changes are one: two legs A-B-C are exchanged for a way from A to C within their triangle.
/// What is not domain can come into a triangle with two free sides only over the third, so either
/// that side is free, or the triangle holds points of bending faces, and the shortest way is along
/// their convex hull with A and C. A bend is dropped so, moved along its face (two triangles), and
/// the end of the string goes from one place to another. So every string that comes out is a path:
/// no simplex is walked through, and a search among the faces takes the place of that.
///
/// Bends are held a little off their faces (FlatDomain::clearance), so that what lies beside a
/// string and what it has passed can be told apart by the signs of areas; lengths are those of the
/// string on the faces themselves.
template <int N>
class SimplexString {
 public:
  using Point = std::array<double, N>;
  using Along = typename BendingFace<N>::Along;

  struct Node {
    Index face;   ///< none: the source, the end, or a point on the way
    bool placed;  ///< on its face; not so where a bend was just found
    Along along;
    Point at;     ///< where the string is held
    Point sharp;  ///< where it is measured
  };

  enum class Pulled {
    taut,
    longer,  ///< than the limit
    stuck,   ///< it needs more bends or changes than there is room for
  };

  explicit SimplexString(const FlatDomain<N>& domain) : domain_(domain) {}

  void start(const Point& at, const Point& sharp) {
    node_[0] = {none, true, {}, at, sharp};
    count_ = 1;
  }
  void add_bend(Index face, const Along& along) {
    const BendingFace<N>& f = domain_.faces[face];
    add({face, true, along, domain_.held(f, along), f.at(along)});
  }
  void add_point(const Point& at, const Point& sharp) { add({none, true, {}, at, sharp}); }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t bends() const { return count_ - 2; }
  [[nodiscard]] const Node& operator[](std::size_t i) const { return node_[i]; }

  [[nodiscard]] double length() const {
    double sum = 0;
    for (std::size_t i = 1; i < count_; ++i) sum += distance_of(node_[i - 1].sharp, node_[i].sharp);
    return sum;
  }

  /// Takes out the point before the end, which must be one that is no bend, and pulls the string
  /// taut.
  Pulled pull(double limit) {
    return count_ <= room && cut(count_ - 2) ? tighten(limit) : Pulled::stuck;
  }
  /// Pulls it taut with all its bends.
  Pulled tighten(double limit) {
    if (count_ > room) return Pulled::stuck;
    for (int changes = 0; changes < most_changes; ++changes) {
      if (!drop_slack()) return Pulled::stuck;
      if (bends() > 0) {
        Taut<N> taut(domain_);
        taut.start(node_[0].sharp, node_[count_ - 1].sharp);
        for (std::size_t i = 1; i + 1 < count_; ++i) taut.add(node_[i].face, node_[i].along);
        if (taut.solve() > limit) return Pulled::longer;
        if (!place(taut)) return Pulled::stuck;
        if (!settled()) continue;
      }
      return length() > limit ? Pulled::longer : Pulled::taut;
    }
    return Pulled::stuck;
  }
  /// Nothing but a search: does the triangle hold no point of a bending face?
  [[nodiscard]] bool is_clear(const Point& a, const Point& b, const Point& c) {
    find(a, b, c, none, none);
    return found_ == 0;
  }

 private:
  static constexpr std::size_t room = 16, most_found = 48;
  static constexpr int most_changes = 24;

  struct Found {
    double x, y;  // in the triangle: shares of C and of B
    Index face;
  };

  /// What there is no room for is counted alone.
  void add(const Node& node) {
    if (count_ < room) node_[count_] = node;
    ++count_;
  }

  /// Moves the bends to their places, one after another.
  bool place(const Taut<N>& taut) {
    if (bends() > 1 && sweeps_nothing(taut)) return true;
    std::size_t i = 1;
    for (std::size_t k = 0, bends = count_ - 2; k < bends; ++k) {
      const BendingFace<N>& face = domain_.faces[node_[i].face];
      const Along& along = taut.along(k);
      const std::size_t behind = count_ - (i + 1);  // others may come in on both sides
      if (!move(i, domain_.held(face, along))) return false;
      node_[i].along = along;
      node_[i].sharp = face.at(along);
      node_[i].placed = true;
      i = count_ - behind;
    }
    return true;
  }

  /// The same at once, if nothing is in between: all legs are looked at, each with both the
  /// triangles that it sweeps.
  bool sweeps_nothing(const Taut<N>& taut) {
    const std::size_t last = count_ - 1;
    Point to[room];
    to[0] = node_[0].at;
    to[last] = node_[last].at;
    bool moves[room] = {};
    for (std::size_t i = 1; i < last; ++i) {
      to[i] = domain_.held(domain_.faces[node_[i].face], taut.along(i - 1));
      moves[i] = distance_of(node_[i].at, to[i]) > domain_.rounding;
    }
    for (std::size_t i = 0; i < last; ++i) {
      const Node &a = node_[i], &b = node_[i + 1];
      if (!moves[i] && !moves[i + 1]) continue;
      Point from, way, half;
      for (std::size_t d = 0; d < N; ++d) {
        from[d] = (a.at[d] + to[i][d]) / 2;
        way[d] = (b.at[d] + to[i + 1][d]) / 2 - from[d];
        half[d] = std::max(std::abs(a.at[d] - to[i][d]), std::abs(b.at[d] - to[i + 1][d])) / 2;
      }
      bool is_free = true;
      search(from, way, half, [&](Index f) {
        Found found;
        const bool near = f != a.face && f != b.face;
        is_free = is_free && !(moves[i] && pierces(f, to[i], a.at, b.at, near, found)) &&
                  !(moves[i + 1] && pierces(f, to[i], b.at, to[i + 1], near, found));
      });
      if (!is_free) return false;
    }
    for (std::size_t i = 1; i < last; ++i) {
      Node& node = node_[i];
      node.at = to[i];
      node.along = taut.along(i - 1);
      node.sharp = domain_.faces[node.face].at(node.along);
      node.placed = true;
    }
    return true;
  }

  [[nodiscard]] bool settled() {
    for (std::size_t i = 1; i + 1 < count_; ++i)
      if (!node_[i].placed || !turns(i)) return false;
    return true;
  }
  /// Is the string around the face, so that it would be shorter through what is no domain?
  [[nodiscard]] bool turns(std::size_t i) const {
    if (domain_.faces[node_[i].face].gate) return true;  // the only way to the other part
    Found found;
    return pierces(node_[i].face, node_[i - 1].at, node_[i].at, node_[i + 1].at,
                   is_near(node_[i].face, i - 1, i + 1), found);
  }
  bool drop_slack() {
    for (std::size_t i = 1, tries = 0; i + 1 < count_;) {
      if (turns(i)) {
        ++i;
        continue;
      }
      if (++tries > 2 * room || !cut(i)) return false;
      i = i > 1 ? i - 1 : 1;
    }
    return true;
  }

  /// A leg keeps its distance from faces but those on which it ends.
  [[nodiscard]] bool is_near(Index face, std::size_t i, std::size_t j) const {
    return face != node_[i].face && face != node_[j].face;
  }

  /// Without node i.
  bool cut(std::size_t i) {
    find(node_[i - 1].at, node_[i].at, node_[i + 1].at, node_[i - 1].face, node_[i + 1].face);
    return replace(i, i + 1);
  }
  /// Node i to another place that it reaches straight; i is then where the node is.
  bool move(std::size_t& i, const Point& to) {
    const Point old = node_[i].at;
    if (distance_of(old, to) <= domain_.rounding) {
      node_[i].at = to;
      return true;
    }
    // From A-B-C over A-B-to-C, whose last leg is made good in the end.
    if (count_ == room) return false;
    std::copy_backward(node_ + i, node_ + count_, node_ + count_ + 1);
    ++count_;
    node_[i + 1].at = to;
    const std::size_t from_end = count_ - (i + 1);
    if (!cut(i)) return false;
    i = count_ - from_end;
    find(to, old, node_[i + 1].at, node_[i].face, node_[i + 1].face);
    return replace(i + 1, i + 1);
  }

  /// Puts the hull of what was found in the place of nodes [begin, end).
  bool replace(std::size_t begin, std::size_t end) {
    if (found_ > most_found) return false;
    const std::size_t kept = found_ == 0 ? 0 : hull();
    if (count_ + kept > room + (end - begin)) return false;
    if (kept != end - begin) {
      if (kept > end - begin)
        std::copy_backward(node_ + end, node_ + count_, node_ + count_ + kept - (end - begin));
      else
        std::copy(node_ + end, node_ + count_, node_ + begin + kept);
      count_ = count_ + kept - (end - begin);
    }
    for (std::size_t k = 0; k < kept; ++k) {
      const Found& f = candidate_[k];
      const BendingFace<N>& face = domain_.faces[f.face];
      Node& node = node_[begin + k];
      node.face = f.face;
      node.placed = false;
      const Point p = at(a_, b_, c_, f);
      node.along = face.along_of(p);
      node.sharp = p;
      node.at = aside(p, f);
    }
    return true;
  }

  /// From a point of the hull away from A-C, where the triangle is free: by a clearance, or half as
  /// far as the triangle goes. Straight away, as long as both A and C see past the point there:
  /// where an angle of the triangle is obtuse they may not, but halfway between both their
  /// directions.
  Point aside(const Point& p, const Found& f) const {
    const Point base = minus(c_, a_);
    const double share = inner(minus(b_, a_), base) / inner(base, base);
    double x = -share, y = 1;  // of the way, as shares of A-C and A-B
    const double foot = f.x + f.y * share;
    if (foot <= 0 || foot >= 1) {
      const double from_a = distance_of(a_, p), from_c = distance_of(c_, p);
      if (!(from_a > 0 && from_c > 0)) return p;
      x = f.x / from_a + (f.x - 1) / from_c;
      y = f.y / from_a + f.y / from_c;
    }
    Point way{};
    for (std::size_t d = 0; d < N; ++d) way[d] = x * base[d] + y * (b_[d] - a_[d]);
    const double length = std::sqrt(inner(way, way));
    if (!(length > 0)) return p;
    double most = domain_.clearance / length;
    if (x < 0) most = std::min(most, f.x / -x / 2);
    if (x + y > 0) most = std::min(most, (1 - f.x - f.y) / (x + y) / 2);
    return plus(p, std::max(most, 0.), way);
  }

  /// The upper hull of what was found, from A to C, and what lies on it.
  ///
  /// A point goes if it is below the line from any point of the hull so far to the next one, not
  /// from the last alone: where several faces meet in one point, or walls lie one over another,
  /// only rounding tells which of two points is the last, and that they turn is no sign then.
  std::size_t hull() {
    std::sort(candidate_, candidate_ + found_, [](const Found& l, const Found& r) {
      if (l.x != r.x) return l.x < r.x;
      return l.y != r.y ? l.y < r.y : l.face < r.face;
    });
    const Found a = {0, 0, none}, c = {1, 0, none};
    const auto below = [](const Found& o, const Found& p, const Found& q) {
      return (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x) > 1e-14;
    };
    std::size_t kept = 0;
    for (std::size_t i = 0; i <= found_; ++i) {
      const Found next = i < found_ ? candidate_[i] : c;
      const auto hidden = [&](const Found& p) {
        return below(a, p, next) || std::any_of(candidate_, candidate_ + kept - 1,
                                                [&](const Found& o) { return below(o, p, next); });
      };
      while (kept > 0 && hidden(candidate_[kept - 1])) --kept;
      if (i < found_) candidate_[kept++] = next;
    }
    return kept;
  }

  /// Points of bending faces in the triangle.
  void find(const Point& a, const Point& b, const Point& c, Index face_a, Index face_c) {
    a_ = a, b_ = b, c_ = c;
    found_ = 0;
    // The triangle is within the line from a corner to the middle of the side across, widened by
    // half that side: best with the shortest side.
    const double ab = square(a, b), bc = square(b, c), ca = square(c, a);
    const Point& apex = bc <= ab && bc <= ca ? a : ca <= ab ? b : c;
    const Point& l = &apex == &a ? b : a;
    const Point& r = &apex == &c ? b : c;
    Point way, half;
    for (std::size_t d = 0; d < N; ++d) {
      way[d] = (l[d] + r[d]) / 2 - apex[d];
      half[d] = std::abs(l[d] - r[d]) / 2;
    }
    search(apex, way, half, [&](Index f) {
      Found found;
      if (!pierces(f, a, b, c, f != face_a && f != face_c, found)) return;
      if (found_ < most_found) candidate_[found_] = found;
      ++found_;
    });
  }
  /// Faces whose boxes come as near to a line as that.
  template <class Visit>
  void search(const Point& from, const Point& way, const Point& near, const Visit& visit) const {
    Point way_over, low, high;  // boxes are met where the line is in all slabs
    for (std::size_t d = 0; d < N; ++d) {
      way_over[d] = std::abs(way[d]) > 1e-200 ? 1 / way[d] : 1e200;
      low[d] = -near[d] - from[d];
      high[d] = near[d] - from[d];
    }
    const auto meets = [&](const Box<N>& box) {
      double first = 0, last = 1;
      for (std::size_t d = 0; d < N; ++d) {
        const double s = (box.low[d] + low[d]) * way_over[d];
        const double t = (box.high[d] + high[d]) * way_over[d];
        first = std::max(first, std::min(s, t));
        last = std::min(last, std::max(s, t));
        if (first > last) return false;
      }
      return true;
    };
    domain_.tree.search(meets, visit);
  }
  static double square(const Point& a, const Point& b) {
    const Point d = minus(a, b);
    return inner(d, d);
  }

  /// Does the triangle A-B-C meet the face, or the way A-C come closer to it than bends are held
  /// (`near`)? Of two ways out of rounding it takes yes, but for a face on which A or C is held:
  /// legs leave it along its walls.
  bool pierces(Index f, const Point& a, const Point& b, const Point& c, bool near,
               Found& found) const {
    const BendingFace<N>& face = domain_.faces[f];
    const double slack = domain_.rounding, margin = near ? domain_.clearance / 4 : slack;
    const double sa = inner(a, face.side) - face.origin_side;
    const double sb = inner(b, face.side) - face.origin_side;
    const double sc = inner(c, face.side) - face.origin_side;
    if (std::min({sa, sb, sc}) > margin || std::max({sa, sb, sc}) < -margin) return false;
    const double ia = inner(a, face.into) - face.origin_into;
    const double ib = inner(b, face.into) - face.origin_into;
    const double ic = inner(c, face.into) - face.origin_into;
    if (std::min({ia, ib, ic}) > margin || std::max({ia, ib, ic}) < -margin) return false;
    const double at_a = sb * ic - ib * sc, at_b = sc * ia - ic * sa, at_c = sa * ib - ia * sb;
    const double all = at_a + at_b + at_c;
    const double sign = all < 0 ? -1 : 1;
    const auto over = [&](double area, double su, double iu, double sv, double iv, double by) {
      return area * sign < -by * (std::abs(su - sv) + std::abs(iu - iv));
    };
    if (over(at_a, sb, ib, sc, ic, slack) || over(at_b, sc, ic, sa, ia, margin) ||
        over(at_c, sa, ia, sb, ib, slack))
      return false;
    // On the way A-C, or so near that areas do not tell where.
    const double way_s = sc - sa, way_i = ic - ia, way2 = way_s * way_s + way_i * way_i;
    if (!(way2 > 0)) return false;
    if (at_b * sign <= slack * std::sqrt(way2)) {
      const double x = -(sa * way_s + ia * way_i) / way2;
      if (x < 0 || x > 1) return false;
      found = {x, 0, f};
      if (!near) {  // where it is held, and no other place of the face?
        const Point p = at(a, b, c, found);
        if (std::min(distance_of(p, a), distance_of(p, c)) < 16 * domain_.clearance) return false;
      }
    } else {
      found = {at_c / all, at_b / all, f};
    }
    if constexpr (N > 2)
      if (!domain_.holds(face, face.along_of(at(a, b, c, found)), 16 * slack)) return false;
    return true;
  }
  static Point at(const Point& a, const Point& b, const Point& c, const Found& found) {
    Point p;
    for (std::size_t d = 0; d < N; ++d)
      p[d] = a[d] + found.y * (b[d] - a[d]) + found.x * (c[d] - a[d]);
    return p;
  }

  const FlatDomain<N>& domain_;
  Node node_[room];
  std::size_t count_ = 0;
  Point a_, b_, c_;  // the triangle last searched
  Found candidate_[most_found];
  std::size_t found_ = 0;
};

}  // namespace plexway
