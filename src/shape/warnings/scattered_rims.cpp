#include "shape/warnings/scattered_rims.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "complexes/common/point3.hpp"

namespace plexway {
namespace {

constexpr double by_chance = 0.4;  // of even clouds 0 to 0.3, of uniformly random ones 0.52
constexpr double arm = 8;          // spacings
constexpr double least_turn = 50 * std::numbers::pi / 180;

double gap(const Point3& p, const Point3& q) {
  const Point3 d = minus(p, q);
  return std::sqrt(dot(d, d));
}

// Standard deviation of the distance to the nearest neighbour over its mean.
double spread_of_nearest(const CloudShape& shape) {
  const auto& at = shape.measured();
  double sum = 0, squares = 0;
  std::size_t count = 0;
  for (Index v = 0; v < at.size(); ++v) {
    double nearest = 0;
    for (const Index w : shape.neighbours.around(v))
      if (const double d = gap(at[v], at[w]); d > 0 && (nearest == 0 || d < nearest)) nearest = d;
    if (nearest == 0) continue;
    sum += nearest, squares += nearest * nearest, ++count;
  }
  if (count == 0) return 0;
  const double mean = sum / static_cast<double>(count);
  return std::sqrt(std::max(squares / static_cast<double>(count) - mean * mean, 0.)) / mean;
}

// The boundary of a sheet as loops of points, with the angle of the sheet at each.
class Rims {
 public:
  template <class Real>
  Rims(const TriangleMesh<Real>& sheet, std::size_t points)
      : next_(points, none), angle_(points, 0) {
    std::vector<Index> outside(sheet.vertex_count(), none);
    for (Index v = 0; v < sheet.vertex_count(); ++v) outside[sheet.inside_vertex(v)] = v;
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

  /// Each loop once; what branches is none.
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
          way += gap(at[loop[k]], at[loop[to]]);
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

}  // namespace

template <class Real>
ScatteredRims scattered_rims(const CloudShape& shape, const PointCloud<Real>& cloud) {
  if (cloud.summary().boundary_points == 0 || !(spread_of_nearest(shape) > by_chance)) return {};
  const auto& at = shape.measured();
  return turns_of(Rims(cloud.surface(), at.size()), at, arm * cloud.summary().mean_spacing);
}

template ScatteredRims scattered_rims(const CloudShape&, const PointCloud<float>&);
template ScatteredRims scattered_rims(const CloudShape&, const PointCloud<double>&);

}  // namespace plexway
