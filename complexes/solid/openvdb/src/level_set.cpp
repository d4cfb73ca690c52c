#include <plexway/openvdb/level_set.hpp>

#include <algorithm>
#include <cmath>

#include <plexway/error.hpp>

#include "bricks.hpp"

namespace plexway::openvdb {
namespace {

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

Vector Frame::to_index(const Vector& world) const {
  const Vector p = {world[0] - origin[0], world[1] - origin[1], world[2] - origin[2]};
  const double volume = determinant();
  return {dot(cross(axes[1], axes[2]), p) / volume, dot(cross(axes[2], axes[0]), p) / volume,
          dot(cross(axes[0], axes[1]), p) / volume};
}

void Bricks::add(const Cell& corner, const float* from) {
  if (!numbers.add(corner).second) return;
  block.push_back(static_cast<std::uint32_t>(values.size() / 512));
  values.insert(values.end(), from, from + 512);
}

void Bricks::add_inside(const Cell& corner) {
  if (numbers.add(corner).second) block.push_back(inside);
}

double Lookup::at(const Vector& p) {
  std::array<std::int32_t, 3> low;
  Vector part;
  for (std::size_t k = 0; k < 3; ++k) {
    const double floor = std::floor(p[k]);
    low[k] = static_cast<std::int32_t>(floor);
    part[k] = p[k] - floor;
  }
  const auto along_z = [&](std::int32_t x, std::int32_t y) {
    const double near = voxel(x, y, low[2]);
    return part[2] == 0 ? near : near + part[2] * (double{voxel(x, y, low[2] + 1)} - near);
  };
  const auto along_y = [&](std::int32_t x) {
    const double near = along_z(x, low[1]);
    return part[1] == 0 ? near : near + part[1] * (along_z(x, low[1] + 1) - near);
  };
  const double near = along_y(low[0]);
  return part[0] == 0 ? near : near + part[0] * (along_y(low[0] + 1) - near);
}

const std::string& LevelSet::name() const { return bricks_->name; }

double LevelSet::voxel() const { return std::cbrt(std::abs(bricks_->frame.determinant())); }

std::size_t LevelSet::active_voxels() const { return bricks_->active; }

std::size_t LevelSet::inside_voxels() const {
  const auto whole = std::count(bricks_->block.begin(), bricks_->block.end(), Bricks::inside);
  const auto cut = std::count_if(bricks_->values.begin(), bricks_->values.end(),
                                 [](float value) { return value < 0; });
  return 512 * static_cast<std::size_t>(whole) + static_cast<std::size_t>(cut);
}

double LevelSet::operator()(const std::array<double, 3>& place) const {
  const Vector at = bricks_->frame.to_index(place);
  constexpr double far = 8.0 * (BrickNumbers::far - 1);
  for (const double x : at)
    if (!(std::abs(x) < far)) return bricks_->background;
  return Lookup(*bricks_).at(at);
}

std::size_t LevelSet::bytes() const {
  return sizeof(Bricks) + bricks_->values.size() * sizeof(float) +
         bricks_->numbers.size() * (sizeof(Cell) + 4 + 40);
}

LevelSet level_set_of(const std::function<double(const std::array<double, 3>&)>& function,
                      const std::array<double, 3>& low, const std::array<double, 3>& high,
                      double voxel) {
  // Values are floats, and a voxel's volume a double.
  if (!(voxel > 1e-36 && voxel < 1e36))
    throw UsageError("level_set_of: the voxel must be a number above 0, from 1e-36 to 1e36");
  Cell first, last;
  for (std::size_t k = 0; k < 3; ++k) {
    const double from = std::floor(low[k] / voxel / 8), to = std::floor(high[k] / voxel / 8);
    constexpr double far = BrickNumbers::far - 2;
    if (!(from <= to) || !(std::abs(from) < far) || !(std::abs(to) < far))
      throw UsageError("level_set_of: the box is empty, or too large for such voxels");
    first[k] = static_cast<std::int32_t>(from);
    last[k] = static_cast<std::int32_t>(to);
  }
  const auto bricks = std::make_shared<Bricks>();
  for (std::size_t k = 0; k < 3; ++k) bricks->frame.axes[k][k] = voxel;
  bricks->background = static_cast<float>(3 * voxel);
  const double band = bricks->background;
  std::array<float, 512> values;
  bool any = false;
  for (std::int32_t x = first[0]; x <= last[0]; ++x)
    for (std::int32_t y = first[1]; y <= last[1]; ++y)
      for (std::int32_t z = first[2]; z <= last[2]; ++z) {
        std::size_t near = 0, inside = 0;
        for (std::int32_t i = 0; i < 512; ++i) {
          const Cell at = {8 * x + (i >> 6), 8 * y + (i >> 3 & 7), 8 * z + (i & 7)};
          const Vector p = {voxel * at[0], voxel * at[1], voxel * at[2]};
          bool in_box = true;
          for (std::size_t k = 0; k < 3; ++k) in_box = in_box && p[k] >= low[k] && p[k] <= high[k];
          const double value = in_box ? function(p) : band;
          if (std::isnan(value)) throw InputError("level_set_of: the function is not a number");
          values[static_cast<std::size_t>(i)] = static_cast<float>(std::clamp(value, -band, band));
          near += std::abs(value) < band;
          inside += value < 0;
        }
        bricks->active += near;
        any = any || inside > 0;
        if (near > 0 || (inside > 0 && inside < 512))
          bricks->add({x, y, z}, values.data());
        else if (inside == 512)
          bricks->add_inside({x, y, z});
      }
  if (!any) throw InputError("level_set_of: the function is negative nowhere: nothing is inside");
  return LevelSet(bricks);
}

}  // namespace plexway::openvdb
