#include "tool/options/fill_options.hpp"

#include <CLI/CLI.hpp>

#include <plexway/error.hpp>

#include "shape/arguments/point_argument.hpp"

namespace plexway::cli {

void add_fill_options(CLI::App& command, FillArguments& options) {
  const std::string group = "How to fill a surface with tetrahedra";
  command.add_option("--max-volume", options.max_volume, "no tetrahedron is larger (default: any)")
      ->type_name("V")
      ->group(group);
  command
      .add_option("--quality", options.quality,
                  "bound on circumradius over shortest edge, above 1 (default 2); 0: none")
      ->type_name("R")
      ->group(group);
  command
      .add_flag("--keep-surface", options.keep_surface,
                "add points inside only: the triangles of the surface stay")
      ->group(group);
  command
      .add_option("--max-seconds", options.max_seconds,
                  "stop TetGen after S seconds (default: never)")
      ->type_name("S")
      ->group(group);
  command
      .add_option("--hole", options.hole_texts, "a point in a cavity that stays empty; repeat it")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false)
      ->group(group);
  add_volume_options(command, options.volume);
}

FillOptions filling(const FillArguments& arguments) {
  FillOptions options = arguments;
  for (const std::string& text : arguments.hole_texts) {
    const auto point = parse_point(text);
    if (!point) throw UsageError("--hole '" + text + "': write X,Y,Z");
    options.holes.push_back(*point);
  }
  ReadOptions all;
  all.fill = options;
  all.volume = arguments.volume;
  all.spelling = Spelling::flags;
  check(all);
  return options;
}

}  // namespace plexway::cli
