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
  std::vector<TangentFrame> frames(places.at.size());
  std::vector<char> thick(places.at.size(), 0);
  for_blocks(places.at.size(), block, threads, progress, [&](std::size_t first, std::size_t last) {
    std::vector<Point3> around;
    for (Index i = static_cast<Index>(first); i < last; ++i) {
      around.clear();
      double sum = 0;
      for (const Index j : places.near.around(i)) {
        around.push_back(minus(places.at[j], places.at[i]));
        sum += dot(around.back(), around.back());
      }
      const double count = static_cast<double>(around.size());
      // The mean square of the distances of the nearest in a plane.
      const double rms = count > 0 ? std::sqrt(sum / count) : 0;
      const double spacing = rms * std::sqrt(2 * std::numbers::pi / (count + 1));
      Point3 n = {0, 0, 0};
      if (!given.empty()) n = given[i];
      const double length = dot(n, n);
      n = length > 0 && std::isfinite(length)
              ? unit(n)
              : fit_normal(around, rule.most_offset * spacing, thick[i]);
      for (std::size_t d = 0; d < 3; ++d) frames[i].normal[d] = static_cast<float>(n[d]);
      frames[i].spacing = static_cast<float>(spacing);
    }
  });
  for (int round = 0; round < 5; ++round) {
    const std::vector<TangentFrame> before = frames;
    for_blocks(places.at.size(), block, threads, {}, [&](std::size_t first, std::size_t last) {
      std::vector<double> weight;
      for (Index i = static_cast<Index>(first); i < last; ++i)
        if (thick[i] != 0) frames[i].normal = agreed_normal(places, before, i, weight);
    });
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

namespace {

// A neighbour in the tangent plane, and its image in the circle around the place: the Delaunay
// umbrella is the hull of these images.
struct Spoke {
  double x, y, u, v;
  Index place;
};

class Umbrella {
 public:
  Umbrella(const Places& places, std::span<const TangentFrame> frames, const SheetRule& rule,
           double widest)
      : places_(places), frames_(frames), rule_(rule), widest_(widest) {}

  void build(Index place, std::vector<Index>& ring) {
    gather(place);
    if (spokes_.empty()) return;
    wrap(place);
    for (int round = 0; round < 8 && look_further(place); ++round) wrap(place);
    const std::size_t start = ring.size();
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const Spoke &a = spokes_[hull_[i]], &b = spokes_[hull_[i + 1 == hull_.size() ? 0 : i + 1]];
      // Half the inverse of the circle's radius is how far the hull's edge is from the place.
      const double turn = a.u * b.v - a.v * b.u;
      const bool wedge = hull_.size() > 2 || (hull_.size() == 2 && turn > 0);
      const bool triangle = wedge && turn > least(place, a, b) * std::hypot(b.u - a.u, b.v - a.v);
      ring.push_back(a.place | (triangle ? 0 : Umbrellas::gap));
    }
    drop_lonely(ring, start);
  }

 private:
  // A triangle's circle is at most so wide: the inverse of twice its radius.
  double least(Index place, const Spoke& a, const Spoke& b) const {
    const float spacings =
        frames_[place].spacing + frames_[a.place].spacing + frames_[b.place].spacing;
    return 1 / (2 * widest_ * static_cast<double>(spacings) / 3);
  }

  bool project(Index place, Index j, Spoke& spoke) const {
    const Point3 q = minus(places_.at[j], places_.at[place]);
    const double x = dot(ex_, q), y = dot(ey_, q), r = x * x + y * y;
    spoke = {x, y, x / r, y / r, j};
    return r > 0;
  }

  void gather(Index place) {
    const auto& n = frames_[place].normal;
    const Point3 normal = {n[0], n[1], n[2]};
    ex_ = some_perpendicular(normal), ey_ = cross(normal, ex_);
    spokes_.clear();
    Spoke spoke;
    for (const Index j : places_.near.around(place))
      if (same_sheet(places_, frames_, rule_, place, j) && project(place, j, spoke))
        spokes_.push_back(spoke);
    // All neighbours within this are known; a list made symmetric is longer than it is complete.
    const std::size_t known = spokes_.size() * 2 / 3;
    known_ = spokes_.empty() ? 0 : std::hypot(spokes_[known].x, spokes_[known].y);
  }

  // Circles that reach beyond what is known of the neighbours are looked through for neighbours
  // of neighbours.
  bool look_further(Index place) {
    const std::size_t before = spokes_.size();
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const std::size_t j = i + 1 == hull_.size() ? 0 : i + 1;
      const Spoke a = spokes_[hull_[i]], b = spokes_[hull_[j]];
      const double eu = b.u - a.u, ev = b.v - a.v, e = std::hypot(eu, ev);
      const double turn = a.u * b.v - a.v * b.u;  // e by the inverse of the circle's width
      if (turn * known_ > e) continue;
      for (const Index end : {a.place, b.place})
        for (const Index c : places_.near.around(end)) {
          Spoke spoke;
          if (c == place || c == a.place || c == b.place || !project(place, c, spoke)) continue;
          const double u = spoke.u - a.u, v = spoke.v - a.v;
          if (!(eu * v - ev * u < -1e-9 * e * std::hypot(u, v))) continue;
          if (std::any_of(spokes_.begin(), spokes_.end(),
                          [&](const Spoke& s) { return s.place == c; }))
            continue;
          if (same_sheet(places_, frames_, rule_, place, c)) spokes_.push_back(spoke);
        }
    }
    return spokes_.size() != before;
  }

  // The hull of the images, counterclockwise from the nearest neighbour.
  void wrap(Index place) {
    hull_.clear();
    std::size_t first = 0;
    const auto size = [&](std::size_t i) {
      return spokes_[i].u * spokes_[i].u + spokes_[i].v * spokes_[i].v;
    };
    for (std::size_t i = 1; i < spokes_.size(); ++i)
      if (size(i) > size(first)) first = i;
    std::size_t at = first;
    do {
      hull_.push_back(at);
      if (hull_.size() > spokes_.size()) {  // rounding: no way around
        hull_.clear();
        return;
      }
      at = next_on_hull(place, at);
    } while (at != first && at != spokes_.size());
  }

  std::size_t next_on_hull(Index place, std::size_t at) {
    const Spoke& a = spokes_[at];
    std::size_t best = spokes_.size();
    double bu = 0, bv = 0, bb = 0;
    ties_.clear();
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      if (i == at) continue;
      const double u = spokes_[i].u - a.u, v = spokes_[i].v - a.v;
      const double turn = bu * v - bv * u, square = u * u + v * v;
      constexpr double tie = 1e-12;  // squares
      if (best != spokes_.size() && turn * turn <= tie * bb * square) {
        if (bu * u + bv * v > 0) {
          ties_.push_back(square > bb ? best : i);
          if (!(square > bb)) continue;
        } else if (a.u * v <= a.v * u) {  // two ways along a line: one has the place to the left
          continue;
        } else {
          ties_.clear();
        }
      } else if (best != spokes_.size() && turn >= 0) {
        continue;
      } else {
        ties_.clear();
      }
      best = i;
      bu = u, bv = v, bb = square;
    }
    if (!ties_.empty()) return break_ties(place, at, best);
    return best;
  }

  // Several on one circle with the place. All agree that the lowest of them sees all others.
  std::size_t break_ties(Index place, std::size_t at, std::size_t best) {
    std::size_t lowest = ties_[0];
    for (const std::size_t i : ties_)
      if (spokes_[i].place < spokes_[lowest].place) lowest = i;
    const Index others = std::min({spokes_[at].place, spokes_[best].place, spokes_[lowest].place});
    if (place < others) {
      const Spoke& a = spokes_[at];  // all of them: the nearest image is next
      const auto far = [&](std::size_t i) {
        return std::hypot(spokes_[i].u - a.u, spokes_[i].v - a.v);
      };
      std::size_t nearest = best;
      for (const std::size_t i : ties_)
        if (far(i) < far(nearest)) nearest = i;
      return nearest;
    }
    return spokes_[lowest].place == others ? lowest : best;
  }

  // Who has a gap on both sides is in no triangle.
  void drop_lonely(std::vector<Index>& ring, std::size_t start) {
    const std::size_t count = ring.size() - start;
    keep_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const Index before = ring[start + (i == 0 ? count : i) - 1];
      if ((before & ring[start + i] & Umbrellas::gap) == 0) keep_.push_back(ring[start + i]);
    }
    ring.resize(start);
    ring.insert(ring.end(), keep_.begin(), keep_.end());
  }

  const Places& places_;
  std::span<const TangentFrame> frames_;
  SheetRule rule_;
  double widest_;
  Point3 ex_{}, ey_{};
  double known_ = 0;
  std::vector<Spoke> spokes_;
  std::vector<std::size_t> hull_, ties_;
  std::vector<Index> keep_;
};

}  // namespace

Umbrellas local_umbrellas(const Places& places, std::span<const TangentFrame> frames,
                          const SheetRule& rule, double widest, int threads,
                          const std::function<bool(double)>& progress) {
  const std::size_t n = places.at.size();
  Umbrellas umbrellas;
  umbrellas.begin.assign(n + 1, 0);
  std::vector<std::vector<Index>> found((n + block - 1) / block);
  for_blocks(n, block, threads, progress, [&](std::size_t first, std::size_t last) {
    Umbrella umbrella(places, frames, rule, widest);
    std::vector<Index>& rings = found[first / block];
    rings.reserve((last - first) * 7);
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t before = rings.size();
      umbrella.build(static_cast<Index>(i), rings);
      umbrellas.begin[i + 1] = rings.size() - before;
    }
  });
  for (std::size_t i = 0; i < n; ++i) umbrellas.begin[i + 1] += umbrellas.begin[i];
  umbrellas.ring.reserve(umbrellas.begin[n]);
  for (std::vector<Index>& rings : found) {
    umbrellas.ring.insert(umbrellas.ring.end(), rings.begin(), rings.end());
    rings = {};
  }
  return umbrellas;
}

}  // namespace plexway
