#include <plexway/any/isolines.hpp>

#include <variant>

#include <plexway/any/complex.hpp>
#include <plexway/apps/isolines.hpp>
#include <plexway/error.hpp>
#include <plexway/support.hpp>

namespace plexway {
namespace {

// What holds the shape, if a purpose goes together with its kind. UsageError without positions.
template <class Data>
const Data& data_for(Purpose purpose, const AnyShape& shape) {
  support(purpose, shape.kind()).require();
  const auto& data = std::get<Data>(shape.data());
  if (data.positions.empty()) throw UsageError("lines and surfaces of a field need positions");
  return data;
}

const io::Triangles& surface_of(const AnyShape& shape) {
  return data_for<io::Triangles>(Purpose::arcs, shape);
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

std::vector<Path> isolines(const AnyDomain& domain, const AnyField& field,
                           std::span<const double> values) {
  const CloudShape* cloud = domain.shape().cloud();
  if (cloud == nullptr) return domain.shape().isolines(field.doubles(), values);
  std::vector<Path> lines;
  const auto along = [&]<class Real>(const PointCloud<Real>& sheet) {
    const auto& found = std::get<DistanceField<Real>>(field.data);
    lines = isolines(sheet, cloud->measured(), std::span<const Real>(found.distance), values);
  };
  with_complex(domain, [&](const auto& complex) {
    if constexpr (std::decay_t<decltype(complex)>::kind == DomainKind::cloud) along(complex);
  });
  return lines;
}

}  // namespace plexway
