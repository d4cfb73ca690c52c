#include "complexes/cloud/umbrella.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>

#include <plexway/common/blocks.hpp>

#include "complexes/cloud/crease.hpp"
#include "complexes/common/arrays.hpp"

namespace plexway::detail {
namespace {

constexpr std::size_t umbrella_block = 1024;

// By a root: std::hypot costs ten times as much, and images are inverse squares as it is.
double norm2(double x, double y) { return std::sqrt(x * x + y * y); }

// How much normals turn around places: where that is little there is no crease, without a look at
// each pair.
class Bends {
 public:
  // A sine, below that of a crease by more than normals in float are off.
  static constexpr double least = 0.29;

  Bends(const Places& places, std::span<const TangentFrame> frames, int threads)
      : frames_(frames), sines_(frames.size()) {
    for_blocks(frames.size(), umbrella_block, threads, {},
               [&](std::size_t first, std::size_t last) {
                 for (Index p = static_cast<Index>(first); p < last; ++p) {
                   double least_square = 1;
                   for (const Index q : places.near.around(p)) {
                     const double cosine = dot(frames[p].normal, frames[q].normal);
                     least_square = std::min(least_square, cosine * cosine);
                   }
                   sines_[p] = static_cast<float>(std::sqrt(1 - least_square));
                 }
               });
  }

  // The largest sine of the angle between the normal of a place and those of its neighbours.
  [[nodiscard]] double at(Index place) const { return static_cast<double>(sines_[place]); }
  [[nodiscard]] double between(Index i, Index j) const {
    const double cosine = dot(frames_[i].normal, frames_[j].normal);
    return std::sqrt(std::max(0.0, 1 - cosine * cosine));
  }

 private:
  std::span<const TangentFrame> frames_;
  std::vector<float> sines_;
};

// Who need not be looked at for a circle: the place, its own neighbours, and who was looked at. By
// the numbers' low bits; whose slot another took is looked at again. Without a branch for each, as
// about one in four is left.
class Asked {
 public:
  // A circle of a place, with the place's neighbours.
  void begin(Index place, std::span<const Index> neighbours) {
    if (place != place_) {
      place_ = place;
      own_ = next_turn();
      slots_[place % slots] = own_ | place;
      for (const Index j : neighbours) slots_[j % slots] = own_ | j;
    }
    circle_ = next_turn();
  }

  // Those of a row that are not yet asked, which then they are. Until the next call.
  std::span<const Index> others(std::span<const Index> around) {
    if (row_.size() < around.size()) row_.resize(around.size());
    Index* const row = row_.data();
    std::size_t count = 0;
    for (const Index c : around) {
      std::uint64_t& slot = slots_[c % slots];
      const std::uint64_t was = slot, now = circle_ | c;
      const std::uint64_t is_own = was == (own_ | c), is_asked = was == now;
      slot = now ^ ((was ^ now) & (0 - is_own));
      row[count] = c;
      count += 1 ^ (is_own | is_asked);
    }
    return std::span<const Index>(row_).first(count);
  }

 private:
  static constexpr std::size_t slots = 1024;
  std::uint64_t next_turn() { return (turn_ += std::uint64_t{1} << 32); }

  std::array<std::uint64_t, slots> slots_{};  // a turn in the high bits, who was asked in the low
  std::uint64_t turn_ = 0, own_ = 0, circle_ = 0;
  Index place_ = none;
  std::vector<Index> row_;
};

class Umbrella {
 public:
  Umbrella(const Places& places, std::span<const TangentFrame> frames, const SheetRule& rule,
           const Bends& bends, double widest)
      : places_(places),
        frames_(frames),
        rule_(rule),
        bends_(bends),
        widest_(widest),
        wrap_(places.at) {}

  /// Pairs of neighbours of which the first was asked for, and that are not on the same sheet.
  [[nodiscard]] std::size_t refused() const { return refused_; }

  void build(Index place, std::vector<Index>& ring) {
    gather(place);
    if (spokes_.empty()) return;
    hull_ = wrap_.wrap(place, spokes_);
    for (int round = 0; round < 8 && look_further(place); ++round)
      hull_ = wrap_.wrap(place, spokes_);
    const std::size_t start = ring.size();
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const Spoke &a = spokes_[hull_[i]], &b = spokes_[hull_[i + 1 == hull_.size() ? 0 : i + 1]];
      // Half the inverse of the circle's radius is how far the hull's edge is from the place.
      const double turn = a.u * b.v - a.v * b.u;
      const bool wedge = hull_.size() > 2 || (hull_.size() == 2 && turn > 0);
      const bool triangle = wedge && turn > least(place, a, b) * norm2(b.u - a.u, b.v - a.v);
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

  // Neighbour j as the place sees it. `calm`: there is surely no crease between the two.
  Point3 seen(Index place, Index j, bool calm) const {
    return calm ? minus(places_.at[j], places_.at[place])
                : unfolded(places_, frames_, rule_, place, j);
  }
  // In the tangent plane.
  std::array<double, 2> flat(const Point3& q) const {
    std::array<double, 2> at;
    for (std::size_t k = 0; k < 2; ++k)  // both at once, where a processor can
      at[k] = axes_[0][k] * q[0] + axes_[1][k] * q[1] + axes_[2][k] * q[2];
    return at;
  }
  static bool set_spoke(const std::array<double, 2>& at, Index j, Spoke& spoke) {
    const auto [x, y] = at;
    const double r = x * x + y * y;
    spoke = {x, y, x / r, y / r, j};
    return r > 0;
  }

  // Which places are surely outside of the circle through the place, a and b, without a division:
  // most are. Beside rounding, which is 1e-15 of all terms together, as of those it is made of.
  struct Outside {
    double u, v, square, least;
    Outside(const Spoke& a, double eu, double ev, double e) : u(-ev), v(eu) {
      // |x| + |y| is at most 0.71 (r size + 1 / size).
      constexpr double sure = 1e-12;
      const double size = std::abs(a.u) + std::abs(a.v);
      square = ev * a.u - eu * a.v - 1.71 * sure * e * size;
      least = 0.71 * sure * e / size;
    }
    [[nodiscard]] bool holds(double x, double y) const {
      return u * x + v * y + square * (x * x + y * y) > least;
    }
  };

  void gather(Index place) {
    const auto& n = frames_[place].normal;
    const Point3 normal = {n[0], n[1], n[2]};
    const Point3 ex = some_perpendicular(normal), ey = cross(normal, ex);
    for (std::size_t d = 0; d < 3; ++d) axes_[d] = {ex[d], ey[d]};
    const bool calm = bends_.at(place) < Bends::least;
    // Then normals tell nothing, unless of the side or nearly the same is asked of them.
    const bool plain = calm && !rule_.oriented && rule_.least_cosine < 0.95;
    const auto row = places_.near.around(place);
    spokes_.resize(row.size());
    Spoke* end = spokes_.data();
    for (const Index j : row) {
      Point3 q;
      bool same;
      if (plain) {
        q = minus(places_.at[j], places_.at[place]);
        same = in_both_planes(frames_[place], frames_[j], rule_, q);
      } else {
        same = same_sheet(places_, frames_, rule_, place, j);
        if (same) q = seen(place, j, calm);
      }
      refused_ += static_cast<std::size_t>(!same) & static_cast<std::size_t>(j > place);
      if (same && set_spoke(flat(q), j, *end)) ++end;
    }
    spokes_.resize(static_cast<std::size_t>(end - spokes_.data()));
    // All neighbours within this are known; a list made symmetric is longer than it is complete.
    const std::size_t known = spokes_.size() * 2 / 3;
    known_ = spokes_.empty() ? 0 : norm2(spokes_[known].x, spokes_[known].y);
  }

  // Circles that reach beyond what is known of the neighbours are looked through for neighbours
  // of neighbours.
  bool look_further(Index place) {
    const std::size_t before = spokes_.size();
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const std::size_t j = i + 1 == hull_.size() ? 0 : i + 1;
      const Spoke a = spokes_[hull_[i]], b = spokes_[hull_[j]];
      const double eu = b.u - a.u, ev = b.v - a.v, e = norm2(eu, ev);
      const double turn = a.u * b.v - a.v * b.u;  // e by the inverse of the circle's width
      if (turn * known_ > e) continue;
      const Outside outside(a, eu, ev, e);
      asked_.begin(place, places_.near.around(place));
      for (const Index end : {a.place, b.place}) {
        const bool calm = bends_.between(place, end) + bends_.at(end) < Bends::least;
        for (const Index c : asked_.others(places_.near.around(end))) {
          const auto at = flat(seen(place, c, calm));
          Spoke spoke;
          if (outside.holds(at[0], at[1]) || !set_spoke(at, c, spoke)) continue;
          const double u = spoke.u - a.u, v = spoke.v - a.v;
          if (!(eu * v - ev * u < -1e-9 * e * norm2(u, v))) continue;
          if (std::any_of(spokes_.begin(), spokes_.end(),
                          [&](const Spoke& s) { return s.place == c; }))
            continue;
          if (same_sheet(places_, frames_, rule_, place, c)) spokes_.push_back(spoke);
        }
      }
    }
    return spokes_.size() != before;
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
  const Bends& bends_;
  double widest_;
  std::array<std::array<double, 2>, 3> axes_{};  // of the tangent plane, by coordinates in space
  double known_ = 0;
  std::size_t refused_ = 0;
  std::vector<Spoke> spokes_;
  Asked asked_;
  SpokeHull wrap_;
  std::span<const std::size_t> hull_;  // the Delaunay umbrella, as images
  std::vector<Index> keep_;
};

}  // namespace

Umbrellas local_umbrellas(const Places& places, std::span<const TangentFrame> frames,
                          const SheetRule& rule, double widest, int threads,
                          const std::function<bool(double)>& progress) {
  const std::size_t n = places.at.size();
  Umbrellas umbrellas;
  umbrellas.begin.assign(n + 1, 0);
  std::vector<std::vector<Index>> found((n + umbrella_block - 1) / umbrella_block);
  std::atomic<std::size_t> refused = 0;
  const Bends bends(places, frames, threads);
  for_blocks(n, umbrella_block, threads, progress, [&](std::size_t first, std::size_t last) {
    Umbrella umbrella(places, frames, rule, bends, widest);
    std::vector<Index>& rings = found[first / umbrella_block];
    rings.reserve((last - first) * 7);
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t before = rings.size();
      umbrella.build(static_cast<Index>(i), rings);
      umbrellas.begin[i + 1] = rings.size() - before;
    }
    refused += umbrella.refused();
  });
  umbrellas.refused = refused;
  for (std::size_t i = 0; i < n; ++i) umbrellas.begin[i + 1] += umbrellas.begin[i];
  umbrellas.ring.reserve(umbrellas.begin[n]);
  for (std::vector<Index>& rings : found) {
    umbrellas.ring.insert(umbrellas.ring.end(), rings.begin(), rings.end());
    rings = {};
  }
  return umbrellas;
}

namespace {

double circle_radius(const Point3& a, const Point3& b) {
  const Point3 c = minus(b, a), n = cross(a, b);
  return std::sqrt(dot(a, a)) * std::sqrt(dot(b, b)) * std::sqrt(dot(c, c)) /
         (2 * std::sqrt(dot(n, n)));
}

// The one in the middle of at most eight, by comparators without branches: a network of Batcher.
double median_of_few(std::span<const double> values) {
  constexpr std::size_t few = 8;
  constexpr unsigned char pairs[][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6},
                                        {5, 7}, {1, 2}, {5, 6}, {0, 4}, {1, 5}, {2, 6}, {3, 7},
                                        {2, 4}, {3, 5}, {1, 2}, {3, 4}, {5, 6}};
  std::array<double, few> v;
  v.fill(std::numeric_limits<double>::infinity());
  std::copy(values.begin(), values.end(), v.begin());
#pragma GCC unroll 19
  for (const auto& [i, j] : pairs) {
    // Asked twice, or compilers make one branch of both.
    const double low = v[j] < v[i] ? v[j] : v[i], high = v[i] < v[j] ? v[j] : v[i];
    v[i] = low, v[j] = high;
  }
  return v[values.size() / 2];
}

double median_of(std::vector<double>& values) {
  return values.size() <= 8 ? median_of_few(values) : median(values);
}

}  // namespace

void set_reach(const Places& places, const Umbrellas& umbrellas, int threads,
               std::span<TangentFrame> frames) {
  constexpr double wide = 1.1, more = 1.3;
  std::vector<double> usual(frames.size(), 0);
  for_blocks(frames.size(), umbrella_block, threads, {}, [&](std::size_t first, std::size_t last) {
    std::vector<double> circles;
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      const auto ring = umbrellas.around(p);
      circles.clear();
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (ring[i] & Umbrellas::gap) continue;
        const Index next = ring[i + 1 == ring.size() ? 0 : i + 1] & ~Umbrellas::gap;
        circles.push_back(circle_radius(minus(places.at[ring[i]], places.at[p]),
                                        minus(places.at[next], places.at[p])));
      }
      if (!circles.empty()) usual[p] = median_of(circles);
    }
  });
  for_blocks(frames.size(), umbrella_block, threads, {}, [&](std::size_t first, std::size_t last) {
    std::vector<double> around;
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      around.assign(1, usual[p]);
      for (const Index q : umbrellas.around(p)) around.push_back(usual[q & ~Umbrellas::gap]);
      const double circle = median_of(around), spacing = static_cast<double>(frames[p].spacing);
      frames[p].reach =
          circle > wide * spacing ? static_cast<float>(more * circle) : frames[p].spacing;
    }
  });
}

}  // namespace plexway::detail
