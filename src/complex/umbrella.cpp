#include "complex/umbrella.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <plexway/complex/blocks.hpp>

#include "complex/crease.hpp"

namespace plexway {
namespace {

constexpr std::size_t block = 1024;

// A neighbour in the tangent plane, and its image in the circle around the place: the Delaunay
// umbrella is the hull of these images.
struct Spoke {
  double x, y, u, v;
  Index place;
};

// By a root: std::hypot costs ten times as much, and images are inverse squares as it is.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

class Umbrella {
 public:
  Umbrella(const Places& places, std::span<const TangentFrame> frames, const SheetRule& rule,
           double widest)
      : places_(places), frames_(frames), rule_(rule), widest_(widest) {}

  /// Pairs of neighbours of which the first was asked for, and that are not on the same sheet.
  [[nodiscard]] std::size_t refused() const { return refused_; }

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
      const bool triangle = wedge && turn > least(place, a, b) * length(b.u - a.u, b.v - a.v);
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
    const Point3 q = unfolded(places_, frames_, rule_, place, j);
    const double x = dot(ex_, q), y = dot(ey_, q), r = x * x + y * y;
    spoke = {x, y, x / r, y / r, j};
    return r > 0;
  }

  // Is place j surely outside of the circle through a and what is (eu, ev) from its image? Without
  // a division: most are.
  bool is_outside(Index place, Index j, const Spoke& a, double eu, double ev, double e) const {
    const Point3 q = unfolded(places_, frames_, rule_, place, j);
    const double x = dot(ex_, q), y = dot(ey_, q), r = x * x + y * y;
    const double size = r * (std::abs(a.u) + std::abs(a.v)) + std::abs(x) + std::abs(y);
    return eu * (y - a.v * r) - ev * (x - a.u * r) > 1e-12 * e * size;
  }

  void gather(Index place) {
    const auto& n = frames_[place].normal;
    const Point3 normal = {n[0], n[1], n[2]};
    ex_ = some_perpendicular(normal), ey_ = cross(normal, ex_);
    spokes_.clear();
    Spoke spoke;
    for (const Index j : places_.near.around(place)) {
      const bool same = same_sheet(places_, frames_, rule_, place, j);
      refused_ += static_cast<std::size_t>(!same) & static_cast<std::size_t>(j > place);
      if (same && project(place, j, spoke)) spokes_.push_back(spoke);
    }
    // All neighbours within this are known; a list made symmetric is longer than it is complete.
    const std::size_t known = spokes_.size() * 2 / 3;
    known_ = spokes_.empty() ? 0 : length(spokes_[known].x, spokes_[known].y);
  }

  // Circles that reach beyond what is known of the neighbours are looked through for neighbours
  // of neighbours.
  bool look_further(Index place) {
    const std::size_t before = spokes_.size();
    for (std::size_t i = 0; i < hull_.size(); ++i) {
      const std::size_t j = i + 1 == hull_.size() ? 0 : i + 1;
      const Spoke a = spokes_[hull_[i]], b = spokes_[hull_[j]];
      const double eu = b.u - a.u, ev = b.v - a.v, e = length(eu, ev);
      const double turn = a.u * b.v - a.v * b.u;  // e by the inverse of the circle's width
      if (turn * known_ > e) continue;
      for (const Index end : {a.place, b.place})
        for (const Index c : places_.near.around(end)) {
          Spoke spoke;
          if (is_outside(place, c, a, eu, ev, e)) continue;
          if (c == place || c == a.place || c == b.place || !project(place, c, spoke)) continue;
          const double u = spoke.u - a.u, v = spoke.v - a.v;
          if (!(eu * v - ev * u < -1e-9 * e * length(u, v))) continue;
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
    us_.resize(spokes_.size()), vs_.resize(spokes_.size());
    std::size_t first = 0;
    largest_ = 0;
    for (std::size_t i = 0; i < spokes_.size(); ++i) {
      const double u = us_[i] = spokes_[i].u, v = vs_[i] = spokes_[i].v, size = u * u + v * v;
      if (size > largest_) first = i, largest_ = size;
    }
    largest_ = std::sqrt(largest_);
    was_clear_ = false;
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
    const std::size_t next = clear_next(at);
    was_clear_ = next != none;
    return was_clear_ ? next : next_of_ties(place, at);
  }

  // Where one image has all others to its left, by far more than a tie: nothing else is to be
  // asked. Else none. It rarely changes its mind, so that is a branch.
  std::size_t clear_next(std::size_t at) const {
    const std::size_t count = us_.size();
    const double *const us = us_.data(), *const vs = vs_.data(), au = us[at], av = vs[at];
    std::size_t best = at == 0 ? 1 : 0;
    if (best >= count) return none;
    double bu = us[best] - au, bv = vs[best] - av, least = clear_of(bu, bv);
    for (std::size_t i = best + 1; i < count; ++i) {
      const double u = us[i] - au, v = vs[i] - av, turn = bu * v - bv * u;
      if (turn > least) [[likely]]
        continue;
      if (i == at) continue;
      if (!(turn < -least)) return none;
      best = i, bu = u, bv = v, least = clear_of(u, v);
    }
    // All are to the left of what was best when they were asked, and that of this one. So they are
    // unless they are nearly behind; then so is the place before on the hull, if it was clear
    // that all are to the left of the way from there.
    if (!was_clear_) {
      for (std::size_t i = 0; i < best; ++i)
        if (i != at && !(bu * (vs[i] - av) - bv * (us[i] - au) > least)) return none;
    } else {
      const std::size_t before = hull_[hull_.size() - 2];
      if (before != best && !(bu * (vs[before] - av) - bv * (us[before] - au) > least)) return none;
    }
    return best;
  }
  // More than a turn from (u, v) to any image that would be a tie: none is farther away than twice
  // the largest is from the place.
  [[nodiscard]] double clear_of(double u, double v) const {
    return 2.2e-6 * largest_ * (std::abs(u) + std::abs(v));
  }

  std::size_t next_of_ties(Index place, std::size_t at) {
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
        return length(spokes_[i].u - a.u, spokes_[i].v - a.v);
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
  double known_ = 0, largest_ = 0;  // the latter of images
  std::size_t refused_ = 0;
  bool was_clear_ = false;  // what is next on the hull, at the place before
  std::vector<Spoke> spokes_;
  std::vector<double> us_, vs_;  // of the spokes, side by side
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
  std::atomic<std::size_t> refused = 0;
  for_blocks(n, block, threads, progress, [&](std::size_t first, std::size_t last) {
    Umbrella umbrella(places, frames, rule, widest);
    std::vector<Index>& rings = found[first / block];
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

double median(std::vector<double>& values) {
  // Of a few by how many are less, which takes no branch for each two.
  constexpr std::size_t few = 12;
  const std::size_t half = values.size() / 2;
  if (values.size() <= few)
    for (const double x : values) {
      std::size_t less = 0, most = 0;
      for (const double y : values) less += y < x, most += y <= x;
      if (less <= half && half < most) return x;
    }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void set_reach(const Places& places, const Umbrellas& umbrellas, int threads,
               std::span<TangentFrame> frames) {
  constexpr double wide = 1.1, more = 1.3;
  std::vector<double> usual(frames.size(), 0);
  for_blocks(frames.size(), block, threads, {}, [&](std::size_t first, std::size_t last) {
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
      if (!circles.empty()) usual[p] = median(circles);
    }
  });
  for_blocks(frames.size(), block, threads, {}, [&](std::size_t first, std::size_t last) {
    std::vector<double> around;
    for (Index p = static_cast<Index>(first); p < last; ++p) {
      around.assign(1, usual[p]);
      for (const Index q : umbrellas.around(p)) around.push_back(usual[q & ~Umbrellas::gap]);
      const double circle = median(around), spacing = static_cast<double>(frames[p].spacing);
      frames[p].reach =
          circle > wide * spacing ? static_cast<float>(more * circle) : frames[p].spacing;
    }
  });
}

}  // namespace plexway
