#include "complexes/surface/intrinsic/delaunay_flips.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>
#include <vector>

#include "complexes/common/building_blocks.hpp"

namespace plexway::detail {
namespace {

constexpr std::uint32_t patience = 4096, growth = 16;

}  // namespace

bool DelaunayFlips::should_flip(Halfedge h) {
  const double excess = triangulation_.excess(h);
  if (!(excess > tolerance_)) return false;
  const std::uint32_t flips = triangulation_.flips(h);
  if (flips < patience) return true;
  may_be_stuck_ = true;
  return excess > std::ldexp(tolerance_, static_cast<int>((flips - patience) / growth));
}

void DelaunayFlips::all(int threads) {
  const auto triangles = triangulation_.triangles();
  const std::size_t slots = triangles.size();
  // Which edges are not Delaunay before the first flip, bit by bit.
  std::vector<unsigned char> suspects(slots);
  over_blocks(slots, threads, [&](std::size_t first, std::size_t last) {
    for (std::size_t slot = first; slot < last; ++slot) {
      unsigned bits = 0;
      for (Index edge = 0; edge < 3; ++edge) {
        const Halfedge h = static_cast<Index>(slot) << Across::face_shift | edge;
        if (triangles[slot].across[edge] > h && triangulation_.excess(h) > tolerance_)
          bits |= 1u << edge;
      }
      suspects[slot] = static_cast<unsigned char>(bits);
    }
  });
  // A flip has the four edges around it looked at. So all that is left are those that were suspect
  // and, of a slot that was flipped, the edge that came of its last flip.
  constexpr unsigned of_flip = 1u << 1;
  for (Index slot = 0; slot < slots; ++slot)
    for (Index edge = 0; edge < 3; ++edge) {
      const unsigned looks = triangulation_.history().changed(slot) ? of_flip : suspects[slot];
      if ((looks >> edge & 1) == 0) continue;
      // From its lower side: what a flip moves is looked at again by itself.
      const Halfedge h = slot << Across::face_shift | edge;
      if (triangles[slot].across[edge] > h) from(h, [](Index) {});
    }
}

std::size_t DelaunayFlips::stuck() const {
  if (!may_be_stuck_) return 0;
  std::size_t halfedges = 0;
  for (Index slot = 0; slot < triangulation_.triangles().size(); ++slot)
    for (Index edge = 0; edge < 3; ++edge)
      halfedges += triangulation_.excess(slot << Across::face_shift | edge) > tolerance_;
  return halfedges / 2;
}

// Calls visit(lower, upper, length), from one side of each, but for those from a vertex to itself.
template <class Visit>
void LostEdges::for_changed_edges(int threads, const Visit& visit) const {
  over_blocks(now_.triangles().size(), threads, [&](std::size_t first, std::size_t last) {
    for (Index s = static_cast<Index>(first); s < last; ++s) {
      if (s < input_faces_ && !now_.history().changed(s)) continue;
      const IntrinsicTriangle& t = now_.triangles()[s];
      for (std::size_t i = 0; i < 3; ++i) {
        const Index v = t.corner[i], w = t.corner[edge_after(i)];
        if (v != w && !told_by_other_side(s, t.across[i]))
          visit(std::min(v, w), std::max(v, w), t.length[i]);
      }
    }
  });
}

LostEdges::LostEdges(const IntrinsicTriangulation& now, std::size_t input_faces, int threads)
    : now_(now), input_faces_(input_faces), end_(now.vertices() + 1, 0) {
  const bool alone = threads_for(threads) == 1;
  const auto up = [alone](Index& count) {
    return alone ? count++ : std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
  };
  for_changed_edges(threads, [&](Index lower, Index, double) { up(end_[lower + 1]); });
  for (std::size_t v = 0; v + 1 < end_.size(); ++v) end_[v + 1] += end_[v];
  edges_.resize(end_.back());
  for_changed_edges(threads, [&](Index lower, Index upper, double length) {
    edges_[up(end_[lower])] = {upper, length};
  });
}

void LostEdges::look_at(Index v, Index w, double length, std::vector<SurfaceChord>& lost) const {
  if (v == w) return;
  const Index lower = std::min(v, w), upper = std::max(v, w);
  for (Index e = lower == 0 ? 0 : end_[lower - 1]; e < end_[lower]; ++e)
    if (edges_[e].upper == upper && edges_[e].length <= length * (1 + 1e-12)) return;
  lost.push_back({lower, upper, length});
}

std::vector<SurfaceChord> LostEdges::sorted(std::vector<SurfaceChord> lost) {
  std::sort(lost.begin(), lost.end(), [](const SurfaceChord& a, const SurfaceChord& b) {
    return std::tie(a.from, a.to, a.length) < std::tie(b.from, b.to, b.length);
  });
  lost.erase(std::unique(lost.begin(), lost.end(),
                         [](const SurfaceChord& a, const SurfaceChord& b) {
                           return a.from == b.from && a.to == b.to;
                         }),
             lost.end());
  return lost;
}

}  // namespace plexway::detail
