#include <plexway/pairs/distance_matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <plexway/error.hpp>
#include <plexway/paths/path_field.hpp>

#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "executors/solid_growth.hpp"
#include "executors/surface_growth.hpp"
#include "paths/cloud_points.hpp"

namespace plexway {
using namespace detail;
namespace {

// Calls row(i, radius), which is to write row i as far as that, for all rows.
template <class Row>
DistanceMatrix by_rows(std::span<const PointSource> points,
                       const std::function<bool(double)>& progress, const SourceDomain& limits,
                       const Row& write_row) {
  check(points, {}, limits);
  for (const PointSource& p : points)
    if (p.offset != 0) throw UsageError("a point of a distance matrix has no offset");

  const std::size_t n = points.size();
  DistanceMatrix result;
  result.size = n;
  result.distance.assign(n * n, infinity);
  std::vector<double>& d = result.distance;
  for (std::size_t i = 0; i < n; ++i) {
    if (progress && !progress(static_cast<double>(i) / static_cast<double>(n)))
      throw Cancelled("cancelled by the progress callback");
    // By way of the points before: an upper bound for each of the others.
    double radius = i == 0 ? infinity : 0;
    for (std::size_t j = 0; j < n && i > 0; ++j) {
      double bound = infinity;
      for (std::size_t r = 0; r < i; ++r) bound = std::min(bound, d[r * n + i] + d[r * n + j]);
      radius = std::max(radius, bound);
    }
    // Bounds have the errors of the distances that they come from.
    write_row(i, radius * 1.05, std::span<double>(d).subspan(i * n, n), result.statistics);
    d[i * n + i] = 0;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double one = d[i * n + j], other = d[j * n + i], least = std::min(one, other);
      if (least < infinity && least > 0 && std::max(one, other) < infinity)
        result.asymmetry = std::max(result.asymmetry, std::abs(one - other) / least);
      d[i * n + j] = d[j * n + i] = least;
    }
  return result;
}

void add(const PropagateStatistics& row, PropagateStatistics& all) {
  all.expansions += row.expansions;
  all.updates += row.updates;
  all.reached_simplices += row.reached_simplices;
  all.windows_gave_up += row.windows_gave_up;
}

// By labels, read where the points are alone.
template <class Complex>
DistanceMatrix matrix(const Complex& domain, std::span<const PointSource> points,
                      const std::function<bool(double)>& progress, const SourceDomain& limits) {
  using Field = Growth<Complex>;
  using Real = typename Field::Number;
  SimplexNumbers<Complex> numbers(domain);
  WorkspaceState<Real> workspace;
  Field field(domain, workspace);
  return by_rows(
      points, progress, limits,
      [&](std::size_t i, double radius, std::span<double> row, PropagateStatistics& statistics) {
        field.clear();
        const Real reach = static_cast<Real>(radius / domain.unit());
        if (points[i].vertex != none) {
          field.add_vertex(domain.inside_vertex(points[i].vertex), 0, 0, reach);
        } else {
          const auto [s, weights] = numbers.inside(points[i]);
          field.add(s, weights, 0, 0, reach);
        }
        for (std::size_t j = 0; j < points.size(); ++j) {
          Real found = std::numeric_limits<Real>::infinity();
          if (points[j].vertex != none) {
            found = field.vertex_distance(domain.inside_vertex(points[j].vertex));
          } else {
            const auto [s, weights] = numbers.inside(points[j]);
            field.each_label(s, [&, &weights = weights](Index, const auto& distance) {
              found = std::min(found, distance(weights));
              return false;
            });
          }
          row[j] = static_cast<double>(found) * domain.unit();
        }
        add(field.totals(), statistics);
      });
}

// By windows or strings; `given` is what was requested, `accuracy` what it comes to.
template <class Complex>
DistanceMatrix field_matrix(const Complex& domain, std::span<const PointSource> points,
                            const std::function<bool(double)>& progress, Accuracy given,
                            Accuracy accuracy, const SourceDomain& limits) {
  PathField field(domain);
  PropagateOptions options;
  options.accuracy = given;
  DistanceMatrix result = by_rows(
      points, progress, limits,
      [&](std::size_t i, double radius, std::span<double> row, PropagateStatistics& statistics) {
        options.radius = radius;
        add(field.solve(Serial{}, points[i], options).statistics, statistics);
        const std::vector<double> found = field.at(points);
        std::copy(found.begin(), found.end(), row.begin());
      });
  result.accuracy = result.statistics.windows_gave_up > 0 ? Accuracy::fast() : accuracy;
  return result;
}

// By what the accuracy comes to.
template <class Complex>
DistanceMatrix any_matrix(const Complex& domain, std::span<const PointSource> points,
                          const std::function<bool(double)>& progress, Accuracy accuracy,
                          const SourceDomain& limits) {
  Combination cell = combination<Serial, Complex>();
  cell.metric = domain.metric();
  cell.accuracy = accuracy.kind();
  support(cell).require();
  const Accuracy found = resolved(accuracy, cell);
  if (found == Accuracy::fast()) {
    support(Purpose::samples, domain).require();
    // In solids strings are as quick.
    if constexpr (std::is_same_v<Complex, TetMesh<typename Growth<Complex>::Number>>)
      return field_matrix(domain, points, progress, Accuracy::accurate(), Accuracy::accurate(),
                          limits);
    else
      return matrix(domain, points, progress, limits);
  }
  return field_matrix(domain, points, progress, accuracy, found, limits);
}

}  // namespace

template <class Real>
DistanceMatrix distance_matrix(Serial, const TriangleMesh<Real>& mesh,
                               std::span<const PointSource> points,
                               const std::function<bool(double)>& progress, Accuracy accuracy) {
  return any_matrix(mesh, points, progress, accuracy,
                    {mesh.vertex_count(), mesh.face_count(), "face", 3});
}

template <class Real>
DistanceMatrix distance_matrix(Serial, const TetMesh<Real>& mesh,
                               std::span<const PointSource> points,
                               const std::function<bool(double)>& progress, Accuracy accuracy) {
  return any_matrix(mesh, points, progress, accuracy,
                    {mesh.vertex_count(), mesh.tet_count(), "tet", 4});
}

template <class Real>
DistanceMatrix distance_matrix(Serial executor, const PointCloud<Real>& cloud,
                               std::span<const PointSource> points,
                               const std::function<bool(double)>& progress, Accuracy accuracy) {
  return distance_matrix(executor, cloud.surface(),
                         std::span<const PointSource>(first_at_place(cloud, points)), progress,
                         accuracy);
}

template DistanceMatrix distance_matrix(Serial, const PointCloud<float>&,
                                        std::span<const PointSource>,
                                        const std::function<bool(double)>&, Accuracy);
template DistanceMatrix distance_matrix(Serial, const PointCloud<double>&,
                                        std::span<const PointSource>,
                                        const std::function<bool(double)>&, Accuracy);
template DistanceMatrix distance_matrix(Serial, const TriangleMesh<float>&,
                                        std::span<const PointSource>,
                                        const std::function<bool(double)>&, Accuracy);
template DistanceMatrix distance_matrix(Serial, const TriangleMesh<double>&,
                                        std::span<const PointSource>,
                                        const std::function<bool(double)>&, Accuracy);
template DistanceMatrix distance_matrix(Serial, const TetMesh<float>&, std::span<const PointSource>,
                                        const std::function<bool(double)>&, Accuracy);
template DistanceMatrix distance_matrix(Serial, const TetMesh<double>&,
                                        std::span<const PointSource>,
                                        const std::function<bool(double)>&, Accuracy);

}  // namespace plexway
