#include "complexes/surface/intrinsic/delaunay_flips.hpp"

#include <cmath>
#include <vector>

#include "complexes/common/building_blocks.hpp"

namespace plexway {
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

}  // namespace plexway
