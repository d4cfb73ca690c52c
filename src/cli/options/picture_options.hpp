#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <plexway/any/scene.hpp>

#include "cli/options/input.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// --picture and what goes with it, as typed.
struct PictureArguments {
  std::string file;
  std::string view, size, range, map, clip, isosurfaces, up, title;
  std::optional<std::size_t> isolines;
  std::string colour;  ///< distance or cells, where a command has both
  bool transparent = false, orthographic = false, small = false;

  [[nodiscard]] bool wanted() const { return !file.empty(); }
};

/// Adds the options to a command; `cells` adds --colour.
void add_picture_options(CLI::App& app, PictureArguments& arguments, bool cells = false);

/// Before any work: throws UsageError for a value that makes no sense or an option without
/// --picture, NotBuiltError where this build draws no pictures, and as check_output_name.
void check_picture(const PictureArguments& arguments, const std::string& input);

/// Draws and writes the picture. Throws as render::picture and render::write_png, and UsageError
/// for a domain without positions.
void write_picture(const PictureArguments& arguments, const Domain& domain,
                   const SceneContent& content);

}  // namespace plexway::cli
