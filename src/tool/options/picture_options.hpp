#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/scene.hpp>

#include "tool/options/input.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {

/// --picture and --html, and what goes with them, as typed.
struct PictureArguments {
  std::string file, html;
  std::string view, size, range, map, clip, isosurfaces, up, title;
  std::optional<std::size_t> isolines;
  std::string colour;  ///< distance or cells, where a command has both
  bool transparent = false, orthographic = false, small = false;

  [[nodiscard]] bool wanted() const { return !file.empty() || !html.empty(); }
  /// The axis that points up in a picture of this: as requested, or as the shape looks.
  [[nodiscard]] char up_of(const Domain& domain) const;
};

/// Adds the options to a command; `cells` adds --colour.
void add_picture_options(CLI::App& app, PictureArguments& arguments, bool cells = false);

/// Before any work: throws UsageError for a value that makes no sense or an option without
/// --picture, NotBuiltError where this build draws no pictures, and as check_output_name.
void check_picture(const PictureArguments& arguments, const std::string& input);

/// Adds which axis points up to a report, where a picture is wanted of what has positions.
void report_picture(const PictureArguments& arguments, const Domain& domain, Summary& summary);

/// Draws and writes the picture, and the page. Throws as render::picture, render::write_png and
/// io::write_page, and UsageError for a domain without positions. Says a note unless `quiet`.
void write_picture(const PictureArguments& arguments, const Domain& domain,
                   const SceneContent& content, bool quiet);

/// --isoline-step and --isolines-out, as typed.
struct IsolineOptions {
  std::string out;
  std::optional<double> step;
};

void add_isoline_options(CLI::App& command, IsolineOptions& options);

/// Before any work: throws UsageError for one without the other, a step that is not > 0, or as
/// check_output_name. Then, for a domain that is neither surface nor solid, or an extension that is
/// not for it.
void check_isolines(const IsolineOptions& options, const std::string& input);
void check_isolines(const IsolineOptions& options, const Domain& domain);

/// Each multiple of the step below the largest distance, but 0; none where none are requested.
/// Throws UsageError for more than 10000, and for none where the file cannot be empty.
std::vector<double> isoline_values(const IsolineOptions& options, std::span<const double> distance);

}  // namespace plexway::detail::cli
