#include <plexway/sampling/poisson_disk.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "sampling/dart_sample.hpp"

namespace plexway {
using namespace detail;
namespace {

void check_options(const PoissonOptions& options, std::size_t vertices) {
  if ((options.radius != 0) == (options.count != 0))
    throw UsageError("give either a radius or a count of darts");
  if (options.count == 0 && (!(options.radius > 0) || !std::isfinite(options.radius)))
    throw UsageError("the radius must be > 0");
  if (options.at_vertices && options.count > vertices)
    throw UsageError("there are only " + std::to_string(vertices) + " vertices, too few for " +
                     std::to_string(options.count) + " darts");
  if (!options.spacing.empty() && options.spacing.size() != vertices)
    throw UsageError(
        "the spacing must have one value a vertex: " + std::to_string(options.spacing.size()) +
        " given, there are " + std::to_string(vertices) + " vertices");
  for (const double s : options.spacing)
    if (!(s > 0) || !std::isfinite(s)) throw UsageError("the spacing must be > 0 everywhere");
}

template <class Complex>
PoissonDisks poisson(const Complex& domain, std::span<const Index> candidates,
                     const PoissonOptions& options,
                     WorkspaceState<typename Growth<Complex>::Number>& workspace) {
  if (options.count == 0)
    return DartSample<Complex>(domain, candidates, options, options.radius, most_parts, workspace)
        .take();

  // A flat sample of radius r has 0.70 A / r^2 darts, one in space 0.73 V / r^3 (random sequential
  // adsorption: disks of radius r / 2 cover 0.547 of the plane, balls 0.384 of space).
  constexpr double dimension = Growth<Complex>::corners - 1;
  double content = 0;
  std::size_t simplices = 0;
  {
    const Growth<Complex> field(domain, workspace);
    simplices = field.simplices();
    for (Index s = 0; s < simplices; ++s) content += static_cast<double>(field.measure(s));
  }
  const double wanted = static_cast<double>(options.count);
  double radius = domain.unit() * std::pow(0.7 * content / wanted, 1 / dimension);
  if (!(radius > 0)) radius = domain.unit();  // flat triangles only
  // Some vertices may be so near to each other that darts at both would take a radius for which all
  // the rest is cut to dust.
  const std::size_t parts = options.at_vertices
                                ? (std::size_t{1} << 20) + 128 * std::max(options.count, simplices)
                                : most_parts;
  std::size_t most_found = 0;
  int too_fine = 0;
  double too_small = 0, too_large = std::numeric_limits<double>::infinity();
  PoissonDisks best;
  for (int round = 0; round < 16; ++round) {
    PoissonDisks found;
    try {
      found = DartSample<Complex>(domain, candidates, options, radius, parts, workspace).take();
    } catch (const TooManyParts&) {
      if (++too_fine > 4) break;
      too_small = radius;
      radius = too_large < std::numeric_limits<double>::infinity() ? (too_small + too_large) / 2
                                                                   : 8 * radius;
      continue;
    }
    most_found = std::max(most_found, found.darts.size());
    const double count = static_cast<double>(found.darts.size());
    (count >= wanted ? too_small : too_large) = radius;
    if (count >= wanted && (best.darts.empty() || found.darts.size() < best.darts.size()))
      best = std::move(found);
    if (!best.darts.empty() && static_cast<double>(best.darts.size()) <= wanted * 1.005) break;
    // A little below what was requested, to come out above it.
    radius *= std::pow(count / (wanted * 1.002), 1 / dimension);
    if (!(radius > too_small && radius < too_large))
      radius = too_large < std::numeric_limits<double>::infinity() ? (too_small + too_large) / 2
                                                                   : too_small * 1.1;
    if (too_large - too_small < 1e-6 * too_small) break;
  }
  if (best.darts.empty())
    throw UsageError("found no radius that leaves room for " + std::to_string(options.count) +
                     " darts, " + std::to_string(most_found) +
                     " at most: the domain holds fewer, or its points are too uneven");
  if (best.darts.size() > options.count) {
    best.darts.resize(options.count);
    best.maximal = false;
  }
  return best;
}

template <class Complex>
PoissonDisks poisson(const Complex& domain, const PoissonOptions& options,
                     WorkspaceState<typename Growth<Complex>::Number>& workspace) {
  check_options(options, domain.vertex_count());
  std::vector<Index> all(options.at_vertices ? domain.vertex_count() : 0);
  std::iota(all.begin(), all.end(), Index{0});
  return poisson(domain, all, options, workspace);
}

}  // namespace

template <class Real>
PoissonDisks poisson_disks(Serial, const TriangleMesh<Real>& mesh, const PoissonOptions& options,
                           Workspace<Real>& workspace) {
  return poisson(mesh, options, workspace.state());
}

template <class Real>
PoissonDisks poisson_disks(Serial, const TetMesh<Real>& mesh, const PoissonOptions& options,
                           Workspace<Real>& workspace) {
  support(Purpose::samples, mesh).require();
  return poisson(mesh, options, workspace.state());
}

template <class Real>
PoissonDisks poisson_disks(Serial, const PointCloud<Real>& cloud, const PoissonOptions& options,
                           Workspace<Real>& workspace) {
  if (options.order == DartOrder::simplices) support(Purpose::darts, cloud).require();
  PoissonOptions at_points = options;
  at_points.at_vertices = true;
  check_options(at_points, cloud.point_count());
  // Of points at one place the first stands for all.
  std::vector<Index> candidates;
  candidates.reserve(cloud.point_count());
  for (Index v = 0; v < cloud.point_count(); ++v)
    if (cloud.of_point(v) == v) candidates.push_back(v);
  if (options.count > candidates.size())
    throw UsageError("there are only " + std::to_string(candidates.size()) +
                     " points at different places, too few for " + std::to_string(options.count) +
                     " darts");
  std::vector<double> spacing(options.spacing.begin(), options.spacing.end());
  if (!spacing.empty()) {  // what joins points is no place for darts
    spacing.resize(cloud.surface().vertex_count(),
                   *std::max_element(spacing.begin(), spacing.end()));
    at_points.spacing = spacing;
  }
  return poisson(cloud.surface(), candidates, at_points, workspace.state());
}

template PoissonDisks poisson_disks(Serial, const PointCloud<float>&, const PoissonOptions&,
                                    Workspace<float>&);
template PoissonDisks poisson_disks(Serial, const PointCloud<double>&, const PoissonOptions&,
                                    Workspace<double>&);
template PoissonDisks poisson_disks(Serial, const TriangleMesh<float>&, const PoissonOptions&,
                                    Workspace<float>&);
template PoissonDisks poisson_disks(Serial, const TriangleMesh<double>&, const PoissonOptions&,
                                    Workspace<double>&);
template PoissonDisks poisson_disks(Serial, const TetMesh<float>&, const PoissonOptions&,
                                    Workspace<float>&);
template PoissonDisks poisson_disks(Serial, const TetMesh<double>&, const PoissonOptions&,
                                    Workspace<double>&);

}  // namespace plexway
