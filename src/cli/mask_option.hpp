#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plexway/complex/mask.hpp>
#include <plexway/source/point_source.hpp>

#include "domain.hpp"
#include "metric_options.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// As typed: FILE or KIND:FILE, or nothing.
struct MaskArgument {
  std::string text;
};

void add_mask_option(CLI::App& command, MaskArgument& argument);
/// The file, or nothing. Throws UsageError for an unknown kind.
[[nodiscard]] std::string mask_file(const MaskArgument& argument);

/// What is closed of a domain, or nothing. Throws InputError "FILE:LINE: cause", where nothing
/// stays open, and UsageError for a cloud.
[[nodiscard]] std::optional<Mask> read_mask(const MaskArgument& argument, const Domain& domain);

/// Sources where `simplices` are only the open ones. Throws InputError for one that is closed, or
/// that the mask cuts off from everything.
void move_sources(const Mask& mask, const Domain& domain, std::vector<PointSource>& sources);

/// The shape, and lengths of its simplices (may be null), without what is closed.
template <class Shape>
Shape open_shape(const Mask& mask, const Shape& shape, MeasuredLengths* lengths) {
  Shape open = shape;
  if constexpr (std::is_same_v<Shape, io::Triangles>) {
    const std::span<const std::array<Index, 3>> all = shape.triangles;
    open.triangles = mask.open(all);
    if (lengths != nullptr) lengths->triangles = mask.open_rows(all, lengths->triangles);
  } else if constexpr (std::is_same_v<Shape, io::Tets>) {
    const std::span<const std::array<Index, 4>> all = shape.tets;
    open.tets = mask.open(all);
    if (lengths != nullptr) lengths->tets = mask.open_rows(all, lengths->tets);
  } else if constexpr (std::is_same_v<Shape, io::Edges>) {
    const std::span<const std::array<Index, 2>> all = shape.edges;
    open.edges = mask.open(all);
    if (!shape.lengths.empty()) open.lengths = mask.open_rows(all, shape.lengths);
    if (lengths != nullptr) lengths->edges = mask.open_rows(all, lengths->edges);
  }
  return open;
}

}  // namespace plexway::cli
