#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// Shapes of some triangles side by side, so that the processor can work on several at once. All 64
/// places hold numbers, also where there are fewer.
struct ShapeBlock {
  static constexpr std::size_t size = 64;
  using Row = std::array<double, size>;
  std::array<Row, 3> length;                    ///< edge i from corner i to the next
  std::array<Row, 3> cosine;                    ///< of the angle at corner i
  std::array<Row, 3> sine;                      ///< >= 0
  std::array<bool, size> degenerate, violated;  ///< as in TriangleShape
};

/// What the triangles of a surface look like, face by face: what a TriangleMesh is made from.
class TriangleShapes {
 public:
  virtual ~TriangleShapes() = default;
  /// Of the faces listed, at most ShapeBlock::size and at least one.
  virtual void look_up(std::span<const Index> faces, ShapeBlock& block) const = 0;
  /// Where the vertices lie in space, if the triangles do.
  [[nodiscard]] virtual std::span<const std::array<double, 3>> positions() const { return {}; }
  /// What counts as one inside; 0: the mean edge. A part of a surface has the whole's.
  [[nodiscard]] virtual double unit() const { return 0; }

 protected:
  TriangleShapes() = default;
  TriangleShapes(const TriangleShapes&) = default;
  TriangleShapes& operator=(const TriangleShapes&) = default;
};

/// From coordinates, which are finite.
class ShapesInSpace final : public TriangleShapes {
 public:
  ShapesInSpace(std::span<const std::array<double, 3>> positions,
                std::span<const std::array<Index, 3>> faces)
      : positions_(positions), faces_(faces) {}
  void look_up(std::span<const Index> faces, ShapeBlock& block) const override;
  [[nodiscard]] std::span<const std::array<double, 3>> positions() const override {
    return positions_;
  }

 private:
  std::span<const std::array<double, 3>> positions_;
  std::span<const std::array<Index, 3>> faces_;
};

/// From lengths. `violated`: which of them broke the triangle inequality before they were repaired.
class ShapesOfLengths final : public TriangleShapes {
 public:
  ShapesOfLengths(std::span<const std::array<double, 3>> lengths, std::span<const char> violated)
      : lengths_(lengths), violated_(violated) {}
  void look_up(std::span<const Index> faces, ShapeBlock& block) const override;

 private:
  std::span<const std::array<double, 3>> lengths_;
  std::span<const char> violated_;
};

/// The mean edge of `faces` triangles, whose longest is `longest`, from row(0), row(1), ...: three
/// lengths each. In shares of the longest, so that no sum overflows. 1 where all have no length.
template <class Row>
double mean_edge(std::size_t faces, double longest, Row row) {
  if (!(longest > 0)) return 1;
  double sum = 0;
  for (std::size_t f = 0; f < faces; ++f) {
    const auto& [a, b, c] = row(f);
    const double p = a / longest, q = b / longest, r = c / longest;
    sum = sum + p + q + r;
  }
  return longest * (sum / (3 * static_cast<double>(faces)));
}

/// Throws InputError where a length is not finite.
void check_length(Index face, std::span<const double, 3> lengths);

/// The angle at each corner, in radians.
void angles_of(const ShapeBlock& block, std::array<ShapeBlock::Row, 3>& angle);

/// Cosines and sines rounded so that turning by the angle keeps lengths: cos^2 + sin^2 = 1. Errors
/// there would add up hinge by hinge, on regular grids all with one sign.
template <class Real>
struct RoundedAngles {
  std::array<std::array<Real, ShapeBlock::size>, 3> cosine, sine;
};
template <class Real>
void round_angles(const ShapeBlock& block, RoundedAngles<Real>& rounded);

}  // namespace plexway::detail
