#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <ios>
#include <limits>
#include <ostream>
#include <span>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/openvdb/field.hpp>
#include <plexway/openvdb/level_set.hpp>

#include "answer.hpp"
#include "bricks.hpp"
#include "file/new_file.hpp"

namespace plexway::openvdb {
namespace {

namespace fs = std::filesystem;

// A file that appears whole or not at all (`file/new_file.hpp`), for OpenVDB, which writes to a
// stream and does not look at its state: so this is the stream's buffer, and remembers what went
// wrong. The constructor and `commit` throw Error "cannot write FILE: reason".
class OutputFile : public std::streambuf {
 public:
  explicit OutputFile(const fs::path& file);

  // Whether what was written can be gone back to.
  [[nodiscard]] bool seekable() const { return file_.seekable(); }
  // Writes what is left, waits until the disk has it, and puts the file in its place.
  void commit();
  // Throws for the reason that the system gave first, or if it gave none, this one.
  [[noreturn]] void refused(const std::string& otherwise);

 protected:
  int_type overflow(int_type c) override;
  int sync() override { return flush() ? 0 : -1; }
  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override;
  pos_type seekpos(pos_type at, std::ios_base::openmode mode) override {
    return seekoff(off_type(at), std::ios_base::beg, mode);
  }

 private:
  bool flush();

  detail::file::NewFile file_;
  int failure_ = 0;  // the first one's errno
  std::vector<char> buffer_;
};

OutputFile::OutputFile(const fs::path& file) : file_(file), buffer_(std::size_t{1} << 16) {
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

bool OutputFile::flush() {
  if (failure_ == 0) failure_ = file_.write(pbase(), static_cast<std::size_t>(pptr() - pbase()));
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return failure_ == 0;
}

OutputFile::int_type OutputFile::overflow(int_type c) {
  if (!flush()) return traits_type::eof();
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  *pptr() = traits_type::to_char_type(c);
  pbump(1);
  return c;
}

OutputFile::pos_type OutputFile::seekoff(off_type by, std::ios_base::seekdir from,
                                         std::ios_base::openmode) {
  if (!seekable() || !flush()) return pos_type(off_type(-1));
  const int whence = from == std::ios_base::beg   ? SEEK_SET
                     : from == std::ios_base::cur ? SEEK_CUR
                                                  : SEEK_END;
  const off_t at = ::lseek(file_.descriptor(), by, whence);
  if (at < 0) failure_ = errno;
  return pos_type(off_type(at));
}

void OutputFile::commit() {
  flush();
  if (failure_ == 0) failure_ = file_.synchronise();
  if (failure_ != 0) file_.refuse(failure_);
  file_.commit();
}

void OutputFile::refused(const std::string& otherwise) {
  if (failure_ != 0) file_.refuse(failure_);
  file_.refuse(otherwise);
}

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
  explicit Raster(const std::array<Vector, 4>& corners) : corners_(corners), low_{}, high_{} {
    for (std::size_t k = 0; k < 3; ++k) {
      double least = corners[0][k], most = corners[0][k];
      for (const Vector& c : corners) {
        least = std::min(least, c[k]);
        most = std::max(most, c[k]);
      }
      low_[k] = static_cast<std::int32_t>(std::ceil(least - slack));
      high_[k] = static_cast<std::int32_t>(std::floor(most + slack));
      slab_ += 16 * slack * (most - least);
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
    for (std::size_t a = 0; a < 3; ++a) {
      slope_[a + 1] = gradient_[a][2];
      slope_[0] -= gradient_[a][2];
    }
  }

  template <class Take>
  void run(Take take) const {
    if (flat_) return;
    for (std::int32_t x = low_[0]; x <= high_[0]; ++x) {
      const auto [first, last] = rows(x);
      for (std::int32_t y = first; y <= last; ++y) {
        const std::array<double, 4> at = constant(x, y);
        const auto [from, to] = row(at);
        for (std::int32_t z = from; z <= to; ++z) {
          std::array<double, 4> weight = at;
          for (std::size_t i = 0; i < 4; ++i) weight[i] += slope_[i] * z;
          if (*std::min_element(weight.begin(), weight.end()) >= -slack)
            take(::openvdb::Coord(x, y, z), weight);
        }
      }
    }
  }

 private:
  static constexpr double slack = 1e-9;
  using Range = std::pair<std::int32_t, std::int32_t>;

  // A voxel more at each end than was computed, but none beyond the box.
  [[nodiscard]] Range within_box(std::size_t k, double least, double most) const {
    if (!(least <= most)) return {0, -1};
    const double low = low_[k], high = high_[k];
    return {static_cast<std::int32_t>(std::clamp(std::floor(least) - 1, low, high + 1)),
            static_cast<std::int32_t>(std::clamp(std::ceil(most) + 1, low - 1, high))};
  }

  // The rows that the slice at x may have: those of edges in a slab, since a face along the slice
  // may lie beside it by rounding, and counts by the slack.
  [[nodiscard]] Range rows(std::int32_t x) const {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const Vector &a = corners_[i], &b = corners_[j];
        if (i == j || a[0] > b[0] || x < a[0] - slab_ || x > b[0] + slab_) continue;
        for (const double end : {x - slab_, x + slab_}) {
          const double share = std::clamp((end - a[0]) / (b[0] - a[0]), 0.0, 1.0);
          // Both ends of an edge along the slice are met, as (a, b) and as (b, a).
          const double y = b[0] > a[0] ? a[1] + share * (b[1] - a[1]) : a[1];
          least = std::min(least, y - slab_);
          most = std::max(most, y + slab_);
        }
      }
    return within_box(1, least, most);
  }

  // The voxels that the row may have: none of the weights is negative.
  [[nodiscard]] Range row(const std::array<double, 4>& at) const {
    double least = low_[2], most = high_[2];
    for (std::size_t i = 0; i < 4; ++i) {
      const double end = (-2 * slack - at[i]) / slope_[i];
      if (slope_[i] > 0) least = std::max(least, end);
      if (slope_[i] < 0) most = std::min(most, end);
      if (slope_[i] == 0 && at[i] < -2 * slack) return {0, -1};
    }
    // Where they are nearly constant along the row, ends are far off either way.
    return least - 2 > most ? Range{0, -1} : within_box(2, std::min(least, most), most);
  }

  // Weights at z = 0.
  [[nodiscard]] std::array<double, 4> constant(std::int32_t x, std::int32_t y) const {
    std::array<double, 4> weight{};
    weight[0] = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      weight[a + 1] = at_zero_[a] + gradient_[a][0] * x + gradient_[a][1] * y;
      weight[0] -= weight[a + 1];
    }
    return weight;
  }

  std::array<Vector, 4> corners_;
  double slab_ = 1e-6;
  Cell low_, high_;
  bool flat_ = false;
  Vector at_zero_{};
  std::array<Vector, 3> gradient_{};
  std::array<double, 4> slope_{};  // of each weight along z
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
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Vector low = {infinite, infinite, infinite}, high = {-infinite, -infinite, -infinite};
  double volume = 0, farthest = 0;
  for (const auto& tet : tets) {
    for (const Index v : tet)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], positions[v][k]);
        high[k] = std::max(high[k], positions[v][k]);
        farthest = std::max(farthest, std::abs(positions[v][k]));
      }
    Frame frame;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t k = 0; k < 3; ++k)
        frame.axes[a][k] = positions[tet[a + 1]][k] - positions[tet[0]][k];
    volume += std::abs(frame.determinant()) / 6;
  }
  if (volume / (voxel * voxel * voxel) > 2e9)
    throw UsageError("the voxel " + text_of(voxel) +
                     " is too small: the solid would have more than 2 10^9 of them");
  if (!(voxel > 0) || farthest / voxel > 1e9)
    throw UsageError("the voxel " + text_of(voxel) +
                     " is too small for a solid so far from the origin");
  const double across = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
  if (voxel > across)
    throw UsageError("the voxel " + text_of(voxel) + " is larger than the whole solid, " +
                     text_of(across) + " across; choose a smaller one");
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
