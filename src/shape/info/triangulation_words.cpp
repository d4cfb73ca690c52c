#include "shape/info/triangulation_words.hpp"

namespace plexway {
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

}  // namespace plexway
