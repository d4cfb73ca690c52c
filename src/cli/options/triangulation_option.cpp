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
                  "Delaunay triangulation of the vertices), refined (that, with a quarter more\n"
                  "vertices inside), or auto (default: what the shape of the input's triangles\n"
                  "calls for; 'plexway info' tells). Results are for the input's vertices")
      ->type_name("NAME")
      ->group("How to solve");
}

Triangulation triangulation_of(const TriangulationArgument& argument) {
  if (argument.name == "input") return Triangulation::input;
  if (argument.name == "delaunay") return Triangulation::delaunay;
  if (argument.name == "refined") return Triangulation::refined;
  if (argument.name == "auto") return Triangulation::automatic;
  throw UsageError("--triangulation '" + argument.name +
                   "': choose one of input, delaunay, refined, auto");
}

void check_triangulation(Triangulation wanted, const Domain& domain) {
  const bool asked = wanted == Triangulation::delaunay || wanted == Triangulation::refined;
  if (asked && domain.kind() != "surface")
    throw UsageError(std::string("--triangulation ") +
                     (wanted == Triangulation::delaunay ? "delaunay" : "refined") + ": a " +
                     std::string(domain.kind()) +
                     " has no triangles to flip; leave the option out");
}

template <class Real>
TriangulatedSurface<Real> make_surface(Triangulation wanted, const io::Triangles& surface,
                                       const MeasuredLengths* lengths,
                                       TriangulationReport& report) {
  report = {};
  const Stopwatch working;
  const auto named = [](Triangulation asked) -> std::optional<Retriangulation> {
    if (asked == Triangulation::automatic) return std::nullopt;
    return asked == Triangulation::input      ? Retriangulation::keep
           : asked == Triangulation::delaunay ? Retriangulation::flips
                                              : Retriangulation::refined;
  }(wanted);
  auto made = [&]() -> TriangulatedSurface<Real> {
    if (lengths == nullptr) return triangulate<Real>(surface.positions, surface.triangles, named);
    TriangleMesh<Real> mesh = make_complex<Real>(surface, lengths);
    const Retriangulation done = named ? *named : what_pays(measure_triangulation(mesh));
    if (done == Retriangulation::keep) return {std::move(mesh), std::nullopt, done};
    IntrinsicDelaunay delaunay(make_complex<double>(surface, lengths), refinement_for(done));
    if (delaunay.summary().flips + delaunay.summary().inserted_vertices > 0)
      mesh = delaunay.mesh<Real>();
    delaunay.release_triangles();
    return {std::move(mesh), std::move(delaunay), done};
  }();
  report.done = made.done;
  if (made.delaunay) {
    report.flips = made.delaunay->summary().flips;
    report.inserted_vertices = made.delaunay->summary().inserted_vertices;
    report.seconds = working.seconds();
  }
  return made;
}
template TriangulatedSurface<float> make_surface(Triangulation, const io::Triangles&,
                                                 const MeasuredLengths*, TriangulationReport&);
template TriangulatedSurface<double> make_surface(Triangulation, const io::Triangles&,
                                                  const MeasuredLengths*, TriangulationReport&);

namespace {

std::string_view name_of(Retriangulation done) {
  return done == Retriangulation::keep    ? "input"
         : done == Retriangulation::flips ? "delaunay"
                                          : "refined";
}

}  // namespace

std::string_view name_of(const TriangulationReport& report) { return name_of(report.done); }

std::string describe(const TriangulationReport& report) {
  std::string text =
      report.done == Retriangulation::keep ? "as in the input" : "intrinsic Delaunay, ";
  if (report.done == Retriangulation::keep) return text;
  text += counted(report.flips, "flips");
  if (report.done == Retriangulation::refined)
    text += " and " + counted(report.inserted_vertices, "vertices") + " put in";
  return text + ", " + short_time(report.seconds);
}

void add_shape(const TriangulationShape& shape, Json& json, Table& table) {
  Json& triangulation = json["triangulation"];
  triangulation["non_delaunay_share"] = shape.non_delaunay_share();
  triangulation["non_delaunay_edges"] = shape.non_delaunay_edges;
  triangulation["smallest_angle"] = shape.smallest_angle;
  triangulation["largest_angle"] = shape.largest_angle;
  triangulation["needle_share"] = shape.needle_share;
  triangulation["blunt_share"] = shape.blunt_share;
  triangulation["auto"] = name_of(what_pays(shape));
  table.add("triangles", "angles " + short_number(shape.smallest_angle) + " to " +
                             short_number(shape.largest_angle) + " degrees; " +
                             short_number(100 * shape.non_delaunay_share()) +
                             " % of the inner edges are not Delaunay; --triangulation auto takes " +
                             std::string(name_of(what_pays(shape))));
}

}  // namespace plexway::cli
