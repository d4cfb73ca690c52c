#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <vector>

#include "complexes/surface/intrinsic/delaunay_flips.hpp"
#include "complexes/surface/intrinsic/planar.hpp"

namespace plexway::detail {
namespace {

// Where the way to a circumcentre ends: in a triangle, or at a boundary edge in between.
struct Goal {
  SlotPoint point;
  Halfedge border = none;
  bool found = false;
};

std::array<Planar, 3> laid_out(const IntrinsicTriangle& t) {
  const Planar c = t.length[2] <= t.length[1]
                       ? t.length[2] * Planar{t.angle[0].c, t.angle[0].s}
                       : Planar{t.length[0], 0} + t.length[1] * Planar{-t.angle[1].c, t.angle[1].s};
  return {Planar{0, 0}, Planar{t.length[0], 0}, c};
}

// Each vertex takes up to two triangles more, and their numbers end somewhere.
std::size_t room_for(const IntrinsicTriangulation& triangulation, double share) {
  constexpr std::size_t most = std::numeric_limits<Index>::max() >> Across::face_shift;
  const std::size_t left = most - std::min(most, triangulation.triangles().size() + 1);
  const double wanted = share * static_cast<double>(triangulation.vertices());
  return static_cast<std::size_t>(std::min(wanted, static_cast<double>(left / 2)));
}

class Refiner {
 public:
  Refiner(IntrinsicTriangulation& triangulation, DelaunayFlips& flips, const Refinement& wanted)
      : triangulation_(triangulation),
        flips_(flips),
        largest_cosine_(std::cos(wanted.smallest_angle * std::numbers::pi / 180)),
        shortest_(wanted.shortest_edge),
        room_(room_for(triangulation, wanted.most_vertices)) {}

  void run() {
    for (Index s = 0; s < triangulation_.triangles().size(); ++s) look_at(s);
    // Each entry is taken once and each insertion makes finitely many, so the room is the end.
    while (!queue_.empty() && triangulation_.inserted().size() < room_) {
      const Bad bad = queue_.top();
      queue_.pop();
      if (badness(bad.slot) != bad.radius) continue;
      const Goal goal = way_to_circumcentre(bad.slot);
      if (!goal.found) continue;
      insert(goal);
      look_at(bad.slot);  // a border in between was split: the triangle may be as it was
    }
  }

 private:
  struct Bad {
    double radius;
    Index slot;
    bool operator<(const Bad& other) const {
      return radius != other.radius ? radius < other.radius : slot > other.slot;
    }
  };

  [[nodiscard]] const IntrinsicTriangle& at(Index slot) const {
    return triangulation_.triangles()[slot];
  }
  [[nodiscard]] bool is_fixed(Index slot, std::size_t edge) const {
    const Index o = at(slot).across[edge];
    return o == none || (o & Across::fan) != 0;
  }

  // The radius of the circle around a bad triangle, 0 for a good one.
  [[nodiscard]] double badness(Index slot) const {
    const IntrinsicTriangle& t = at(slot);
    std::size_t least = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (t.angle[i].c > t.angle[least].c) least = i;
    const double opposite = t.length[edge_after(least)];
    if (t.angle[least].c <= largest_cosine_ || !(opposite > shortest_)) return 0;
    // Between two edges that must stay nothing can be done about an angle.
    if (is_fixed(slot, least) && is_fixed(slot, edge_before(least))) return 0;
    return t.angle[least].s > 0 ? opposite / (2 * t.angle[least].s) : 0;
  }

  void look_at(Index slot) {
    if (const double radius = badness(slot); radius > 0) queue_.push({radius, slot});
  }

  // On an edge that is never flipped, as circumcentres of right triangles are, a vertex inside
  // would leave a flat triangle there for good: split the edge, or nothing.
  [[nodiscard]] Goal goal_in(Index slot, const std::array<double, 3>& to) const {
    constexpr double on_edge = 1e-5;  // of the height: float lengths are no better
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t edge = edge_after(i);
      if (to[i] > on_edge || !is_fixed(slot, edge)) continue;
      if (at(slot).across[edge] != none) return {};
      return {{}, slot << Across::face_shift | static_cast<Index>(edge), true};
    }
    return {{slot, clamped(to)}, none, true};
  }

  // Straight from the middle of the triangle.
  [[nodiscard]] Goal way_to_circumcentre(Index slot) const {
    const IntrinsicTriangle& t = at(slot);
    std::array<Planar, 3> corner = laid_out(t);
    std::array<double, 3> weight{};
    double total = 0;
    for (std::size_t i = 0; i < 3; ++i) total += weight[i] = 2 * t.angle[i].s * t.angle[i].c;
    if (!(std::abs(total) > 1e-12)) return {};
    Planar centre, start = 1. / 3 * (corner[0] + corner[1] + corner[2]);
    for (std::size_t i = 0; i < 3; ++i) centre = centre + weight[i] / total * corner[i];
    std::size_t came = 3;
    for (int steps = 0; steps < 100; ++steps) {
      const auto from = barycentric(corner, start), to = barycentric(corner, centre);
      std::size_t out = 3;
      double soonest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < 3; ++i) {  // over the edge after corner i + 1
        if (to[i] >= 0 || edge_after(i) == came) continue;
        const double when = std::fmax(from[i], 0) / (std::fmax(from[i], 0) - to[i]);
        if (when < soonest) soonest = when, out = edge_after(i);
      }
      if (out == 3) return goal_in(slot, to);
      const Index o = at(slot).across[out];
      if (o == none) return {{}, slot << Across::face_shift | static_cast<Index>(out), true};
      if ((o & Across::fan) != 0) return {};
      // Unfolded: along the edge and off it, then seen from the other side.
      const Planar first = corner[out], second = corner[edge_after(out)];
      const double length = at(slot).length[out];
      if (!(length > 0)) return {};
      const Planar e = 1 / length * (second - first);
      const bool turns_over = (o & Across::flip) != 0;
      slot = o >> Across::face_shift;
      came = o & Across::edge_mask;
      corner = laid_out(at(slot));
      const Planar base = corner[came], along = 1 / length * (corner[edge_after(came)] - base);
      const Planar up = {-along.y, along.x};
      const auto moved = [&](Planar q) {
        const double x = dot(q - first, e), y = -cross(e, q - first);
        return base + (turns_over ? x : length - x) * along + y * up;
      };
      const Planar passed = start + soonest * (centre - start);
      start = moved(passed);
      centre = moved(centre);
    }
    return {};
  }

  void insert(const Goal& goal) {
    const Index before = static_cast<Index>(triangulation_.triangles().size());
    const Index slot = goal.border != none ? goal.border >> Across::face_shift : goal.point.slot;
    if (goal.border != none)
      triangulation_.split_border(goal.border);
    else
      triangulation_.split(slot, goal.point.at);
    changed_.assign(1, slot);
    const Index after = static_cast<Index>(triangulation_.triangles().size());
    for (Index s = before; s < after; ++s) changed_.push_back(s);
    const std::size_t fresh = changed_.size();
    for (std::size_t k = 0; k < fresh; ++k)
      flips_.around(changed_[k], [&](Index s) { changed_.push_back(s); });
    std::sort(changed_.begin(), changed_.end());
    changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
    for (const Index s : changed_) look_at(s);
  }

  IntrinsicTriangulation& triangulation_;
  DelaunayFlips& flips_;
  double largest_cosine_;
  double shortest_;
  std::size_t room_;
  std::priority_queue<Bad> queue_;
  std::vector<Index> changed_;
};

}  // namespace

void refine(IntrinsicTriangulation& triangulation, DelaunayFlips& flips, const Refinement& wanted) {
  Refiner(triangulation, flips, wanted).run();
}

}  // namespace plexway::detail
