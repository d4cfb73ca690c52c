#include <plexway/sampling/farthest_points.hpp>

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>

#include <plexway/error.hpp>

#include "complexes/common/number_range.hpp"
#include "executors/checks.hpp"
#include "executors/solid_growth.hpp"
#include "executors/surface_growth.hpp"
#include "paths/cloud_points.hpp"

namespace plexway {
using namespace detail;
namespace {

template <class Complex>
class Traversal {
  using Field = Growth<Complex>;
  using Real = typename Field::Number;

 public:
  explicit Traversal(const Complex& domain)
      : domain_(domain), numbers_(domain), field_(domain, workspace_) {}

  /// Vertices below `vertices` are chosen from.
  FarthestPoints run(std::span<const PointSource> start, std::size_t vertices,
                     const FarthestOptions& options) {
    FarthestPoints result;
    // What the field starts with at vertices: where points get as dense as simplices, the label
    // there is another's.
    std::unordered_map<Index, Real> offset;
    for (const PointSource& point : start) {
      if (point.vertex != none) {
        const Real own = static_cast<Real>(point.offset / domain_.unit());
        const auto [known, is_new] = offset.try_emplace(point.vertex, own);
        if (!is_new) known->second = std::min(known->second, own);
      }
      add(point, static_cast<Index>(result.points.size()));
      result.points.push_back(point);
      result.distance.push_back(0);
    }
    // Distances only fall, so one that is out of date is too large, and comes up in time.
    std::priority_queue<std::pair<Real, Index>> farthest;
    for (Index v = 0; v < vertices; ++v)
      if (field_.corner_at(domain_.inside_vertex(v)) != none)
        farthest.emplace(std::numeric_limits<Real>::infinity(), none - v);
    while (!farthest.empty()) {
      const auto [known, packed] = farthest.top();
      const Index v = none - packed;
      Real now = field_.vertex_distance(domain_.inside_vertex(v));
      if (const auto own = offset.find(v); own != offset.end()) now = std::min(now, own->second);
      farthest.pop();
      if (now < known) {
        farthest.emplace(now, packed);
        continue;
      }
      result.covering = static_cast<double>(now) * domain_.unit();
      if (result.points.size() >= options.count || result.covering <= options.radius) break;
      const Index number = static_cast<Index>(result.points.size());
      if (options.progress &&
          !options.progress(static_cast<double>(number) / static_cast<double>(options.count)))
        throw Cancelled("cancelled by the progress callback");
      add(PointSource::at(v), number);
      result.points.push_back(PointSource::at(v));
      result.distance.push_back(now < std::numeric_limits<Real>::infinity() ? result.covering
                                                                            : infinity);
      result.covering = 0;
    }
    result.statistics = field_.totals();
    return result;
  }

 private:
  void add(const PointSource& point, Index number) {
    const Real sigma = static_cast<Real>(point.offset / domain_.unit());
    if (point.vertex != none) {
      field_.add_vertex(domain_.inside_vertex(point.vertex), sigma, number, infinity);
    } else {
      const auto [s, weights] = numbers_.inside(point);
      field_.add(s, weights, sigma, number, infinity);
    }
  }

  const Complex& domain_;
  SimplexNumbers<Complex> numbers_;
  WorkspaceState<Real> workspace_;
  Field field_;
};

template <class Complex>
FarthestPoints farthest(const Complex& domain, std::span<const PointSource> start,
                        std::size_t vertices, const FarthestOptions& options,
                        const SourceDomain& limits) {
  check(start, {}, limits);
  if (options.count == 0) throw UsageError("the count of points must be > 0");
  if (!(options.radius >= 0)) throw UsageError("the radius must be >= 0");
  return Traversal<Complex>(domain).run(start, vertices, options);
}

}  // namespace

template <class Real>
FarthestPoints farthest_points(Serial, const TriangleMesh<Real>& mesh,
                               std::span<const PointSource> start, const FarthestOptions& options) {
  return farthest(mesh, start, mesh.vertex_count(), options,
                  {mesh.vertex_count(), mesh.face_count(), "face", 3});
}

template <class Real>
FarthestPoints farthest_points(Serial, const TetMesh<Real>& mesh,
                               std::span<const PointSource> start, const FarthestOptions& options) {
  support(Purpose::samples, mesh).require();
  return farthest(mesh, start, mesh.vertex_count(), options,
                  {mesh.vertex_count(), mesh.tet_count(), "tet", 4});
}

template <class Real>
FarthestPoints farthest_points(Serial, const PointCloud<Real>& cloud,
                               std::span<const PointSource> start, const FarthestOptions& options) {
  FarthestPoints found =
      farthest(cloud.surface(), std::span<const PointSource>(first_at_place(cloud, start)),
               cloud.point_count(), options, {cloud.point_count(), 0, "face", 3});
  std::copy(start.begin(), start.end(), found.points.begin());
  return found;
}

template FarthestPoints farthest_points(Serial, const PointCloud<float>&,
                                        std::span<const PointSource>, const FarthestOptions&);
template FarthestPoints farthest_points(Serial, const PointCloud<double>&,
                                        std::span<const PointSource>, const FarthestOptions&);
template FarthestPoints farthest_points(Serial, const TriangleMesh<float>&,
                                        std::span<const PointSource>, const FarthestOptions&);
template FarthestPoints farthest_points(Serial, const TriangleMesh<double>&,
                                        std::span<const PointSource>, const FarthestOptions&);
template FarthestPoints farthest_points(Serial, const TetMesh<float>&, std::span<const PointSource>,
                                        const FarthestOptions&);
template FarthestPoints farthest_points(Serial, const TetMesh<double>&,
                                        std::span<const PointSource>, const FarthestOptions&);

}  // namespace plexway
