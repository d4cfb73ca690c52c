#pragma once

#include <string>
#include <vector>

#include <plexway/shape/read_options.hpp>

#include "tool/options/volume_options.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// How to fill a surface with tetrahedra, as typed.
struct FillArguments : FillOptions {
  std::vector<std::string> hole_texts;
  VolumeOptions volume;

  /// Whether any of them but `volume` differs from its default.
  [[nodiscard]] bool given() const { return FillOptions::given() || !hole_texts.empty(); }
};

/// Adds the options to a command, in a group of their own.
void add_fill_options(CLI::App& command, FillArguments& options);

/// The options with the holes' points. Throws UsageError for a value out of range.
[[nodiscard]] FillOptions filling(const FillArguments& arguments);

}  // namespace plexway::cli
