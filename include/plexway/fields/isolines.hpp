#pragma once

#include <type_traits>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/common/ids.hpp>
#include <plexway/common/rows_of.hpp>
#include <plexway/fields/fine_field.hpp>
#include <plexway/paths/path.hpp>

namespace plexway {

/// The lines on a surface where a field has given values, each as long as it goes on; a closed one
/// ends where it begins. Between vertices the field is linear, so a line is straight in a triangle;
/// triangles with a corner that is not reached have none.
///
/// Shapes: n positions and distances, m faces of vertices < n. The lines come value by value;
/// Path::source is the place of the value in the list, and Path::length that of the line. Write
/// them with io::write_paths. Throws UsageError for other counts, a face of a vertex that is not
/// there, or a value that is not finite. Cost: linear in m for each value.
[[nodiscard]] std::vector<Path> isolines(const GivenPoints& positions,
                                         const GivenSimplices<3>& faces,
                                         const Given<double>& distance,
                                         const Given<double>& values);

/// The same for a field that is known inside of faces, too: lines are arcs, and cross edges where
/// `at` has the value. Between their points they are off by about `tolerance` (the field's unit),
/// where the field is smooth. PathPoint::simplex is a face given. Throws UsageError for a tolerance
/// that is not > 0, too. Cost: that of fine_field, and some ten calls of `at` a point.
[[nodiscard]] std::vector<Path> isolines(const GivenPoints& positions,
                                         const GivenSimplices<3>& faces,
                                         const Given<double>& distance, const Given<double>& values,
                                         const DistanceInside& at, double tolerance);

/// Lines on a cloud, straight in each triangle of its sheet: PathPoint::simplex is one of those.
/// `points` and `distance` have one entry a point, as the cloud was made and solved. Throws as
/// above.
template <class Real>
[[nodiscard]] std::vector<Path> isolines(const PointCloud<Real>& cloud, const GivenPoints& points,
                                         const Given<std::type_identity_t<Real>>& distance,
                                         const Given<double>& values);

}  // namespace plexway
