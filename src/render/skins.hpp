#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <plexway/render/picture.hpp>

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

using namespace detail;

inline constexpr Colour part_grey = {214, 219, 226};
inline constexpr Colour unreached = {150, 150, 150};

/// Moves positions to a frame in which the scene is about 1 in size, around the origin.
struct Frame {
  Point centre{};
  double scale = 1;

  [[nodiscard]] Point operator()(const Point& p) const { return times(scale, minus(p, centre)); }
};

/// How the parts of a scene are turned into triangles.
struct Making {
  Frame frame;
  std::optional<Plane> clip;  ///< in the frame
  Point toward{};             ///< to the camera, unit
  double pixel = 0;           ///< about a pixel's size in the frame, at the scene's middle
};

/// Triangles of a part's positions with smooth normals, creases of more than 55 degrees kept.
/// `triangles` may be those of the part or others, such as the boundary of its tetrahedra.
void add_surface(Batch& batch, const Part& part, const Cells* cells,
                 std::span<const std::array<std::uint32_t, 3>> triangles, const Making& making);

/// The triangles of exactly one tetrahedron, facing outwards; not those in the clip plane, which
/// are the cap's.
std::vector<std::array<std::uint32_t, 3>> boundary(
    std::span<const Point> positions, std::span<const std::array<std::uint32_t, 4>> tets,
    const Making& making);

/// Where the clip plane cuts the tetrahedra: a polygon of each, values linear in it.
void add_cap(Batch& batch, const Part& part, const Cells* cells, const Making& making);

/// Where the value, linear in each tetrahedron, is `iso`.
void add_isosurface(Batch& batch, const Part& part, double iso, const Making& making);

/// A ball. `rings` from pole to pole; twice as many around.
void add_ball(Batch& batch, const Vertex& centre, double radius, std::size_t rings);

/// A flat ring around a place, facing the camera: where a ball is that something hides.
void add_ring(std::vector<Corner>& corners, const Vertex& centre, double inner, double outer,
              const Point& toward);

/// A tube along a polyline, closed by balls at its ends and at sharp bends.
void add_tube(Batch& batch, std::span<const Vertex> line, double radius, std::size_t sides);

/// The edges of a part as tubes with balls where they meet; thinner where edges are short.
void add_wires(Batch& batch, const Part& part, const Making& making);

/// The points of a part as discs, the rounder the larger they are, wide enough to touch their
/// neighbours: along the normals where there are some, else as balls seen from the camera.
void add_discs(Batch& batch, const Part& part, const Making& making);

/// How far each point's fourth nearest other place is, at most twice and at least half of what is
/// usual: how large the discs are that look like a surface. 0.1 each where all are at one place.
/// Wherever points are crowded or lonely, the cost is n log n.
[[nodiscard]] std::vector<double> spacings(std::span<const Point> points);

}  // namespace plexway::render
