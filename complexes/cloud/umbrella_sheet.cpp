#include "complexes/cloud/umbrella.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

#include <plexway/common/blocks.hpp>

#include "complexes/cloud/crease.hpp"
#include "complexes/cloud/sheet.hpp"

namespace plexway::detail {
namespace {

constexpr std::size_t sheet_block = 1024;
using Triangle = SheetWedges::Triangle;

struct Candidate {
  int missing;  // votes
  double circle;
  Triangle corners;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return std::tie(a.missing, a.circle, a.corners) < std::tie(b.missing, b.circle, b.corners);
  }
};

struct Votes {
  std::vector<Triangle> agreed;
  std::vector<Candidate> others;
};

class VoteCount {
 public:
  VoteCount(const Umbrellas& umbrellas, const SheetWedges& sheet)
      : umbrellas_(umbrellas), sheet_(sheet), counted_(umbrellas.ring.size(), 0) {}

  // The triangles of which a place is the lowest corner, if it votes for them. By several threads.
  void count_lowest(Index p, Votes& votes) {
    for_wedges(p, [&](std::size_t, Index a, Index b) {
      if ((p > a) | (p > b)) return;
      const std::size_t at_a = find(a, p, b), at_b = find(b, p, a);
      if (at_a != nowhere) counted_[at_a] = 1;
      if (at_b != nowhere) counted_[at_b] = 1;
      if (at_a != nowhere && at_b != nowhere)
        votes.agreed.push_back(a < b ? Triangle{p, a, b} : Triangle{p, b, a});
      else
        add(p, a, b, at_a != nowhere || at_b != nowhere, votes);
    });
  }
  // Those that have no vote from their lowest corner, once all of those above are counted.
  void count_others(Index p, Votes& votes) const {
    for_wedges(p, [&](std::size_t i, Index a, Index b) {
      if (((p < a) & (p < b)) | (counted_[i] != 0)) return;
      const Index low = std::min(a, b), high = std::max(a, b);
      const bool by_high = find(high, p, low) != nowhere;
      if (!by_high || p < high) add(p, a, b, by_high, votes);
    });
  }

 private:
  static constexpr std::size_t nowhere = ~std::size_t{0};

  template <class Visit>
  void for_wedges(Index p, const Visit& visit) const {
    const std::span<const Index> ring = umbrellas_.around(p);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i] & Umbrellas::gap) continue;
      const Index next = ring[i + 1 == ring.size() ? 0 : i + 1] & ~Umbrellas::gap;
      visit(umbrellas_.begin[p] + i, ring[i], next);
    }
  }
  // Where in the ring of `place` its umbrella has the triangle with a and b.
  [[nodiscard]] std::size_t find(Index place, Index a, Index b) const {
    const std::span<const Index> ring = umbrellas_.around(place);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (ring[i] != a && ring[i] != b) continue;  // with the bit of a gap it is neither
      const Index next = ring[i + 1 == ring.size() ? 0 : i + 1] & ~Umbrellas::gap;
      if (next == (ring[i] == a ? b : a)) return umbrellas_.begin[place] + i;
    }
    return nowhere;
  }
  void add(Index p, Index a, Index b, bool second, Votes& votes) const {
    Triangle t = {p, a, b};
    std::sort(t.begin(), t.end());
    votes.others.push_back({second ? 1 : 2, sheet_.circle(t), t});
  }

  const Umbrellas& umbrellas_;
  const SheetWedges& sheet_;
  std::vector<char> counted_;  // of each wedge: its triangle has a vote from the lowest corner
};

}  // namespace

void add_umbrellas(const Umbrellas& umbrellas, int threads, SheetWedges& sheet) {
  const std::size_t n = umbrellas.begin.size() - 1;
  std::vector<Votes> found((n + sheet_block - 1) / sheet_block);
  VoteCount count(umbrellas, sheet);
  for_blocks(n, sheet_block, threads, {}, [&](std::size_t first, std::size_t last) {
    Votes& votes = found[first / sheet_block];
    votes.agreed.reserve(2 * (last - first));
    for (Index p = static_cast<Index>(first); p < last; ++p) count.count_lowest(p, votes);
  });
  for_blocks(n, sheet_block, threads, {}, [&](std::size_t first, std::size_t last) {
    for (Index p = static_cast<Index>(first); p < last; ++p)
      count.count_others(p, found[first / sheet_block]);
  });
  std::size_t agreed = 0;
  for (const Votes& votes : found) agreed += votes.agreed.size();
  sheet.reserve(agreed + agreed / 16);
  std::vector<Candidate> others;
  for (Votes& votes : found) {
    for (const Triangle& t : votes.agreed) sheet.add(t);
    others.insert(others.end(), votes.others.begin(), votes.others.end());
    votes = {};
  }
  std::sort(others.begin(), others.end());
  for (const Candidate& c : others)
    if (sheet.has_room(c.corners)) sheet.add(c.corners);
}

namespace {

constexpr std::size_t longest_hole = 24;  // edges

// The hole next to triangle (u, v, w) behind its edge u v; empty if it is longer than that.
bool trace_hole(const SheetWedges& sheet, Index u, Index v, Index w, std::vector<Index>& loop) {
  loop.assign(1, u);
  while (loop.size() <= longest_hole) {
    const Index next = sheet.next_around(v, u, w);
    if (next == none) return false;
    const Index triangle = sheet.only_triangle(v, next);
    if (triangle == none) return false;
    loop.push_back(v);
    for (const Index c : sheet.triangles()[triangle])
      if (c != v && c != next) w = c;
    u = v;
    v = next;
    if (u == loop[0] && v == loop[1]) {
      loop.pop_back();
      return true;
    }
  }
  return false;
}

// Closes it ear by ear, the smallest circle first, with triangles that fit.
template <class Fits>
void fill_hole(double widest, const Fits& fits, SheetWedges& sheet, std::vector<Index>& loop) {
  while (loop.size() >= 3) {
    const std::size_t m = loop.size();
    std::size_t best = m;
    double least = widest;
    Triangle ear{};
    for (std::size_t i = 0; i < m; ++i) {
      Triangle t = {loop[(i + m - 1) % m], loop[i], loop[(i + 1) % m]};
      std::sort(t.begin(), t.end());
      if (t[0] == t[1] || t[1] == t[2]) continue;
      const double circle = sheet.circle(t);
      if (!(circle < least) || !fits(t)) continue;
      best = i;
      least = circle;
      ear = t;
    }
    if (best == m) return;
    sheet.add(ear);
    if (m == 3) return;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

// Would each of its edges have two triangles at most, and those not the same?
bool can_join(const SheetWedges& sheet, const Triangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    int count = 0;
    bool same = false;
    sheet.around(t[i], [&](const SheetWedges::Wedge& w) {
      const Index next = t[(i + 1) % 3], last = t[(i + 2) % 3];
      if (w.a != next && w.b != next) return;
      ++count;
      same |= w.a == last || w.b == last;
    });
    if (count > 1 || same) return false;
  }
  return true;
}

// visit(loop) for holes, from each of their edges until it is closed.
template <class Visit>
void for_holes(SheetWedges& sheet, const Visit& visit) {
  struct Edge {
    Index v, w;  // of the triangle that it belongs to: the far end, and the apex
  };
  std::vector<Edge> edges;
  std::vector<Index> loop;
  for (Index u = 0; u < sheet.place_count(); ++u) {
    if (!sheet.open(u)) continue;
    edges.clear();
    sheet.around(u, [&](const SheetWedges::Wedge& w) {
      edges.push_back({w.a, w.b});
      edges.push_back({w.b, w.a});
    });
    for (const auto [v, w] : edges)  // what fills one hole closes edges of it
      if (sheet.only_triangle(u, v) != none && trace_hole(sheet, u, v, w, loop)) visit(loop);
  }
}

// visit(loop) for the parts of a loop that pass no place twice.
template <class Visit>
void for_simple_loops(const std::vector<Index>& loop, const Visit& visit) {
  std::vector<Index> way, part;
  for (const Index place : loop) {
    const auto at = std::find(way.begin(), way.end(), place);
    if (at != way.end()) {
      part.assign(at, way.end());
      way.erase(at, way.end());
      visit(part);
    }
    way.push_back(place);
  }
  visit(way);
}

}  // namespace

void fill_holes(double widest, SheetWedges& sheet) {
  for_holes(sheet, [&](std::vector<Index>& loop) {
    fill_hole(
        widest, [&](const Triangle& t) { return sheet.has_room(t); }, sheet, loop);
  });
}

namespace {

// Is a loop the rim of a hole in the sheet, not of the sheet or of the end of a tube? Angles of a
// flat sheet around a hole of m edges are (m + 2) pi, around an open end m pi.
bool is_hole(const SheetWedges& sheet, const std::vector<Index>& loop) {
  double taken = 0;
  for (const Index place : loop) taken += sheet.angle_taken(place);
  return taken > static_cast<double>(loop.size() + 1) * std::numbers::pi;
}

}  // namespace

void close_tears(double widest, SheetWedges& sheet) {
  constexpr std::size_t longest = 8;  // edges
  for_holes(sheet, [&](const std::vector<Index>& loop) {
    for_simple_loops(loop, [&](std::vector<Index>& part) {
      if (part.size() <= longest && is_hole(sheet, part))
        fill_hole(
            widest, [&](const Triangle& t) { return can_join(sheet, t); }, sheet, part);
    });
  });
}

std::vector<Index> torn_places(double widest, SheetWedges& sheet) {
  std::vector<Index> torn;
  for_holes(sheet, [&](const std::vector<Index>& loop) {
    if (!is_hole(sheet, loop)) return;
    const std::size_t m = loop.size();
    for (std::size_t i = 0; i < m; ++i) {
      const Triangle ear = {loop[i], loop[(i + 1) % m], loop[(i + 2) % m]};
      if (ear[0] == ear[2] || !(sheet.circle(ear) < widest)) continue;
      torn.insert(torn.end(), loop.begin(), loop.end());
      return;
    }
  });
  std::sort(torn.begin(), torn.end());
  torn.erase(std::unique(torn.begin(), torn.end()), torn.end());
  return torn;
}

void trim_boundary(double widest, SheetWedges& sheet) {
  // No deeper than a void by chance would be: where all triangles are that wide nothing is special.
  constexpr int deepest = 3;
  struct Loose {
    Index triangle;
    int depth;
  };
  const auto loose = [&](Index f) { return sheet.circle(sheet.triangles()[f]) > widest; };
  std::vector<Loose> queue;
  for (Index u = 0; u < sheet.place_count(); ++u)
    if (sheet.open(u))
      sheet.around(u, [&](const SheetWedges::Wedge& w) {
        const bool at_rim =
            sheet.only_triangle(u, w.a) != none || sheet.only_triangle(u, w.b) != none;
        if (at_rim && loose(w.triangle)) queue.push_back({w.triangle, 1});
      });
  for (std::size_t head = 0; head < queue.size(); ++head) {
    const auto [f, depth] = queue[head];
    const Triangle t = sheet.triangles()[f];
    if (t[0] == none) continue;
    bool last = false;  // of some place
    for (const Index place : t) {
      int at = 0;
      sheet.around(place, [&](const SheetWedges::Wedge&) { ++at; });
      last |= at == 1;
    }
    if (last) continue;
    sheet.remove(f);
    if (depth == deepest) continue;
    for (std::size_t i = 0; i < 3; ++i)
      if (const Index g = sheet.only_triangle(t[i], t[(i + 1) % 3]); g != none && loose(g))
        queue.push_back({g, depth + 1});
  }
}

void fill_notches(double deepest, SheetWedges& sheet) {
  constexpr int rounds = 3;  // what fills one may leave another beside it
  for (int round = 0; round < rounds; ++round)
    for (Index place = 0; place < sheet.place_count(); ++place) {
      Triangle t;
      if (sheet.notch(place, t) <= deepest && sheet.has_room(t)) sheet.add(t);
    }
}

namespace {

double corner_angle(const Places& places, Index corner, Index a, Index b) {
  const Point3 p = minus(places.at[a], places.at[corner]),
               q = minus(places.at[b], places.at[corner]);
  const Point3 n = cross(p, q);
  return std::atan2(std::sqrt(dot(n, n)), dot(p, q));
}

// Measured on a square with a block in it, 5k to 100k points, six draws each: mean errors of 4.4e-3
// to 5.4e-3 without, 2.1e-3, 1.7e-3 and 1.0e-3 so. Twice as far is no better.
constexpr double least_angle = std::numbers::pi * (1 + 10.0 / 180);
constexpr double farthest = 8;  // spacings
constexpr int rounds = 6;

struct Saddle {
  double angle;
  Index place;
};

std::vector<Saddle> find_saddles(const Places& places, const SheetWedges& sheet) {
  std::vector<Saddle> saddles;
  for (Index p = 0; p < places.near.point_count(); ++p) {
    if (!sheet.open(p)) continue;
    const double taken = sheet.angle_taken(p);
    if (taken > least_angle) saddles.push_back({taken, p});
  }
  std::stable_sort(saddles.begin(), saddles.end(),
                   [](const Saddle& a, const Saddle& b) { return a.angle > b.angle; });
  return saddles;
}

// The triangle on the other side of the edge of f from x to y, if there is one and no more.
SheetWedges::Wedge beyond(const SheetWedges& sheet, Index x, Index y, Index f) {
  SheetWedges::Wedge found = {none, none, none, none};
  int count = 0;
  sheet.around(x, [&](const SheetWedges::Wedge& w) {
    if (w.a != y && w.b != y) return;
    ++count;
    if (w.triangle != f) found = w;
  });
  if (count != 2) found.triangle = none;
  return found;
}

// Could the edge from c to z take the place of that from x to y, between them?
bool can_flip(const Places& places, Index c, Index x, Index y, Index z) {
  constexpr double most = std::numbers::pi - 0.04;
  return corner_angle(places, x, c, y) + corner_angle(places, x, y, z) < most &&
         corner_angle(places, y, c, x) + corner_angle(places, y, x, z) < most;
}

}  // namespace

void widen_boundary_saddles(const Places& places, std::span<const TangentFrame> frames,
                            const SheetRule& rule, SheetWedges& sheet) {
  const std::vector<Saddle> saddles = find_saddles(places, sheet);
  std::vector<char> is_saddle(places.at.size(), 0);
  for (const Saddle& s : saddles) is_saddle[s.place] = 1;
  std::vector<Index> star;
  for (int round = 0; round < rounds; ++round)
    for (const Saddle& s : saddles) {
      const Index c = s.place;
      const double most = farthest * static_cast<double>(frames[c].spacing);
      star.clear();
      sheet.around(c, [&](const SheetWedges::Wedge& w) { star.push_back(w.triangle); });
      for (const Index f : star) {
        const Triangle t = sheet.triangles()[f];
        const std::size_t i = t[0] == c ? 0 : t[1] == c ? 1 : 2;
        const Index x = t[(i + 1) % 3], y = t[(i + 2) % 3];
        const SheetWedges::Wedge other = beyond(sheet, x, y, f);
        if (other.triangle == none) continue;
        const Index z = other.a == y ? other.b : other.a;
        if (z == c || is_saddle[x] || is_saddle[y] || is_saddle[z]) continue;
        const Point3 far = minus(places.at[z], places.at[c]);
        if (dot(far, far) > most * most || !can_flip(places, c, x, y, z)) continue;
        // Over a crease the edge would be no straight line on the sheet.
        if (crease_between(places, frames, rule, c, z) || !same_sheet(places, frames, rule, c, z))
          continue;
        sheet.remove(f);
        sheet.remove(other.triangle);
        sheet.add({c, x, z});
        sheet.add({c, z, y});
      }
    }
}

}  // namespace plexway::detail
