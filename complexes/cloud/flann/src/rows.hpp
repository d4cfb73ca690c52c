#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace plexway::flann {

/// How the nearest neighbours of a point of a surface lie about it: all round, as they should, or
/// along a line, as where a scanner's rows are farther apart than the points in a row, with no
/// neighbours on one side of it or on both. Points on the rim of a surface have many on one side.
class RowOfPoints {
 public:
  /// From offsets to the neighbours, nearest first.
  explicit RowOfPoints(std::span<const std::array<double, 3>> offsets);

  /// Are the neighbours those of a row?
  [[nodiscard]] bool found() const { return found_; }

  /// How many of more neighbours, nearest first, it takes until some lie on either side; 0 if they
  /// do not. `any`: on one side is enough.
  [[nodiscard]] std::size_t needed(std::span<const std::array<double, 3>> offsets, bool any) const;

 private:
  [[nodiscard]] bool is_beside(const std::array<double, 3>& offset,
                               std::array<double, 3>& across) const;

  std::array<double, 3> along_{};
  double reach_ = 0;
  bool found_ = false;
};

}  // namespace plexway::flann
