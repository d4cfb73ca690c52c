#include "cli/options/triangulation_option.hpp"

#include <CLI/CLI.hpp>

#include <plexway/error.hpp>

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
  if (asked && domain.kind() != DomainKind::surface)
    throw UsageError(std::string("--triangulation ") +
                     (wanted == Triangulation::delaunay ? "delaunay" : "refined") + ": a " +
                     std::string(kind_noun(domain.kind())) +
                     " has no triangles to flip; leave the option out");
}

namespace {

std::string_view name_of(Triangulation done) {
  return done == Triangulation::input      ? "input"
         : done == Triangulation::delaunay ? "delaunay"
                                           : "refined";
}

std::string_view name_of(Retriangulation done) {
  return name_of(done == Retriangulation::keep    ? Triangulation::input
                 : done == Retriangulation::flips ? Triangulation::delaunay
                                                  : Triangulation::refined);
}

}  // namespace

std::string_view name_of(const TriangulationReport& report) { return name_of(report.done); }

std::string describe(const TriangulationReport& report) {
  std::string text =
      report.done == Triangulation::input ? "as in the input" : "intrinsic Delaunay, ";
  if (report.done == Triangulation::input) return text;
  text += counted(report.flips, "flips");
  if (report.done == Triangulation::refined)
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
