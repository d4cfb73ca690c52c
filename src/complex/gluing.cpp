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

std::vector<Index> breadth_first_order(const Gluing& across) {
  std::vector<Index> order;
  order.reserve(across.size());
  std::vector<char> seen(across.size(), 0);
  for (Index seed = 0; seed < across.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    std::size_t head = order.size();
    order.push_back(seed);
    while (head < order.size()) {
      for (const Index h : across[order[head++]]) {
        if (h == none || seen[h / 3]) continue;
        seen[h / 3] = 1;
        order.push_back(h / 3);
      }
    }
  }
  return order;
}

std::vector<Index> morton_order(std::span<const std::array<double, 3>> positions, Faces faces) {
  std::array<double, 3> low{}, high{};
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const auto& face : faces)  // a stray vertex must not put all others into one cell
    for (const Index v : face)
      for (std::size_t d = 0; d < 3; ++d) {
        low[d] = std::min(low[d], positions[v][d]);
        high[d] = std::max(high[d], positions[v][d]);
      }
  double width = 0;
  for (std::size_t d = 0; d < 3; ++d) width = std::max(width, high[d] / 2 - low[d] / 2);
  const double scale = width > 0 ? 0.5 * 2097151 / width : 0;
  struct Keyed {
    std::uint64_t key;
    Index face;
  };
  std::vector<Keyed> keyed(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    std::uint64_t key = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      double centre = 0;  // relative to `low`, and divided first: no overflow near 1e308
      for (const Index v : faces[f]) centre += (positions[v][d] / 3 - low[d] / 3) * scale;
      std::uint64_t q = static_cast<std::uint64_t>(std::clamp(centre, 0.0, 2097151.0));
      // Spread 21 bits to every third place.
      q = (q | q << 32) & 0x1f00000000ffff;
      q = (q | q << 16) & 0x1f0000ff0000ff;
      q = (q | q << 8) & 0x100f00f00f00f00f;
      q = (q | q << 4) & 0x10c30c30c30c30c3;
      q = (q | q << 2) & 0x1249249249249249;
      key |= q << d;
    }
    keyed[f] = {key, static_cast<Index>(f)};
  }
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.face < b.face;
  });
  std::vector<Index> order(faces.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = keyed[i].face;
  return order;
}

}  // namespace plexway
