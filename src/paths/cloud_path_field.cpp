#include <plexway/paths/cloud_path_field.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>

#include "paths/cloud_points.hpp"
#include "paths/solved.hpp"
#include "paths/surface_trace.hpp"

namespace plexway {
using namespace detail;
namespace {

/// Are the lengths of a sheet those between its places, as exact as `Real` has them?
template <class Real>
bool measured_in_space(const TriangleMesh<Real>& sheet, std::span<const Index> outer,
                       std::span<const std::array<double, 3>> places) {
  constexpr double slack = 1e-5;
  for (Index f = 0; f < sheet.face_count(); ++f) {
    const TriangleRecord<Real>& t = sheet.triangles()[f];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto &p = places[outer[t.corner[i]]], &q = places[outer[t.corner[edge_after(i)]]];
      const double l = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]) / sheet.unit();
      if (!(std::abs(l - static_cast<double>(t.length[i])) <= slack * (1 + l))) return false;
    }
  }
  return true;
}

}  // namespace

template <class Real>
PathField<PointCloud<Real>>::PathField(const PointCloud<Real>& cloud, GivenPoints points)
    : cloud_(&cloud), places_(std::move(points)) {
  if (!places_.empty() && places_.size() != cloud.point_count())
    throw UsageError(std::to_string(places_.size()) + " positions for " +
                     std::to_string(cloud.point_count()) + " points: give one a point, or none");
  outer_ = vertices_outside(cloud.surface());
  if (places_.empty()) return;
  if (!cloud.more_places().empty()) {
    std::vector<std::array<double, 3>> all(places_.begin(), places_.end());
    all.insert(all.end(), cloud.more_places().begin(), cloud.more_places().end());
    places_ = std::move(all);
  }
  in_space_ = measured_in_space(cloud.surface(), outer_, places_);
}

template <class Real>
void PathField<PointCloud<Real>>::took(std::span<const PointSource> sources,
                                       Visibility visibility) {
  sources_ = first_at_place(*cloud_, sources);
  visibility_ = visibility;
  solved_ = true;
  // Tracing asks all vertices of the sheet. What joins two points is where both ends are.
  if (cloud_->surface().vertex_count() != field_.distance.size())
    sheet_.distance = sheet_distances<Real>(*cloud_, field_.distance, outer_);
}

template <class Real>
Path PathField<PointCloud<Real>>::trace(const PointSource& point,
                                        const TraceOptions& options) const {
  if (!solved_) throw UsageError("there is nothing to trace before a solve");
  check(options, *cloud_);
  const PointSource at = first_at_place(*cloud_, std::span(&point, 1))[0];
  using Places = std::span<const std::array<double, 3>>;
  const bool more = cloud_->surface().vertex_count() != field_.distance.size();
  const Solved<Real> solved = {workspace_.state(),
                               more ? sheet_ : field_,
                               sources_,
                               in_space_ ? Places(places_) : Places(),
                               places_,
                               outer_,
                               {},
                               visibility_};
  return or_no_way_at_all(SurfaceTrace<Real>(cloud_->surface(), solved).trace(at, options), solved,
                          at);
}

template <class Real>
std::array<Index, 3> PathField<PointCloud<Real>>::corners(Index simplex) const {
  const auto [f, turned] = cloud_->surface().inside_face(simplex);
  if (f == none)
    throw UsageError("triangle " + std::to_string(simplex) + " is out of range, there are " +
                     std::to_string(cloud_->surface().face_count()));
  const Index* v = cloud_->surface().triangles()[f].corner;
  return {outer_[v[0]], outer_[v[turned ? 2 : 1]], outer_[v[turned ? 1 : 2]]};
}

template <class Real>
std::size_t PathField<PointCloud<Real>>::bytes() const {
  const std::size_t copied = cloud_->more_places().empty() ? 0 : places_.size();
  return outer_.capacity() * sizeof(Index) + copied * sizeof(places_[0]) + workspace_.bytes() +
         (field_.distance.capacity() + sheet_.distance.capacity()) * sizeof(Real) +
         field_.label.capacity() * sizeof(Index) + sources_.capacity() * sizeof(PointSource);
}

template class PathField<PointCloud<float>>;
template class PathField<PointCloud<double>>;

}  // namespace plexway
