#include "cloud.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <plexway/complex/smoothing.hpp>
#include <plexway/error.hpp>
#include <plexway/io/field.hpp>

#include "io/extension.hpp"
#include "pcl_functions.hpp"
#include "report.hpp"

#ifdef PLEXWAY_HAS_FLANN
#include <plexway/flann/neighbours.hpp>
#endif

namespace plexway::cli {
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

auto share_shown(ProgressLine& progress) {
  return [&progress](double share) {
    progress.done(share);
    return true;
  };
}

template <class Row>
void keep(std::vector<Row>& rows, const std::vector<Index>& numbers) {
  if (rows.empty()) return;
  std::vector<Row> kept;
  kept.reserve(numbers.size());
  for (const Index i : numbers) kept.push_back(rows[i]);
  rows = std::move(kept);
}

void denoise(Cloud& cloud, const CloudArguments& arguments) {
  const std::size_t before = cloud.points.positions.size();
  const auto kept = pcl_functions("--denoise")
                        .without_outliers(cloud.points.positions, arguments.deviations.value_or(3));
  keep(cloud.points.positions, kept);
  keep(cloud.points.normals, kept);
  if (!cloud.points.original.empty())
    keep(cloud.points.original, kept);
  else if (kept.size() < before)
    cloud.points.original = kept;
  cloud.outliers = before - kept.size();
}

void thin(Cloud& cloud, double size) {
  try {
    cloud.points.positions = pcl_functions("--voxel").voxel_grid(cloud.points.positions, size);
  } catch (const UsageError& error) {
    const std::string_view why = error.what();  // "voxel_grid: ..."
    throw UsageError("--voxel" + std::string(why.substr(std::min(why.find(':'), why.size()))));
  }
  cloud.points.normals.clear();  // the points are means now, and have none of their own
  cloud.points.original.clear();
  cloud.thinned = true;
}

Neighbours find_neighbours(const Cloud& cloud, const CloudArguments& arguments,
                           ProgressLine& progress) {
#ifdef PLEXWAY_HAS_FLANN
  flann::NeighbourOptions options;
  options.k = cloud.k;
  if (arguments.neighbour_radius) options.radius = *arguments.neighbour_radius;
  options.progress = share_shown(progress);
  return flann::surface_neighbours(cloud.points.positions, options);
#else
  (void)cloud;
  (void)arguments;
  (void)progress;
  return {};
#endif
}

// Normals that only fit a plane have arbitrary signs, half of them the wrong one; those of a
// scanner or a mesh agree with the nearest point's all but across a gap.
bool all_point_to_one_side(const Cloud& cloud) {
  const auto& normals = cloud.points.normals;
  std::size_t compared = 0, against = 0;
  for (Index i = 0; i < normals.size(); ++i) {
    const auto around = cloud.neighbours.around(i);
    if (around.empty()) continue;
    const auto& a = normals[i];
    const auto& b = normals[around.front()];
    const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    compared += along != 0 ? 1 : 0;  // 0 where one is unknown
    against += along < 0 ? 1 : 0;
  }
  return compared > 0 && 20 * against < compared;
}

}  // namespace

bool is_cloud_file(const std::string& file) {
  const std::string extension = io::lower_extension(file);
  return extension == ".xyz" || extension == ".pcd";
}

CloudFile read_cloud(const std::string& file) {
  require_flann(file);
  if (io::lower_extension(file) != ".pcd") return {io::read_points(file), 0};
  CloudFile read;
  read.points = pcl_functions(file).read_points(file, read.not_finite);
  return read;
}

Cloud make_cloud(const std::string& file, CloudFile read, const CloudArguments& arguments,
                 ProgressLine& progress) {
  require_flann(file);
  Cloud cloud;
  cloud.points = std::move(read.points);
  cloud.not_finite = read.not_finite;
  cloud.points_in_file = cloud.points.positions.size() + cloud.not_finite;
  if (arguments.denoise) {
    progress.phase("looking for outliers in " + file);
    denoise(cloud, arguments);
  }
  if (arguments.voxel) {
    progress.phase("thinning " + file);
    thin(cloud, *arguments.voxel);
  }
  cloud.k = arguments.k.value_or(arguments.neighbour_radius ? 0 : 16);
  cloud.max_normal_angle = arguments.max_normal_angle;
  progress.phase("looking for neighbours");
  cloud.neighbours = find_neighbours(cloud, arguments, progress);
  cloud.progress = share_shown(progress);
  cloud.normals_agree = all_point_to_one_side(cloud);
  if (arguments.smooth) {
    progress.phase("smoothing");
    SmoothOptions options;
    options.progress = share_shown(progress);
    cloud.smoothed = smooth(cloud.points.positions, cloud.neighbours, options);
  }
  return cloud;
}

CloudOptions cloud_options(const Cloud& cloud) {
  CloudOptions options;
  if (cloud.max_normal_angle) options.max_normal_angle = *cloud.max_normal_angle;
  options.normals = cloud.normals();
  options.progress = cloud.progress;
  return options;
}

Index nearest_point(const Cloud& cloud, const std::array<double, 3>& point) {
  Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cloud.points.positions.size(); ++i) {
    const auto& p = cloud.points.positions[i];
    const double away = std::hypot(p[0] - point[0], p[1] - point[1], p[2] - point[2]);
    if (!(away < least)) continue;
    least = away;
    best = static_cast<Index>(i);
  }
  return best;
}

void write_field(const std::filesystem::path& out, const Cloud& cloud,
                 std::span<const double> distance, std::span<const std::int32_t> label,
                 std::span<const double> error) {
  if (io::lower_extension(out) == ".pcd")
    pcl_functions("--out " + out.string())
        .write_field(out, cloud.points.positions, distance, cloud.points.original);
  else
    io::write_field(out, cloud.points, distance, label, error);
}

std::span<const std::string_view> cloud_field_extensions() {
  static const std::vector<std::string_view> all = [] {
    const auto known = io::field_extensions();
    std::vector<std::string_view> extensions(known.begin(), known.end());
    extensions.push_back(".pcd");
    return extensions;
  }();
  return all;
}

std::optional<std::vector<Index>> dropped_points(const Cloud& cloud) {
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

std::string kept_points(const Cloud& cloud) {
  const std::size_t kept = cloud.points.positions.size();
  std::string why;
  const auto add = [&](const std::string& what) {
    why.append(why.empty() ? "" : ", ").append(what);
  };
  if (cloud.not_finite > 0) add(std::to_string(cloud.not_finite) + " not finite");
  if (cloud.outliers > 0) add(counted(cloud.outliers, "outliers"));
  if (cloud.thinned) add("thinned to one point a cube");
  if (why.empty()) return why;
  return std::to_string(kept) + " of " + counted(cloud.points_in_file, "points") + ": " + why;
}

std::string why_disconnected(const Cloud& cloud, std::size_t components) {
  std::string text = "the cloud has " + counted(components, "components");
  const auto k = connecting_k(cloud);
  if (!k)
    text += ", which even 256 neighbours do not connect";
  else if (cloud.k != 0 && *k > cloud.k)
    text += "; --k " + std::to_string(*k) + " is the least that connects its points";
  else
    text += ", though " + std::to_string(*k) +
            " neighbours connect its points: --neighbour-radius or --max-normal-angle keeps them "
            "apart, or the points are no surface there";
  return text;
}

std::optional<std::size_t> connecting_k(const Cloud& cloud) {
#ifdef PLEXWAY_HAS_FLANN
  return flann::connecting_k(cloud.points.positions);
#else
  (void)cloud;
  return std::nullopt;
#endif
}

}  // namespace plexway::cli
