#include "complexes/solid/tet_gluing.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/solid/detail/tet_record.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/common/disjoint_sets.hpp"

namespace plexway::detail {

TetCorners corners_of_vertices(std::size_t vertices, Tets tets, std::span<const Index> first_use,
                               int threads) {
  TetCorners rows;
  rows.begin.assign(vertices + 1, 0);
  const auto tell_corners = [&](std::size_t first, std::size_t last, const auto& tell) {
    for (std::size_t t = first; t < last; ++t)
      for (std::size_t i = 0; i < 4; ++i) tell(tets[t][i], static_cast<Index>(4 * t + i));
  };
  tell_vertices<Index>(first_use, tets.size(), threads, tell_corners,
                       [&](Index v, Index) { ++rows.begin[v + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) rows.begin[v + 1] += rows.begin[v];
  rows.corner.resize(4 * tets.size());
  std::vector<Index> cursor(rows.begin.begin(), rows.begin.end() - 1);
  tell_vertices<Index>(first_use, tets.size(), threads, tell_corners,
                       [&](Index v, Index c) { rows.corner[cursor[v]++] = c; });
  return rows;
}

namespace {

using Face = std::array<Index, 3>;

Face sorted_face(const std::array<Index, 4>& tet, Index i) {
  Face f = {tet[(i + 1) & 3], tet[(i + 2) & 3], tet[(i + 3) & 3]};
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  if (f[1] > f[2]) std::swap(f[1], f[2]);
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  return f;
}

std::string name(const Face& f) {
  return "face " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]);
}

// Bit i: whether the ascending order of face i is an even permutation of its order as seen from
// inside, which is 1 2 3, 0 3 2, 0 1 3, 0 2 1.
unsigned even_faces(const std::array<Index, 4>& tet) {
  const auto& [a, b, c, d] = tet;
  const unsigned ab = a < b, ac = a < c, ad = a < d, bc = b < c, bd = b < d, cd = c < d;
  return (bc ^ cd ^ bd) | (ad ^ cd ^ 1 ^ ac) << 1 | (ab ^ bd ^ ad) << 2 | (ac ^ bc ^ 1 ^ ab) << 3;
}

// A face of a tetrahedron by its vertices but for the lowest: the middle one in the upper half.
struct FaceSide {
  // Upper half: corner 4 t + i; then bits 16 to 31: on which side of the face it lies; then 1. So
  // sums of up to 65,535 tell how many there are, how many of them lie on one side, and of two
  // which the other is.
  static constexpr std::uint64_t one = 1, ascending = one << 16, several = ascending;
  static constexpr int corner_shift = 32;

  std::uint64_t others;
  std::uint64_t told;

  [[nodiscard]] Index corner() const { return static_cast<Index>(told >> corner_shift); }
  [[nodiscard]] bool ascends() const { return (told & ascending) != 0; }
};

[[noreturn]] void refuse_third(Index lowest, std::span<FaceSide> sides) {
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::pair(a.others, a.corner()) < std::pair(b.others, b.corner());
  });
  auto run = sides.begin(), end = run;
  while (end - run < 3)
    for (run = end; end != sides.end() && end->others == run->others;) ++end;
  constexpr std::ptrdiff_t listed = 3;
  std::string list;
  for (auto k = run; k != end && k - run < listed; ++k) {
    const bool last = k + 1 == end;
    list += (k == run ? "" : last ? " and " : ", ") + std::to_string(k->corner() / 4);
  }
  if (end - run > listed) list += " and " + std::to_string(end - run - listed) + " more";
  throw InputError(
      "tets " + list + " share " +
      name({lowest, static_cast<Index>(run->others >> 32), static_cast<Index>(run->others)}) +
      ": at most two can");
}

/// Glues the faces whose lowest vertex is one of some, vertex by vertex.
class FaceGluer {
 public:
  FaceGluer(Tets tets, const TetCorners& rows, TetGluing& across, std::span<Index> lowest)
      : tets_(tets), rows_(rows), across_(across), lowest_(lowest), met_(rows.vertices(), none) {}

  /// Writes all faces of which `v` is the lowest vertex, and the lowest that shares an edge with
  /// it.
  void glue_at(Index v) { glue_by_order(v, glue_by_table(collect(v))); }
  /// Did those glued so far lie on two sides of each face?
  [[nodiscard]] bool fit() const { return fit_; }
  /// From the vertices so far to higher ones.
  [[nodiscard]] std::size_t edges() const { return edges_; }

 private:
  static constexpr int table_bits = 10;
  // What the faces that fall into one place come to, so that a pair is told without asking which
  // of the two came first.
  struct Place {
    std::uint64_t others = 0;  // xor
    std::uint64_t told = 0;    // sum
  };

  std::span<FaceSide> collect(Index v) {
    // The other corners as the face opposite to a corner has them, seen from inside.
    const auto row = rows_.at(v);
    if (sides_.size() < 3 * row.size() + 1) sides_.resize(6 * row.size() + 64);
    FaceSide* end = sides_.data();
    Index least = row.empty() ? none : v;
    std::size_t edges = 0;
    for (const Index c : row) {
      const auto& tet = tets_[c / 4];
      const auto& [p, q, r] = tet_faces_inside[c % 4];
      const Index x = tet[p], y = tet[q], z = tet[r];
      const std::uint64_t first = std::uint64_t{c & ~Index{3}} << FaceSide::corner_shift | 1;
      const auto add = [&](Index from, Index to, std::uint64_t rest, std::size_t ours) {
        // The lower into the upper half without a branch, which would be guessed wrong half the
        // time: the halves change places or not.
        const std::uint64_t ascends = from < to;
        const std::uint64_t both = std::uint64_t{to} << 32 | from;
        const std::uint64_t by = ascends << 5;
        *end = {both << by | both >> (-by & 63),
                first + (rest << FaceSide::corner_shift) + (ascends << 16)};
        end += ours;
      };
      const std::size_t over_x = x > v, over_y = y > v, over_z = z > v;  // else another vertex's
      add(x, y, r, over_x & over_y), add(y, z, p, over_y & over_z), add(z, x, q, over_z & over_x);
      edges += over_x & std::size_t{met_[x] != v};
      met_[x] = v;
      edges += over_y & std::size_t{met_[y] != v};
      met_[y] = v;
      edges += over_z & std::size_t{met_[z] != v};
      met_[z] = v;
      least = std::min(std::min(least, x), std::min(y, z));
    }
    edges_ += edges;
    lowest_[v] = least;
    return {sides_.data(), end};
  }

  // Returns those that are not glued so: where faces of several fall into one place, where more
  // than two are one, and where two lie on one side.
  std::span<FaceSide> glue_by_table(std::span<FaceSide> sides) {
    if (sides.size() >= FaceSide::several) return sides;
    left_.resize(sides_.size());
    const auto place = [&](const FaceSide& s) -> Place& {
      return table_[static_cast<std::size_t>(s.others * 0x9e3779b97f4a7c15 >> (64 - table_bits))];
    };
    for (const FaceSide& s : sides) {
      Place& p = place(s);
      p.others ^= s.others;
      p.told += s.told;
    }
    constexpr std::uint64_t two_sides = 2 * FaceSide::one + FaceSide::ascending;
    std::size_t left = 0;
    for (const FaceSide& s : sides) {
      const Place& p = place(s);
      const bool pair = (static_cast<std::uint32_t>(p.told) == two_sides) & (p.others == 0);
      const Index other = static_cast<Index>((p.told - s.told) >> FaceSide::corner_shift);
      glue(s, pair ? other : none);
      left_[left] = s;
      left += !(pair | (p.told == s.told));
    }
    for (const FaceSide& s : sides) place(s) = {};
    return {left_.data(), left};
  }

  void glue_by_order(Index v, std::span<FaceSide> sides) {
    std::sort(sides.begin(), sides.end(),
              [](const FaceSide& a, const FaceSide& b) { return a.others < b.others; });
    for (auto run = sides.begin(), end = run; run != sides.end(); run = end) {
      while (end != sides.end() && end->others == run->others) ++end;
      if (end - run > 2) refuse_third(v, sides);
      const auto& other = *(end - 1);
      const bool pair = end - run == 2;
      glue(*run, pair ? other.corner() : none);
      if (pair) glue(other, run->corner());
      fit_ = fit_ && !(pair && other.ascends() == run->ascends());
    }
  }

  void glue(const FaceSide& side, Index other) {
    across_[side.corner() / 4][side.corner() % 4] = other;
  }

  Tets tets_;
  const TetCorners& rows_;
  TetGluing& across_;
  std::span<Index> lowest_;
  std::vector<Index> met_;  // the last vertex that each shared an edge with
  std::vector<FaceSide> sides_, left_;
  std::vector<Place> table_ = std::vector<Place>(std::size_t{1} << table_bits);
  std::size_t edges_ = 0;
  bool fit_ = true;
};

}  // namespace

void check_tets(std::size_t vertices, Tets tets, int threads) {
  if (tets.empty()) throw InputError("the solid has no tetrahedra");
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  if (tets.size() > TetAcross::limit - 2)
    throw InputError(std::to_string(tets.size()) + " tetrahedra: at most " +
                     std::to_string(TetAcross::limit - 2) + " fit the index");
  over_blocks(tets.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      for (std::size_t i = 0; i < 4; ++i) {
        if (tets[t][i] >= vertices)
          throw InputError("tet " + std::to_string(t) + ": vertex " + std::to_string(tets[t][i]) +
                           " is out of range, there are " + std::to_string(vertices));
        for (std::size_t j = 0; j < i; ++j)
          if (tets[t][i] == tets[t][j])
            throw InputError("tet " + std::to_string(t) + ": vertex " + std::to_string(tets[t][i]) +
                             " occurs twice");
      }
  });
}

GluedTets glue_tets(Tets tets, const TetCorners& rows, int threads) {
  GluedTets glued;
  glued.across.resize(tets.size());
  std::vector<Index> lowest(rows.vertices());
  std::mutex mutex;
  for_blocks(rows.vertices(), vertex_part(rows.vertices(), threads), threads, {},
             [&](std::size_t first, std::size_t last) {
               FaceGluer gluer(tets, rows, glued.across, lowest);
               for (Index v = static_cast<Index>(first); v < last; ++v) gluer.glue_at(v);
               const std::lock_guard lock(mutex);
               glued.fit &= gluer.fit();
               glued.edges += gluer.edges();
             });
  glued.components = count_components<4>(tets, lowest, threads);
  return glued;
}

GluedTets glue_tets(std::size_t vertices, Tets tets, int threads) {
  return glue_tets(tets, corners_of_vertices(vertices, tets, {}, threads), threads);
}

namespace {

/// On which side of its faces a tetrahedron lies: turning it over makes all faces the other.
class FaceSides {
 public:
  FaceSides(Tets tets, std::span<const char> turn, int threads) : turn_(turn), even_(tets.size()) {
    over_blocks(tets.size(), threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t t = first; t < last; ++t)
        even_[t] = static_cast<unsigned char>(even_faces(tets[t]));
    });
  }
  /// Does t lie on the other side of its face i than u, of which it is face j?
  [[nodiscard]] bool fit(std::size_t t, Index i, std::size_t u, Index j) const {
    return ((even_[t] >> i ^ turn_[t]) & 1) != ((even_[u] >> j ^ turn_[u]) & 1);
  }

 private:
  std::span<const char> turn_;
  Unfilled<unsigned char> even_;
};

bool faces_fit(Tets tets, const TetGluing& across, std::span<const char> turn, int threads) {
  const FaceSides sides(tets, turn, threads);
  std::atomic<bool> fit = true;
  over_blocks(tets.size(), threads, [&](std::size_t first, std::size_t last) {
    bool own = true;
    for (std::size_t t = first; t < last; ++t)
      for (Index i = 0; i < 4; ++i)
        if (const Index o = across[t][i]; o != none) own = own && sides.fit(t, i, o / 4, o % 4);
    if (!own) fit = false;
  });
  return fit;
}

}  // namespace

std::vector<char> orient_tets(Tets tets, const TetGluing& across,
                              std::span<const signed char> volume, int threads) {
  std::vector<char> turn(tets.size(), 0), known(tets.size(), 0);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    turn[t] = volume[t] < 0;
    known[t] = volume[t] != 0;
  }
  if (std::find(known.begin(), known.end(), 0) == known.end() &&
      faces_fit(tets, across, turn, threads))
    return turn;
  const FaceSides sides(tets, turn, threads);
  const auto fits = [&](std::size_t t, Index i, std::size_t u, Index j) {
    return sides.fit(t, i, u, j);
  };
  std::vector<Index> queue;
  const auto is_thin = [&](std::size_t t) { return volume[t] == 1 || volume[t] == -1; };
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (Index i = 0; i < 4; ++i) {
      const Index o = across[t][i];
      if (o == none || !known[t] || !known[o / 4] || fits(t, i, o / 4, o % 4)) continue;
      if (is_thin(t))
        known[t] = 0;
      else if (is_thin(o / 4))
        known[o / 4] = 0;
    }
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (Index i = 0; i < 4; ++i) {
      const Index o = across[t][i];
      if (o == none || !known[t]) continue;
      if (!known[o / 4]) {
        if (queue.empty() || queue.back() != t) queue.push_back(static_cast<Index>(t));
      } else if (o / 4 > t && !fits(t, i, o / 4, o % 4)) {
        throw InputError("tets " + std::to_string(t) + " and " + std::to_string(o / 4) +
                         " lie on the same side of " + name(sorted_face(tets[t], i)) +
                         ", which they share");
      }
    }
  const auto spread = [&] {
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index t = queue[head];
      for (Index i = 0; i < 4; ++i) {
        const Index o = across[t][i];
        if (o == none || known[o / 4]) continue;
        known[o / 4] = 1;
        turn[o / 4] = !fits(t, i, o / 4, o % 4);
        queue.push_back(o / 4);
      }
    }
    queue.clear();
  };
  spread();
  for (std::size_t t = 0; t < tets.size(); ++t)
    if (!known[t]) {
      known[t] = 1;
      queue.push_back(static_cast<Index>(t));
      spread();
    }
  return turn;
}

}  // namespace plexway::detail
