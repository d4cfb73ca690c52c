#pragma once

#include <array>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "progress.hpp"
#include "volume_options.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// How to fill a surface with tetrahedra, as typed.
struct FillOptions {
  double max_volume = 0;
  double quality = 2;
  bool keep_surface = false;
  double max_seconds = 0;
  std::vector<std::string> holes;
  VolumeOptions volume;

  /// Whether any of them but `volume` differs from its default.
  [[nodiscard]] bool given() const;
};

/// Adds the options to a command, in a group of their own.
void add_fill_options(CLI::App& command, FillOptions& options);

/// Throws UsageError for a value out of range.
void check(const FillOptions& options);

/// Throws NotBuiltError, naming the package, where this build has no TetGen; `what` starts the
/// message.
void require_tetgen(const std::string& what);

/// Whether the extension of `file` is one of TetGen's boundaries, .poly and .smesh.
bool is_poly(const std::string& file);

/// The solid inside a surface, or inside what a `.poly` or `.smesh` describes. Throws InputError
/// "FILE: cause", UsageError as `check`, NotBuiltError as `require_tetgen`, and Error at the time
/// limit.
io::Tets fill_surface(const std::string& file, const io::Triangles& surface,
                      const FillOptions& options, ProgressLine& progress);
io::Tets fill_poly(const std::string& file, const FillOptions& options, ProgressLine& progress);

}  // namespace plexway::cli
