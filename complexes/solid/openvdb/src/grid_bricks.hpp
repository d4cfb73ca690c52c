#pragma once

#include <openvdb/openvdb.h>

#include <plexway/error.hpp>

#include "bricks.hpp"

namespace plexway::openvdb {

/// The affine map of a grid. Throws InputError for one that is not, a frustum.
inline Frame frame_of(const ::openvdb::math::Transform& transform) {
  if (!transform.isLinear())
    throw InputError("its transform is a frustum; resample it to one with parallel voxels");
  const auto at = [&](double x, double y, double z) {
    const ::openvdb::Vec3d p = transform.indexToWorld(::openvdb::Vec3d(x, y, z));
    return Vector{p.x(), p.y(), p.z()};
  };
  Frame frame;
  frame.origin = at(0, 0, 0);
  const std::array<Vector, 3> ends = {at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t k = 0; k < 3; ++k) frame.axes[a][k] = ends[a][k] - frame.origin[k];
  const double volume = std::abs(frame.determinant());
  if (!(volume > 0) || !std::isfinite(volume))
    throw InputError("its transform makes voxels without volume");
  return frame;
}

/// Hands out the leaves of a level set's tree and the tiles inside, cut into bricks. Serial: no
/// threads of TBB are needed. Throws InputError where there is too much of it.
template <class Tree>
void hand_out(const Tree& tree, const BrickTaker& take) {
  const auto corner_of = [](const ::openvdb::Coord& c) {
    const Cell corner = {c.x() >> 3, c.y() >> 3, c.z() >> 3};
    if (!BrickNumbers::in_range(corner))
      throw InputError("it lies too far from the origin of its grid");
    return corner;
  };
  std::array<float, 512> values;
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    static_assert(Tree::LeafNodeType::SIZE == 512);
    bool damaged = false;
    for (::openvdb::Index i = 0; i < 512; ++i) {
      values[i] = static_cast<float>(leaf->getValue(i));
      damaged = damaged || std::isnan(values[i]);
    }
    if (damaged) throw InputError("a value is not a number");
    take(corner_of(leaf->origin()), values.data());
  }
  std::size_t bricks = 0;
  auto tile = tree.cbeginValueAll();
  tile.setMaxDepth(Tree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    if (std::isnan(*tile)) throw InputError("a value is not a number");
    if (!(*tile < 0)) continue;
    ::openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    const Cell first = corner_of(box.min()), last = corner_of(box.max());
    bricks += static_cast<std::size_t>(last[0] - first[0] + 1) *
              static_cast<std::size_t>(last[1] - first[1] + 1) *
              static_cast<std::size_t>(last[2] - first[2] + 1);
    if (bricks > BrickNumbers::most_inside) throw InputError("more than 2^31 voxels lie inside");
    for (Cell c = first; c[0] <= last[0]; ++c[0])
      for (c[1] = first[1]; c[1] <= last[1]; ++c[1])
        for (c[2] = first[2]; c[2] <= last[2]; ++c[2]) take(c, nullptr);
  }
}

}  // namespace plexway::openvdb
