#include <plexway/shape/read_options.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <plexway/error.hpp>

namespace plexway {
namespace {

constexpr std::array<std::string_view, 6> kind_names = {"surface",   "solid", "wireframe",
                                                        "simplices", "cloud", "mixed"};

}  // namespace

bool FillOptions::given() const {
  const FillOptions untouched;
  return max_volume != untouched.max_volume || quality != untouched.quality || keep_surface ||
         max_seconds != untouched.max_seconds || !holes.empty();
}

bool CloudPreparation::given() const {
  return k || neighbour_radius || max_normal_angle || denoise || deviations || smooth;
}

std::string spelled(Spelling spelling, std::string_view field) {
  if (spelling == Spelling::fields) return std::string(field);
  std::string flag = "--" + std::string(field);
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

void check(const ReadOptions& options) {
  const auto name = [&](std::string_view field) { return spelled(options.spelling, field); };
  const auto positive = [&](const std::optional<double>& value, std::string_view field) {
    if (value && (!(*value > 0) || std::isinf(*value)))
      throw UsageError(name(field) + " must be a number greater than 0");
  };
  if (options.merge && (!(*options.merge >= 0) || std::isinf(*options.merge)))
    throw UsageError(name("merge") + " must be a number >= 0");
  const FillOptions& fill = options.fill;
  if (!(fill.max_volume >= 0) || std::isinf(fill.max_volume))
    throw UsageError(name("max_volume") + " must be a number greater than 0");
  if (!(fill.quality == 0 || fill.quality > 1) || std::isinf(fill.quality))
    throw UsageError(name("quality") + " must be a number greater than 1, or 0 for none");
  if (!(fill.max_seconds >= 0) || std::isinf(fill.max_seconds))
    throw UsageError(name("max_seconds") + " must be a number greater than 0");
  const CloudPreparation& cloud = options.cloud;
  positive(cloud.neighbour_radius, "neighbour_radius");
  positive(options.volume.voxel, "voxel");
  positive(cloud.deviations, "deviations");
  positive(cloud.max_normal_angle, "max_normal_angle");
  if (cloud.max_normal_angle && *cloud.max_normal_angle > 180)
    throw UsageError(name("max_normal_angle") + " must be at most 180 degrees");
  if (cloud.deviations && !cloud.denoise)
    throw UsageError(name("deviations") + " goes with " + name("denoise"));
}

std::string_view kind_name(DomainKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

std::string_view kind_noun(DomainKind kind) {
  return kind == DomainKind::mixed       ? "mixed domain"
         : kind == DomainKind::simplices ? "complex of simplices"
                                         : kind_name(kind);
}

std::optional<DomainKind> kind_named(std::string_view name) {
  const auto found = std::find(kind_names.begin(), kind_names.end(), name);
  if (found == kind_names.end()) return std::nullopt;
  return static_cast<DomainKind>(found - kind_names.begin());
}

}  // namespace plexway
