#include "complex/tet_gluing.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <tuple>

#include <plexway/complex/tet_record.hpp>
#include <plexway/error.hpp>

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

// Whether the face's ascending order is an even permutation of its order as seen from inside.
bool is_even(const std::array<Index, 4>& tet, Index i) {
  // Corners of face i such that they turn the same way for every i.
  constexpr Index order[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const Index a = tet[order[i][0]], b = tet[order[i][1]], c = tet[order[i][2]];
  return ((a < b) + (b < c) + (a < c)) % 2 != 0;
}

}  // namespace

void check_tets(std::size_t vertices, Tets tets) {
  if (tets.empty()) throw InputError("the solid has no tetrahedra");
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  if (tets.size() > TetAcross::limit - 2)
    throw InputError(std::to_string(tets.size()) + " tetrahedra: at most " +
                     std::to_string(TetAcross::limit - 2) + " fit the index");
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      if (tets[t][i] >= vertices)
        throw InputError("tet " + std::to_string(t) + ": vertex " + std::to_string(tets[t][i]) +
                         " is out of range, there are " + std::to_string(vertices));
      for (std::size_t j = 0; j < i; ++j)
        if (tets[t][i] == tets[t][j])
          throw InputError("tet " + std::to_string(t) + ": vertex " + std::to_string(tets[t][i]) +
                           " occurs twice");
    }
}

TetGluing glue_tets(std::size_t vertices, Tets tets) {
  // Faces in buckets by their lowest vertex, then sorted by the other two.
  struct Keyed {
    Index middle, high, corner;
  };
  std::vector<std::size_t> begin(vertices + 1, 0);
  for (const auto& tet : tets)
    for (Index i = 0; i < 4; ++i) ++begin[sorted_face(tet, i)[0] + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<Keyed> faces(tets.size() * 4);
  {
    std::vector<std::size_t> cursor(begin.begin(), begin.end() - 1);
    for (std::size_t t = 0; t < tets.size(); ++t)
      for (Index i = 0; i < 4; ++i) {
        const Face f = sorted_face(tets[t], i);
        faces[cursor[f[0]]++] = {f[1], f[2], static_cast<Index>(4 * t + i)};
      }
  }
  TetGluing across(tets.size(), {none, none, none, none});
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto first = faces.begin() + static_cast<std::ptrdiff_t>(begin[v]);
    const auto last = faces.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]);
    std::sort(first, last, [](const Keyed& a, const Keyed& b) {
      return std::tie(a.middle, a.high, a.corner) < std::tie(b.middle, b.high, b.corner);
    });
    for (auto run = first; run != last;) {
      auto end = run + 1;
      while (end != last && end->middle == run->middle && end->high == run->high) ++end;
      if (end - run > 2) {
        std::string list;
        for (auto k = run; k != end; ++k)
          list += (k == run ? "" : k + 1 == end ? " and " : ", ") + std::to_string(k->corner / 4);
        throw InputError("tets " + list + " share " +
                         name({static_cast<Index>(v), run->middle, run->high}) +
                         ": at most two can");
      }
      if (end - run == 2) {
        const Index a = run->corner, b = (run + 1)->corner;
        across[a / 4][a % 4] = b;
        across[b / 4][b % 4] = a;
      }
      run = end;
    }
  }
  return across;
}

std::vector<char> orient_tets(Tets tets, const TetGluing& across,
                              std::span<const signed char> volume) {
  std::vector<char> turn(tets.size(), 0);
  std::vector<char> known(tets.size(), 0);
  std::vector<Index> queue;
  for (std::size_t t = 0; t < tets.size(); ++t)
    if (volume[t] != 0) {
      turn[t] = volume[t] < 0;
      known[t] = 1;
    }
  const auto fits = [&](std::size_t t, Index i, std::size_t u, Index j) {
    return (is_even(tets[t], i) != (turn[t] != 0)) != (is_even(tets[u], j) != (turn[u] != 0));
  };
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
