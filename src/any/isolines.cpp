#include <plexway/any/isolines.hpp>

#include <array>
#include <type_traits>
#include <variant>
#include <vector>

#include <plexway/any/complex.hpp>
#include <plexway/any/support.hpp>
#include <plexway/apps/isolines.hpp>

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

// Triangles of a shape, with their numbers among all simplices.
struct Triangles {
  std::vector<std::array<Index, 3>> corners;
  std::vector<Index> number;
};

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
  Triangles open;
  Index simplex = 0;
  const auto take = [&](std::span<const std::array<Index, 3>> triangles) {
    for (const auto& triangle : triangles) {
      if (domain.open_simplices() == nullptr || domain.open_simplices()->inside(simplex) != none) {
        open.corners.push_back(triangle);
        open.number.push_back(simplex);
      }
      ++simplex;
    }
  };
  if (const auto* const surface = std::get_if<io::Triangles>(&shape.data()))
    take(surface->triangles);
  else
    for (const MixedShape::Part& part : std::get<MixedShape>(shape.data()).parts) {
      simplex += static_cast<Index>(part.edges.size());
      take(part.triangles);
      simplex += static_cast<Index>(part.tets.size());
    }
  std::vector<Path> lines = isolines(shape.positions(), open.corners, distance, values);
  for (Path& line : lines)
    for (PathPoint& point : line.points) point.simplex = open.number[point.simplex];
  return lines;
}

std::vector<Path> isolines(const AnyDomain& domain, const AnyField& field,
                           std::span<const double> values) {
  return isolines(domain, field.doubles(), values);
}

}  // namespace plexway
