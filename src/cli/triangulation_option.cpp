#include "triangulation_option.hpp"

#include <CLI/CLI.hpp>

#include <plexway/error.hpp>

#include "make_complex.hpp"
#include "progress.hpp"

namespace plexway::cli {

void add_triangulation_option(CLI::App& command, TriangulationArgument& argument) {
  command
      .add_option("--triangulation", argument.name,
                  "surfaces: which triangles to solve on: input, delaunay (the intrinsic\n"
                  "Delaunay triangulation of the same vertices), or auto (default: delaunay\n"
                  "where the input's are badly shaped; 'plexway info' tells)")
      ->type_name("NAME")
      ->group("How to solve");
}

Triangulation triangulation_of(const TriangulationArgument& argument) {
  if (argument.name == "input") return Triangulation::input;
  if (argument.name == "delaunay") return Triangulation::delaunay;
  if (argument.name == "auto") return Triangulation::automatic;
  throw UsageError("--triangulation '" + argument.name + "': choose one of input, delaunay, auto");
}

void check_triangulation(Triangulation wanted, const Domain& domain) {
  if (wanted == Triangulation::delaunay && domain.kind() != "surface")
    throw UsageError("--triangulation delaunay: a " + std::string(domain.kind()) +
                     " has no triangles to flip; leave the option out");
}

template <class Real>
std::optional<IntrinsicDelaunay> retriangulate(Triangulation wanted, const io::Triangles& surface,
                                               TriangleMesh<Real>& mesh,
                                               TriangulationReport& report) {
  report = {};
  if (wanted == Triangulation::input) return std::nullopt;
  const Stopwatch working;
  std::optional<IntrinsicDelaunay> delaunay;
  if (wanted == Triangulation::delaunay || flipping_pays(measure_triangulation(mesh))) {
    if constexpr (sizeof(Real) == sizeof(double))
      delaunay.emplace(mesh);
    else
      delaunay.emplace(make_complex<double>(surface));
    report.delaunay = true;
    report.flips = delaunay->summary().flips;
    if (report.flips > 0) mesh = delaunay->mesh<Real>();
  }
  report.seconds = working.seconds();
  return delaunay;
}
template std::optional<IntrinsicDelaunay> retriangulate(Triangulation, const io::Triangles&,
                                                        TriangleMesh<float>&, TriangulationReport&);
template std::optional<IntrinsicDelaunay> retriangulate(Triangulation, const io::Triangles&,
                                                        TriangleMesh<double>&,
                                                        TriangulationReport&);

std::string_view name_of(const TriangulationReport& report) {
  return report.delaunay ? "delaunay" : "input";
}

std::string describe(const TriangulationReport& report) {
  if (!report.delaunay) return "as in the input";
  return "intrinsic Delaunay, " + counted(report.flips, "flips") + ", " +
         short_time(report.seconds);
}

void add_shape(const TriangulationShape& shape, Json& json, Table& table) {
  Json& triangulation = json["triangulation"];
  triangulation["non_delaunay_share"] = shape.non_delaunay_share();
  triangulation["non_delaunay_edges"] = shape.non_delaunay_edges;
  triangulation["smallest_angle"] = shape.smallest_angle;
  triangulation["largest_angle"] = shape.largest_angle;
  triangulation["needle_share"] = shape.needle_share;
  triangulation["blunt_share"] = shape.blunt_share;
  triangulation["auto"] = flipping_pays(shape) ? "delaunay" : "input";
  table.add("triangles", "angles " + short_number(shape.smallest_angle) + " to " +
                             short_number(shape.largest_angle) + " degrees; " +
                             short_number(100 * shape.non_delaunay_share()) +
                             " % of the inner edges are not Delaunay; --triangulation auto takes " +
                             (flipping_pays(shape) ? "delaunay" : "input"));
}

}  // namespace plexway::cli
