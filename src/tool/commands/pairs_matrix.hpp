#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "tool/options/input.hpp"
#include "tool/options/solve_options.hpp"

namespace plexway::cli {

struct Among;

/// What `plexway pairs --sources` takes, as typed.
struct MatrixCommand : InputCommand {
  std::string sources, targets;  ///< FILE or "all"
  std::string out, stats, histogram, labels;
  std::string type = "float32";
  std::optional<double> radius;
  std::optional<std::size_t> nearest;
  std::optional<double> bin_width;
  std::size_t bins = 100;
  bool symmetric = false, estimate = false;
  SolveOptions solve;
  MaskArgument mask;
  MetricArgument metric;
  TriangulationArgument triangulation;
  const Among* among = nullptr;  ///< who shares the rows; null: nobody
};

/// The options that only matrices of this kind have.
void add_matrix_options(CLI::App& app, MatrixCommand& command);

/// Is anything requested that only --sources understands? Its name, or empty.
[[nodiscard]] std::string only_for_matrices(const MatrixCommand& command);

/// Solves what is missing of the matrix, and puts it in its place.
void run_matrix(const MatrixCommand& command);

}  // namespace plexway::cli
