#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/source/source.hpp>

#include "arrays.hpp"
#include "domain.hpp"

namespace plexway::python {

Sources::Sources(std::vector<Source> sources) : sources_(std::move(sources)) {
  for (const Source& source : sources_)
    if (const auto* point = std::get_if<PointSource>(&source)) points_.push_back(*point);
  if (points_.size() != sources_.size()) points_.clear();
}

std::span<const PointSource> Sources::points(Purpose purpose) const {
  support_of_sources(purpose, points_.size() == sources_.size()).require();
  return points_;
}

void bind_sources(py::module_& module) {
  py::class_<PointSource>(module, "Point")
      .def(py::init([](Index vertex, double offset) {
             return PointSource{.vertex = vertex, .offset = offset};
           }),
           py::arg("vertex"), py::arg("offset"))
      .def(py::init([](Index simplex, const std::vector<double>& barycentric, double offset) {
             if (barycentric.empty() || barycentric.size() > 4)
               throw py::value_error("barycentric: expected one number a corner, at most 4");
             PointSource point{.simplex = simplex, .offset = offset};
             std::copy(barycentric.begin(), barycentric.end(), point.barycentric.begin());
             return point;
           }),
           py::arg("simplex"), py::arg("barycentric"), py::arg("offset"))
      .def_property_readonly("vertex",
                             [](const PointSource& p) -> py::object {
                               if (p.vertex == none) return py::none();
                               return py::int_(p.vertex);
                             })
      .def_property_readonly("simplex",
                             [](const PointSource& p) -> py::object {
                               if (p.simplex == none) return py::none();
                               return py::int_(p.simplex);
                             })
      .def_readonly("barycentric", &PointSource::barycentric)
      .def_readonly("offset", &PointSource::offset);
  py::class_<VertexSource>(module, "VertexSet")
      .def(py::init([](const py::object& vertices, const py::object& offsets, double offset) {
             VertexSource source{.vertices = indices_of(vertices, "vertices"), .offset = offset};
             if (!offsets.is_none()) {
               source.offsets = numbers_of(offsets, "offsets");
               if (source.offsets.size() != source.vertices.size())
                 throw py::value_error("offsets: expected one a vertex, " +
                                       std::to_string(source.vertices.size()) + ", got " +
                                       std::to_string(source.offsets.size()));
             }
             return source;
           }),
           py::arg("vertices"), py::arg("offsets"), py::arg("offset"))
      .def_property_readonly("points", [](const VertexSource& set) {
        std::vector<PointSource> points;
        for (std::size_t i = 0; i < set.vertices.size(); ++i)
          points.push_back({.vertex = set.vertices[i],
                            .offset = set.offset + (set.offsets.empty() ? 0 : set.offsets[i])});
        return points;
      });
  py::class_<BallSource>(module, "Ball")
      .def(py::init([](const PointSource& centre, double radius, double offset) {
             return BallSource{.centre = centre, .radius = radius, .offset = offset};
           }),
           py::arg("centre"), py::arg("radius"), py::arg("offset"));
  py::class_<CurveSource>(module, "Curve")
      .def(py::init([](std::vector<PointSource> points, double offset) {
             return CurveSource{.points = std::move(points), .offset = offset};
           }),
           py::arg("points"), py::arg("offset"))
      .def_property_readonly("points", [](const CurveSource& curve) { return curve.points; });
  py::class_<SimplexSource>(module, "WholeSimplex")
      .def(py::init([](Index simplex, double offset) {
             return SimplexSource{.simplex = simplex, .offset = offset};
           }),
           py::arg("simplex"), py::arg("offset"));
}

}  // namespace plexway::python
