#include "fill_options.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <utility>

#include <plexway/error.hpp>

#include "io/extension.hpp"
#include "source_argument.hpp"

#ifdef PLEXWAY_HAS_TETGEN
#include <plexway/tetgen/tetrahedralize.hpp>
#endif

namespace plexway::cli {
namespace {

std::vector<std::array<double, 3>> hole_points(const FillOptions& options) {
  std::vector<std::array<double, 3>> points;
  for (const std::string& text : options.holes) {
    const auto point = parse_point(text);
    if (!point) throw UsageError("--hole '" + text + "': write X,Y,Z");
    points.push_back(*point);
  }
  return points;
}

#ifdef PLEXWAY_HAS_TETGEN
tetgen::TetrahedralizeOptions tetgen_options(const FillOptions& options, ProgressLine& progress) {
  const auto go_on = [&progress, told = false](double seconds) mutable {
    progress.seconds_passed(seconds);
    if (seconds > 60 && !told) {
      told = true;
      progress.note(
          "TetGen has taken a minute, and on needles it may never end; --keep-surface or --quality "
          "0 often help, and --max-seconds sets a limit");
    }
    return true;
  };
  return {.max_volume = options.max_volume,
          .max_radius_edge = options.quality,
          .quality = options.quality > 0,
          .keep_surface = options.keep_surface,
          .max_seconds = options.max_seconds,
          .go_on = go_on};
}

template <class Fill>
io::Tets filled(const std::string& file, Fill fill) {
  try {
    tetgen::Solid solid = fill();
    return {std::move(solid.positions), std::move(solid.tets)};
  } catch (const InputError& error) {
    throw InputError(file + ": cannot be filled: " + error.what());
  } catch (const UsageError&) {
    throw;
  } catch (const NotBuiltError&) {
    throw;
  } catch (const Error& error) {
    throw Error(file + ": cannot be filled: " + error.what());
  }
}
#endif

}  // namespace

bool FillOptions::given() const {
  const FillOptions untouched;
  return max_volume != untouched.max_volume || quality != untouched.quality || keep_surface ||
         max_seconds != untouched.max_seconds || !holes.empty();
}

void add_fill_options(CLI::App& command, FillOptions& options) {
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
  command.add_option("--hole", options.holes, "a point in a cavity that stays empty; repeat it")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false)
      ->group(group);
  add_volume_options(command, options.volume);
}

void check(const FillOptions& options) {
  if (!(options.max_volume >= 0) || std::isinf(options.max_volume))
    throw UsageError("--max-volume must be a number greater than 0");
  if (!(options.quality == 0 || options.quality > 1) || std::isinf(options.quality))
    throw UsageError("--quality must be a number greater than 1, or 0 for none");
  if (!(options.max_seconds >= 0) || std::isinf(options.max_seconds))
    throw UsageError("--max-seconds must be a number greater than 0");
  (void)hole_points(options);
  check(options.volume);
}

void require_tetgen(const std::string& what) {
#ifdef PLEXWAY_HAS_TETGEN
  (void)what;
#else
  throw NotBuiltError(what +
                      ": filling a surface needs TetGen, which is not built in; install "
                      "libtet1.5-dev and build again");
#endif
}

bool is_poly(const std::string& file) {
  const std::string extension = io::lower_extension(file);
  return extension == ".poly" || extension == ".smesh";
}

io::Tets fill_surface(const std::string& file, const io::Triangles& surface,
                      const FillOptions& options, ProgressLine& progress) {
  check(options);
  require_tetgen(file);
#ifdef PLEXWAY_HAS_TETGEN
  return filled(file, [&] {
    return tetgen::tetrahedralize(surface.positions, surface.triangles, hole_points(options),
                                  tetgen_options(options, progress));
  });
#else
  (void)surface;
  (void)progress;
  return {};
#endif
}

io::Tets fill_poly(const std::string& file, const FillOptions& options, ProgressLine& progress) {
  check(options);
  require_tetgen(file);
#ifdef PLEXWAY_HAS_TETGEN
  auto complex = tetgen::read_poly(file);
  for (const auto& hole : hole_points(options)) complex.holes.push_back(hole);
  return filled(file,
                [&] { return tetgen::tetrahedralize(complex, tetgen_options(options, progress)); });
#else
  (void)progress;
  return {};
#endif
}

}  // namespace plexway::cli
