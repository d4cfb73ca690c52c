#include "complex/delaunay_flips.hpp"

#include <cmath>

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

void DelaunayFlips::all() {
  const auto triangles = triangulation_.triangles();
  for (Index slot = 0; slot < triangles.size(); ++slot)
    for (Index edge = 0; edge < 3; ++edge) {
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
