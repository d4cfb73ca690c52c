#pragma once

#include <span>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/fields/fine_field.hpp>
#include <plexway/fields/isosurfaces.hpp>
#include <plexway/paths/path.hpp>

namespace plexway {

/// Lines on a surface where a field has the values: arcs, which know the field inside of triangles
/// (isolines.hpp). Throws UsageError for other shapes, and as plexway::isolines.
[[nodiscard]] std::vector<Path> isolines(const AnyShape& shape, const AnyPathField& field,
                                         std::span<const double> values, double tolerance);

/// Triangles over a surface on which its field is linear within the tolerance (fine_field.hpp).
/// Throws likewise.
[[nodiscard]] FineField fine_field(const AnyShape& shape, const AnyPathField& field,
                                   double tolerance);

/// Surfaces in a solid where a field has the values (isosurfaces.hpp). Throws likewise.
[[nodiscard]] Isosurfaces isosurfaces(const AnyShape& shape, std::span<const double> distance,
                                      std::span<const double> values);

/// Lines where a field has the values, straight in triangles: those of surfaces and mixed domains
/// that a mask leaves open, by their numbers in the shape (PathPoint::simplex), and those of a
/// cloud's sheet. `distance` has any number a vertex, +inf where there is none; for clouds it is
/// rounded to the domain's precision. UsageError for other kinds and without positions, else throws
/// and costs as plexway::isolines.
[[nodiscard]] std::vector<Path> isolines(const AnyDomain& domain, std::span<const double> distance,
                                         std::span<const double> values);
/// The same of a field that was solved on `domain`.
[[nodiscard]] std::vector<Path> isolines(const AnyDomain& domain, const AnyField& field,
                                         std::span<const double> values);

}  // namespace plexway
