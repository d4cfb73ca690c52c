#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <plexway/io/tets.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "shape/info/report.hpp"
#include "shape/warnings/survey.hpp"

namespace plexway::detail {

/// What `info` says of a domain: the same for programs and for people.
struct InfoReport {
  Json json;  ///< without "input" and "kind"
  Table table;
  std::vector<std::string> warnings;

  /// So many of them under `key`, and where there are any what that means.
  void add_count(const char* key, std::size_t count, std::string_view plural,
                 const std::string& meaning) {
    json[key] = count;
    warn(count, plural, meaning);
  }
  /// So many of them, where there are any, and what that means.
  void warn(std::size_t count, std::string_view plural, const std::string& meaning) {
    if (count > 0) warnings.push_back(counted(count, plural) + meaning);
  }
  /// How many vertices each component has: of the 100 largest; a row where there are several.
  void add_components(std::size_t count, const std::vector<std::size_t>& sizes);
  /// Where it lies, and how long its edges are; `nowhere` stands for the box where there is none.
  void add_space(std::span<const std::array<double, 3>> positions,
                 const std::optional<Spread>& spread,
                 const std::string& nowhere = "none: not in space",
                 const std::string& edges = "edge length");
  /// How many simplices are longer than wide.
  void add_slender(double share, std::string_view simplices);
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

/// What is measured on a solid beside SolidSummary, in the file's unit.
struct SolidSurvey {
  Spread edge;                            ///< over all edges, each once
  double volume = 0, largest_volume = 0;  ///< of all tetrahedra, and of one
  /// Share of tetrahedra whose longest edge is more than 10 times sqrt(3/2) their lowest height.
  double slender_share = 0;
  std::size_t coincident_vertices = 0;
};

/// Cost: O(n log n).
SolidSurvey survey_solid(const AnyShape& solid);

}  // namespace plexway::detail
