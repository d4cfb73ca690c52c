#include "complexes/cloud/umbrella.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <plexway/common/blocks.hpp>

#include "complexes/common/arrays.hpp"

namespace plexway::detail {
namespace {

constexpr std::size_t frame_block = 1024;

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

// The median distance from the plane of those within `slab` of it.
double median_offset(std::span<const Point3> around, const Point3& n, double slab) {
  std::vector<double> offsets;
  for (const Point3& q : around)
    if (const double off = std::abs(dot(n, q)); off <= slab) offsets.push_back(off);
  return offsets.empty() ? 0 : median(offsets);
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

// Where neighbours are too thick a layer to be sure of the plane by their spread alone.
Point3 plane_of_layer(std::span<const Point3> around, double slab, const Point3& spread_least) {
  Point3 n = supported_plane(around, slab, spread_least);
  // What is far off for most of those near the plane is beside it: at the edge of a solid the plane
  // tilts less and less towards the other side. Noise is far off for none.
  for (int i = 0; i < 8; ++i) {
    const Moments own = near_plane(around, n, slab);
    if (own.count < 5) break;
    n = least_direction(own.about_mean());
    slab = std::min(slab, 3 * median_offset(around, n, slab));
  }
  return n;
}

// The frames of all places, and how sure they are.
class Frames {
 public:
  Frames(const Places& places, std::span<const Point3> given, const SheetRule& rule, int threads)
      : places_(places),
        given_(given),
        rule_(rule),
        threads_(threads),
        frames_(places.at.size()),
        share_(frames_.size(), 0),
        thick_(frames_.size(), 0) {}

  std::vector<TangentFrame> make(const std::function<bool(double)>& progress) {
    for_all(progress, [&](Index i, Room& room) { fit(i, room.around); });
    thinnest_ = share_;
    for_all({}, [&](Index i, Room&) {
      for (const Index j : places_.near.around(i)) thinnest_[i] = std::min(thinnest_[i], share_[j]);
    });
    for_all({}, [&](Index i, Room&) { thick_[i] = is_thick(i); });
    if (std::find(thick_.begin(), thick_.end(), 1) != thick_.end()) {
      for_all({}, [&](Index i, Room& room) {
        if (thick_[i] != 0) refit(i, room.around);
      });
      for (int round = 0; round < 5; ++round) {
        const std::vector<TangentFrame> before = frames_;
        for_all({}, [&](Index i, Room& room) {
          if (thick_[i] != 0) frames_[i].normal = agreed_normal(before, i, room.number);
        });
      }
    }
    turn_as_given();
    return std::move(frames_);
  }

 private:
  struct Room {
    std::vector<Point3> around;
    std::vector<double> number;
  };
  template <class Visit>
  void for_all(const std::function<bool(double)>& progress, const Visit& visit) const {
    for_blocks(frames_.size(), frame_block, threads_, progress,
               [&](std::size_t first, std::size_t last) {
                 Room room;
                 for (std::size_t i = first; i < last; ++i) visit(static_cast<Index>(i), room);
               });
  }

  [[nodiscard]] bool is_given(Index i) const {
    const double square = given_.empty() ? 0 : dot(given_[i], given_[i]);
    return square > 0 && std::isfinite(square);
  }
  void set_normal(Index i, const Point3& normal) {
    for (std::size_t d = 0; d < 3; ++d) frames_[i].normal[d] = static_cast<float>(normal[d]);
  }
  // Nearest first. One that is far from all has these as its neighbours, too: it says nothing of
  // the surface here.
  void gather(Index i, std::vector<Point3>& around) const {
    constexpr double too_far = 100 * 100;  // of the middle one's distance, squared
    around.clear();
    for (const Index j : places_.near.around(i))
      around.push_back(minus(places_.at[j], places_.at[i]));
    if (around.empty()) return;
    const double middle = dot(around[around.size() / 2], around[around.size() / 2]);
    while (dot(around.back(), around.back()) > too_far * middle) around.pop_back();
  }

  // By all neighbours.
  void fit(Index i, std::vector<Point3>& around) {
    gather(i, around);
    Moments all;
    double sum = 0;
    for (const Point3& q : around) all.add(q), sum += dot(q, q);
    // In a plane the mean square distance of the nearest goes with their number.
    const double count = std::max<double>(static_cast<double>(around.size()), 1);
    const double spacing = std::sqrt(2 * std::numbers::pi * sum / (count * (count + 1)));
    frames_[i].spacing = static_cast<float>(spacing);
    const Symmetric spread = all.about_mean();
    const Point3 normal = is_given(i) ? unit(given_[i]) : least_direction(spread);
    set_normal(i, normal);
    share_[i] = static_cast<float>(share_along(spread, normal));
  }

  // Noise, an edge of a solid, or another sheet. Where that is just within reach the plane follows
  // it without getting thick; but some place two rings around is thinner by far.
  [[nodiscard]] bool is_thick(Index i) const {
    constexpr float sure = 0.02f, least = 3e-4f, by_far = 10;
    if (!(share_[i] > least) || is_given(i)) return false;
    if (share_[i] > sure) return true;
    float thinnest = thinnest_[i];
    for (const Index j : places_.near.around(i)) thinnest = std::min(thinnest, thinnest_[j]);
    return share_[i] > by_far * thinnest;
  }

  void refit(Index i, std::vector<Point3>& around) {
    gather(i, around);
    const auto& n = frames_[i].normal;
    set_normal(i,
               plane_of_layer(around, rule_.most_offset * static_cast<double>(frames_[i].spacing),
                              {n[0], n[1], n[2]}));
  }

  // Of the normals around a place the one that the others agree with most: near ones above all,
  // those that are sure, and those of places that lie in one plane with it.
  std::array<float, 3> agreed_normal(std::span<const TangentFrame> frames, Index place,
                                     std::vector<double>& weight) const {
    const auto row = places_.near.around(place);
    const double spacing = static_cast<double>(frames[place].spacing);
    weight.clear();
    for (const Index j : row) {
      const Point3 q = minus(places_.at[j], places_.at[place]);
      const double sure = 1 / (1e-3 + static_cast<double>(share_[j]));
      weight.push_back(sure / (spacing * spacing + dot(q, q)));
    }
    std::array<float, 3> best = frames[place].normal;
    double most = -1;
    const double near = 0.01 * spacing;
    const auto look = [&](const std::array<float, 3>& n) {
      double sum = 0;
      for (std::size_t k = 0; k < row.size(); ++k) {
        const auto& m = frames[row[k]].normal;
        const Point3 q = minus(places_.at[row[k]], places_.at[place]);
        const double cosine = dot(n, m), ours = dot(n, q) / near, theirs = dot(m, q) / near;
        sum += weight[k] * cosine * cosine / (1 + ours * ours + theirs * theirs);
      }
      if (sum > most) most = sum, best = n;
    };
    look(frames[place].normal);
    for (const Index j : row) look(frames[j].normal);
    return best;
  }

  // Normals that are not given point to the side that those around them do.
  void turn_as_given() {
    for (Index i = 0; i < frames_.size() && !given_.empty(); ++i) {
      if (is_given(i)) continue;
      double outward = 0;
      for (const Index j : places_.near.around(i))
        if (is_given(j)) outward += dot(frames_[i].normal, frames_[j].normal);
      if (outward < 0)
        for (float& x : frames_[i].normal) x = -x;
    }
  }

  const Places& places_;
  std::span<const Point3> given_;
  SheetRule rule_;
  int threads_;
  std::vector<TangentFrame> frames_;
  std::vector<float> share_;     // of the neighbours' spread along the normal
  std::vector<float> thinnest_;  // the least of a place and its neighbours
  std::vector<char> thick_;
};

}  // namespace

std::vector<TangentFrame> tangent_frames(const Places& places, std::span<const Point3> given,
                                         const SheetRule& rule, int threads,
                                         const std::function<bool(double)>& progress) {
  return Frames(places, given, rule, threads).make(progress);
}

}  // namespace plexway::detail
