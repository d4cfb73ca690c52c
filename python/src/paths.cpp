#include <pybind11/stl.h>

#include <array>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/isolines.hpp>

#include "arrays.hpp"
#include "domain.hpp"

namespace plexway::python {
namespace {

// (positions, or None in a domain without, simplices, barycentric, length, source)
py::tuple told(Path path, bool placed) {
  std::vector<std::int64_t> simplices;
  std::vector<std::array<double, 4>> barycentric;
  for (const PathPoint& point : path.points) {
    simplices.push_back(point.simplex == none ? -1 : static_cast<std::int64_t>(point.simplex));
    barycentric.push_back(point.barycentric);
  }
  py::object positions = py::none();
  if (placed) positions = owned(std::move(path.positions));
  return py::make_tuple(std::move(positions), owned(std::move(simplices)),
                        owned(std::move(barycentric)), path.length,
                        path.source == none ? -1 : static_cast<std::int64_t>(path.source));
}

ReadOut level_of(const std::string& name) {
  if (name == "linear") return ReadOut::linear;
  if (name == "simplex") return ReadOut::simplex;
  if (name == "neighbours") return ReadOut::neighbours;
  if (name == "star") return ReadOut::star;
  throw py::value_error("level '" + name +
                        "': choose one of 'linear', 'simplex', 'neighbours', 'star'");
}

// Keeps the domain, which the field refers to.
struct Field {
  std::shared_ptr<const Domain> domain;
  AnyPathField any;
  const AnyDomain* on;       // which of the domain's
  std::vector<Remark> told;  // what holds for the field alone
  PropagateOptions bounds;   // radius alone
};

std::vector<Remark> remarks(const Field& field) {
  const py::gil_scoped_release free;
  std::vector<Remark> all = domain_remarks(*field.on, Reader::python);
  const auto reach = reach_remarks(*field.on, field.any.field(), field.bounds, Reader::python);
  for (const auto* some : {&field.told, &reach}) all.insert(all.end(), some->begin(), some->end());
  return all;
}

std::shared_ptr<Field> path_field(const std::shared_ptr<Domain>& domain, std::vector<Source> given,
                                  const SolveArguments& arguments, py::object progress) {
  const Sources sources(std::move(given));
  const AnyExecutor executor = executor_of(arguments);
  Watch watch(std::move(progress));
  const PropagateOptions options = options_of(arguments, watch);
  return watch.run([&] {
    const AnyDomain& any = domain->for_sources(executor, sources.list(), options);
    AnyPathField field = any.path_field(executor, sources.points(Purpose::paths), options);
    std::vector<Remark> told = field_remarks(any, field.field(), sources.list(), Reader::python);
    PropagateOptions bounds;
    bounds.radius = options.radius;
    return std::make_shared<Field>(
        Field{domain, std::move(field), &any, std::move(told), std::move(bounds)});
  });
}

py::array distance(const std::shared_ptr<Field>& field) {
  const py::object owner = py::cast(field);
  const AnyField& of = field->any.field();
  return std::visit(
      [&](const auto& f) -> py::array {
        return view(f.distance.data(), 1, f.distance.size(), owner).attr("ravel")();
      },
      of.data);
}

py::list isolines(const Domain& domain, const py::object& distance, const py::object& values) {
  const std::vector<double> field = numbers_of(distance, "distance");
  const std::vector<double> wanted = numbers_of(values, "values");
  std::vector<Path> lines;
  {
    const py::gil_scoped_release free;
    lines = plexway::isolines(domain.any(), field, wanted);
  }
  py::list list;
  for (Path& line : lines) {
    const bool placed = !line.positions.empty();
    list.append(told(std::move(line), placed));
  }
  return list;
}

py::tuple isosurfaces(const Domain& domain, const py::object& distance, const py::object& values) {
  const std::vector<double> field = numbers_of(distance, "distance");
  const std::vector<double> wanted = numbers_of(values, "values");
  Isosurfaces found;
  {
    const py::gil_scoped_release free;
    found = plexway::isosurfaces(domain.open(), field, wanted);
  }
  return py::make_tuple(owned(std::move(found.positions)), owned(std::move(found.triangles)),
                        owned(std::move(found.value)));
}

}  // namespace

void bind_paths(py::module_& module) {
  py::class_<Field, std::shared_ptr<Field>>(module, "Field")
      .def_property_readonly("distance", &distance)
      .def_property_readonly("notes", [](const Field& f) { return texts_of(remarks(f)); })
      .def_property_readonly("doubts", [](const Field& f) { return doubts_of(f.told); })
      .def_property_readonly("bytes", [](const Field& f) { return f.any.bytes(); })
      .def("label", [](const Field& f) { return owned(f.any.field().file_label()); })
      .def("trace",
           [](const Field& f, const PointSource& point, const std::optional<double>& margin) {
             Path path;
             {
               const py::gil_scoped_release free;
               path = f.any.trace(point, {.margin = margin});
             }
             const bool placed = path.points.empty() ? !f.domain->shape().positions().empty()
                                                     : !path.positions.empty();
             return told(std::move(path), placed);
           })
      .def("at",
           [](const Field& f, const std::vector<PointSource>& points, const std::string& level) {
             const ReadOut asked = level_of(level);
             std::vector<double> distances;
             {
               const py::gil_scoped_release free;
               distances = f.any.at(points, asked);
             }
             return owned(std::move(distances));
           })
      .def("gradient", [](const Field& f) {
        std::vector<std::array<double, 3>> directions;
        {
          const py::gil_scoped_release free;
          directions = f.any.gradient();
        }
        return owned(std::move(directions));
      });
  module.def("path_field", &path_field);
  module.def("isolines", &isolines);
  module.def("isosurfaces", &isosurfaces);
}

}  // namespace plexway::python
