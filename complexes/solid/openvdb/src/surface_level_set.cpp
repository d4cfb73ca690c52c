#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/openvdb/surface.hpp>

#include "answer.hpp"
#include "closing.hpp"
#include "grid_bricks.hpp"

namespace plexway::openvdb {
namespace {

double distance(const Vector& a, const Vector& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

struct Extent {
  double diagonal = 0, mean_edge = 0, area = 0, farthest = 0;
};

Extent extent_of(const ClosedSurface& surface) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vector low = {far, far, far}, high = {-far, -far, -far};
  Extent extent;
  for (const auto& t : surface.triangles) {
    std::array<double, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector& p = surface.positions[t[i]];
      side[i] = distance(p, surface.positions[t[(i + 1) % 3]]);
      extent.mean_edge += side[i] / (3.0 * static_cast<double>(surface.triangles.size()));
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], p[k]);
        high[k] = std::max(high[k], p[k]);
        extent.farthest = std::max(extent.farthest, std::abs(p[k]));
      }
    }
    const double half = (side[0] + side[1] + side[2]) / 2;
    extent.area +=
        std::sqrt(std::max(0.0, half * (half - side[0]) * (half - side[1]) * (half - side[2])));
  }
  extent.diagonal = distance(low, high);
  return extent;
}

double choose_voxel(const Extent& extent, double asked) {
  if (asked != 0 && (!(asked > 0) || !std::isfinite(asked)))
    throw UsageError("the voxel must be 0, to have it chosen, or a number above 0");
  if (!(extent.diagonal > 0)) throw InputError("all vertices lie at one place");
  const double voxel =
      asked > 0 ? asked
                : std::clamp(extent.mean_edge / 2, extent.diagonal / 128, extent.diagonal / 32);
  if (voxel > extent.diagonal)
    throw UsageError("the voxel " + text_of(voxel) + " is larger than the whole surface, " +
                     text_of(extent.diagonal) + " across; choose a smaller one");
  // Six voxels across the surface, and a few numbers for each.
  if (6 * extent.area / (voxel * voxel) > 1e9)
    throw UsageError("the voxel " + text_of(voxel) +
                     " is too small: more than 10^9 voxels near the surface");
  if (extent.farthest / voxel > 8.0 * (BrickNumbers::far - 4))
    throw UsageError("the voxel " + text_of(voxel) +
                     " is too small for a surface so far from the origin");
  // Values are floats, and a voxel's volume a double.
  if (!(voxel > 1e-36 && voxel < 1e36))
    throw InputError("a surface that is " + text_of(extent.diagonal) +
                     " across is beyond what a level set can hold; scale it");
  return voxel;
}

// The surface in voxels, as meshToVolume takes it: floats, of the type that the library itself was
// compiled for, around the middle, so that one far from the origin loses nothing.
class Mesh {
 public:
  Mesh(const ClosedSurface& surface, double voxel) {
    Vector low = surface.positions[surface.triangles[0][0]], high = low;
    for (const auto& t : surface.triangles)
      for (const Index v : t)
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], surface.positions[v][k]);
          high[k] = std::max(high[k], surface.positions[v][k]);
        }
    for (std::size_t k = 0; k < 3; ++k)
      middle_[k] = static_cast<std::int32_t>(std::round((low[k] + high[k]) / 2 / voxel / 8));
    for (const Vector& p : surface.positions) {
      ::openvdb::Vec3s at;
      for (int k = 0; k < 3; ++k) {
        const auto n = static_cast<std::size_t>(k);
        at[k] = static_cast<float>(p[n] / voxel - 8.0 * middle_[n]);
      }
      points_.push_back(at);
    }
    for (const auto& t : surface.triangles) triangles_.emplace_back(t[0], t[1], t[2]);
  }
  using Adapter = ::openvdb::tools::QuadAndTriangleDataAdapter<::openvdb::Vec3s, ::openvdb::Vec3I>;
  [[nodiscard]] Adapter adapter() const { return {points_, triangles_}; }
  /// A brick around the middle, where it is.
  [[nodiscard]] Cell placed(const Cell& c) const {
    return {c[0] + middle_[0], c[1] + middle_[1], c[2] + middle_[2]};
  }

 private:
  Cell middle_{};
  std::vector<::openvdb::Vec3s> points_;
  std::vector<::openvdb::Vec3I> triangles_;
};

}  // namespace

LevelSet level_set_of(std::span<const std::array<double, 3>> positions,
                      std::span<const std::array<Index, 3>> triangles,
                      const SurfaceOptions& options) {
  Repair own;
  Repair& report = options.report == nullptr ? own : *options.report;
  report = {};
  const ClosedSurface surface = close_surface(positions, triangles, report);
  const double voxel = choose_voxel(extent_of(surface), options.voxel);
  report.voxel = voxel;
  constexpr float half_width = 3;
  const auto bricks = std::make_shared<Bricks>();
  try {
    ::openvdb::initialize();
    const auto transform = ::openvdb::math::Transform::createLinearTransform(voxel);
    const Mesh mesh(surface, voxel);
    ::openvdb::util::NullInterrupter no_interrupter;
    const auto grid = ::openvdb::tools::meshToVolume<::openvdb::FloatGrid>(
        no_interrupter, mesh.adapter(), *transform, half_width, half_width, 0, nullptr);
    bricks->frame = frame_of(*transform);
    bricks->background = grid->background();
    bricks->active = grid->activeVoxelCount();
    hand_out(grid->constTree(), [&](const Cell& around, const float* values) {
      const Cell corner = mesh.placed(around);
      values != nullptr ? bricks->add(corner, values) : bricks->add_inside(corner);
    });
  } catch (const ::openvdb::Exception& error) {
    throw Error(std::string("OpenVDB cannot make a level set: ") + error.what());
  }
  LevelSet level_set(bricks);
  if (level_set.inside_voxels() == 0)
    throw InputError("it encloses nothing as wide as a voxel (" + text_of(voxel) +
                     "): all can be reached from outside, or a smaller voxel is needed");
  return level_set;
}

}  // namespace plexway::openvdb
