#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/fields/isolines.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/paths.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/isolines.hpp>
#include <plexway/shape/support.hpp>

#include "io/names.hpp"
#include "shape/level_sets.hpp"
#include "shape/warnings/survey.hpp"

namespace plexway {

namespace {

// What holds the shape, if it supports a purpose.
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
  return with_cloud(domain, [&]<class Real>(const PointCloud<Real>& sheet) {
    const std::vector<Real> rounded(distance.begin(), distance.end());
    return isolines(sheet, points, std::span<const Real>(rounded), values);
  });
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

namespace detail {

namespace {

struct Extent {
  double diagonal = 0;  ///< of the box around the shape
  bool flat = false;
};

Extent extent_of(const AnyShape& shape) {
  const auto [low, high] = bounding_box(shape.positions());
  const std::array<double, 3> size = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  const double diagonal = std::hypot(size[0], size[1], size[2]);
  return {diagonal, *std::min_element(size.begin(), size.end()) < 1e-3 * diagonal};
}

constexpr double pixels = 600;  // of a picture, about: the diagonal

}  // namespace

bool is_known_inside(const AnyDomain& domain, const AnyExecutor& executor,
                     const SourceList& sources, const PropagateOptions& options) {
  const PropagateOptions unbounded;
  return support(Purpose::arcs, domain.shape()) && sources.only_points() &&
         !std::holds_alternative<GL>(executor) && domain.lengths() == nullptr &&
         domain.open_simplices() == nullptr && options.radius == unbounded.radius &&
         options.max_expansions == unbounded.max_expansions;
}

bool shows_inside(const AnyDomain& domain) {
  const Extent extent = extent_of(domain.shape());
  return domain.mean_edge() > 4 * extent.diagonal / pixels && extent.flat;
}

FineField field_for_picture(const AnyShape& shape, const AnyPathField& field) {
  return fine_field(shape, field, extent_of(shape).diagonal / pixels / 4);
}

namespace {

void write_isosurfaces(const std::filesystem::path& out, const AnyShape& solid,
                       std::span<const double> distance, std::span<const double> values) {
  Isosurfaces found = isosurfaces(solid, distance, values);
  std::vector<double> value;
  for (const Index n : found.value) value.push_back(values[n]);
  io::Triangles surface;
  surface.positions = std::move(found.positions);
  surface.triangles = std::move(found.triangles);
  const auto fields = io::field_extensions();
  if (std::find(fields.begin(), fields.end(), io::lower_extension(out)) != fields.end())
    io::write_field(out, surface, value);
  else
    io::write_triangles(out, surface);
}

}  // namespace

std::vector<std::string_view> level_set_extensions() {
  std::vector<std::string_view> all;
  for (const auto known : {io::path_extensions(), io::triangle_output_extensions()})
    for (const std::string_view name : known)
      if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  return all;
}

std::span<const std::string_view> level_set_extensions(DomainKind kind) {
  if (support(Purpose::isosurfaces, kind)) return io::triangle_output_extensions();
  support(Purpose::isolines, kind).require();
  return io::path_extensions();
}

std::vector<double> level_set_values(std::span<const double> distance, double step) {
  double most = 0;
  for (const double d : distance)
    if (std::isfinite(d)) most = std::max(most, d);
  if (most / step > 10000)
    throw UsageError(
        "the step of level sets: that would be more than 10000 values; take a larger step");
  std::vector<double> values;
  for (int n = 1; n * step < most; ++n) values.push_back(n * step);
  return values;
}

void write_level_sets(const std::filesystem::path& out, const AnyShape& shown,
                      const AnyDomain& domain, const AnyField& field, const AnyPathField* paths,
                      std::span<const double> values, double tolerance) {
  if (support(Purpose::isosurfaces, shown.kind()))
    return write_isosurfaces(out, shown, field.doubles(), values);
  const std::vector<Path> lines = paths != nullptr ? isolines(shown, *paths, values, tolerance)
                                                   : isolines(domain, field, values);
  io::write_isolines(out, lines, values);
}

}  // namespace detail

}  // namespace plexway
