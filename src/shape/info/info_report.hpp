#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <plexway/io/tets.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "shape/info/report.hpp"
#include "shape/warnings/survey.hpp"

namespace plexway {

/// What `info` says of a domain: the same for programs and for people.
struct InfoReport {
  Json json;  ///< without "input" and "kind"
  Table table;
};

/// In double precision, on the triangles of the file. Throws InputError "FILE: cause".
inline AnyDomain measured_domain(const AnyShape& domain) {
  return AnyDomain(domain,
                   {.precision = Precision::float64, .triangulation = Triangulation::input});
}
template <class Complex>
const Complex& complex_as(const AnyDomain& built) {
  return *std::get<const Complex*>(complex_of(built));
}

/// Throw InputError "FILE: cause" where the domain makes no complex. One for each kind.
InfoReport info_of(const AnyShape& domain, const io::Triangles& surface);
InfoReport info_of(const AnyShape& domain, const io::Tets& solid);
InfoReport info_of(const AnyShape& domain, const io::Edges& wireframe);
InfoReport info_of(const AnyShape& domain, const CloudShape& cloud);
InfoReport info_of(const AnyShape& domain, const SimplexShape& simplices);
InfoReport info_of(const AnyShape& domain, const MixedShape& mixed);

/// What the file's reader did besides taking what it has, and simplices that are left out:
/// "split_polygons", "split_cells", "dropped_simplices" and "passed_over"; rows of what there is.
void add_file_report(const AnyShape& domain, Json& json, Table& table);

/// Executors and devices that can run solves here.
InfoReport info_of_devices();

// Pieces that several kinds have.

Json to_json(const Bounds& box);
Json to_json(const Spread& spread);
std::string to_text(const Bounds& box);
std::string to_text(const Spread& spread);
/// At most the 100 largest.
Json sizes_json(const std::vector<std::size_t>& sizes);
/// Adds a line with the sizes of the largest components where there are several.
void add_sizes(Table& table, const std::vector<std::size_t>& sizes);

/// What is measured on a solid beside SolidSummary, in the file's unit.
struct SolidSurvey {
  Bounds box;
  Spread edge;                            ///< over all edges, each once
  double volume = 0, largest_volume = 0;  ///< of all tetrahedra, and of one
  /// Share of tetrahedra whose longest edge is more than 10 times sqrt(3/2) their lowest height.
  double slender_share = 0;
  std::size_t coincident_vertices = 0;
};

/// Cost: O(n log n).
SolidSurvey survey_solid(const AnyShape& solid);

/// What may surprise the user of this solid, a sentence each.
std::vector<std::string> solid_warnings(const SolidSummary& summary, const SolidSurvey& survey);

}  // namespace plexway
