#include "paths/cells/cells.hpp"

#include <algorithm>
#include <cmath>

namespace plexway::detail {
namespace {

/// The crossings of a string as numbers that may vary: all coordinates on a face but the first.
class Taut {
 public:
  Taut(const Cells& all, const CellString& string) : legs_(string.cells.size()) {
    joints_.resize(string.crossings.size());
    for (std::size_t k = 0; k < legs_; ++k) {
      const Cell cell = all.cell(string.cells[k]);
      if (k == 0) start_ = place_in(cell, string.start);
      if (k + 1 == legs_) end_ = place_in(cell, string.end);
      if (k > 0) take(cell, string.crossings[k - 1], joints_[k - 1].out);
      if (k + 1 < legs_) take(cell, string.crossings[k], joints_[k].in);
    }
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      Joint& joint = joints_[k];
      joint.corners = string.crossings[k].face.corners;
      // Inside of the face, for the barrier.
      constexpr double inwards = 0.02;
      for (std::size_t i = 0; i < joint.corners; ++i)
        joint.at[i] = (1 - inwards) * string.crossings[k].at[i] +
                      inwards / static_cast<double>(joint.corners);
      barriers_ += joint.corners > 1 ? joint.corners : 0;
    }
    step_.resize(joints_.size());
  }

  void run() {
    if (barriers_ == 0) return;
    const double scale = length(0, 0);
    if (!(scale > 0)) return;
    const double share = scale / static_cast<double>(barriers_ + legs_);
    for (double softness = 1e-2 * share;; softness = std::max(softness * 0.1, 1e-12 * share)) {
      const bool last = softness <= 1e-12 * share;
      for (int i = 0; i < 40; ++i) {
        const double gain = find_step(softness);
        if (!(gain > (last ? 1e-3 : 0.1) * softness) || !go(softness, gain, scale)) break;
      }
      if (last) break;
    }
  }

  void give(CellString& string) const {
    for (std::size_t k = 0; k < joints_.size(); ++k)
      for (std::size_t i = 0; i < joints_[k].corners; ++i)
        string.crossings[k].at[i] = joints_[k].at[i];
  }

 private:
  struct Joint {
    std::size_t corners = 0;
    std::array<Point3, 3> in = {}, out = {};  // corners in the cell before, and in that behind
    std::array<double, 3> at = {};
  };
  using Pair = std::array<double, 2>;
  using Block = std::array<Pair, 2>;

  static void take(const Cell& cell, const CellCrossing& crossing, std::array<Point3, 3>& to) {
    for (std::size_t i = 0; i < crossing.face.corners; ++i)
      to[i] = cell.place[cell.corner(crossing.face.vertex[i])];
  }
  static Point3 point(const std::array<Point3, 3>& corner, const std::array<double, 3>& at,
                      std::size_t corners) {
    Point3 p = {0, 0, 0};
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t d = 0; d < 3; ++d) p[d] += at[i] * corner[i][d];
    return p;
  }
  std::array<double, 3> moved(std::size_t k, double by) const {
    const Joint& joint = joints_[k];
    std::array<double, 3> at = joint.at;
    for (std::size_t i = 1; i < joint.corners; ++i) {
      at[i] += by * step_[k][i - 1];
      at[0] -= by * step_[k][i - 1];
    }
    return at;
  }

  // After a part of the step; lengths are rounded off by `softness`, so that they have no kink.
  double length(double by, double softness) const {
    double sum = 0;
    Point3 from = start_;
    for (std::size_t k = 0; k < legs_; ++k) {
      Point3 to = end_, next{};
      if (k < joints_.size()) {
        const auto at = moved(k, by);
        to = point(joints_[k].in, at, joints_[k].corners);
        next = point(joints_[k].out, at, joints_[k].corners);
        if (joints_[k].corners > 1)
          for (std::size_t i = 0; softness > 0 && i < joints_[k].corners; ++i)
            sum -= softness * std::log(at[i]);
      }
      const Point3 leg = minus(to, from);
      sum += std::sqrt(dot(leg, leg) + softness * softness);
      from = next;
    }
    return sum;
  }

  // Newton's step; what it promises to gain.
  double find_step(double softness) {
    const std::size_t n = joints_.size();
    slope_.assign(n, {0, 0});
    diagonal_.assign(n, {});
    beside_.assign(n, {});
    const auto direction = [](const std::array<Point3, 3>& corner, std::size_t i) {
      return minus(corner[i + 1], corner[0]);
    };
    Point3 from = start_;
    for (std::size_t k = 0; k < legs_; ++k) {
      const Joint* const before = k > 0 ? &joints_[k - 1] : nullptr;
      const Joint* const behind = k < n ? &joints_[k] : nullptr;
      const Point3 to = behind ? point(behind->in, behind->at, behind->corners) : end_;
      const Point3 leg = minus(to, from);
      const double d = std::sqrt(dot(leg, leg) + softness * softness);
      const Point3 u = {leg[0] / d, leg[1] / d, leg[2] / d};
      const auto bend = [&](const Point3& a, const Point3& b) {
        return (dot(a, b) - dot(a, u) * dot(b, u)) / d;
      };
      for (std::size_t i = 0; before && i + 1 < before->corners; ++i) {
        const Point3 a = direction(before->out, i);
        slope_[k - 1][i] -= dot(a, u);
        for (std::size_t j = 0; j + 1 < before->corners; ++j)
          diagonal_[k - 1][i][j] += bend(a, direction(before->out, j));
        for (std::size_t j = 0; behind && j + 1 < behind->corners; ++j)
          beside_[k - 1][i][j] -= bend(a, direction(behind->in, j));
      }
      for (std::size_t i = 0; behind && i + 1 < behind->corners; ++i) {
        const Point3 a = direction(behind->in, i);
        slope_[k][i] += dot(a, u);
        for (std::size_t j = 0; j + 1 < behind->corners; ++j)
          diagonal_[k][i][j] += bend(a, direction(behind->in, j));
      }
      if (behind) from = point(behind->out, behind->at, behind->corners);
    }
    for (std::size_t k = 0; k < n; ++k) {
      const Joint& joint = joints_[k];
      const double first = softness / joint.at[0];
      for (std::size_t i = 0; i < 2; ++i) {
        if (i + 1 >= joint.corners) {
          diagonal_[k][i][i] = 1;
          continue;
        }
        const double own = softness / joint.at[i + 1];
        slope_[k][i] += first - own;
        diagonal_[k][i][i] += own / joint.at[i + 1];
        for (std::size_t j = 0; j + 1 < joint.corners; ++j)
          diagonal_[k][i][j] += first / joint.at[0];
        diagonal_[k][i][i] *= 1 + 1e-13;
      }
    }
    return solve();
  }

  static Block inverse(const Block& a) {
    const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    return {{{a[1][1] / det, -a[0][1] / det}, {-a[1][0] / det, a[0][0] / det}}};
  }
  static Block times(const Block& a, const Block& b) {
    Block c{};
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
    return c;
  }
  static Pair times(const Block& a, const Pair& b) {
    return {a[0][0] * b[0] + a[0][1] * b[1], a[1][0] * b[0] + a[1][1] * b[1]};
  }
  static Block turned(const Block& a) { return {{{a[0][0], a[1][0]}, {a[0][1], a[1][1]}}}; }

  // The band of blocks, eliminated from the start to the end.
  double solve() {
    const std::size_t n = joints_.size();
    for (std::size_t k = 0; k < n; ++k) {
      Pair right = {-slope_[k][0], -slope_[k][1]};
      if (k > 0) {
        const Block up = times(turned(beside_[k - 1]), diagonal_[k - 1]);  // inverted already
        const Pair from = times(up, step_[k - 1]);
        const Block less = times(up, beside_[k - 1]);
        for (std::size_t i = 0; i < 2; ++i) {
          right[i] -= from[i];
          for (std::size_t j = 0; j < 2; ++j) diagonal_[k][i][j] -= less[i][j];
        }
      }
      diagonal_[k] = inverse(diagonal_[k]);
      step_[k] = right;
    }
    double gain = 0;
    for (std::size_t k = n; k-- > 0;) {
      Pair right = step_[k];
      if (k + 1 < n) {
        const Pair back = times(beside_[k], step_[k + 1]);
        right = {right[0] - back[0], right[1] - back[1]};
      }
      step_[k] = times(diagonal_[k], right);
      gain -= slope_[k][0] * step_[k][0] + slope_[k][1] * step_[k][1];
    }
    return gain;
  }

  // As far as it stays inside and gets shorter.
  bool go(double softness, double gain, double scale) {
    double by = 1;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const auto at = moved(k, 1);
      for (std::size_t i = 0; i < joints_[k].corners; ++i)
        if (at[i] < joints_[k].at[i])
          by = std::min(by, 0.95 * joints_[k].at[i] / (joints_[k].at[i] - at[i]));
    }
    const double now = length(0, softness);
    for (int halvings = 0; halvings < 30; ++halvings, by /= 2) {
      if (!(length(by, softness) <= now - 1e-4 * by * gain + 4e-16 * scale)) continue;
      for (std::size_t k = 0; k < joints_.size(); ++k) joints_[k].at = moved(k, by);
      return true;
    }
    return false;
  }

  std::size_t legs_, barriers_ = 0;
  Point3 start_{}, end_{};
  std::vector<Joint> joints_;
  std::vector<Pair> slope_, step_;
  std::vector<Block> diagonal_, beside_;
};

}  // namespace

Point3 place_in(const Cell& cell, const std::array<double, 4>& at) {
  Point3 p = {0, 0, 0};
  for (std::size_t i = 0; i < cell.corners; ++i)
    for (std::size_t d = 0; d < 3; ++d) p[d] += at[i] * cell.place[i][d];
  return p;
}

std::array<double, 4> CellString::place(const Cell& cell, std::size_t k) const {
  std::array<double, 4> at = {0, 0, 0, 0};
  const CellCrossing& crossing = crossings[k];
  for (std::size_t i = 0; i < crossing.face.corners; ++i)
    at[cell.corner(crossing.face.vertex[i])] = crossing.at[i];
  return at;
}

std::array<std::array<double, 4>, 2> CellString::leg(const Cell& cell, std::size_t k) const {
  std::array<std::array<double, 4>, 2> ends = {k == 0 ? start : place(cell, k - 1),
                                               k + 1 == cells.size() ? end : place(cell, k)};
  if (cell.corners == 2 && cell.vertex[0] == cell.vertex[1])  // a loop: to the nearer of its ends
    for (const std::size_t i : {0U, 1U})
      if (ends[i][0] == 1 || ends[i][1] == 1) {
        const bool second = ends[1 - i][1] > .5;
        ends[i] = {second ? 0. : 1., second ? 1. : 0.};
      }
  return ends;
}

double CellString::length(const Cells& all, std::size_t k) const {
  const Cell cell = all.cell(cells[k]);
  const auto [from, to] = leg(cell, k);
  return norm(minus(place_in(cell, to), place_in(cell, from)));
}

double CellString::length(const Cells& all) const {
  double sum = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) sum += length(all, k);
  return sum;
}

void pull_taut(const Cells& all, CellString& string) {
  if (string.crossings.empty()) return;
  const double before = string.length(all);
  CellString taut = string;
  Taut pull(all, string);
  pull.run();
  pull.give(taut);
  // What the barrier keeps off a corner or an edge by no more than rounding lies there.
  constexpr double close = 1e-9;
  CellString tidy = taut;
  for (CellCrossing& crossing : tidy.crossings) {
    double sum = 0;
    for (std::size_t i = 0; i < crossing.face.corners; ++i) {
      if (crossing.at[i] < close) crossing.at[i] = 0;
      sum += crossing.at[i];
    }
    for (std::size_t i = 0; i < crossing.face.corners; ++i) crossing.at[i] /= sum;
  }
  const double loose = taut.length(all), after = tidy.length(all);
  if (after <= loose * (1 + 1e-12)) taut = std::move(tidy);
  if (taut.length(all) < before) string = std::move(taut);
}

}  // namespace plexway::detail
