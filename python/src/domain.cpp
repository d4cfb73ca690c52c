#include "domain.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <type_traits>
#include <utility>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/open_simplices.hpp>

#include "arrays.hpp"

namespace plexway::python {

Domain::Domain(AnyShape shape, BuildOptions options)
    : any_(std::move(shape), options), options_(std::move(options)), open_(any_.shape()) {
  if (const auto mask = without_collapsed(any_.shape(), options_.mask))
    open_ = any_.shape().open_part(*mask);
  options_.progress = {};  // it was the caller's while building
}

const AnyDomain& Domain::for_sources(const AnyExecutor& executor, const SourceList& sources,
                                     const PropagateOptions& options) const {
  const Refusal refusal = any_.support(executor, sources, options).refusal();
  if (refusal != Refusal::shapes_float && refusal != Refusal::windows_float) return any_;
  const std::scoped_lock lock(mutex_);
  if (!twice_) {
    BuildOptions twice = options_;
    twice.precision = Precision::float64;
    twice_ = std::make_unique<const AnyDomain>(shape(), twice);
  }
  return *twice_;
}

Source Domain::boundary(double offset) const {
  Source source = open_.boundary(offset);
  auto* const walls = std::get_if<VertexSource>(&source);
  if (walls == nullptr || !options_.lengths) return source;
  // By a metric the nearest wall in space says nothing: its vertices are left.
  VertexSource rim{.vertices = {}, .offset = offset};
  for (std::size_t i = 0; i < walls->vertices.size(); ++i)
    if (walls->offsets.empty() || walls->offsets[i] == 0)
      rim.vertices.push_back(walls->vertices[i]);
  return rim;
}

PointSource Domain::inside(const PointSource& point) const {
  const OpenSimplices* const open = any_.open_simplices();
  return open == nullptr ? point : open->inside(point);
}

PointSource Domain::outside(const PointSource& point) const {
  const OpenSimplices* const open = any_.open_simplices();
  return open == nullptr ? point : open->outside(point);
}

std::vector<PointSource> Domain::outside(std::vector<PointSource> points) const {
  for (PointSource& point : points) point = outside(point);
  return points;
}

namespace {

template <class Wanted>
py::tuple texts(const std::vector<Warning>& warnings, const Wanted& wanted) {
  py::list found;
  for (const Warning& warning : warnings)
    if (wanted(warning)) found.append(warning.text);
  return py::tuple(found);
}

std::vector<Warning> told_of(const Domain& domain) {
  const py::gil_scoped_release free;
  return domain_warnings(domain.any(), Reader::python);
}

}  // namespace

py::tuple texts_of(const std::vector<Warning>& warnings) {
  return texts(warnings, [](const Warning&) { return true; });
}
py::tuple doubts_of(const std::vector<Warning>& warnings) {
  return texts(warnings, [](const Warning& warning) { return warning.doubtful; });
}

std::size_t Domain::bytes() const {
  const std::scoped_lock lock(mutex_);
  return any_.bytes() + (twice_ ? twice_->bytes() : 0);
}

namespace {

py::object positions_of(const std::shared_ptr<Domain>& domain) {
  const py::object owner = py::cast(domain);
  if (const auto* shape = std::get_if<SimplexShape>(&domain->shape().data());
      shape != nullptr && shape->axes > 0)
    return view(shape->positions.data(), shape->vertices, shape->axes, owner);
  const auto rows = domain->shape().positions();
  if (rows.empty()) return py::none();
  return view(rows.data(), rows.size(), owner);
}

template <std::size_t N>
py::object rows(const std::vector<std::array<Index, N>>& simplices, const py::object& owner) {
  return view(simplices.data(), simplices.size(), owner);
}

py::object simplices(const AnyShape& shape, const py::object& owner) {
  return std::visit(
      [&](const auto& data) -> py::object {
        using Kind = std::decay_t<decltype(data)>;
        if constexpr (std::is_same_v<Kind, io::Triangles>) {
          return rows(data.triangles, owner);
        } else if constexpr (std::is_same_v<Kind, io::Tets>) {
          return rows(data.tets, owner);
        } else if constexpr (std::is_same_v<Kind, io::Edges>) {
          return rows(data.edges, owner);
        } else if constexpr (std::is_same_v<Kind, SimplexShape>) {
          const auto corners = static_cast<std::size_t>(data.dimension) + 1;
          return view(data.corners.data(), data.corners.size() / corners, corners, owner);
        } else {
          return py::none();
        }
      },
      shape.data());
}

// What is closed: as masks by vertices and by simplices, not 0 there; or None.
py::object given_mask(const Domain& domain) {
  const Mask* const mask = domain.options().mask.get();
  if (mask == nullptr) return py::none();
  const auto bytes = [](std::span<const char> closed) {
    return owned(std::vector<std::uint8_t>(closed.begin(), closed.end()));
  };
  return py::make_tuple(bytes(mask->closed_vertices()), bytes(mask->closed_simplices()));
}

// One row a simplex, as the domain was made from; or None.
py::object lengths_of(const MeasuredLengths* lengths, const py::object& owner) {
  if (lengths == nullptr) return py::none();
  if (!lengths->triangles.empty())
    return view(lengths->triangles.data(), lengths->triangles.size(), owner);
  if (!lengths->tets.empty()) return view(lengths->tets.data(), lengths->tets.size(), owner);
  if (!lengths->speeds.empty())
    return view(lengths->speeds.data(), lengths->speeds.size(), 1, owner).attr("ravel")();
  return view(lengths->edges.data(), lengths->edges.size(), 1, owner).attr("ravel")();
}

py::object given_lengths(const std::shared_ptr<Domain>& domain) {
  const py::object owner = py::cast(domain);
  const AnyShape& shape = domain->shape();
  if (const auto* edges = std::get_if<io::Edges>(&shape.data()); edges && !edges->lengths.empty())
    return view(edges->lengths.data(), edges->lengths.size(), 1, owner).attr("ravel")();
  if (const auto* own = std::get_if<SimplexShape>(&shape.data()); own && !own->lengths.empty()) {
    const auto n = static_cast<std::size_t>(own->dimension * (own->dimension + 1) / 2);
    return view(own->lengths.data(), own->lengths.size() / n, n, owner);
  }
  return lengths_of(shape.lengths(), owner);
}

// Parts of a mixed domain as from_parts takes them, vertices by numbers of the part.
py::object parts(const Domain& domain) {
  const auto* shape = std::get_if<MixedShape>(&domain.shape().data());
  if (shape == nullptr) return py::none();
  py::list list;
  for (const MixedShape::Part& part : shape->parts) {
    const auto from = [&](auto rows) {
      for (auto& row : rows)
        for (Index& v : row) v -= static_cast<Index>(part.first_vertex);
      return owned(std::move(rows));
    };
    const auto first = shape->positions.begin() + static_cast<std::ptrdiff_t>(part.first_vertex);
    list.append(py::make_tuple(
        owned(std::vector(first, first + static_cast<std::ptrdiff_t>(part.vertices))),
        from(part.edges), from(part.triangles), from(part.tets)));
  }
  return py::make_tuple(list, shape->tolerance);
}

// What a cloud kept of its points, and how it looked for neighbours.
py::object cloud(const std::shared_ptr<Domain>& domain) {
  const CloudShape* shape = domain->shape().cloud();
  if (shape == nullptr) return py::none();
  const py::object owner = py::cast(domain);
  py::dict told;
  told["normals"] = shape->points.normals.empty()
                        ? py::object(py::none())
                        : view(shape->points.normals.data(), shape->points.normals.size(), owner);
  told["original"] = shape->points.original.empty() ? py::object(py::none())
                                                    : owned(std::vector(shape->points.original));
  told["k"] = shape->k;
  told["max_normal_angle"] = shape->max_normal_angle;
  told["smooth"] = !shape->smoothed.empty();
  told["points_in_file"] = shape->points_in_file;
  told["not_finite"] = shape->not_finite;
  told["outliers"] = shape->outliers;
  return told;
}

const char* name_of(Triangulation triangulation) {
  switch (triangulation) {
    case Triangulation::delaunay:
      return "delaunay";
    case Triangulation::refined:
      return "refined";
    case Triangulation::automatic:
      return "auto";
    case Triangulation::input:
      break;
  }
  return "input";
}

}  // namespace

void bind_domain(py::module_& module) {
  py::class_<Domain, std::shared_ptr<Domain>>(module, "Domain")
      .def_property_readonly("kind",
                             [](const Domain& d) { return std::string(d.shape().kind_name()); })
      .def_property_readonly("dimension", [](const Domain& d) { return d.shape().dimension(); })
      .def_property_readonly("simplex_name",
                             [](const Domain& d) { return std::string(d.shape().simplex_name()); })
      .def_property_readonly("vertex_count", [](const Domain& d) { return d.any().vertices(); })
      .def_property_readonly("simplex_count",  // those that are open
                             [](const Domain& d) {
                               const OpenSimplices* const open = d.any().open_simplices();
                               return open == nullptr ? d.any().simplices() : open->size();
                             })
      .def_property_readonly("given_simplices",
                             [](const Domain& d) { return d.shape().simplices(); })
      .def_property_readonly("components", [](const Domain& d) { return d.any().components(); })
      .def_property_readonly("mean_edge", [](const Domain& d) { return d.any().mean_edge(); })
      .def_property_readonly("bytes", &Domain::bytes)
      .def_property_readonly("build_seconds",
                             [](const Domain& d) { return d.any().build_seconds(); })
      .def_property_readonly("refracting_edges",
                             [](const Domain& d) { return d.any().refracting_edges(); })
      .def_property_readonly(
          "double", [](const Domain& d) { return d.any().precision() == Precision::float64; })
      .def_property_readonly("file", [](const Domain& d) { return d.shape().file().string(); })
      .def_property_readonly("triangulation",
                             [](const Domain& d) {
                               const TriangulationReport& report = d.any().triangulation();
                               py::dict told;
                               told["done"] = name_of(report.done);
                               told["flips"] = report.flips;
                               told["inserted_vertices"] = report.inserted_vertices;
                               return told;
                             })
      .def_property_readonly("wanted_triangulation",
                             [](const Domain& d) { return name_of(d.options().triangulation); })
      .def_property_readonly("violations",  // how many, and the first
                             [](const Domain& d) {
                               const metric::Violations found = violations_of(d.any());
                               return py::make_tuple(found.count, found.first);
                             })
      .def_property_readonly("measured",
                             [](const std::shared_ptr<Domain>& d) {
                               return lengths_of(d->options().lengths.get(), py::cast(d));
                             })
      .def_property_readonly("file_report",
                             [](const Domain& d) {
                               const io::FileReport& report = d.shape().report();
                               py::dict told, passed_over;
                               told["split_polygons"] = report.split_polygons;
                               told["split_cells"] = report.split_cells;
                               told["dropped_simplices"] = d.shape().collapsed().size();
                               told["merged_vertices"] = d.shape().merged_count();
                               for (const auto& [what, count] : report.passed_over)
                                 passed_over[what.c_str()] = count;
                               told["passed_over"] = passed_over;
                               return told;
                             })
      .def_property_readonly("notes", [](const Domain& d) { return texts_of(told_of(d)); })
      .def_property_readonly("doubts", [](const Domain& d) { return doubts_of(told_of(d)); })
      .def_property_readonly(
          "refracts",
          [](const Domain& d) { return d.options().lengths && d.options().lengths->refracts; })
      .def_property_readonly("positions", &positions_of)
      .def_property_readonly(
          "simplices",
          [](const std::shared_ptr<Domain>& d) { return simplices(d->open(), py::cast(d)); })
      .def_property_readonly(
          "all_simplices",
          [](const std::shared_ptr<Domain>& d) { return simplices(d->shape(), py::cast(d)); })
      .def("require_open",
           [](const Domain& domain, const py::list& sources) {  // cast only where it matters
             const OpenSimplices* const open = domain.any().open_simplices();
             if (open == nullptr || domain.options().mask == nullptr) return;
             for (const py::handle source : sources) open->require(source.cast<Source>());
           })
      .def_property_readonly("mask", &given_mask)
      .def_property_readonly("merge",  // None where no vertices were merged
                             [](const Domain& d) {
                               const bool any = !d.shape().merged_vertices().empty();
                               return any ? std::optional(d.shape().merge_tolerance())
                                          : std::nullopt;
                             })
      .def_property_readonly("lengths", &given_lengths)
      .def_property_readonly("parts", &parts)
      .def_property_readonly("cloud", &cloud)
      .def("corners",
           [](const Domain& d, std::size_t simplex) {
             if (simplex >= d.shape().simplices()) throw py::index_error("no such simplex");
             const auto corners = d.shape().corners(simplex);
             return std::vector<Index>(corners.begin(), corners.end());
           })
      .def("closest",
           [](const Domain& d, const std::array<double, 3>& point) {
             const py::gil_scoped_release free;
             const PointSource found = d.open().closest(point);
             const auto at = d.open().position(found);
             return std::pair(d.outside(found),
                              std::hypot(at[0] - point[0], at[1] - point[1], at[2] - point[2]));
           })
      .def("position",
           [](const Domain& d, const PointSource& point) { return d.shape().position(point); })
      .def("joined",
           [](const Domain& d, const std::vector<PointSource>& points, double offset) {
             const py::gil_scoped_release free;
             std::vector<PointSource> inside;
             for (const PointSource& point : points) inside.push_back(d.inside(point));
             CurveSource curve = d.open().joined(inside);
             curve.points = d.outside(std::move(curve.points));
             curve.offset = offset;
             return curve;
           })
      .def("boundary", &Domain::boundary)
      .def("keep", [](const Domain& d, const std::filesystem::path& out) { d.any().keep(out); })
      .def("write_field", [](const Domain& d, const std::filesystem::path& out,
                             const py::object& distance, const py::object& label) {
        const std::vector<double> values = numbers_of(distance, "distance");
        std::vector<std::int32_t> labels;
        if (!label.is_none())
          for (const double l : numbers_of(label, "label"))
            labels.push_back(static_cast<std::int32_t>(l));
        const py::gil_scoped_release free;
        d.open().write_field(out, values, labels);
      });
}

}  // namespace plexway::python
