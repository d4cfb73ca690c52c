#pragma once

#include <functional>
#include <string>
#include <vector>

#include <plexway/tetgen/tetrahedralize.hpp>

namespace plexway::tetgen {

/// The name of the program that runs TetGen.
constexpr const char* helper_name = "plexway-tetgen";

/// How a run of TetGen ended. The first ones are the numbers that TetGen itself throws.
enum class Ending : int {
  done = 0,
  out_of_memory = 1,
  internal_error = 2,
  self_intersection = 3,
  tiny_feature = 4,
  close_facets = 5,
  input_error = 10,
  killed = 100,   ///< by somebody, or by the system
  crashed = 103,  ///< by a fault of its own, abort() included
  out_of_time = 101,
  cancelled = 102,
};

/// What a run left behind.
struct Run {
  Ending ending = Ending::killed;
  std::string how;   ///< it was killed
  std::string said;  ///< on standard output and standard error, up to a limit
  /// Where done: points (the input's own first), four corners a tetrahedron, an attribute each.
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 4>> tets;
  std::vector<double> attributes;
};

/// When to end a run before it ends by itself.
struct Patience {
  double seconds = 0;           ///< 0: no limit
  bool until_it_talks = false;  ///< when it has said more than is kept of it
  /// Asked a few times a second, with the seconds passed; false ends the run. May be empty.
  std::function<bool(double)> go_on = {};
};

/// Runs TetGen on `complex` in a child process with the switches of its command line. Indices must
/// be in range. Throws Error when there can be no child, NotBuiltError when the program is not
/// installed.
Run run_isolated(const PiecewiseLinearComplex& complex, const std::string& switches,
                 const Patience& patience);

}  // namespace plexway::tetgen
