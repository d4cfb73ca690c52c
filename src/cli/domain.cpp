#include "domain.hpp"

#include <algorithm>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>

#include "closest_point.hpp"

namespace plexway::cli {
namespace {

constexpr std::array<std::string_view, 4> kinds = {"surface", "solid", "cloud", "wireframe"};

void require_built(const std::string& kind) {
  if (kind.empty() || kind == "surface") return;
  if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end())
    throw NotBuiltError("--as " + kind +
                        ": domains of this kind are not built in; there is: surface");
  std::string names;
  for (const std::string_view name : kinds) names.append(names.empty() ? "" : ", ").append(name);
  throw UsageError("--as " + kind + ": no such kind; the kinds are " + names);
}

}  // namespace

Domain Domain::load(const std::filesystem::path& file, const std::string& as) {
  require_built(as);
  Domain domain;
  domain.file_ = file;
  domain.surface_ = io::read_triangles(file);
  return domain;
}

PointSource Domain::closest(const std::array<double, 3>& point) const {
  const TrianglePoint found = closest_point(surface_, point);
  const auto& corners = surface_.triangles[found.triangle];
  for (std::size_t i = 0; i < 3; ++i) {
    // Nearer to the corner than a rounding error of the coordinates.
    if (found.barycentric[i] >= 1 - 1e-12) return PointSource::at(corners[i]);
  }
  return PointSource::in(static_cast<Index>(found.triangle), found.barycentric);
}

std::array<double, 3> Domain::position(const PointSource& source) const {
  if (source.vertex != none) return surface_.positions[source.vertex];
  std::array<double, 3> at = {0, 0, 0};
  const auto& corners = surface_.triangles[source.simplex];
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      at[k] += source.barycentric[i] * surface_.positions[corners[i]][k];
  }
  return at;
}

void Domain::write_field(const std::filesystem::path& out, std::span<const double> distance,
                         std::span<const std::int32_t> label) const {
  io::write_field(out, surface_, distance, label);
}

}  // namespace plexway::cli
