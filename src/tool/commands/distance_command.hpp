#pragma once

#include <string>
#include <vector>

#include "io/field/field_formats.hpp"
#include "tool/app.hpp"
#include "tool/options/input.hpp"
#include "tool/options/picture_options.hpp"
#include "tool/options/solve_options.hpp"

namespace plexway::detail::cli {
/// 'plexway distance', as typed.
struct DistanceCommand : InputCommand {
  std::vector<std::string> sources;
  std::string out;
  IsolineOptions isolines;
  SolveOptions solve;
  PictureArguments picture;
  MaskArgument mask;
  MetricArgument metric;
  TriangulationArgument triangulation;
  bool in_parts = false;         ///< does nobody read the whole?
  const Among* among = nullptr;  ///< who shares the pieces; null: nobody

  /// Does each process write a part?
  [[nodiscard]] bool writes_parts() const { return among != nullptr && io::is_partitioned(out); }
  /// Is it this process that writes and reports?
  [[nodiscard]] bool leads() const { return among == nullptr || among->ranks.leads(); }
};

/// With --in-parts: a surface that no process has as a whole.
void run_distance_in_parts(DistanceCommand command);

}  // namespace plexway::detail::cli
