#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/draw_list.hpp"

namespace plexway::render {

/// The cells of a part: their colours, and how far their sources are beyond their own vertices.
class Cells {
 public:
  /// From the labels and values of a part whose simplices are these triangles or tetrahedra.
  explicit Cells(const Part& part);

  /// For the corners of a simplex: paints, and the values of up to three cells at each corner, of
  /// which the least tells what cell a place is in. False where no corner is in a cell.
  bool paint(std::span<const std::uint32_t> corners, std::span<Vertex> vertices) const;

  [[nodiscard]] Colour colour(std::int32_t label) const;

 private:
  // How far the source of a cell is from a vertex outside of the cell.
  struct Beyond {
    std::uint32_t vertex;
    std::int32_t label;
    std::size_t known;  ///< by how many corners of a simplex: more are better
    double value;
  };
  [[nodiscard]] std::int32_t label(std::uint32_t vertex) const;
  void look_beyond(std::span<const std::uint32_t> corners);
  [[nodiscard]] double value(std::uint32_t vertex, std::int32_t label) const;
  void choose_colours();

  const Part& part_;
  std::vector<Beyond> beyond_;
  std::vector<std::array<std::int32_t, 2>> neighbours_;
  std::vector<std::uint8_t> colour_;  ///< of each label: a place in the palette
};

/// Colours that the colour-blind can tell apart, of even lightness (P. Tol, "light").
std::span<const Colour> cell_palette();

}  // namespace plexway::render
