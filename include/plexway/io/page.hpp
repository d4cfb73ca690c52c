#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace plexway::io {

/// What a page shows. All simplices name vertices of `positions`; what none names is no point of a
/// picture, but where there are no simplices at all the vertices are shown as points.
struct Page {
  /// Three coordinates a point.
  using Points = std::vector<std::array<double, 3>>;

  /// Over the colour bar, and in the window's title.
  std::string title = "distance";
  std::span<const std::array<double, 3>> positions;          ///< finite
  std::vector<std::array<std::uint32_t, 2>> edges = {};      ///< shown as lines
  std::vector<std::array<std::uint32_t, 3>> triangles = {};  ///< shown from both sides
  std::span<const double> value = {};  ///< one a vertex, or none; what is not finite is grey
  /// One a vertex, or none: which cell it is in. Colours are the cells' then; negative: none.
  std::span<const std::int32_t> label = {};
  std::string map = "viridis";                      ///< colours, as io::ColourMap knows them
  std::optional<std::array<double, 2>> range = {};  ///< values at its ends; none: the values' own
  char up = 'z';                                    ///< axis that points up, x, y or z
  ///@{
  /// Balls: red, white and dark.
  Points sources = {}, targets = {}, dots = {};
  ///@}
  std::vector<Points> paths = {};  ///< lines in space
};

/// Writes one file of HTML that shows it in a browser, to turn, move and come nearer, by a pointer,
/// a wheel or fingers: it holds all that it needs, and loads nothing. It takes WebGL 2. The file
/// appears whole or not at all. 16 bytes a vertex and 12 a triangle, and a third more.
///
/// Throws UsageError for a map that does not exist, a position that is not finite, values, labels
/// or vertices out of range, and Error "cannot write FILE: reason" when the system refuses.
void write_page(const std::filesystem::path& file, const Page& page);

}  // namespace plexway::io
