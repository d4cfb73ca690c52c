#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "labels/front.hpp"
#include "labels/straight_lines.hpp"
#include "labels/workspace_state.hpp"

namespace plexway::detail {

/// What `read_out_edges` did.
struct Lowered {
  bool any = false;
  std::size_t much = 0;  ///< vertices that got nearer by more than 1e-4
};

/// Distances that go down along edges. The result is the least over all ways, each summed from its
/// start, whoever goes first: rounding keeps order. Labels of equal ways are those of the first, so
/// they are one thread's work.
template <class Real, bool kLabels>
class EdgeReadOut {
 public:
  EdgeReadOut(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace)
      : mesh_(mesh),
        triangles_(mesh.triangles()),
        workspace_(workspace),
        rooms_(rooms_of(workspace)),
        distance_(workspace.vertex.data()) {}

  /// Looks at `faces` triangles, which(0) and so on, ascending; in all others nothing is reached.
  template <class Scheduler, class Which>
  Lowered run(const Scheduler& scheduler, std::size_t faces, const Which& which) {
    rooms_.start();
    if constexpr (kLabels) {
      Room& room = rooms_.take();
      scheduler.search(
          faces, [&](std::size_t n) { return wrong(which(n)); },
          [&](std::size_t n) { look(which(n), room); });
      rooms_.give_back(room);
    } else {
      std::mutex mutex;
      scheduler.over(faces, [&](std::size_t begin, std::size_t end) {
        Room* room = nullptr;
        {
          const std::scoped_lock lock(mutex);
          room = &rooms_.take();
        }
        for (std::size_t n = begin; n < end; ++n) look(which(n), *room);
        const std::scoped_lock lock(mutex);
        rooms_.give_back(*room);
      });
    }
    follow();
    Lowered lowered;
    for (const Room& room : rooms_.all) lowered.any |= !room.changes.empty();
    if (lowered.any) lowered.much = count_much();
    return lowered;
  }

 private:
  using Room = LoweringRoom<Real>;
  static LoweringRooms<Real>& rooms_of(WorkspaceState<Real>& workspace) {
    if (!workspace.lowering) workspace.lowering = std::make_unique<LoweringRooms<Real>>();
    return *workspace.lowering;
  }
  using Change = VertexDistance<Real>;

  [[nodiscard]] Real at(Index v) const {
    return std::atomic_ref(distance_[v]).load(std::memory_order_relaxed);
  }

  /// Not so where nothing is reached: there infinity is compared with itself.
  [[nodiscard]] bool wrong(std::size_t f) const {
    const TriangleRecord<Real>& t = triangles_[f];
    const Real a = at(t.corner[0]), b = at(t.corner[1]), c = at(t.corner[2]);
    const Real x = t.length[0], y = t.length[1], z = t.length[2];
    return std::abs(a - b) > x || std::abs(b - c) > y || std::abs(c - a) > z;
  }

  /// Calls keep(to, distance) if that is nearer.
  template <class Keep>
  void relax(Index from, Index to, Real length, std::vector<Change>& changes, const Keep& keep) {
    const Real now = at(from) + length;
    std::atomic_ref<Real> kept(distance_[to]);
    Real before = kept.load(std::memory_order_relaxed);
    if (!(before < std::numeric_limits<Real>::infinity())) return;
    do {
      if (!(now < before)) return;
    } while (!kept.compare_exchange_weak(before, now, std::memory_order_relaxed));
    changes.push_back({to, before});
    if constexpr (kLabels) workspace_.vertex_source[to] = workspace_.vertex_source[from];
    keep(to, now);
  }

  template <class Keep>
  void pass_on(Index v, std::vector<Index>& corners, std::vector<Change>& changes,
               const Keep& keep) {
    mesh_.corners_at(v, corners);
    for (const Index corner : corners) {
      const TriangleRecord<Real>& t = triangles_[corner / 3];
      const std::size_t i = corner % 3;
      relax(v, t.corner[edge_after(i)], t.length[i], changes, keep);
      relax(v, t.corner[edge_before(i)], t.length[edge_before(i)], changes, keep);
    }
    for (const auto& chord : mesh_.chords_at(v))
      relax(v, chord.vertex, chord.length, changes, keep);
  }

  /// Nearly all that there is to lower is found here and lowers nothing further: so it is passed on
  /// while it is in the cache, not in Dijkstra's order, which jumps to and fro; but for what hubs
  /// of many triangles would make dear.
  void look(std::size_t f, Room& room) {
    if (!wrong(f)) [[likely]]
      return;
    const TriangleRecord<Real>& t = triangles_[f];
    std::array<Change, 6> found;
    std::size_t count = 0;
    const auto keep = [&](Index v, Real d) { found[count++] = {v, d}; };
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = t.corner[i], w = t.corner[edge_after(i)];
      relax(v, w, t.length[i], room.changes, keep);
      relax(w, v, t.length[i], room.changes, keep);
    }
    room.most += 32;
    const auto wait = [&](Index v, Real d) { room.waiting.push_back({v, d}); };
    for (std::size_t i = 0; i < count; ++i) {
      const auto [v, d] = found[i];
      if (at(v) != d) continue;  // nearer still by now, and kept again
      if (room.seen < room.most) {
        pass_on(v, room.corners, room.changes, wait);
        room.seen += room.corners.size();
      } else {
        wait(v, d);
      }
    }
  }

  /// In Dijkstra's order: each gets its last distance once.
  void follow() {
    PriorityQueue<Real> nearer(workspace_.front);
    const auto push = [&](Index v, Real d) { nearer.push(v, d); };
    for (const Room& room : rooms_.all)
      for (const auto& [v, d] : room.waiting) push(v, d);
    std::vector<Change>& changes = rooms_.all.front().changes;
    if (mesh_.has_chords())
      for (Index v = 0; v < mesh_.vertex_count(); ++v)
        for (const auto& chord : mesh_.chords_at(v))
          relax(v, chord.vertex, chord.length, changes, push);
    for (Index v = 0; nearer.pop(v, [&](Index w) { return at(w); });)
      pass_on(v, workspace_.corners, changes, push);
  }

  [[nodiscard]] std::size_t count_much() {
    std::vector<Index>& much = rooms_.lowered;
    much.clear();
    for (const Room& room : rooms_.all)
      for (const auto& [v, before] : room.changes)
        if (at(v) < before * Real(1 - 1e-4)) much.push_back(v);
    std::sort(much.begin(), much.end());
    return static_cast<std::size_t>(std::unique(much.begin(), much.end()) - much.begin());
  }

  const TriangleMesh<Real>& mesh_;
  std::span<const TriangleRecord<Real>> triangles_;
  WorkspaceState<Real>& workspace_;
  LoweringRooms<Real>& rooms_;
  Real* distance_;
};

/// No vertex is farther than a neighbour and the edge between, or the chord. A triangle keeps one
/// label, the best for its centre, and now and then, at a corner on a ragged boundary, that one is
/// poor. The same bits with any scheduler. Cost: one pass, and n log n for the n vertices near what
/// it changes.
template <class Real, bool kLabels, class Scheduler, class Which>
Lowered read_out_edges(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace,
                       const Scheduler& scheduler, std::size_t faces, const Which& which) {
  return EdgeReadOut<Real, kLabels>(mesh, workspace).run(scheduler, faces, which);
}
template <class Real, bool kLabels, class Scheduler>
Lowered read_out_edges(const TriangleMesh<Real>& mesh, WorkspaceState<Real>& workspace,
                       const Scheduler& scheduler) {
  return read_out_edges<Real, kLabels>(mesh, workspace, scheduler, mesh.face_count(),
                                       [](std::size_t f) { return f; });
}

}  // namespace plexway::detail

namespace plexway::detail::surface {
/// What `repair` did.
struct Repaired {
  std::size_t raised = 0;   ///< vertices below the straight line, by more than 1e-3
  std::size_t lowered = 0;  ///< vertices that got nearer by more than 1e-4
};

/// What a bounded solve reached, in the numbers inside, ascending.
struct Reached {
  std::vector<Index> vertices, triangles;  ///< those with a corner there

  /// Takes the vertices, and finds the triangles.
  template <class Real>
  void find_triangles(const TriangleMesh<Real>& mesh) {
    triangles.clear();
    std::vector<Index> corners;
    for (const Index v : vertices) {
      mesh.corners_at(v, corners);
      for (const Index corner : corners) triangles.push_back(corner / 3);
    }
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  }
};

/// Distances at vertices that can only be wrong: those below the straight line in space, from
/// `sources` that are nothing but points (none: not looked at), and those above a neighbour's and
/// the edge between. Looks at what was reached alone, if that is known (else null), as all else is
/// right.
template <class Real, bool kLabels, class Scheduler>
Repaired repair(const TriangleMesh<Real>& mesh, std::span<const PointSource> sources,
                WorkspaceState<Real>& workspace, const Scheduler& scheduler,
                const Reached* reached = nullptr) {
  const StraightLines<Real> lines(mesh, sources);
  const auto raise = [&] {
    if (reached == nullptr) return lines.template raise<kLabels>(workspace, scheduler);
    return lines.template raise<kLabels>(workspace, scheduler, reached->vertices.size(),
                                         [&](std::size_t n) { return reached->vertices[n]; });
  };
  Repaired repaired;
  repaired.raised = raise();
  const Lowered lowered =
      reached == nullptr
          ? read_out_edges<Real, kLabels>(mesh, workspace, scheduler)
          : read_out_edges<Real, kLabels>(mesh, workspace, scheduler, reached->triangles.size(),
                                          [&](std::size_t n) { return reached->triangles[n]; });
  repaired.lowered = lowered.much;
  // What sums of many edges lost by rounding.
  if (lowered.any) raise();
  return repaired;
}

}  // namespace plexway::detail::surface
