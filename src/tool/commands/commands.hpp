#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace plexway::cli {

struct Among;

/// What the command line asks for; set while it is parsed, run afterwards.
using Action = std::function<void()>;

void add_distance_command(CLI::App& tool, Action& action, const Among* among);
void add_info_command(CLI::App& tool, Action& action);
void add_bench_command(CLI::App& tool, Action& action);
void add_path_command(CLI::App& tool, Action& action);
void add_tetrahedralize_command(CLI::App& tool, Action& action);
void add_convert_command(CLI::App& tool, Action& action);
void add_prepare_command(CLI::App& tool, Action& action);
void add_poisson_command(CLI::App& tool, Action& action);
void add_cvt_command(CLI::App& tool, Action& action);
void add_farthest_command(CLI::App& tool, Action& action);
void add_pairs_command(CLI::App& tool, Action& action, const Among* among);
void add_tune_command(CLI::App& tool, Action& action);

}  // namespace plexway::cli
