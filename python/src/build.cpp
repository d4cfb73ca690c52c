#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/formats.hpp>
#include <plexway/io/labels.hpp>
#include <plexway/metric/edge_lengths.hpp>
#include <plexway/shape/open_simplices.hpp>

#include "arrays.hpp"
#include "domain.hpp"

namespace plexway::python {
namespace {

template <class Value>
Value named(const char* option, const std::string& name,
            std::initializer_list<std::pair<const char*, Value>> choices) {
  std::string names;
  for (const auto& [known, value] : choices) {
    if (name == known) return value;
    names.append(names.empty() ? "" : ", ").append("'").append(known).append("'");
  }
  throw py::value_error(std::string(option) + " '" + name + "': choose one of " + names);
}

// One tensor from nine numbers; only a symmetric matrix is one.
metric::Tensor tensor_of(const double* m) {
  const auto differ = [](double a, double b) {
    return !(std::abs(a - b) <= 1e-9 * (std::abs(a) + std::abs(b)));
  };
  if (differ(m[1], m[3]) || differ(m[2], m[6]) || differ(m[5], m[7]))
    throw py::value_error("metric: a tensor must be symmetric");
  return {m[0], m[1], m[2], m[4], m[5], m[8]};
}

std::vector<metric::Tensor> tensors_of(const py::handle& array) {
  const std::vector<double> numbers = numbers_of(array, "metric");
  std::vector<metric::Tensor> tensors;
  for (std::size_t i = 0; i + 9 <= numbers.size(); i += 9)
    tensors.push_back(tensor_of(&numbers[i]));
  return tensors;
}

// `described`: what it is, its array, and for those a simplex whether paths are refracted.
metric::Metric metric_of(const py::tuple& described, bool refracts) {
  const auto kind = described[0].cast<std::string>();
  metric::Agreement agreement;
  if (refracts && described.size() == 3 && kind != "lengths" && described[2].cast<bool>())
    agreement.sides = metric::Sides::own;
  if (kind == "speeds") return metric::SimplexSpeeds{numbers_of(described[1], "metric"), agreement};
  if (kind == "simplex tensors") return metric::SimplexTensors{tensors_of(described[1]), agreement};
  if (kind == "vertex tensors") return metric::VertexTensors{tensors_of(described[1])};
  if (kind == "lengths") {
    const auto edges = index_rows_of<2>(described[1], "edges");
    const std::vector<double> lengths = numbers_of(described[2], "lengths");
    if (edges.size() != lengths.size())
      throw py::value_error("lengths: expected one an edge, " + std::to_string(edges.size()) +
                            ", got " + std::to_string(lengths.size()));
    metric::GivenLengths given;
    for (std::size_t i = 0; i < edges.size(); ++i)
      given.edges.push_back({edges[i][0], edges[i][1], lengths[i]});
    return given;
  }
  return metric::TensorFunction{[function = py::object(described[1])](const metric::Point& at) {
    const std::vector<double> m = numbers_of(function(at), "metric");
    if (m.size() != 9) throw py::value_error("metric: the function must return a 3 x 3 matrix");
    return tensor_of(m.data());
  }};
}

// What a domain was measured to have before: ("measured", rows, refracts).
MeasuredLengths measured_before(const AnyShape& shape, const py::tuple& described) {
  MeasuredLengths lengths;
  lengths.refracts = described[2].cast<bool>();
  if (shape.kind() == DomainKind::surface) {
    lengths.triangles = number_rows_of<3>(described[1], "lengths");
    lengths.violations =
        metric::find_violations(std::span<const std::array<double, 3>>(lengths.triangles));
  } else if (shape.kind() == DomainKind::solid && lengths.refracts) {
    lengths.speeds = numbers_of(described[1], "speeds");
  } else if (shape.kind() == DomainKind::solid) {
    lengths.tets = number_rows_of<6>(described[1], "lengths");
    lengths.violations =
        metric::find_violations(std::span<const std::array<double, 6>>(lengths.tets));
  } else if (shape.kind() == DomainKind::mixed) {
    lengths.speeds = numbers_of(described[1], "speeds");
  } else {
    lengths.edges = numbers_of(described[1], "lengths");
  }
  return lengths;
}

// A metric by which a shape is measured now; a surface that has lengths alone by speeds.
MeasuredLengths measured_by(const AnyShape& shape, const py::tuple& described) {
  const metric::Metric metric = metric_of(
      described, shape.kind() == DomainKind::surface || shape.kind() == DomainKind::solid);
  const auto* speeds = std::get_if<metric::SimplexSpeeds>(&metric);
  if (shape.kind() != DomainKind::surface || shape.lengths() == nullptr || speeds == nullptr)
    return shape.measure(metric);
  MeasuredLengths lengths;
  lengths.refracts = speeds->agreement.sides == metric::Sides::own;
  lengths.triangles = metric::triangle_times(
      shape.lengths()->triangles, std::get<io::Triangles>(shape.data()).triangles, *speeds);
  lengths.violations =
      metric::find_violations(std::span<const std::array<double, 3>>(lengths.triangles));
  return lengths;
}

struct BuildArguments {
  std::string precision, triangulation;
  py::object metric;    // None, or a tuple as above
  py::object mask;      // see mask_of
  py::object progress;  // None or a function
};

// None; a text (shape/open_simplices.hpp); truth values, which are left of the vertices or the
// simplices; or those of both that are closed.
std::shared_ptr<const Mask> mask_of(const py::object& given, const AnyShape& shape) {
  if (given.is_none()) return nullptr;
  if (py::isinstance<py::str>(given)) return read_mask(given.cast<std::string>(), shape);
  const std::size_t vertices = shape.vertices(), simplices = shape.simplices();
  auto mask = std::make_shared<Mask>(vertices, simplices);
  if (py::isinstance<py::tuple>(given)) {
    const auto both = given.cast<py::tuple>();
    const std::vector<Index> of_vertices = indices_of(both[0], "mask");
    const std::vector<Index> of_simplices = indices_of(both[1], "mask");
    for (Index v = 0; v < of_vertices.size(); ++v)
      if (of_vertices[v] != 0) mask->close_vertex(v);
    for (Index s = 0; s < of_simplices.size(); ++s)
      if (of_simplices[s] != 0) mask->close_simplex(s);
    return mask;
  }
  const py::array array = py::array::ensure(given);
  if (!array || array.dtype().kind() != 'b' || array.ndim() != 1)
    throw py::value_error("mask: expected truth values, one a vertex or one a simplex");
  const auto truth = array.cast<py::array_t<bool, py::array::c_style | py::array::forcecast>>();
  const std::span<const bool> left(truth.data(), static_cast<std::size_t>(truth.size()));
  if (vertices == simplices && left.size() == vertices)
    throw py::value_error(
        "mask: there are as many simplices as vertices; leave the simplices out of the array");
  if (left.size() != vertices && left.size() != simplices)
    throw py::value_error("mask: expected " + std::to_string(vertices) + " or " +
                          std::to_string(simplices) + " truth values, got " +
                          std::to_string(left.size()));
  for (Index i = 0; i < left.size(); ++i) {
    if (left[i]) continue;
    if (left.size() == simplices)
      mask->close_simplex(i);
    else
      mask->close_vertex(i);
  }
  return mask;
}

std::shared_ptr<Domain> build(AnyShape shape, const BuildArguments& arguments) {
  BuildOptions options;
  options.precision =
      named<Precision>("precision", arguments.precision,
                       {{"single", Precision::float32}, {"double", Precision::float64}});
  options.triangulation = named<Triangulation>("triangulation", arguments.triangulation,
                                               {{"auto", Triangulation::automatic},
                                                {"input", Triangulation::input},
                                                {"delaunay", Triangulation::delaunay},
                                                {"refined", Triangulation::refined}});
  if (!arguments.metric.is_none()) {
    const auto described = arguments.metric.cast<py::tuple>();
    options.lengths = std::make_shared<const MeasuredLengths>(
        described[0].cast<std::string>() == "measured" ? measured_before(shape, described)
                                                       : measured_by(shape, described));
  }
  options.mask = mask_of(arguments.mask, shape);
  Watch watch(arguments.progress);
  options.progress = watch.of_share();
  return watch.run([&] { return std::make_shared<Domain>(std::move(shape), std::move(options)); });
}

BuildArguments arguments_of(const py::kwargs& given) {
  return {given["precision"].cast<std::string>(), given["triangulation"].cast<std::string>(),
          given["metric"], given.contains("mask") ? py::object(given["mask"]) : py::none(),
          given["progress"]};
}

CloudPreparation preparation_of(const py::kwargs& given) {
  CloudPreparation made;
  const auto take = [&](const char* name, auto& value) {
    if (given.contains(name)) value = given[name].cast<std::decay_t<decltype(value)>>();
  };
  take("k", made.k);
  take("neighbour_radius", made.neighbour_radius);
  take("max_normal_angle", made.max_normal_angle);
  take("denoise", made.denoise);
  take("deviations", made.deviations);
  take("smooth", made.smooth);
  return made;
}

std::shared_ptr<Domain> from_arrays(const std::string& kind, const py::object& positions,
                                    std::size_t vertices, const py::object& simplices,
                                    const py::object& lengths, const py::kwargs& given) {
  const BuildArguments arguments = arguments_of(given);
  const auto make = [&]() -> AnyShape {
    if (kind == "surface") {
      auto rows = index_rows_of<3>(simplices, "F");
      if (lengths.is_none()) return AnyShape::surface(points_of(positions, "V"), std::move(rows));
      return AnyShape::surface(vertices, std::move(rows), number_rows_of<3>(lengths, "lengths"));
    }
    if (kind == "solid") {
      auto rows = index_rows_of<4>(simplices, "T");
      if (lengths.is_none()) return AnyShape::solid(points_of(positions, "V"), std::move(rows));
      return AnyShape::solid(vertices, std::move(rows), number_rows_of<6>(lengths, "lengths"));
    }
    auto rows = index_rows_of<2>(simplices, "E");
    if (lengths.is_none()) return AnyShape::wireframe(points_of(positions, "V"), std::move(rows));
    return AnyShape::wireframe(vertices, std::move(rows), numbers_of(lengths, "lengths"));
  };
  const AnyShape made = make();
  const py::object merge = given["merge"];
  return build(merge.is_none() ? made : made.merged(merge.cast<double>()), arguments);
}

std::shared_ptr<Domain> from_simplices(const py::object& positions, std::size_t vertices,
                                       const py::object& simplices, int dimension, std::size_t axes,
                                       const py::object& lengths, const py::kwargs& given) {
  SimplexShape shape;
  shape.dimension = dimension;
  shape.vertices = vertices;
  shape.axes = axes;
  shape.corners = indices_of(simplices, "S", static_cast<std::size_t>(dimension) + 1);
  if (lengths.is_none())
    shape.positions = numbers_of(positions, "V");
  else
    shape.lengths = numbers_of(lengths, "lengths");
  return build(AnyShape::simplices(std::move(shape)), arguments_of(given));
}

std::shared_ptr<Domain> from_points(const py::object& positions, const py::object& normals,
                                    const py::object& original, const py::kwargs& given) {
  io::Points points;
  points.positions = points_of(positions, "V");
  if (!normals.is_none()) {
    points.normals = number_rows_of<3>(normals, "normals");
    if (points.normals.size() != points.positions.size())
      throw py::value_error("normals: expected one a point");
  }
  if (!original.is_none()) points.original = indices_of(original, "original");
  Watch watch(given["progress"]);
  ReadOptions reading;
  reading.cloud = preparation_of(given);
  if (given.contains("voxel")) reading.volume.voxel = given["voxel"].cast<std::optional<double>>();
  reading.progress.share = watch.of_share();
  AnyShape shape = watch.run([&] { return AnyShape::cloud(std::move(points), reading); });
  return build(std::move(shape), arguments_of(given));
}

// Parts: (V, edges, triangles, tets), each with vertices of its own.
std::shared_ptr<Domain> from_parts(const py::list& parts, double tolerance,
                                   const py::kwargs& given) {
  MixedShape shape;
  shape.tolerance = tolerance;
  for (const py::handle& handle : parts) {
    const auto part = handle.cast<py::tuple>();
    const auto positions = points_of(part[0], "V");
    MixedShape::Part made;
    made.first_vertex = shape.positions.size();
    made.vertices = positions.size();
    made.edges = index_rows_of<2>(part[1], "edges");
    made.triangles = index_rows_of<3>(part[2], "triangles");
    made.tets = index_rows_of<4>(part[3], "tets");
    const auto move = [&](auto& rows, const char* name) {
      for (auto& row : rows)
        for (Index& v : row) {
          if (v >= positions.size())
            throw py::value_error(std::string(name) + ": vertex " + std::to_string(v) +
                                  " of a part with " + std::to_string(positions.size()));
          v += static_cast<Index>(made.first_vertex);
        }
    };
    move(made.edges, "edges"), move(made.triangles, "triangles"), move(made.tets, "tets");
    shape.positions.insert(shape.positions.end(), positions.begin(), positions.end());
    shape.parts.push_back(std::move(made));
  }
  return build(AnyShape::mixed(std::move(shape)), arguments_of(given));
}

std::shared_ptr<Domain> read(const std::vector<std::filesystem::path>& files, double tolerance,
                             const py::object& as, const py::kwargs& given) {
  Watch watch(given["progress"]);
  ReadOptions reading;
  if (!as.is_none()) {
    const auto name = as.cast<std::string>();
    reading.as = kind_named(name);
    if (!reading.as)
      throw py::value_error("kind '" + name +
                            "': choose one of surface, solid, wireframe, simplices, cloud, mixed");
  }
  reading.cloud = preparation_of(given);
  if (given.contains("voxel")) reading.volume.voxel = given["voxel"].cast<std::optional<double>>();
  if (given.contains("repair")) reading.volume.repair = given["repair"].cast<bool>();
  if (given.contains("strict")) reading.strict = given["strict"].cast<bool>();
  if (given.contains("merge")) reading.merge = given["merge"].cast<std::optional<double>>();
  if (given.contains("grid")) reading.volume.grid = given["grid"].cast<std::string>();
  if (given.contains("max_volume")) reading.fill.max_volume = given["max_volume"].cast<double>();
  reading.progress.share = watch.of_share();
  reading.progress.seconds = [&watch](double) { return watch.tick(0); };
  AnyShape shape = watch.run([&] {
    return files.size() == 1 ? AnyShape::read(files.front(), reading)
                             : AnyShape::read(files, tolerance, reading);
  });
  return build(std::move(shape), arguments_of(given));
}

}  // namespace

void bind_build(py::module_& module) {
  module.def("from_arrays", &from_arrays);
  module.def("from_simplices", &from_simplices);
  module.def("from_points", &from_points);
  module.def("from_parts", &from_parts);
  module.def("read", &read);
  module.def("known_formats", &io::known_formats);
  module.def("read_labels", [](const std::filesystem::path& file, std::size_t vertices) {
    return owned(io::read_vertex_labels(file, vertices));
  });
}

}  // namespace plexway::python
