#include "shape/warnings/cloud_gaps.hpp"

#include <algorithm>
#include <bit>
#include <vector>

#include "complexes/common/disjoint_sets.hpp"
#include "complexes/common/point3.hpp"
#include "complexes/common/vertices_outside.hpp"
#include "shape/warnings/cloud_rims.hpp"

namespace plexway::detail {
namespace {

constexpr double wider = 1.9;    // than the edges that go on from it
constexpr double onward = -0.5;  // cosine of the angle with these

// Triangles, two for each point of the gap's length. The longest row of chance among n points grows
// with log n, as the longest run of heads among n coins does.
std::size_t least_in_row(std::size_t points) {
  return std::max(std::size_t{24}, 3 * static_cast<std::size_t>(std::bit_width(points)) / 2);
}

}  // namespace

template <class Real>
BridgedGaps bridged_gaps(const CloudShape& shape, const PointCloud<Real>& cloud) {
  const std::vector<double> nearest = nearest_neighbours(shape);
  if (is_scattered(nearest)) return {};
  const auto& at = shape.measured();
  const auto& sheet = cloud.surface();
  const std::vector<Index> outside = vertices_outside(sheet);
  const auto triangles = sheet.triangles().first(sheet.face_count());
  // Beyond p, seen from q, is there a point much nearer to p?
  const auto goes_on_short = [&](Index p, Index q) {
    const Point3 d = minus(at[q], at[p]);
    const double l = norm(d);
    if (!(l > wider * nearest[p])) return false;
    const auto around = shape.neighbours.around(p);
    return std::any_of(around.begin(), around.end(), [&](Index w) {
      const Point3 e = minus(at[w], at[p]);
      const double m = norm(e);
      return m > 0 && wider * m < l && dot(d, e) < onward * l * m;
    });
  };
  const auto is_wide = [&](const TriangleRecord<Real>& t, std::size_t i) {
    const Index p = outside[t.corner[i]], q = outside[t.corner[edge_after(i)]];
    return p < at.size() && q < at.size() &&  // else a place that is no point
           goes_on_short(p, q) && goes_on_short(q, p);
  };
  std::vector<Index> over;
  for (Index t = 0; t < triangles.size(); ++t)
    if (is_wide(triangles[t], 0) + is_wide(triangles[t], 1) + is_wide(triangles[t], 2) >= 2)
      over.push_back(t);
  DisjointSets rows(over.size());
  for (Index c = 0; c < over.size(); ++c)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& t = triangles[over[c]];
      const auto other = std::lower_bound(over.begin(), over.begin() + c,
                                          Index{t.across[i] >> Across::face_shift});
      if (other != over.begin() + c && *other == t.across[i] >> Across::face_shift && is_wide(t, i))
        rows.unite(c, static_cast<Index>(other - over.begin()));
    }
  std::vector<std::size_t> size(over.size(), 0);
  for (Index c = 0; c < over.size(); ++c) ++size[rows.find(c)];
  BridgedGaps found;
  for (Index c = 0; c < over.size(); ++c) {
    if (size[rows.find(c)] < least_in_row(at.size())) continue;
    ++found.triangles;
    for (const Index v : triangles[over[c]].corner) found.first = std::min(found.first, outside[v]);
  }
  return found;
}

template BridgedGaps bridged_gaps(const CloudShape&, const PointCloud<float>&);
template BridgedGaps bridged_gaps(const CloudShape&, const PointCloud<double>&);

}  // namespace plexway::detail
