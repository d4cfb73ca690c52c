#include "complex/gluing.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include <plexway/error.hpp>

namespace plexway {
namespace {

Index next(Index corner) { return corner == 2 ? 0 : corner + 1; }

}  // namespace

Gluing glue_by_vertices(std::size_t vertices, Faces faces) {
  // Halfedges in buckets by their lower vertex, then matched by the upper one: linear, no hashing.
  std::vector<Index> begin(vertices + 1, 0);
  const auto lower = [&](std::size_t f, Index i) {
    return std::min(faces[f][i], faces[f][next(i)]);
  };
  const auto upper = [&](Index halfedge) {
    const auto& face = faces[halfedge / 3];
    return std::max(face[halfedge % 3], face[next(halfedge % 3)]);
  };
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (Index i = 0; i < 3; ++i) ++begin[lower(f, i) + 1];
  for (std::size_t v = 0; v < vertices; ++v) begin[v + 1] += begin[v];
  std::vector<Index> bucket(faces.size() * 3);
  {
    std::vector<Index> cursor(begin.begin(), begin.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (Index i = 0; i < 3; ++i) bucket[cursor[lower(f, i)]++] = static_cast<Index>(3 * f + i);
  }
  Gluing across(faces.size(), {none, none, none});
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto first = bucket.begin() + begin[v], last = bucket.begin() + begin[v + 1];
    std::sort(first, last, [&](Index a, Index b) {
      const Index ua = upper(a), ub = upper(b);
      return ua != ub ? ua < ub : a < b;
    });
    for (auto run = first; run != last;) {
      auto end = run + 1;
      while (end != last && upper(*end) == upper(*run)) ++end;
      if (end - run > 1)
        for (auto h = run; h != end; ++h) across[*h / 3][*h % 3] = h + 1 == end ? *run : *(h + 1);
      run = end;
    }
  }
  return across;
}

void check_gluing(Faces faces, std::span<const std::array<Index, 3>> across) {
  const std::size_t halfedges = faces.size() * 3;
  std::vector<char> entered(halfedges, 0);
  for (std::size_t h = 0; h < halfedges; ++h) {
    const Index to = across[h / 3][h % 3];
    if (to == none) continue;
    const std::string where = "face " + std::to_string(h / 3) + ", edge " + std::to_string(h % 3);
    if (to >= halfedges) throw InputError(where + ": glued to a halfedge that does not exist");
    if (to == h) throw InputError(where + ": glued to itself");
    if (entered[to]++) throw InputError(where + ": its other side is glued twice");
    const auto& a = faces[h / 3];
    const auto& b = faces[to / 3];
    const auto p = std::minmax(a[h % 3], a[next(static_cast<Index>(h % 3))]);
    const auto q = std::minmax(b[to % 3], b[next(to % 3)]);
    if (p != q) throw InputError(where + ": glued to an edge with other vertices");
  }
  for (std::size_t h = 0; h < halfedges; ++h)
    if ((across[h / 3][h % 3] != none) != (entered[h] != 0))
      throw InputError("face " + std::to_string(h / 3) + ", edge " + std::to_string(h % 3) +
                       ": glued from one side only");
}

Orientation orient(Faces faces, const Gluing& across) {
  const auto pair_of = [&](Index h) -> Index {  // none for boundaries and fans
    const Index o = across[h / 3][h % 3];
    return o != none && across[o / 3][o % 3] == h ? o : none;
  };
  // In a loop (both ends one vertex) vertices do not tell directions apart: taken as opposite.
  const auto same_way = [&](Index h, Index o) {
    const Index a = faces[h / 3][h % 3], b = faces[h / 3][next(h % 3)];
    return a != b && a == faces[o / 3][o % 3];
  };
  Orientation result;
  bool consistent = true;
  for (Index h = 0; consistent && h < faces.size() * 3; ++h) {
    const Index o = pair_of(h);
    consistent = o == none || !same_way(h, o);
  }
  if (consistent) return result;
  constexpr char unseen = 2;
  result.turned.assign(faces.size(), unseen);
  std::vector<Index> queue;
  for (Index seed = 0; seed < faces.size(); ++seed) {
    if (result.turned[seed] != unseen) continue;
    result.turned[seed] = 0;
    queue.assign(1, seed);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index f = queue[head];
      for (Index i = 0; i < 3; ++i) {
        const Index o = pair_of(3 * f + i);
        if (o == none) continue;
        const char wanted = result.turned[f] ^ static_cast<char>(same_way(3 * f + i, o));
        if (result.turned[o / 3] == unseen) {
          result.turned[o / 3] = wanted;
          queue.push_back(o / 3);
        } else if (result.turned[o / 3] != wanted) {
          result.orientable = false;
        }
      }
    }
  }
  return result;
}

}  // namespace plexway
