#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "data/corner_domains.hpp"
#include "mixed_domains.hpp"

namespace mixed_welds_test {

// Corners that exist only once pieces are welded.

namespace {

using namespace mixed_domains;
using Plane = std::array<double, 2>;

double length(const Plane& a, const Plane& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Rooms in a row, each a strip low[i] <= x <= low[i + 1] of the plane; door i is open on the line
/// x = low[i + 1] for from <= y <= to. Between places of any two rooms, by the doors' ends.
struct Rooms {
  std::vector<double> low;
  std::vector<std::array<double, 2>> door;

  double way(std::size_t p_room, const Plane& p, std::size_t q_room, const Plane& q) const {
    if (p_room > q_room) return way(q_room, q, p_room, p);
    std::vector<Plane> at = {p};
    std::vector<std::size_t> room = {p_room};  // the first that it lies in
    for (std::size_t d = p_room; d < q_room; ++d)
      for (const double y : door[d]) at.push_back({low[d + 1], y}), room.push_back(d);
    at.push_back(q);
    room.push_back(q_room);
    std::vector<double> best(at.size(), infinity);
    best[0] = 0;
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = i + 1; j < at.size(); ++j) {
        if (!sees(at[i], room[i] + (i > 0), at[j], room[j])) continue;
        best[j] = std::min(best[j], best[i] + length(at[i], at[j]));
      }
    return best.back();
  }

 private:
  // From a place in room `first`, to one of room `last` or at the far side of it.
  bool sees(const Plane& a, std::size_t first, const Plane& b, std::size_t last) const {
    for (std::size_t d = first; d < last; ++d) {
      const double x = low[d + 1];
      const double share = b[0] == a[0] ? 0 : (x - a[0]) / (b[0] - a[0]);
      for (const double y :
           {a[1] + (b[1] - a[1]) * share, b[0] == a[0] ? b[1] : a[1] + (b[1] - a[1]) * share})
        if (y < door[d][0] - 1e-12 || y > door[d][1] + 1e-12) return false;
    }
    return true;
  }
};

/// Welds vertices of two pieces that lie together and satisfy a condition.
void weld_where(Welded& domain, const Welded::Piece& a, const Welded::Piece& b,
                const std::function<bool(const Position&)>& open) {
  std::vector<std::array<Index, 2>> pairs;
  for (Index v = 0; v < a.vertices; ++v)
    for (Index w = 0; w < b.vertices; ++w) {
      const Position &p = domain.positions[a.vertex(v)], &q = domain.positions[b.vertex(w)];
      if (distance(p, q) < 1e-9 && open(p)) pairs.push_back({v, w});
    }
  REQUIRE(domain.complex.weld(a, b, pairs) == pairs.size());
}

/// The least way through a rectangle or line of a plane x = const, by ternary search.
double through(const Position& p, const Position& q, double x, const std::array<double, 4>& yz,
               double speed_p = 1, double speed_q = 1) {
  const auto way = [&](double y, double z) {
    const Position b = {x, y, z};
    return distance(p, b) / speed_p + distance(b, q) / speed_q;
  };
  const auto least = [](double low, double high, const auto& f) {
    for (int i = 0; i < 40; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
    }
    return f((low + high) / 2);
  };
  return least(yz[0], yz[1],
               [&](double y) { return least(yz[2], yz[3], [&](double z) { return way(y, z); }); });
}

}  // namespace

TEST_CASE("two rectangles welded to an L") {
  for (unsigned seed = 0; seed < 3; ++seed) {
    Welded domain(seed);
    const auto one = domain.add(sheet({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, 12, 6));
    const auto other = domain.add(sheet({0, 1, 0}, {1, 0, 0}, {0, 1, 0}, 6, 6));
    CHECK(domain.weld(one, other) == 7);
    // As rooms one above the other.
    const Rooms rooms = {{0, 1, 2}, {{0, 1}}};
    const auto turned = [&](Index v) -> Plane {
      return {domain.positions[v][1], domain.positions[v][0]};
    };
    for (const Index source : {one.vertex(84), one.vertex(90), other.vertex(45), other.vertex(6)})
      CHECK(domain.worst(source, [&](Index v) {
        return rooms.way(Welded::of(other, source), turned(source), Welded::of(other, v),
                         turned(v));
      }) < 1e-9);
  }
}

TEST_CASE("rooms joined by a door, and a slit that ends at a weld") {
  for (const auto& door : {std::array<double, 2>{.375, .625}, {0, .5}, {.25, 1}}) {
    Welded domain(1);
    const auto one = domain.add(sheet({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8, 8));
    const auto other = domain.add(sheet({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8, 8));
    weld_where(domain, one, other,
               [&](const Position& p) { return p[1] >= door[0] - 1e-9 && p[1] <= door[1] + 1e-9; });
    const Rooms rooms = {{0, 1, 2}, {door}};
    const auto at = [&](Index v) -> Plane {
      return {domain.positions[v][0], domain.positions[v][1]};
    };
    for (const Index source : {one.vertex(0), one.vertex(44), one.vertex(76), other.vertex(80)})
      CHECK(domain.worst(source, [&](Index v) {
        return rooms.way(Welded::of(other, source), at(source), Welded::of(other, v), at(v));
      }) < 1e-9);
  }
}

TEST_CASE("a fin on a sheet, and a page on part of a line") {
  for (const auto& foot : {std::array<double, 2>{0, 1}, {.25, .75}, {0, .5}}) {
    Welded domain(2);
    const auto ground = domain.add(sheet({-1, 0, 0}, {2, 0, 0}, {0, 1, 0}, 16, 8));
    const auto fin = domain.add(sheet({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 8, 8));
    weld_where(domain, ground, fin,
               [&](const Position& p) { return p[1] >= foot[0] - 1e-9 && p[1] <= foot[1] + 1e-9; });
    const Rooms rooms = {{-1, 0, 1}, {foot}};
    // Which of the two half planes of the ground does not matter: all about the line.
    const auto at = [&](Index v) -> Plane {
      const Position& p = domain.positions[v];
      return {Welded::of(fin, v) ? p[2] : -std::abs(p[0]), p[1]};
    };
    for (const Index source :
         {ground.vertex(0), ground.vertex(40), ground.vertex(150), fin.vertex(80), fin.vertex(9)}) {
      const Errors e = errors(domain, source, [&](Index v) {
        if (Welded::of(fin, source) == Welded::of(fin, v))
          return distance(domain.positions[source], domain.positions[v]);
        const bool up = Welded::of(fin, v);
        return rooms.way(0, at(up ? source : v), 1, at(up ? v : source));
      });
      CAPTURE(foot[0], foot[1], source, e.mean, e.worst, e.low);
      CHECK(e.worst < 1e-9);
    }
  }
}

TEST_CASE("solids joined by a window") {
  Welded domain(0);
  const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, 8));
  const auto other = domain.add(block({1, 0, 0}, {2, 1, 1}, 8));
  const std::array<double, 4> window = {.25, .75, .25, .75};
  weld_where(domain, one, other, [&](const Position& p) {
    return p[1] > .24 && p[1] < .76 && p[2] > .24 && p[2] < .76;
  });
  for (const Position& from : {Position{.5, .5, .5}, Position{0, 0, 0}, Position{.75, .125, .5}}) {
    const Index source = domain.nearest(one, from);
    const Errors e = errors(domain, source, [&](Index v) {
      const Position& p = domain.positions[v];
      return Welded::of(one, v) ? distance(from, p) : through(from, p, 1, window);
    });
    CAPTURE(from[0], from[1], from[2], e.mean, e.worst, e.low);
    CHECK(e.mean < 1e-7);
    CHECK(e.worst < 1e-6);
    CHECK(e.low > -1e-6);
  }
}

TEST_CASE("a sheet behind an obstacle in a solid") {
  // A block with a notch all along y, and a sheet on its far side, across the notch.
  Block notched = block({0, 0, 0}, {2, 1, 1}, 8);
  std::erase_if(notched.tets, [&](const std::array<Index, 4>& tet) {
    Position middle = {0, 0, 0};
    for (const Index v : tet)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += notched.positions[v][k] / 4;
    return middle[0] > .75 && middle[0] < 1.25 && middle[2] > .5;
  });
  const auto least = [](double low, double high, const auto& f) {
    for (int i = 0; i < 50; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
    }
    return f((low + high) / 2);
  };
  for (const double speed : {1., .5, 2.})
    for (const Position& from : {Position{.25, .25, 1}, Position{0, 1, .75}}) {
      Welded domain(0);
      const auto solid = domain.add(notched);
      const auto fin = domain.add(sheet({2, .5, 0}, {1, 0, 0}, {0, 0, 1}, 8, 8), speed);
      domain.weld(solid, fin);
      // In the section across the notch: under both its corners where they are in the way.
      const auto under = [&](double z) {
        const Plane p = {from[0], from[2]}, q = {2, z}, a = {.75, .5}, b = {1.25, .5};
        const auto below = [](const Plane& s, const Plane& t, const Plane& corner) {
          return s[1] + (t[1] - s[1]) * (corner[0] - s[0]) / (t[0] - s[0]) <= corner[1];
        };
        double best = below(p, q, a) && below(p, q, b) ? length(p, q) : infinity;
        if (below(a, q, b)) best = std::min(best, length(p, a) + length(a, q));
        if (below(p, b, a)) best = std::min(best, length(p, b) + length(b, q));
        return std::min(best, length(p, a) + length(a, b) + length(b, q));
      };
      const auto field =
          solve(Serial{}, domain.complex, PointSource::at(domain.nearest(solid, from)));
      for (Index v = fin.first_vertex; v < domain.positions.size(); ++v) {
        const Position& p = domain.positions[v];
        const double truth = least(0, 1, [&](double z) {
          return std::hypot(under(z), .5 - from[1]) + std::hypot(p[0] - 2, p[2] - z) / speed;
        });
        CAPTURE(speed, from[0], p[0], p[2], field.distance[v], truth);
        CHECK(field.distance[v] < truth * (1 + 2e-3));
        CHECK(field.distance[v] > truth * (1 - 1e-5));
      }
    }
}

TEST_CASE("a prism dealt among solids in patches is as right as one solid") {
  // Around two posts; patches of two cells a side, so welds make reflex edges. Found by fuzzing.
  const samples::CornerDomain plan = {
      "", {{.25, .375, .125, .375}, {.625, .75, .5, .75}}, {0, .25}};
  samples::Shape flat = plan.grid(8, 0.16, 5);
  const std::vector<double> truth = plan.distances(flat.points);
  const auto n = Index(flat.points.size());
  const double height = 0.3;
  for (const int pieces : {2, 3}) {
    std::vector<Block> parts(static_cast<std::size_t>(pieces));
    std::vector<std::vector<Index>> number(parts.size(), std::vector<Index>(2 * n, none));
    std::vector<double> exact;
    Welded domain(0);
    const auto add_tet = [&](std::size_t part, std::array<Index, 4> tet) {
      for (Index& v : tet) {
        Index& own = number[part][v];
        if (own == none) {
          own = Index(parts[part].positions.size());
          const auto& p = flat.points[v % n];
          parts[part].positions.push_back({p[0], p[1], v < n ? 0 : height});
        }
        v = own;
      }
      parts[part].tets.push_back(tet);
    };
    for (std::array<Index, 3> f : flat.faces) {
      std::sort(f.begin(), f.end());
      const double x = (flat.points[f[0]][0] + flat.points[f[1]][0] + flat.points[f[2]][0]) / 3;
      const double y = (flat.points[f[0]][1] + flat.points[f[1]][1] + flat.points[f[2]][1]) / 3;
      const auto part = std::size_t(int(x * 4) * 2 + int(y * 4) * 3) % std::size_t(pieces);
      add_tet(part, {f[0], f[1], f[2], f[2] + n});
      add_tet(part, {f[0], f[1], f[1] + n, f[2] + n});
      add_tet(part, {f[0], f[0] + n, f[1] + n, f[2] + n});
    }
    std::vector<Welded::Piece> welded;
    Index source = none;
    for (std::size_t part = 0; part < parts.size(); ++part) {
      welded.push_back(domain.add(parts[part]));
      for (std::size_t other = 0; other < part; ++other) domain.weld(welded[other], welded.back());
      std::vector<double> own(parts[part].positions.size());
      for (Index v = 0; v < 2 * n; ++v)
        if (number[part][v] != none)
          own[number[part][v]] = std::hypot(truth[v % n], v < n ? 0 : height);
      exact.insert(exact.end(), own.begin(), own.end());
      if (number[part][0] != none) source = welded.back().vertex(number[part][0]);
    }
    const Errors e = errors(domain, source, [&](Index v) { return exact[v]; });
    CAPTURE(pieces, e.mean, e.worst, e.low);
    CHECK(e.mean < 1e-4);
    CHECK(e.worst < 1e-2);
    CHECK(e.low > -1e-9);
  }
}

TEST_CASE("random rooms in a row, folded in space, are exact") {
  std::mt19937 random(5);
  const auto integer = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  constexpr int domains = 700;
  for (int trial = 0; trial < domains; ++trial) {
    Welded domain(unsigned(trial) + 1);
    const int count = integer(2, 4), rows = integer(6, 12);
    Rooms rooms = {{0}, {}};
    std::vector<Welded::Piece> pieces;
    std::vector<Plane> flat;  // unfolded
    Position corner = {0, 0, 0};
    for (int r = 0; r < count; ++r) {
      const double width = real(.3, 1.5), angle = real(-1, 1);
      const Position u = {width * std::cos(angle), 0, width * std::sin(angle)};
      const auto columns = std::size_t(std::ceil(width * rows * real(.6, 1.5)));
      const Sheet s = sheet(corner, u, {0, 1, 0}, columns, std::size_t(rows));
      pieces.push_back(domain.add(s));
      for (std::size_t i = 0; i <= columns; ++i)
        for (int j = 0; j <= rows; ++j)
          flat.push_back(
              {rooms.low.back() + width * double(i) / double(columns), double(j) / rows});
      for (std::size_t k = 0; k < 3; ++k) corner[k] += u[k];
      rooms.low.push_back(rooms.low.back() + width);
      if (r == 0) continue;
      const int from = integer(0, rows - 1), to = integer(from + 1, rows);
      rooms.door.push_back({double(from) / rows, double(to) / rows});
      const auto& door = rooms.door.back();
      weld_where(domain, pieces[pieces.size() - 2], pieces.back(),
                 [&](const Position& p) { return p[1] > door[0] - 1e-9 && p[1] < door[1] + 1e-9; });
    }
    const auto room = [&](Index v) {
      std::size_t r = 0;
      while (!Welded::of(pieces[r], v)) ++r;
      return r;
    };
    const Index source = Index(integer(0, int(flat.size()) - 1));
    const Errors e = errors(domain, source, [&](Index v) {
      return rooms.way(room(source), flat[source], room(v), flat[v]);
    });
    CAPTURE(trial, e.mean, e.worst, e.low);
    if (e.low <= -1e-9) CHECK(e.low > -1e-9);
    if (e.worst >= 1e-9) CHECK(e.worst < 1e-9);
  }
}

TEST_CASE("random boxes in a row, joined by windows, are never too near") {
  std::mt19937 random(6);
  const auto integer = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  Errors all;
  constexpr int domains = 300;
  for (int trial = 0; trial < domains; ++trial) {
    Welded domain(unsigned(trial) + 1);
    const int n = integer(2, 4);
    const double speed = trial % 2 == 0 ? 1 : std::array<double, 4>{.4, .8, 1.3, 3}[trial / 2 % 4];
    const auto one = domain.add(block({0, 0, 0}, {1, 1, 1}, std::size_t(n)));
    const auto other = domain.add(block({1, 0, 0}, {2, 1, 1}, std::size_t(n)), speed);
    const int y0 = integer(0, n - 1), y1 = integer(y0 + 1, n), z0 = integer(0, n - 1),
              z1 = integer(z0 + 1, n);
    const std::array<double, 4> window = {double(y0) / n, double(y1) / n, double(z0) / n,
                                          double(z1) / n};
    weld_where(domain, one, other, [&](const Position& p) {
      return p[1] > window[0] - 1e-9 && p[1] < window[1] + 1e-9 && p[2] > window[2] - 1e-9 &&
             p[2] < window[3] + 1e-9;
    });
    const Index source = one.vertex(Index(integer(0, int(one.vertices) - 1)));
    const Position& from = domain.positions[source];
    const auto field = solve(Serial{}, domain.complex, PointSource::at(source));
    for (Index v = 0; v < domain.positions.size(); ++v) {
      const Position& p = domain.positions[v];
      // In a block with a faster one beside it paths may go there and back: no closed form.
      if (Welded::of(one, v) && speed > 1) continue;
      const double truth =
          Welded::of(one, v) ? distance(from, p) : through(from, p, 1, window, 1, speed);
      if (truth < 1e-5) continue;
      const double off = (field.distance[v] / domain.move.scale - truth) / truth;
      CAPTURE(trial, speed, p[0], p[1], p[2], field.distance[v] / domain.move.scale, truth);
      if (off < -1e-6) CHECK(off > -1e-6);
      all.worst = std::max(all.worst, off);
      all.mean += std::abs(off) / double(domain.positions.size()) / domains;
    }
  }
  CAPTURE(all.worst);
  CHECK(all.mean < 5e-3);
}

}  // namespace mixed_welds_test
