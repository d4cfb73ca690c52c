#include <plexway/shape/isolines.hpp>

#include <array>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/fields/isolines.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/support.hpp>

namespace plexway {
namespace {

// What holds the shape, if a purpose goes together with it.
template <class Data>
const Data& data_for(Purpose purpose, const AnyShape& shape) {
  support(purpose, shape).require();
  return std::get<Data>(shape.data());
}

const io::Triangles& surface_of(const AnyShape& shape) {
  return data_for<io::Triangles>(Purpose::arcs, shape);
}

// On the triangles of a mixed domain, whose simplices are edges and tetrahedra besides.
std::vector<Path> on_parts(const MixedShape& shape, std::span<const double> distance,
                           std::span<const double> values) {
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> number;  // among all simplices
  Index simplex = 0;
  for (const MixedShape::Part& part : shape.parts) {
    simplex += static_cast<Index>(part.edges.size());
    for (const auto& triangle : part.triangles) {
      triangles.push_back(triangle);
      number.push_back(simplex++);
    }
    simplex += static_cast<Index>(part.tets.size());
  }
  std::vector<Path> lines = isolines(shape.positions, triangles, distance, values);
  for (Path& line : lines)
    for (PathPoint& point : line.points) point.simplex = number[point.simplex];
  return lines;
}

// Lines on the sheet of a cloud.
std::vector<Path> on_sheet(const AnyDomain& domain, std::span<const std::array<double, 3>> points,
                           std::span<const double> distance, std::span<const double> values) {
  std::vector<Path> lines;
  const auto along = [&]<class Real>(const PointCloud<Real>& sheet) {
    const std::vector<Real> rounded(distance.begin(), distance.end());
    lines = isolines(sheet, points, std::span<const Real>(rounded), values);
  };
  with_complex(domain, [&](const auto& complex) {
    if constexpr (std::decay_t<decltype(complex)>::kind == DomainKind::cloud) along(complex);
  });
  return lines;
}

DistanceInside inside(const AnyPathField& field) {
  return [&field](Index face, const std::array<double, 4>& weights) {
    return field.at({.simplex = face, .barycentric = weights});
  };
}

}  // namespace

std::vector<Path> isolines(const AnyShape& shape, const AnyPathField& field,
                           std::span<const double> values, double tolerance) {
  const io::Triangles& surface = surface_of(shape);
  return isolines(surface.positions, surface.triangles, field.field().doubles(), values,
                  inside(field), tolerance);
}

FineField fine_field(const AnyShape& shape, const AnyPathField& field, double tolerance) {
  const io::Triangles& surface = surface_of(shape);
  return fine_field(surface.positions, surface.triangles, field.field().doubles(), inside(field),
                    {.tolerance = tolerance});
}

Isosurfaces isosurfaces(const AnyShape& shape, std::span<const double> distance,
                        std::span<const double> values) {
  const auto& solid = data_for<io::Tets>(Purpose::isosurfaces, shape);
  return isosurfaces(solid.positions, solid.tets, distance, values);
}

std::vector<Path> isolines(const AnyDomain& domain, std::span<const double> distance,
                           std::span<const double> values) {
  const AnyShape& shape = domain.shape();
  support(Purpose::isolines, shape).require();
  if (const CloudShape* const cloud = shape.cloud())
    return on_sheet(domain, cloud->measured(), distance, values);
  if (const auto* const mixed = std::get_if<MixedShape>(&shape.data()))
    return on_parts(*mixed, distance, values);
  const io::Triangles& surface = std::get<io::Triangles>(shape.data());
  const OpenSimplices* const open = domain.open_simplices();
  if (open == nullptr) return isolines(surface.positions, surface.triangles, distance, values);
  std::vector<std::array<Index, 3>> triangles;
  for (Index n = 0; n < open->size(); ++n) triangles.push_back(surface.triangles[open->outside(n)]);
  std::vector<Path> lines = isolines(surface.positions, triangles, distance, values);
  for (Path& line : lines) open->outside(line);
  return lines;
}

std::vector<Path> isolines(const AnyDomain& domain, const AnyField& field,
                           std::span<const double> values) {
  return isolines(domain, field.doubles(), values);
}

}  // namespace plexway
