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

struct MeasuredLengths;

/// Which triangles a surface is solved on.
enum class Triangulation { input, delaunay, refined, automatic };

/// As typed.
struct TriangulationArgument {
  std::string name = "auto";
};

/// Adds --triangulation to a command, in the group of the options that say how to solve.
void add_triangulation_option(CLI::App& command, TriangulationArgument& argument);

/// Throws UsageError for a name that does not exist.
Triangulation triangulation_of(const TriangulationArgument& argument);

/// Throws UsageError where `delaunay` or `refined` is asked of what is no surface.
void check_triangulation(Triangulation wanted, const Domain& domain);

/// Which one it became.
struct TriangulationReport {
  Retriangulation done = Retriangulation::keep;
  std::size_t flips = 0;
  std::size_t inserted_vertices = 0;  ///< numbered after the input's
  double seconds = 0;                 ///< for building on other triangles, where that was done
};

/// Builds a surface on the triangles wanted, or if that is left open on those that pay; what comes
/// with it translates sources. `lengths` are those of a metric, or null.
template <class Real>
TriangulatedSurface<Real> make_surface(Triangulation wanted, const io::Triangles& surface,
                                       const MeasuredLengths* lengths, TriangulationReport& report);

/// What a report says of it: "input", "delaunay" or "refined"; and a sentence for people.
[[nodiscard]] std::string_view name_of(const TriangulationReport& report);
[[nodiscard]] std::string describe(const TriangulationReport& report);

/// What `info` says of the triangles: their shape, and what `auto` makes of it.
void add_shape(const TriangulationShape& shape, Json& json, Table& table);

}  // namespace plexway::cli
