#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "complexes/common/arrays.hpp"
#include "complexes/common/disjoint_sets.hpp"
#include "complexes/common/geometry.hpp"
#include "shape/warnings/cloud_rims.hpp"

namespace plexway::detail {
namespace {

constexpr std::size_t most_sources = 16;
constexpr double nearest = 3, farthest = 25;  // spacings
constexpr double longer = 0.05, behind_walls = 0.5;
constexpr std::size_t most_points = 10000;  // an even cloud has 2000 within `farthest`
constexpr std::size_t most_looks = 64;      // at one point each, a source

constexpr double beside = 2, height = 0.4;  // spacings

// Tells quickly that a point does not lie in one plane with what is around a source: all that is
// within `beside` of the source is near every line from it.
class AroundSource {
 public:
  AroundSource(const std::vector<Point3>& offsets, double spacing) : height_(height * spacing) {
    const double reach = 0.999 * beside * spacing;
    double longest = 0, widest = 0;
    std::vector<Point3> near;
    for (const Point3& p : offsets)
      if (dot(p, p) <= reach * reach) near.push_back(p);
    for (const Point3& p : near)
      if (dot(p, p) > longest) longest = dot(p, p), a_ = p;
    for (const Point3& p : near)
      if (const Point3 across = cross(a_, p); dot(across, across) > widest)
        widest = dot(across, across), b_ = p, normal_ = across;
    // From points in a line, as in scans by rows, nobody can tell.
    is_line_ = !(std::sqrt(widest) >= 0.05 * longest);
    if (is_line_) return;
    // A direction in which a and b are at most `height_` high is so far from the normal at most:
    // what it has in their plane is a sum of these along the dual basis.
    const double aa = dot(a_, a_), ab = dot(a_, b_), bb = dot(b_, b_);
    const double tilt = height_ * (std::sqrt(aa) + std::sqrt(bb)) / std::sqrt(widest);
    if (!(tilt < 1)) return;
    least_ = std::sqrt(1 - tilt * tilt);
    for (double& x : normal_) x /= std::sqrt(widest);
    for (std::size_t i = 0; i < 3; ++i) {
      dual_a_[i] = (bb * a_[i] - ab * b_[i]) / widest;
      dual_b_[i] = (aa * b_[i] - ab * a_[i]) / widest;
    }
  }

  // Is there a plane that could have all of them, and is given by those around the source? No is
  // sure.
  [[nodiscard]] bool may_be_flat(const Point3& to) const {
    if (is_line_) return false;
    const double along = std::abs(dot(dual_a_, to)) + std::abs(dot(dual_b_, to));
    return least_ * std::abs(dot(normal_, to)) <= 1.001 * height_ * (1 + along);
  }

 private:
  double height_, least_ = 0;  // of a plane's normal along ours
  bool is_line_ = true;
  Point3 a_ = {}, b_ = {}, normal_ = {}, dual_a_ = {}, dual_b_ = {};
};

// Do the points near the line from a source to another point lie in one plane? On a surface that
// is bent so much that a straight line is a twentieth too short they do not at its ends.
bool in_one_plane(const std::vector<Point3>& points, const Point3& to, double spacing) {
  constexpr std::size_t least = 6;
  const double length2 = dot(to, to);
  std::vector<Point3> near;
  for (const Point3& p : points) {
    const double along = std::clamp(dot(p, to) / length2, 0., 1.);
    const Point3 off = {p[0] - along * to[0], p[1] - along * to[1], p[2] - along * to[2]};
    if (dot(off, off) <= beside * beside * spacing * spacing) near.push_back(p);
  }
  if (near.size() < least) return false;
  const Point3 normal = fit_frame(near, std::vector<double>(near.size(), 1)).normal;
  double low = 0, high = 0;
  for (const Point3& p : near) {
    low = std::min(low, dot(normal, p));
    high = std::max(high, dot(normal, p));
  }
  return high - low <= height * spacing;
}

constexpr double by_chance = 0.4;  // of even clouds 0 to 0.3, of uniformly random ones 0.52
constexpr double arm = 8;          // spacings
constexpr double least_turn = 50 * std::numbers::pi / 180;

// The boundary of a sheet as loops of points, with the angle of the sheet at each.
class Rims {
 public:
  template <class Real>
  Rims(const TriangleMesh<Real>& sheet, std::size_t points)
      : next_(points, none), angle_(points, 0) {
    const std::vector<Index> outside = vertices_outside(sheet);
    const auto triangles = sheet.triangles().first(sheet.face_count());
    const Index sentinel = static_cast<Index>(sheet.face_count());
    for (const auto& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index v = outside[t.corner[i]], w = outside[t.corner[edge_after(i)]];
        if (v >= points || w >= points) continue;
        angle_[v] += std::atan2(static_cast<double>(t.sine(i)), static_cast<double>(t.cosine[i]));
        if (t.across[i] >> Across::face_shift >= sentinel) next_[v] = next_[v] == none ? w : v;
      }
  }

  [[nodiscard]] double excess(Index v) const { return angle_[v] - std::numbers::pi; }

  // Each loop once; what branches is none.
  template <class Take>
  void each(const Take& take) const {
    std::vector<char> seen(next_.size(), 0);
    std::vector<Index> loop;
    for (Index start = 0; start < next_.size(); ++start) {
      if (next_[start] == none || seen[start]) continue;
      loop.clear();
      Index v = start;
      for (; v != none && !seen[v]; v = next_[v]) seen[v] = 1, loop.push_back(v);
      if (v == start && loop.size() > 2) take(loop);
    }
  }

 private:
  std::vector<Index> next_;  // along the boundary
  std::vector<double> angle_;
};

ScatteredRims turns_of(const Rims& rims, const std::vector<Point3>& at, double reach) {
  ScatteredRims found;
  rims.each([&](const std::vector<Index>& loop) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      double excess = rims.excess(loop[i]);
      // From here as far as the arm goes, or halfway round.
      const auto walk = [&](std::size_t step) {
        double way = 0;
        std::size_t k = i;
        for (std::size_t steps = 0; way < reach && 2 * steps < n; ++steps) {
          const std::size_t to = (k + step) % n;
          way += norm(minus(at[loop[k]], at[loop[to]]));
          k = to;
          if (way < reach) excess += rims.excess(loop[k]);
        }
        return at[loop[k]];
      };
      const Point3 before = minus(at[loop[i]], walk(n - 1)), behind = minus(walk(1), at[loop[i]]);
      const Point3 across = cross(before, behind);
      const double turn = std::atan2(std::sqrt(dot(across, across)), dot(before, behind));
      if (turn < least_turn || excess < least_turn) continue;
      found.first = found.points++ == 0 ? loop[i] : std::min(found.first, loop[i]);
    }
  });
  return found;
}

constexpr double wider = 1.9;    // than the edges that go on from it
constexpr double onward = -0.5;  // cosine of the angle with these

// Triangles, two for each point of the gap's length. The longest row of chance among n points grows
// with log n, as the longest run of heads among n coins does.
std::size_t least_in_row(std::size_t points) {
  return std::max(std::size_t{24}, 3 * static_cast<std::size_t>(std::bit_width(points)) / 2);
}

}  // namespace

RimDetours rim_detours(std::span<const std::array<double, 3>> positions, double spacing,
                       std::span<const double> distance, std::span<const std::size_t> sources) {
  RimDetours detours;
  std::vector<bool> found(positions.size(), false);
  std::vector<std::size_t> patch, farther;
  std::vector<Point3> offsets;
  for (const std::size_t s : sources.first(std::min(most_sources, sources.size()))) {
    patch.clear();
    offsets.clear();
    for (std::size_t v = 0; v < positions.size(); ++v) {
      const Point3 q = minus(positions[v], positions[s]);
      if (!(dot(q, q) <= farthest * farthest * spacing * spacing)) continue;
      patch.push_back(v);
      offsets.push_back(q);
    }
    if (patch.size() > most_points) continue;
    const AroundSource around(offsets, spacing);
    const auto share_of = [&](std::size_t i) {
      return (distance[patch[i]] - distance[s]) / std::sqrt(dot(offsets[i], offsets[i])) - 1;
    };
    farther.clear();
    for (std::size_t i = 0; i < patch.size(); ++i) {
      if (dot(offsets[i], offsets[i]) < nearest * nearest * spacing * spacing) continue;
      if (const double share = share_of(i); !(share > longer && share < behind_walls)) continue;
      if (!found[patch[i]] && around.may_be_flat(offsets[i])) farther.push_back(i);
    }
    const std::size_t looks = std::min(most_looks, farther.size());
    bool any = false;
    for (std::size_t k = 0; k < looks; ++k) {
      const std::size_t i = farther[k * farther.size() / looks], v = patch[i];
      if (!in_one_plane(offsets, offsets[i], spacing)) continue;
      found[v] = any = true;
      if (detours.points++ == 0 || v < detours.first) detours.first = v;
      detours.most = std::max(detours.most, share_of(i));
    }
    if (any && looks < farther.size()) detours.all = false;
  }
  return detours;
}

std::vector<double> nearest_neighbours(const CloudShape& shape) {
  const auto& at = shape.measured();
  std::vector<double> nearest(at.size(), 0);
  for (Index v = 0; v < at.size(); ++v)
    for (const Index w : shape.neighbours.around(v))
      if (const double d = norm(minus(at[v], at[w])); d > 0 && (nearest[v] == 0 || d < nearest[v]))
        nearest[v] = d;
  return nearest;
}

bool is_scattered(std::span<const double> nearest) {
  double sum = 0, squares = 0, count = 0;
  for (const double d : nearest)
    if (d > 0) sum += d, squares += d * d, ++count;
  const double mean = sum / count;
  return count > 0 && squares / count - mean * mean > by_chance * by_chance * mean * mean;
}

template <class Real>
ScatteredRims scattered_rims(const CloudShape& shape, const PointCloud<Real>& cloud) {
  if (cloud.summary().boundary_points == 0 || !is_scattered(nearest_neighbours(shape))) return {};
  const auto& at = shape.measured();
  return turns_of(Rims(cloud.surface(), at.size()), at, arm * cloud.summary().mean_spacing);
}

template ScatteredRims scattered_rims(const CloudShape&, const PointCloud<float>&);
template ScatteredRims scattered_rims(const CloudShape&, const PointCloud<double>&);

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
