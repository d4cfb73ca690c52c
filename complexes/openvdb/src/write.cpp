#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <ios>
#include <limits>
#include <ostream>
#include <string>

#include <plexway/error.hpp>
#include <plexway/openvdb/field.hpp>
#include <plexway/openvdb/level_set.hpp>

#include "bricks.hpp"
#include "output_file.hpp"

namespace plexway::openvdb {
namespace {

namespace fs = std::filesystem;

// OpenVDB's own writer of files leaves a short one on a full disk, and says nothing.
class Archive : public ::openvdb::io::Archive {
 public:
  void write_to(OutputFile& file, const ::openvdb::GridCPtrVec& grids) const {
    std::ostream out(&file);
    out.exceptions(std::ios::badbit | std::ios::failbit);
    ::openvdb::MetaMap metadata;
    metadata.insertMeta("creator", ::openvdb::StringMetadata("plexway"));
    write(out, grids, file.seekable(), metadata);
    out.flush();
  }

 private:
  using ::openvdb::io::Archive::write;
};

void write(const fs::path& file, const ::openvdb::GridCPtrVec& grids) {
  OutputFile out(file);
  try {
    Archive().write_to(out, grids);
  } catch (const ::openvdb::Exception& error) {
    out.refused(error.what());
  } catch (const std::ios_base::failure& error) {
    out.refused(error.what());
  }
  out.commit();
}

::openvdb::math::Transform::Ptr transform_of(const Frame& frame) {
  ::openvdb::Mat4d matrix = ::openvdb::Mat4d::identity();
  for (int a = 0; a < 3; ++a)
    for (int k = 0; k < 3; ++k)
      matrix[a][k] = frame.axes[static_cast<std::size_t>(a)][static_cast<std::size_t>(k)];
  for (int k = 0; k < 3; ++k) matrix[3][k] = frame.origin[static_cast<std::size_t>(k)];
  return ::openvdb::math::Transform::createLinearTransform(matrix);
}

// The voxels whose centre lies in a tetrahedron, with their weights of the corners.
class Raster {
 public:
  Raster(const std::array<Vector, 4>& corners) : low_{}, high_{} {
    for (std::size_t k = 0; k < 3; ++k) {
      double least = corners[0][k], most = corners[0][k];
      for (const Vector& c : corners) {
        least = std::min(least, c[k]);
        most = std::max(most, c[k]);
      }
      low_[k] = static_cast<std::int32_t>(std::ceil(least - slack));
      high_[k] = static_cast<std::int32_t>(std::floor(most + slack));
    }
    // Barycentric coordinates are affine: their gradients are the rows of the inverse.
    Frame frame;
    frame.origin = corners[0];
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t k = 0; k < 3; ++k) frame.axes[a][k] = corners[a + 1][k] - corners[0][k];
    flat_ = !(std::abs(frame.determinant()) > 1e-12);
    if (flat_) return;
    at_zero_ = frame.to_index({0, 0, 0});
    for (std::size_t k = 0; k < 3; ++k) {
      Vector step = {0, 0, 0};
      step[k] = 1;
      const Vector there = frame.to_index(step);
      for (std::size_t a = 0; a < 3; ++a) gradient_[a][k] = there[a] - at_zero_[a];
    }
  }

  template <class Take>
  void run(Take take) const {
    if (flat_) return;
    for (std::int32_t x = low_[0]; x <= high_[0]; ++x)
      for (std::int32_t y = low_[1]; y <= high_[1]; ++y)
        for (std::int32_t z = low_[2]; z <= high_[2]; ++z) {
          std::array<double, 4> weight{};
          weight[0] = 1;
          for (std::size_t a = 0; a < 3; ++a) {
            weight[a + 1] =
                at_zero_[a] + gradient_[a][0] * x + gradient_[a][1] * y + gradient_[a][2] * z;
            weight[0] -= weight[a + 1];
          }
          if (*std::min_element(weight.begin(), weight.end()) >= -slack)
            take(::openvdb::Coord(x, y, z), weight);
        }
  }

 private:
  static constexpr double slack = 1e-9;
  Cell low_, high_;
  bool flat_ = false;
  Vector at_zero_{};
  std::array<Vector, 3> gradient_{};
};

double mean_edge(std::span<const std::array<double, 3>> positions,
                 std::span<const std::array<Index, 4>> tets) {
  double sum = 0;
  for (const auto& tet : tets)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const Vector &a = positions[tet[i]], &b = positions[tet[j]];
        sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      }
  return sum / (6 * static_cast<double>(tets.size()));
}

double check(std::span<const std::array<double, 3>> positions,
             std::span<const std::array<Index, 4>> tets, std::span<const double> distance,
             std::span<const std::int32_t> label, double voxel) {
  if (distance.size() != positions.size() || (!label.empty() && label.size() != positions.size()))
    throw UsageError("write_field: one distance and one label a vertex are needed");
  if (tets.empty()) throw UsageError("write_field: a volume needs a solid with tetrahedra");
  for (const auto& tet : tets)
    for (const Index v : tet)
      if (v >= positions.size()) throw UsageError("write_field: a tetrahedron names no vertex");
  if (voxel != 0 && (!(voxel > 0) || !std::isfinite(voxel)))
    throw UsageError("the voxel must be 0, to have it chosen, or a number above 0");
  if (voxel == 0) voxel = mean_edge(positions, tets) / 2;
  double volume = 0, farthest = 0;
  for (const auto& tet : tets) {
    Frame frame;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t k = 0; k < 3; ++k) {
        frame.axes[a][k] = positions[tet[a + 1]][k] - positions[tet[0]][k];
        farthest = std::max(farthest, std::abs(positions[tet[a]][k]));
      }
    volume += std::abs(frame.determinant()) / 6;
  }
  if (volume / (voxel * voxel * voxel) > 2e9)
    throw UsageError("the voxel is too small: the solid would have more than 2 10^9 of them");
  if (!(voxel > 0) || farthest / voxel > 1e9)
    throw UsageError("the voxel is too small for a solid so far from the origin");
  return voxel;
}

}  // namespace

void write_level_set(const fs::path& file, const LevelSet& level_set, std::string_view name) {
  ::openvdb::initialize();
  const Bricks& bricks = level_set.bricks();
  const auto grid = ::openvdb::FloatGrid::create(bricks.background);
  auto& tree = grid->tree();
  for (std::size_t b = 0; b < bricks.numbers.size(); ++b) {
    const Cell& corner = bricks.numbers.corners()[b];
    const ::openvdb::Coord at(8 * corner[0], 8 * corner[1], 8 * corner[2]);
    if (bricks.block[b] == Bricks::inside) {
      tree.addTile(1, at, -bricks.background, false);
      continue;
    }
    auto* const leaf = tree.touchLeaf(at);
    const float* const values = &bricks.values[std::size_t{bricks.block[b]} * 512];
    for (::openvdb::Index i = 0; i < 512; ++i) {
      const bool near = std::abs(values[i]) < bricks.background;
      near ? leaf->setValueOn(i, values[i]) : leaf->setValueOff(i, values[i]);
    }
  }
  ::openvdb::tools::pruneLevelSet(tree);
  grid->setTransform(transform_of(bricks.frame));
  grid->setGridClass(::openvdb::GRID_LEVEL_SET);
  grid->setName(name.empty() ? "surface" : std::string(name));
  grid->setCreator("plexway");
  write(file, {grid});
}

std::size_t write_field(const fs::path& file, std::span<const std::array<double, 3>> positions,
                        std::span<const std::array<Index, 4>> tets,
                        std::span<const double> distance, std::span<const std::int32_t> label,
                        const FieldOptions& options) {
  const double voxel = check(positions, tets, distance, label, options.voxel);
  ::openvdb::initialize();
  const auto field = ::openvdb::FloatGrid::create(outside);
  const auto labels = ::openvdb::Int32Grid::create(-1);
  {
    auto to_field = field->getAccessor();
    auto to_labels = labels->getAccessor();
    for (const auto& tet : tets) {
      std::array<Vector, 4> corners;
      std::array<double, 4> d{};
      bool reached = true;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t k = 0; k < 3; ++k) corners[i][k] = positions[tet[i]][k] / voxel;
        d[i] = distance[tet[i]];
        reached = reached && std::isfinite(d[i]);
      }
      if (!reached) continue;
      Raster(corners).run([&](const ::openvdb::Coord& at, const std::array<double, 4>& weight) {
        double value = 0;
        for (std::size_t i = 0; i < 4; ++i) value += weight[i] * d[i];
        to_field.setValue(at, static_cast<float>(std::max(value, 0.0)));
        if (label.empty()) return;
        const auto most = std::max_element(weight.begin(), weight.end()) - weight.begin();
        to_labels.setValue(at, label[tet[static_cast<std::size_t>(most)]]);
      });
    }
  }
  const auto transform = ::openvdb::math::Transform::createLinearTransform(voxel);
  field->setTransform(transform);
  field->setName(options.name);
  field->setCreator("plexway");
  ::openvdb::GridCPtrVec grids = {field};
  if (!label.empty()) {
    labels->setTransform(transform->copy());
    labels->setName("label");
    labels->setCreator("plexway");
    grids.push_back(labels);
  }
  write(file, grids);
  return field->activeVoxelCount();
}

}  // namespace plexway::openvdb
