#include "complex/tet_gluing.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>
#include <tuple>

#include <plexway/complex/detail/tet_record.hpp>
#include <plexway/error.hpp>

#include "complex/building_blocks.hpp"

namespace plexway {
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

// A face by its vertices but for the lowest: the middle one in the upper half.
struct FaceSide {
  std::uint64_t others;
  Index corner;
};

// The vertices in ascending order, each with the corner that it is in its last two bits.
std::array<std::uint64_t, 4> ascending(const std::array<Index, 4>& tet) {
  std::array<std::uint64_t, 4> v;
  for (std::size_t i = 0; i < 4; ++i) v[i] = std::uint64_t{tet[i]} << 2 | i;
  const auto order = [&](std::size_t i, std::size_t j) {
    const std::uint64_t low = std::min(v[i], v[j]);
    v[j] = std::max(v[i], v[j]);
    v[i] = low;
  };
  order(0, 1), order(2, 3), order(0, 2), order(1, 3), order(1, 2);
  return v;
}

[[noreturn]] void refuse_third(Index lowest, std::span<FaceSide> sides) {
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.others, a.corner) < std::tie(b.others, b.corner);
  });
  auto run = sides.begin(), end = run;
  while (end - run < 3)
    for (run = end; end != sides.end() && end->others == run->others;) ++end;
  constexpr std::ptrdiff_t listed = 3;
  std::string list;
  for (auto k = run; k != end && k - run < listed; ++k) {
    const bool last = k + 1 == end;
    list += (k == run ? "" : last ? " and " : ", ") + std::to_string(k->corner / 4);
  }
  if (end - run > listed) list += " and " + std::to_string(end - run - listed) + " more";
  throw InputError(
      "tets " + list + " share " +
      name({lowest, static_cast<Index>(run->others >> 32), static_cast<Index>(run->others)}) +
      ": at most two can");
}

// Glues what is in the buckets of the vertices from `begin` to `stop`; end[v]: where that of v
// ends.
void glue_buckets(FaceSide* sides, std::span<const Index> end, std::size_t begin, std::size_t stop,
                  TetGluing& across) {
  constexpr std::ptrdiff_t few = 96;
  FaceSide* first = sides + (begin == 0 ? 0 : end[begin - 1]);
  for (Index v = static_cast<Index>(begin); v < stop; ++v) {
    FaceSide* const next = sides + end[v];
    FaceSide* last = next;
    const auto glue = [&](const FaceSide& a, const FaceSide& b) {
      across[a.corner / 4][a.corner % 4] = b.corner;
      across[b.corner / 4][b.corner % 4] = a.corner;
    };
    if (last - first > few) {
      std::sort(first, last,
                [](const FaceSide& a, const FaceSide& b) { return a.others < b.others; });
      for (FaceSide* behind = first; first != last; first = behind) {
        while (behind != last && behind->others == first->others) ++behind;
        if (behind - first > 2) refuse_third(v, {first, last});
        if (behind - first == 2) glue(first[0], first[1]);
      }
    }
    for (; first < last; ++first) {
      const std::uint64_t others = first->others;
      const auto after = [&](FaceSide* s) {
        do ++s;
        while (s < last && s->others != others);
        return s;
      };
      FaceSide* const second = after(first);
      if (second >= last) continue;
      if (after(second) < last) refuse_third(v, {first, last});
      glue(*first, *second);
      *second = *--last;
    }
    first = next;
  }
}

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

TetGluing glue_tets(std::size_t vertices, Tets tets, int threads) {
  // By several threads, buckets have what is in them in any order: who scans does not mind.
  const bool alone = threads_for(threads) == 1 || tets.size() <= building_block;
  const auto up = [alone](Index& count, Index by) {
    if (!alone) return std::atomic_ref(count).fetch_add(by, std::memory_order_relaxed);
    const Index before = count;
    count += by;
    return before;
  };
  // Faces in buckets by their lowest vertex, some twenty each: those are scanned for the other two.
  // Only where many meet are they sorted.
  std::vector<Index> end(vertices + 1, 0);
  over_blocks(tets.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto v = ascending(tets[t]);
      up(end[(v[0] >> 2) + 1], 3);
      up(end[(v[1] >> 2) + 1], 1);
    }
  });
  for (std::size_t v = 0; v < vertices; ++v) end[v + 1] += end[v];
  Unfilled<FaceSide> sides(tets.size() * 4);
  over_blocks(tets.size(), threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const auto v = ascending(tets[t]);
      const auto add = [&](std::size_t low, std::size_t middle, std::size_t high,
                           std::size_t rest) {
        sides[up(end[v[low] >> 2], 1)] = {v[middle] >> 2 << 32 | v[high] >> 2,
                                          static_cast<Index>(4 * t + (v[rest] & 3))};
      };
      add(0, 1, 2, 3), add(0, 1, 3, 2), add(0, 2, 3, 1), add(1, 2, 3, 0);
    }
  });
  TetGluing across(tets.size(), {none, none, none, none});
  over_blocks(vertices, threads, [&](std::size_t first, std::size_t last) {
    glue_buckets(sides.data(), end, first, last, across);
  });
  return across;
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

}  // namespace

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

}  // namespace plexway
