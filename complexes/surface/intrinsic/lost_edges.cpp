#include "complexes/surface/intrinsic/lost_edges.hpp"

#include <algorithm>
#include <atomic>
#include <tuple>

namespace plexway {

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

}  // namespace plexway
