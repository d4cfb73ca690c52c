#include <plexway/apps/poisson_disk.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "apps/dart_thrower.hpp"

namespace plexway {
namespace {

void check(const PoissonOptions& options, std::size_t vertices) {
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

/// Before any is cut: at least so many parts have edges within `limits`, one a vertex, in the unit
/// inside. Throws TooManyParts.
template <class Complex>
void check_parts(const Growth<Complex>& field, std::span<const double> limits, double radius,
                 std::size_t most) {
  constexpr std::size_t corners = Growth<Complex>::corners;
  // Of all triangles and tetrahedra with edges up to 1 the regular ones have most content.
  constexpr double content = corners == 3 ? 0.4330127018922193 : 0.1178511301977579;
  double parts = 0;
  for (Index s = 0; s < field.simplices(); ++s) {
    double limit = 0;
    for (std::size_t i = 0; i < corners; ++i)
      limit = std::max(limit, limits[field.corners_of(s)[i]]);
    parts += std::max(1., static_cast<double>(field.measure(s)) /
                              (content * std::pow(limit, double{corners - 1})));
  }
  const double too_many = parts / static_cast<double>(std::min(most, most_parts));
  if (too_many <= 1) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "the radius %.3g is too small for this domain, which would be cut into more than "
                "%.1g parts; choose %.2g or more",
                radius, parts, radius * std::pow(too_many, 1 / double{corners - 1}));
  throw TooManyParts(text);
}

/// Radii in units: what is larger than the domain covers all of it, like the domain. A dart of
/// radius rho starts at the largest radius less rho, which must leave it some digits.
template <class Real>
void check_radii(std::size_t simplices, std::vector<double>& radii) {
  // No way through the domain is longer than all edges, 3 or 6 a simplex, together.
  const double widest = 6 * static_cast<double>(simplices);
  const auto [least, largest] = std::minmax_element(radii.begin(), radii.end());
  constexpr double most = 2e-4 / double{std::numeric_limits<Real>::epsilon()};
  if (*largest > most * *least && *least < widest) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "radii from %.3g to %.3g of the mean edge are beyond %s precision: %skeep them "
                  "within 1 : %.1g",
                  *least, *largest, sizeof(Real) < sizeof(double) ? "single" : "double",
                  sizeof(Real) < sizeof(double) ? "use double, or " : "", most);
    throw PrecisionError(text);
  }
  for (double& radius : radii) radius = std::min(radius, widest);
}

template <class Real>
std::span<const Index> corners_in(const TriangleMesh<Real>& mesh, Index s) {
  return mesh.triangles()[s].corner;
}
template <class Real>
std::span<const Index> corners_in(const TetMesh<Real>& mesh, Index s) {
  return mesh.tets()[s].corner;
}

/// A sample with one radius, `most` darts at most. `candidates`: the vertices that darts may hit.
template <class Complex>
PoissonDisks sample(const Complex& domain, const SimplexNumbers<Complex>& numbers,
                    std::span<const Index> candidates, const PoissonOptions& options, double radius,
                    std::size_t most, WorkspaceState<typename Growth<Complex>::Number>& kept,
                    std::size_t parts = most_parts) {
  using Real = typename Growth<Complex>::Number;
  // In radii. Simplices on the way between two darts then belong to one of them, not to others.
  constexpr double longest_edge = 0.4;
  std::vector<double> limits(domain.vertex_count(), radius / domain.unit() * longest_edge);
  for (std::size_t v = 0; v < options.spacing.size(); ++v)
    limits[domain.inside_vertex(static_cast<Index>(v))] *= options.spacing[v];
  check_parts(Growth<Complex>(domain, kept), limits, radius, parts);
  const CutDomain<Complex> fine = cut(domain, std::move(limits), parts);
  const Complex& complex = *fine.complex;

  // The copy has other numbers inside, and another unit.
  const auto inside = [&](Index v) { return fine.copy ? complex.inside_vertex(v) : v; };
  std::vector<double> radii(complex.vertex_count());
  for (Index v = 0; v < radii.size(); ++v)
    radii[inside(v)] = fine.limits[v] / longest_edge * domain.unit() / complex.unit();
  std::vector<Index> vertices;
  vertices.reserve(candidates.size());
  for (const Index v : candidates) vertices.push_back(inside(domain.inside_vertex(v)));

  WorkspaceState<Real> own_workspace;
  Growth<Complex> field(complex, fine.copy ? own_workspace : kept);
  check_radii<Real>(field.simplices(), radii);
  const DartThrower<Complex> thrower(field, radii, vertices, options, most, [&](double share) {
    if (options.progress && !options.progress(std::clamp(share, 0., 1.)))
      throw Cancelled("cancelled by the progress callback");
  });

  PoissonDisks result;
  result.radius = radius;
  result.maximal = thrower.maximal();
  result.thrown = thrower.thrown();
  result.taken_back = thrower.taken_back();
  result.statistics = field.totals();
  if (!fine.copy) {
    for (const auto& dart : thrower.darts())
      result.darts.push_back(dart.vertex != none
                                 ? PointSource::at(numbers.outside_vertex(dart.vertex))
                                 : numbers.outside(dart.simplex, dart.weights));
    return result;
  }
  const SimplexNumbers<Complex> own(complex);
  for (const auto& dart : thrower.darts()) {
    if (dart.vertex != none) {  // the copy knows vertices by their numbers inside the domain
      const Index v = own.outside_vertex(dart.vertex);
      result.darts.push_back(PointSource::at(numbers.outside_vertex(v)));
      continue;
    }
    const Index parent = fine.parent[own.outside(dart.simplex, dart.weights).simplex];
    const std::span<const Index> corners = corners_in(domain, parent);
    Weights weights{};
    for (std::size_t i = 0; i < Growth<Complex>::corners; ++i) {
      const Index v = own.outside_vertex(field.corners_of(dart.simplex)[i]);
      const Weights place = place_in(fine.halved, domain.vertex_count(), corners, v);
      for (std::size_t k = 0; k < 4; ++k) weights[k] += dart.weights[i] * place[k];
    }
    result.darts.push_back(numbers.outside(parent, weights));
  }
  return result;
}

template <class Complex>
PoissonDisks poisson(const Complex& domain, std::span<const Index> candidates,
                     const PoissonOptions& options,
                     WorkspaceState<typename Growth<Complex>::Number>& workspace) {
  const SimplexNumbers<Complex> numbers(domain);
  constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
  if (options.count == 0)
    return sample(domain, numbers, candidates, options, options.radius, unlimited, workspace);

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
      found = sample(domain, numbers, candidates, options, radius, unlimited, workspace, parts);
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
    // A little below what was asked for, to come out above it.
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
  check(options, domain.vertex_count());
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
  if (options.order == DartOrder::simplices)
    throw UsageError(
        "darts on a cloud are its points, so none is thrown into simplices: leave the order "
        "uniform");
  PoissonOptions at_points = options;
  at_points.at_vertices = true;
  check(at_points, cloud.point_count());
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
