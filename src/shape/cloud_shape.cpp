#include <plexway/io/formats.hpp>
#include <plexway/shape/cloud_shape.hpp>

#include <algorithm>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/surface/smoothing.hpp>

#include "complexes/common/geometry.hpp"
#include "io/names.hpp"
#include "shape/modules/module.hpp"

#ifdef PLEXWAY_HAS_FLANN
#include <plexway/flann/neighbours.hpp>
#endif

namespace plexway {
using namespace detail;
namespace {

// Before anything is read: without neighbours there is nothing to be done.
void require_flann(const std::string& what) {
#ifdef PLEXWAY_HAS_FLANN
  (void)what;
#else
  throw NotBuiltError(what +
                      ": a cloud needs FLANN for its neighbours, which is not built in; install "
                      "libflann-dev and build again");
#endif
}

// A stage of the work.
void begin(const ReadOptions& options, const std::string& what) {
  if (options.progress.stage) options.progress.stage(what);
}

template <class Row>
void keep(std::vector<Row>& rows, const std::vector<Index>& numbers) {
  if (rows.empty()) return;
  std::vector<Row> kept;
  kept.reserve(numbers.size());
  for (const Index i : numbers) kept.push_back(rows[i]);
  rows = std::move(kept);
}

void denoise(CloudShape& cloud, const ReadOptions& options) {
  const std::size_t before = cloud.points.positions.size();
  const auto kept =
      pcl_functions(spelled(options.spelling, "denoise"))
          .without_outliers(cloud.points.positions, options.cloud.deviations.value_or(3));
  keep(cloud.points.positions, kept);
  keep(cloud.points.normals, kept);
  if (!cloud.points.original.empty())
    keep(cloud.points.original, kept);
  else if (kept.size() < before)
    cloud.points.original = kept;
  cloud.outliers = before - kept.size();
}

void thin(CloudShape& cloud, const ReadOptions& options) {
  const std::string name = spelled(options.spelling, "voxel");
  try {
    cloud.points.positions =
        pcl_functions(name).voxel_grid(cloud.points.positions, *options.volume.voxel);
  } catch (const UsageError& error) {
    const std::string_view why = error.what();  // "voxel_grid: ..."
    throw UsageError(name + std::string(why.substr(std::min(why.find(':'), why.size()))));
  }
  cloud.points.normals.clear();  // the points are means now, and have none of their own
  cloud.points.original.clear();
  cloud.thinned = true;
}

Neighbours find_neighbours([[maybe_unused]] const CloudShape& cloud,
                           [[maybe_unused]] const ReadOptions& options) {
#ifdef PLEXWAY_HAS_FLANN
  flann::NeighbourOptions search;
  search.k = cloud.k;
  if (options.cloud.neighbour_radius) search.radius = *options.cloud.neighbour_radius;
  search.progress = options.progress.share;
  return flann::surface_neighbours(cloud.points.positions, search);
#else
  return {};
#endif
}

// Normals that only fit a plane have arbitrary signs, half of them the wrong one; those of a
// scanner or a mesh agree with the nearest point's on the same sheet. Over a sharp edge they may
// well oppose it, and so they do across a thin gap: what is no continuation of the sheet says
// nothing.
bool all_point_to_one_side(const CloudShape& cloud) {
  constexpr double least_cosine = 0.95, most_rise = 0.5;
  const auto& normals = cloud.points.normals;
  const auto& at = cloud.points.positions;
  std::size_t compared = 0, against = 0;
  for (Index i = 0; i < normals.size(); ++i) {
    const auto around = cloud.neighbours.around(i);
    if (around.empty()) continue;
    const Index j = around.front();
    const auto &a = normals[i], &b = normals[j];
    const Point3 q = minus(at[j], at[i]);
    const double along = dot(a, b), rise = dot(a, q), sizes = dot(a, a) * dot(b, b);
    if (!(along * along > least_cosine * least_cosine * sizes)) continue;  // or one is unknown
    if (rise * rise > most_rise * most_rise * dot(a, a) * dot(q, q)) continue;
    ++compared;
    against += along < 0 ? 1 : 0;
  }
  return compared > 0 && 20 * against < compared;
}

}  // namespace

bool is_cloud_file(const std::string& file) {
  const io::FileReader reader = io::format_of(file).reader;
  return reader == io::FileReader::points || reader == io::FileReader::cloud;
}

CloudFile read_cloud(const std::string& file) {
  require_flann(file);
  if (io::lower_extension(file) != ".pcd") return {io::read_points(file), 0};
  CloudFile read;
  read.points = pcl_functions(file).read_points(file, read.not_finite);
  return read;
}

CloudShape make_cloud(const std::string& name, CloudFile read, const ReadOptions& options) {
  require_flann(name);
  CloudShape cloud;
  cloud.points = std::move(read.points);
  cloud.not_finite = read.not_finite;
  cloud.points_in_file = cloud.points.positions.size() + cloud.not_finite;
  if (options.cloud.denoise) {
    begin(options, "looking for outliers in " + name);
    denoise(cloud, options);
  }
  if (options.volume.voxel) {
    begin(options, "thinning " + name);
    thin(cloud, options);
  }
  cloud.k = options.cloud.k.value_or(options.cloud.neighbour_radius ? 0 : 16);
  cloud.max_normal_angle = options.cloud.max_normal_angle;
  begin(options, "looking for neighbours");
  cloud.neighbours = find_neighbours(cloud, options);
  cloud.normals_agree = all_point_to_one_side(cloud);
  if (options.cloud.smooth) {
    begin(options, "smoothing");
    SmoothOptions smoothing;
    smoothing.progress = options.progress.share;
    cloud.smoothed = smooth(cloud.points.positions, cloud.neighbours, smoothing);
  }
  return cloud;
}

std::optional<std::vector<Index>> dropped_points(const CloudShape& cloud) {
  if (cloud.thinned) return std::nullopt;
  std::vector<Index> dropped;
  Index next = 0;
  const auto pass = [&](Index number) {
    for (; next < number; ++next) dropped.push_back(next);
    ++next;
  };
  for (const Index number : cloud.points.original) pass(number);
  if (!cloud.points.original.empty()) pass(static_cast<Index>(cloud.points_in_file));
  return dropped;
}

std::optional<std::size_t> connecting_k(const CloudShape& cloud) {
#ifdef PLEXWAY_HAS_FLANN
  return flann::connecting_k(cloud.points.positions);
#else
  (void)cloud;
  return std::nullopt;
#endif
}

}  // namespace plexway
