#include "complexes/cloud/cloud_bridges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "complexes/cloud/crease.hpp"
#include "complexes/common/disjoint_sets.hpp"

namespace plexway::detail {
namespace {

struct Pair {
  double distance_between;
  Index a, b;
  friend auto operator<=>(const Pair&, const Pair&) = default;
};

double distance_between(const Places& places, Index a, Index b) {
  const Point3 q = minus(places.at[a], places.at[b]);
  return std::sqrt(dot(q, q));
}

// Of those that share a triangle with a, the nearest to b.
Index beside(const Places& places, const SheetWedges& sheet, Index a, Index b) {
  Pair best = {std::numeric_limits<double>::infinity(), none, none};
  sheet.around(a, [&](const SheetWedges::Wedge& w) {
    for (const Index x : {w.a, w.b})
      if (x != b) best = std::min(best, {distance_between(places, x, b), x, a});
  });
  return best.a;
}

}  // namespace

CloudParts bridge_parts(const SheetRule& rule, std::span<const TangentFrame> frames, Places& places,
                        SheetWedges& sheet) {
  const std::size_t n = places.near.point_count();
  DisjointSets parts(n);
  for (const auto& [a, b, c] : sheet.triangles())
    if (a != none) parts.unite(a, b), parts.unite(b, c);

  std::vector<Index> of(n);
  bool several = false;
  for (Index i = 0; i < n; ++i) {
    of[i] = parts.find(i);
    several |= of[i] != of[0];
  }
  std::vector<Pair> pairs;
  for (Index i = 0; i < n && several; ++i) {
    bool alone = !sheet.used(i);
    for (const Index j : places.near.around(i)) {
      if (of[i] == of[j]) continue;
      if (!same_sheet(places, frames, rule, i, j)) continue;
      alone = false;
      pairs.push_back({distance_between(places, i, j), std::min(i, j), std::max(i, j)});
    }
    if (alone && !places.near.around(i).empty()) {
      const Index j = places.near.around(i)[0];
      pairs.push_back({distance_between(places, i, j), std::min(i, j), std::max(i, j)});
    }
  }
  std::sort(pairs.begin(), pairs.end());

  CloudParts result;
  for (const auto& [l, a, b] : pairs) {
    if (parts.find(a) == parts.find(b)) continue;
    parts.unite(a, b);
    ++result.bridges;
    const bool at_a = sheet.used(a), at_b = sheet.used(b);
    result.joints += at_a && at_b;
    if (!at_a && !at_b) {
      const Index halfway = static_cast<Index>(places.at.size());
      const Point3 &p = places.at[a], &q = places.at[b];
      places.at.push_back({p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2, p[2] / 2 + q[2] / 2});
      sheet.add_place();
      parts.add();
      parts.unite(halfway, a);
      sheet.add({a, b, halfway});
      continue;
    }
    // One triangle at each end, glued along the segment.
    const Index x = at_a ? beside(places, sheet, a, b) : none;
    const Index y = at_b ? beside(places, sheet, b, a) : none;
    if (at_a) sheet.add({a, x, b});
    if (at_b) sheet.add({b, y, a});
  }
  result.part.resize(n);
  for (Index i = 0; i < n; ++i) result.part[i] = parts.find(i);
  return result;
}

}  // namespace plexway::detail
