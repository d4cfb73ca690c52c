#include "complex/lost_edges.hpp"

#include <algorithm>
#include <tuple>

namespace plexway {

void add_chord(std::vector<SurfaceChord>& to, Index v, Index w, double length) {
  if (v != w) to.push_back({std::min(v, w), std::max(v, w), length});
}

std::vector<SurfaceChord> lost_edges(std::vector<SurfaceChord> then,
                                     const IntrinsicTriangulation& now, std::size_t input_faces) {
  std::vector<SurfaceChord> there;
  for (Index s = 0; s < now.triangles().size(); ++s) {
    if (s < input_faces && !now.history().changed(s)) continue;
    const IntrinsicTriangle& t = now.triangles()[s];
    for (std::size_t i = 0; i < 3; ++i)
      add_chord(there, t.corner[i], t.corner[edge_after(i)], t.length[i]);
  }
  const auto less = [](const SurfaceChord& a, const SurfaceChord& b) {
    return std::tie(a.from, a.to, a.length) < std::tie(b.from, b.to, b.length);
  };
  // Of several between the same ends the shortest counts.
  const auto shortest = [&](std::vector<SurfaceChord>& all) {
    std::sort(all.begin(), all.end(), less);
    all.erase(std::unique(all.begin(), all.end(),
                          [](const SurfaceChord& a, const SurfaceChord& b) {
                            return a.from == b.from && a.to == b.to;
                          }),
              all.end());
  };
  shortest(then);
  shortest(there);
  auto known = there.begin();
  std::erase_if(then, [&](const SurfaceChord& chord) {
    while (known != there.end() &&
           std::tie(known->from, known->to) < std::tie(chord.from, chord.to))
      ++known;
    return known != there.end() && known->from == chord.from && known->to == chord.to &&
           known->length <= chord.length * (1 + 1e-12);
  });
  return then;
}

}  // namespace plexway
