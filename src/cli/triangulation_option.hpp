#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <plexway/complex/intrinsic_delaunay.hpp>

#include "domain.hpp"
#include "report.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// Which triangles a surface is solved on.
enum class Triangulation { input, delaunay, automatic };

/// As typed.
struct TriangulationArgument {
  std::string name = "auto";
};

/// Adds --triangulation to a command, in the group of the options that say how to solve.
void add_triangulation_option(CLI::App& command, TriangulationArgument& argument);

/// Throws UsageError for a name that does not exist.
Triangulation triangulation_of(const TriangulationArgument& argument);

/// Throws UsageError where `delaunay` is asked of what is no surface.
void check_triangulation(Triangulation wanted, const Domain& domain);

/// Which one it became.
struct TriangulationReport {
  bool delaunay = false;
  std::size_t flips = 0;
  double seconds = 0;  ///< for looking, and for flipping where that was done
};

/// Replaces the mesh of a surface by its intrinsic Delaunay triangulation if that is wanted, or if
/// it is left open and pays; what is returned then translates sources.
template <class Real>
std::optional<IntrinsicDelaunay> retriangulate(Triangulation wanted, const io::Triangles& surface,
                                               TriangleMesh<Real>& mesh,
                                               TriangulationReport& report);

/// What a report says of it: "input", or "delaunay"; and for people with the number of flips.
[[nodiscard]] std::string_view name_of(const TriangulationReport& report);
[[nodiscard]] std::string describe(const TriangulationReport& report);

/// What `info` says of the triangles: their shape, and what `auto` makes of it.
void add_shape(const TriangulationShape& shape, Json& json, Table& table);

}  // namespace plexway::cli
