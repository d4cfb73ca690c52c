#include <plexway/pcl/filters.hpp>

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <plexway/error.hpp>

#include "complexes/common/box_tree.hpp"
#include "quiet.hpp"

namespace plexway::pcl {
using namespace detail;
namespace {

using Row = std::array<double, 3>;
using Cloud = ::pcl::PointCloud<::pcl::PointXYZ>;

/// PCL computes in single precision: points go to it from the corner of their box, in units of its
/// longest side, so that neither an offset nor the unit costs digits.
class Frame {
 public:
  explicit Frame(std::span<const Row> points) {
    if (points.size() >= static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw InputError("the cloud has more points than PCL's 31 bits count");
    auto box = Box<3>::empty();
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const double x : points[i])
        if (!std::isfinite(x)) throw InputError("point " + std::to_string(i) + " is not finite");
      box.add(points[i]);
    }
    if (points.empty()) return;
    const auto& [low, high] = box;
    corner_ = low;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      half_[k] = high[k] / 2 - low[k] / 2;
      longest = std::max(longest, half_[k]);
    }
    if (longest > 0) half_unit_ = longest;
  }

  /// Halves, because a box may be longer than the largest number.
  double half_unit() const { return half_unit_; }
  double half(std::size_t k) const { return half_[k]; }

  Cloud::Ptr to_pcl(std::span<const Row> points) const {
    auto cloud = std::make_shared<Cloud>();
    cloud->reserve(points.size());
    for (const Row& p : points) {
      std::array<float, 3> at;
      for (std::size_t k = 0; k < 3; ++k)
        at[k] = static_cast<float>((p[k] / 2 - corner_[k] / 2) / half_unit_);
      cloud->push_back({at[0], at[1], at[2]});
    }
    return cloud;
  }

  Row from_pcl(const ::pcl::PointXYZ& point) const {
    const std::array<float, 3> at = {point.x, point.y, point.z};
    Row row;
    for (std::size_t k = 0; k < 3; ++k)
      row[k] = corner_[k] + 2 * half_unit_ * static_cast<double>(at[k]);
    return row;
  }

 private:
  Row corner_{}, half_{};
  double half_unit_ = 1;
};

/// Neighbours besides the point itself, as many as there can be.
int neighbours_of(const char* who, int wanted, std::size_t points) {
  if (wanted < 1) throw UsageError(std::string(who) + ": at least one neighbour is needed");
  return static_cast<int>(std::min(static_cast<std::size_t>(wanted), points - 1));
}

}  // namespace

std::vector<Row> voxel_grid(std::span<const Row> points, double size) {
  if (!(size > 0) || std::isinf(size))
    throw UsageError("voxel_grid: the size must be a number above 0");
  if (points.empty()) return {};
  const Frame frame(points);
  // PCL numbers the cubes with 31 bits, and returns the cloud as it was if that is not enough.
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  const auto cubes = [&](double side) {
    double product = 1;
    for (std::size_t k = 0; k < 3; ++k) product *= std::floor(2 * (frame.half(k) / side)) + 2;
    return product;
  };
  if (!(cubes(size) < most)) {
    double enough = size;
    while (!(cubes(enough) < most)) enough *= 1.1;
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", enough);
    throw UsageError(std::string("voxel_grid: the cloud's box has more cubes of that size than "
                                 "2^31 - 1; try ") +
                     text);
  }
  Cloud thinned;
  const Quiet quiet;
  ::pcl::VoxelGrid<::pcl::PointXYZ> filter;
  filter.setInputCloud(frame.to_pcl(points));
  // Larger than the cloud is as good as infinite, and does not underflow.
  const auto leaf = static_cast<float>(std::clamp(size / frame.half_unit() / 2, 1e-10, 4.0));
  filter.setLeafSize(leaf, leaf, leaf);
  filter.filter(thinned);
  std::vector<Row> kept;
  kept.reserve(thinned.size());
  for (const auto& point : thinned) kept.push_back(frame.from_pcl(point));
  return kept;
}

std::vector<Index> without_outliers(std::span<const Row> points, const OutlierOptions& options) {
  if (!(options.deviations > 0))
    throw UsageError("without_outliers: the deviations must be a number above 0");
  const Frame frame(points);
  std::vector<Index> numbers;
  if (points.size() < 3) {
    for (std::size_t i = 0; i < points.size(); ++i) numbers.push_back(static_cast<Index>(i));
    return numbers;
  }
  const Quiet quiet;
  ::pcl::StatisticalOutlierRemoval<::pcl::PointXYZ> filter;
  filter.setInputCloud(frame.to_pcl(points));
  filter.setMeanK(neighbours_of("without_outliers", options.neighbours, points.size()));
  filter.setStddevMulThresh(options.deviations);
  ::pcl::Indices kept;
  filter.filter(kept);
  for (const auto i : kept) numbers.push_back(static_cast<Index>(i));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

}  // namespace plexway::pcl
