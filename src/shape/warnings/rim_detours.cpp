#include "shape/warnings/rim_detours.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "complexes/common/local_frame.hpp"
#include "complexes/common/point3.hpp"

namespace plexway {
namespace {

constexpr std::size_t most_sources = 16;
constexpr double nearest = 3, farthest = 25;  // spacings
constexpr double longer = 0.05, behind_walls = 0.5;
constexpr std::size_t most_points = 10000;  // an even cloud has 2000 within `farthest`
constexpr std::size_t most_looks = 64;      // at one point each, a source

constexpr double beside = 2, height = 0.4;  // spacings

/// Tells quickly that a point does not lie in one plane with what is around a source: all that is
/// within `beside` of the source is near every line from it.
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

  /// Is there a plane that could have all of them, and is told by those around the source? No is
  /// sure.
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

/// Do the points near the line from a source to another point lie in one plane? On a surface that
/// is bent so much that a straight line is a twentieth too short they do not at its ends.
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

}  // namespace plexway
