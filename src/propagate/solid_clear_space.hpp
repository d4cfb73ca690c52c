#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>

namespace plexway {

/// How far the boundary of a solid is, roughly: a grid of cubes, each with the number of cubes
/// around it, in every direction, that no boundary face touches. A straight line through these need
/// not be walked from tetrahedron to tetrahedron.
///
/// Empty where it would not help: for lengths alone, in convex solids, and where walls are near
/// everywhere, or faces so long that they touch most cubes. Parts where a solid overlaps itself in
/// space count as touched. Cost: linear, about 50 ns a tetrahedron; memory: up to 10 bytes a
/// tetrahedron.
template <class Real>
class SolidClearSpace {
 public:
  using Point = Vector3<Real>;

  [[nodiscard]] bool empty() const { return level_.empty(); }
  [[nodiscard]] std::uint64_t identity() const { return identity_; }

  /// Of another solid, in the memory that there is.
  void measure(const TetMesh<Real>& mesh);

  /// A part of a line, as shares of it, that lies in cubes without boundary.
  struct Run {
    Real begin, end;
    Index tet;  ///< has its centre in the cube that `end` is in; none: there is no such part
  };
  /// The first from `after` on that is at least `least` long, as far as one need look.
  [[nodiscard]] Run next(const Point& from, const Point& to, Real after, Real least) const;

 private:
  using Cell = std::array<int, 3>;
  [[nodiscard]] std::size_t at(const Cell& c) const {
    return static_cast<std::size_t>((c[2] * count_[1] + c[1]) * count_[0] + c[0]);
  }
  [[nodiscard]] Cell cell_of(const Point& p) const {
    const Real x[3] = {p.x, p.y, p.z};
    Cell c;
    for (std::size_t d = 0; d < 3; ++d)
      c[d] = static_cast<int>(
          std::clamp((x[d] - low_[d]) * per_length_, Real(0), static_cast<Real>(count_[d] - 1)));
    return c;
  }
  void fill(const TetMesh<Real>& mesh);
  bool mark_boundary(const TetMesh<Real>& mesh);
  void spread();
  void settle_tets(const TetMesh<Real>& mesh);

  std::uint64_t identity_ = 0;
  Cell count_ = {0, 0, 0};
  std::array<Real, 3> low_ = {0, 0, 0};
  Real side_ = 1, per_length_ = 1;
  std::vector<std::uint8_t> level_;  // 0: touched by the boundary; k: so are none nearer than k
  std::vector<Index> tet_;           // one with its centre there, or none
  std::vector<Index> part_;          // of cubes that faces join: while it is made
  std::vector<Index> stack_;
};

template <class Real>
void SolidClearSpace<Real>::measure(const TetMesh<Real>& mesh) {
  identity_ = 0;  // of none, should memory run out
  fill(mesh);
  identity_ = mesh.identity();
}

template <class Real>
void SolidClearSpace<Real>::fill(const TetMesh<Real>& mesh) {
  level_.clear();
  tet_.clear();
  if (!mesh.embedded() || mesh.reflex_edges().empty() || mesh.tet_count() < 1000) return;
  std::array<Real, 3> high;
  low_.fill(std::numeric_limits<Real>::infinity());
  high.fill(-std::numeric_limits<Real>::infinity());
  for (std::size_t t = 0; t < mesh.tet_count(); ++t) {
    for (const Index v : mesh.tets()[t].corner) {
      const Point& p = mesh.points()[v];
      const Real x[3] = {p.x, p.y, p.z};
      for (std::size_t d = 0; d < 3; ++d) {
        low_[d] = std::min(low_[d], x[d]);
        high[d] = std::max(high[d], x[d]);
      }
    }
  }
  // Half an edge wide, unless that makes more cubes than tetrahedra.
  side_ = Real(0.5);
  const double most = 2 * static_cast<double>(mesh.tet_count());
  for (;; side_ *= Real(1.25)) {
    double cubes = 1;
    for (std::size_t d = 0; d < 3; ++d)
      cubes *= std::floor(static_cast<double>((high[d] - low_[d]) / side_)) + 1;
    if (cubes <= most) break;
  }
  per_length_ = 1 / side_;
  std::size_t cubes = 1;
  for (std::size_t d = 0; d < 3; ++d) {
    count_[d] = static_cast<int>((high[d] - low_[d]) * per_length_) + 1;
    cubes *= static_cast<std::size_t>(count_[d]);
  }
  level_.assign(cubes, 255);
  tet_.assign(cubes, none);
  if (!mark_boundary(mesh)) {
    level_.clear();
    return;
  }
  settle_tets(mesh);
  spread();
  // Where walls are near everywhere, looking for room costs more than walking.
  const auto roomy = std::count_if(level_.begin(), level_.end(), [](auto l) { return l > 1; });
  if (2 * static_cast<std::size_t>(roomy) < level_.size()) level_.clear();
  std::vector<Index>().swap(part_);
  std::vector<Index>().swap(stack_);
}

// False if it is too much work to be worth it.
template <class Real>
bool SolidClearSpace<Real>::mark_boundary(const TetMesh<Real>& mesh) {
  constexpr Index opposite[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
  const Real margin = Real(0.01);  // lines are walked a thousandth beside strings
  const Index sentinel = static_cast<Index>(mesh.tet_count());
  std::size_t left = 16 * level_.size();
  for (Index t = 0; t < sentinel; ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      if (mesh.tets()[t].across[i] >> TetAcross::tet_shift != sentinel) continue;
      Point low = mesh.points()[mesh.tets()[t].corner[opposite[i][0]]], high = low;
      for (std::size_t k = 1; k < 3; ++k) {
        const Point& p = mesh.points()[mesh.tets()[t].corner[opposite[i][k]]];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
      const Point wider = {margin, margin, margin};
      const Cell first = cell_of(low - wider), last = cell_of(high + wider);
      std::size_t here = 1;
      for (std::size_t d = 0; d < 3; ++d) here *= static_cast<std::size_t>(last[d] - first[d] + 1);
      if (here > left) return false;
      left -= here;
      Cell c;
      for (c[2] = first[2]; c[2] <= last[2]; ++c[2])
        for (c[1] = first[1]; c[1] <= last[1]; ++c[1])
          for (c[0] = first[0]; c[0] <= last[0]; ++c[0]) level_[at(c)] = 0;
    }
  return true;
}

// A tetrahedron for each cube. Cubes without boundary that hang together are covered by
// tetrahedra everywhere equally often: more than once where the solid overlaps itself, and then no
// cube knows in which sheet a line is. So small that their volume does not tell: left alone.
template <class Real>
void SolidClearSpace<Real>::settle_tets(const TetMesh<Real>& mesh) {
  constexpr std::size_t least_cubes = 27;
  part_.assign(level_.size(), none);
  std::vector<double> volume, cubes;
  for (Index seed = 0; seed < level_.size(); ++seed) {
    if (level_[seed] == 0 || part_[seed] != none) continue;
    const Index part = static_cast<Index>(volume.size());
    volume.push_back(0);
    cubes.push_back(0);
    stack_.assign(1, seed);
    part_[seed] = part;
    while (!stack_.empty()) {
      const Index cube = stack_.back();
      stack_.pop_back();
      ++cubes[part];
      Cell c = {static_cast<int>(cube) % count_[0], static_cast<int>(cube) / count_[0] % count_[1],
                static_cast<int>(cube) / count_[0] / count_[1]};
      for (std::size_t d = 0; d < 3; ++d)
        for (const int step : {-1, 1}) {
          Cell o = c;
          o[d] += step;
          if (o[d] < 0 || o[d] >= count_[d]) continue;
          const std::size_t other = at(o);
          if (level_[other] == 0 || part_[other] != none) continue;
          part_[other] = part;
          stack_.push_back(static_cast<Index>(other));
        }
    }
  }
  for (Index t = 0; t < mesh.tet_count(); ++t) {
    const TetRecord<Real>& record = mesh.tets()[t];
    const std::size_t cube = at(cell_of(record.centre));
    if (level_[cube] == 0) continue;
    if (tet_[cube] == none) tet_[cube] = t;
    const Point &a = mesh.points()[record.corner[0]], &b = mesh.points()[record.corner[1]],
                &c = mesh.points()[record.corner[2]], &d = mesh.points()[record.corner[3]];
    volume[part_[cube]] += std::abs(static_cast<double>(dot(cross(b - a, c - a), d - a))) / 6;
  }
  const double cube_volume = std::pow(static_cast<double>(side_), 3);
  for (std::size_t cube = 0; cube < level_.size(); ++cube) {
    if (level_[cube] == 0) continue;
    const Index part = part_[cube];
    if (cubes[part] < least_cubes || volume[part] > 1.5 * cubes[part] * cube_volume)
      level_[cube] = 0;
  }
}

// From the boundary, once forth and once back: of all that touch a cube, corners too.
template <class Real>
void SolidClearSpace<Real>::spread() {
  const auto pass = [&](int step) {
    Cell c;
    const auto run = [&](std::size_t d, const auto& inner) {
      for (int i = 0; i < count_[d]; ++i) {
        c[d] = step > 0 ? i : count_[d] - 1 - i;
        inner();
      }
    };
    run(2, [&] {
      run(1, [&] {
        run(0, [&] {
          int level = level_[at(c)];
          // The thirteen that come before it.
          for (int n = 0; n < 13 && level > 0; ++n) {
            const Cell o = {c[0] + step * (n % 3 - 1), c[1] + step * (n / 3 % 3 - 1),
                            c[2] + step * (n / 9 - 1)};
            const bool within = o[0] >= 0 && o[0] < count_[0] && o[1] >= 0 && o[1] < count_[1] &&
                                o[2] >= 0 && o[2] < count_[2];
            level = std::min(level, within ? level_[at(o)] + 1 : 1);
          }
          level_[at(c)] = static_cast<std::uint8_t>(level);
        });
      });
    });
  };
  pass(-1);
  pass(1);
}

template <class Real>
typename SolidClearSpace<Real>::Run SolidClearSpace<Real>::next(const Point& from, const Point& to,
                                                                Real after, Real least) const {
  const Point way = to - from;
  const Real most = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
  const Real cube = side_ / most;  // as a share of the line; so far it may leave a cube
  const Run nothing = {0, 0, none};
  Run run = nothing;
  bool clear = false;
  const auto good = [&] { return clear && run.tet != none && run.end - run.begin >= least; };
  for (Real s = after;;) {
    const std::size_t here = at(cell_of(from + s * way));
    const int around = level_[here] - 1;  // so many cubes in each direction are clear, and this one
    if (around < 1) {
      if (good()) return run;
      clear = false;
    } else {
      if (!clear) run = {s, s, none};
      clear = true;
      if (tet_[here] != none) {
        run.tet = tet_[here];
        run.end = s;
      }
    }
    if (s >= 1) return good() ? run : nothing;
    s = std::min(s + cube * static_cast<Real>(clear ? around : 2), Real(1));
  }
}

}  // namespace plexway
