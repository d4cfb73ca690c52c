#include "complex/umbrella.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <plexway/complex/blocks.hpp>

namespace plexway {
namespace {

constexpr std::size_t block = 1024;

// A symmetric matrix: xx, yy, zz, xy, xz, yz.
using Symmetric = std::array<double, 6>;

// The direction in which points with these second moments spread least. The adjugate turns the
// least eigenvalue into the largest, and squaring leaves nothing but that one.
Point3 least_direction(Symmetric m) {
  const double trace = m[0] + m[1] + m[2];
  if (!(trace > 0)) return {0, 0, 1};
  for (double& x : m) x /= trace;
  Symmetric a = {m[1] * m[2] - m[5] * m[5], m[0] * m[2] - m[4] * m[4], m[0] * m[1] - m[3] * m[3],
                 m[4] * m[5] - m[3] * m[2], m[3] * m[5] - m[4] * m[1], m[3] * m[4] - m[5] * m[0]};
  if (!(a[0] + a[1] + a[2] > 1e-14)) {  // on a line
    const std::size_t d = m[0] > m[1] ? (m[0] > m[2] ? 0 : 2) : (m[1] > m[2] ? 1 : 2);
    const Point3 rows[3] = {{m[0], m[3], m[4]}, {m[3], m[1], m[5]}, {m[4], m[5], m[2]}};
    return some_perpendicular(unit(rows[d]));
  }
  for (int i = 0; i < 4; ++i) {
    const double size = a[0] + a[1] + a[2];
    for (double& x : a) x /= size;
    a = {a[0] * a[0] + a[3] * a[3] + a[4] * a[4], a[3] * a[3] + a[1] * a[1] + a[5] * a[5],
         a[4] * a[4] + a[5] * a[5] + a[2] * a[2], a[0] * a[3] + a[3] * a[1] + a[4] * a[5],
         a[0] * a[4] + a[3] * a[5] + a[4] * a[2], a[3] * a[4] + a[1] * a[5] + a[5] * a[2]};
  }
  const Point3 rows[3] = {{a[0], a[3], a[4]}, {a[3], a[1], a[5]}, {a[4], a[5], a[2]}};
  return unit(rows[a[0] > a[1] ? (a[0] > a[2] ? 0 : 2) : (a[1] > a[2] ? 1 : 2)]);
}

struct Moments {
  Symmetric second{};
  Point3 first{};
  double count = 1;  // the place itself, at 0

  void add(const Point3& q) {
    for (std::size_t d = 0; d < 3; ++d) first[d] += q[d];
    const double more[6] = {q[0] * q[0], q[1] * q[1], q[2] * q[2],
                            q[0] * q[1], q[0] * q[2], q[1] * q[2]};
    for (std::size_t i = 0; i < 6; ++i) second[i] += more[i];
    ++count;
  }
  [[nodiscard]] Symmetric about_mean() const {
    Symmetric m = second;
    const double of[6] = {first[0] * first[0], first[1] * first[1], first[2] * first[2],
                          first[0] * first[1], first[0] * first[2], first[1] * first[2]};
    for (std::size_t i = 0; i < 6; ++i) m[i] -= of[i] / count;
    return m;
  }
};

// The least spread in direction n, as a share of all.
double share_along(const Symmetric& m, const Point3& n) {
  const double along = n[0] * (m[0] * n[0] + 2 * m[3] * n[1] + 2 * m[4] * n[2]) +
                       n[1] * (m[1] * n[1] + 2 * m[5] * n[2]) + n[2] * m[2] * n[2];
  return along / (m[0] + m[1] + m[2]);
}

// Neighbours within `slab` of the plane through the place with normal n.
Moments near_plane(std::span<const Point3> around, const Point3& n, double slab) {
  Moments moments;
  for (const Point3& q : around)
    if (std::abs(dot(n, q)) <= slab) moments.add(q);
  return moments;
}

// How well a plane through the place explains its neighbours: the nearer to it the better, and near
// neighbours count more.
double support(std::span<const Point3> around, const Point3& n, double slab) {
  double sum = 0;
  for (const Point3& q : around) {
    const double off = dot(n, q) / slab;
    if (off * off < 1) sum += (1 - off * off) / (slab * slab + dot(q, q));
  }
  return sum;
}

// Of the planes through the place and two of its nearest neighbours the best: it finds the place's
// own sheet among several, where the spread of all says nothing.
Point3 supported_plane(std::span<const Point3> around, double slab, Point3 best) {
  constexpr std::size_t nearest = 8;
  double most = support(around, best, slab);
  for (std::size_t i = 1; i < std::min(nearest, around.size()); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Point3 n = cross(around[i], around[j]);
      // Not from a needle.
      if (!(dot(n, n) > 0.1 * dot(around[i], around[i]) * dot(around[j], around[j]))) continue;
      const double s = support(around, unit(n), slab);
      if (s > most) most = s, best = unit(n);
    }
  return best;
}

// A place's normal, and whether its neighbours are too thick a layer to be sure.
Point3 fit_normal(std::span<const Point3> around, double slab, char& thick) {
  Moments all;
  for (const Point3& q : around) all.add(q);
  const Symmetric spread = all.about_mean();
  Point3 n = least_direction(spread);
  thick = share_along(spread, n) > 0.02;  // noise, an edge of a solid, or another sheet
  if (thick == 0) return n;
  n = supported_plane(around, slab, n);
  for (int i = 0; i < 2; ++i) {
    const Moments own = near_plane(around, n, slab);
    if (own.count < 5) break;
    n = least_direction(own.about_mean());
  }
  return n;
}

// Of the normals around a place the one that the others agree with most, near ones above all.
std::array<float, 3> agreed_normal(const Places& places, std::span<const TangentFrame> frames,
                                   Index place, std::vector<double>& weight) {
  const auto row = places.near.around(place);
  const double spacing = static_cast<double>(frames[place].spacing);
  weight.clear();
  for (const Index j : row) {
    const Point3 q = minus(places.at[j], places.at[place]);
    weight.push_back(1 / (spacing * spacing + dot(q, q)));
  }
  std::array<float, 3> best = frames[place].normal;
  double most = -1;
  const auto look = [&](const std::array<float, 3>& n) {
    double sum = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const double cosine = dot(n, frames[row[k]].normal);
      sum += weight[k] * cosine * cosine;
    }
    if (sum > most) most = sum, best = n;
  };
  look(frames[place].normal);
  for (const Index j : row) look(frames[j].normal);
  return best;
}

}  // namespace

std::vector<TangentFrame> tangent_frames(const Places& places, std::span<const Point3> given,
                                         const SheetRule& rule, int threads,
                                         const std::function<bool(double)>& progress) {
  const std::size_t n = places.at.size();
  std::vector<TangentFrame> frames(n);
  std::vector<char> thick(n, 0);
  const auto is_given = [&](Index i) {
    const double square = given.empty() ? 0 : dot(given[i], given[i]);
    return square > 0 && std::isfinite(square);
  };
  for_blocks(n, block, threads, progress, [&](std::size_t first, std::size_t last) {
    std::vector<Point3> around;
    for (Index i = static_cast<Index>(first); i < last; ++i) {
      around.clear();
      double sum = 0;
      for (const Index j : places.near.around(i)) {
        around.push_back(minus(places.at[j], places.at[i]));
        sum += dot(around.back(), around.back());
      }
      // In a plane the mean square distance of the nearest goes with their number.
      const double count = std::max<double>(static_cast<double>(around.size()), 1);
      const double spacing = std::sqrt(2 * std::numbers::pi * sum / (count * (count + 1)));
      frames[i].spacing = static_cast<float>(spacing);
      const Point3 normal =
          is_given(i) ? unit(given[i]) : fit_normal(around, rule.most_offset * spacing, thick[i]);
      for (std::size_t d = 0; d < 3; ++d) frames[i].normal[d] = static_cast<float>(normal[d]);
    }
  });
  const bool any = std::find(thick.begin(), thick.end(), 1) != thick.end();
  for (int round = 0; any && round < 5; ++round) {
    const std::vector<TangentFrame> before = frames;
    for_blocks(n, block, threads, {}, [&](std::size_t first, std::size_t last) {
      std::vector<double> weight;
      for (Index i = static_cast<Index>(first); i < last; ++i)
        if (thick[i] != 0) frames[i].normal = agreed_normal(places, before, i, weight);
    });
  }
  for (Index i = 0; i < n && !given.empty(); ++i) {
    if (is_given(i)) continue;
    double outward = 0;  // as the given ones around it
    for (const Index j : places.near.around(i))
      if (is_given(j)) outward += dot(frames[i].normal, frames[j].normal);
    if (outward < 0)
      for (float& x : frames[i].normal) x = -x;
  }
  return frames;
}

bool same_sheet(const Places& places, std::span<const TangentFrame> frames, const SheetRule& rule,
                Index i, Index j) {
  const TangentFrame &a = frames[i], &b = frames[j];
  const double cosine = dot(a.normal, b.normal);
  if ((rule.oriented ? cosine : std::abs(cosine)) < rule.least_cosine) return false;
  const Point3 q = minus(places.at[j], places.at[i]);
  const auto fits = [&](const TangentFrame& f) {
    return std::abs(dot(f.normal, q)) <= rule.most_offset * static_cast<double>(f.spacing);
  };
  return fits(a) && fits(b);
}

}  // namespace plexway
