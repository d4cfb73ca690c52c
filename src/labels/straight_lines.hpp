#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <plexway/source/point_source.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/box_tree.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// Where a source lies in space, in units of the mean edge, and its offset.
struct SourcePlace {
  std::array<double, 3> at{};
  double sigma = 0;
};

/// What is nearer than the straight line by more than this share of it is counted.
inline constexpr double much_nearer = 1e-3;

/// No path on a surface in space is shorter than the straight line: a distance that is can only be
/// wrong, and gets the line's length, which is nearer to the truth. Where coordinates are not known
/// nothing is checked.
template <class Real>
class StraightLines {
 public:
  StraightLines(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources)
      : mesh_(&mesh), positions_(mesh.positions()), sources_(sources), count_(sources.size()) {}
  /// To vertices at these positions, from sources of which their places are known.
  StraightLines(std::span<const std::array<double, 3>> positions,
                std::span<const SourcePlace> places)
      : positions_(positions), places_(places), count_(places.size()) {}

  /// Raises what is below, by more than rounding. Returns how many were by more than `much_nearer`.
  /// Cost: 24 bytes read a vertex; and for one that is below the line to its own source, as
  /// rounding leaves every other in the plane, the sources that lie about as near.
  template <bool kLabels, class Scheduler>
  std::size_t raise(WorkspaceState<Real>& workspace, const Scheduler& scheduler) const {
    return raise<kLabels>(workspace, scheduler, workspace.vertex.size(),
                          [](std::size_t v) { return v; });
  }
  /// Of `count` vertices, which(0) and so on; all others are right.
  template <bool kLabels, class Scheduler, class Which>
  std::size_t raise(WorkspaceState<Real>& workspace, const Scheduler& scheduler, std::size_t count,
                    const Which& which) const {
    if (positions_.empty() || count_ == 0) return 0;
    std::atomic<std::size_t> raised{0};
    scheduler.over(count, [&](std::size_t begin, std::size_t end) {
      std::size_t some = 0;
      Line line(*this, 0);
      for (std::size_t n = begin; n < end; ++n) {
        const std::size_t v = which(n);
        Real& d = workspace.vertex[v];
        if constexpr (kLabels) {
          if (workspace.vertex_source[v] >= count_) continue;
          if (workspace.vertex_source[v] != line.source)
            line = Line(*this, workspace.vertex_source[v]);
        }
        if (!line.longer_than(d, positions_[v])) [[likely]]
          continue;
        const double least = least_line(v, line);
        some += static_cast<double>(d) < least * (1 - much_nearer);
        d = std::max(d, static_cast<Real>(least));
      }
      raised += some;
    });
    return raised;
  }

  /// One vertex, by its number inside, at distance d from a source.
  [[nodiscard]] Real raised(std::size_t v, Real d, Index source) const {
    if (positions_.empty() || source >= count_) return d;
    const Line line(*this, source);
    if (!line.longer_than(d, positions_[v])) return d;
    return std::max(d, static_cast<Real>(least_line(v, line)));
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  /// So many lines are measured one after the other: nothing is allocated.
  static constexpr std::size_t few = 8;

  // From one source to any vertex.
  struct Line {
    Line(const StraightLines& lines, Index number) : source(number) {
      if (lines.mesh_ == nullptr) {
        sigma = lines.places_[number].sigma;
        at[0] = lines.places_[number].at;
        return;
      }
      const PointSource& s = lines.sources_[number];
      sigma = s.offset / lines.mesh_->unit();
      if (s.vertex != none) {
        at[0] = lines.positions_[lines.mesh_->inside_vertex(s.vertex)];
        return;
      }
      const auto [f, turned] = lines.mesh_->inside_face(s.simplex);
      const TriangleRecord<Real>& t = lines.mesh_->triangles()[f];
      std::array<double, 4> b = s.barycentric;
      if (turned) std::swap(b[1], b[2]);
      if (lines.mesh_->faces_are_in_space()) {
        at[0] = {0, 0, 0};
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t k = 0; k < 3; ++k) at[0][k] += b[i] * lines.positions_[t.corner[i]][k];
        return;
      }
      // The triangle lies in space somehow, but its corners are known, and the ways to them.
      const double px[3] = {0, static_cast<double>(t.length[0]), static_cast<double>(t.apex_x(0))};
      const double py[3] = {0, 0, static_cast<double>(t.apex_h(0))};
      const double x = b[1] * px[1] + b[2] * px[2], y = b[2] * py[2];
      for (std::size_t i = 0; i < 3; ++i) {
        at[i] = lines.positions_[t.corner[i]];
        back[i] = std::hypot(px[i] - x, py[i] - y);
      }
      ends = 3;
    }

    static double squared(const std::array<double, 3>& p, const std::array<double, 3>& q) {
      const double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
      return x * x + y * y + z * z;
    }
    [[nodiscard]] double length(const std::array<double, 3>& p) const {
      double most = 0;  // NaN: not known, so nothing is
      for (std::size_t i = 0; i < ends; ++i)
        most = std::max(most, std::sqrt(squared(p, at[i])) - back[i]);
      return sigma + most;
    }
    /// By more than rounding.
    [[nodiscard, gnu::always_inline]] bool longer_than(Real d,
                                                       const std::array<double, 3>& p) const {
      constexpr double slack = 1 + (sizeof(Real) == 4 ? 1 : 64) *
                                       static_cast<double>(std::numeric_limits<Real>::epsilon());
      double most = -infinity;
      for (std::size_t i = 0; i < ends; ++i) {
        const double way = std::max(0.0, static_cast<double>(d) * slack - sigma + back[i]);
        most = std::max(most, squared(p, at[i]) - way * way);
      }
      return most > 0;
    }

    /// No line from here is shorter than from this box, this much along a fourth axis. A place that
    /// is not known is everywhere.
    [[nodiscard]] Box<4> box() const {
      constexpr double far = 1e150;
      const double way = sigma - back[0];
      if (!(std::abs(at[0][0]) + std::abs(at[0][1]) + std::abs(at[0][2]) < far))
        return {{-far, -far, -far, way}, {far, far, far, way}};
      return {{at[0][0], at[0][1], at[0][2], way}, {at[0][0], at[0][1], at[0][2], way}};
    }

    Index source;
    double sigma = 0;
    std::size_t ends = 1;
    std::array<std::array<double, 3>, 3> at{};
    std::array<double, 3> back{};
  };

  /// The shortest line to a vertex, of which one is known.
  [[nodiscard]] double least_line(std::size_t v, const Line& known) const {
    const std::array<double, 3>& p = positions_[v];
    double least = known.length(p);
    if (count_ <= few) {
      for (Index n = 0; n < count_; ++n)
        if (n != known.source) least = std::min(least, Line(*this, n).length(p));
      return least;
    }
    std::call_once(grown_, [&] {
      std::vector<Box<4>> boxes;
      for (Index n = 0; n < count_; ++n) boxes.push_back(Line(*this, n).box());
      by_place_ = BoxTree<4>(boxes);
    });
    const auto may_be_shorter = [&](const Box<4>& box) {
      const Box<3> place = {{box.low[0], box.low[1], box.low[2]},
                            {box.high[0], box.high[1], box.high[2]}};
      return !(box.low[3] + place.distance(p) >= least);
    };
    by_place_.search(may_be_shorter,
                     [&](Index n) { least = std::min(least, Line(*this, n).length(p)); });
    return least;
  }

  const TriangleMesh<Real>* mesh_ = nullptr;
  std::span<const std::array<double, 3>> positions_;
  std::span<const PointSource> sources_;
  std::span<const SourcePlace> places_;
  std::size_t count_ = 0;  ///< of sources
  mutable std::once_flag grown_;
  mutable BoxTree<4> by_place_;
};

}  // namespace plexway::detail
