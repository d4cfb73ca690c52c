#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <plexway/common/distinct_points.hpp>

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

/// A place found: how far it is, in squares of the search's own unit, and its number there.
struct Found {
  double squared;
  Index point;  ///< the caller's number of its first point: it decides between equals
  Index place;
  friend auto operator<=>(const Found&, const Found&) = default;
};

/// The points' distinct places in FLANN's k-d tree.
class Search {
 public:
  explicit Search(std::span<const std::array<double, 3>> points)
      : Search(points, distinct_points(points)) {}
  Search(std::span<const std::array<double, 3>> points, DistinctPoints places);
  ~Search();

  [[nodiscard]] const DistinctPoints& places() const { return places_; }
  /// Place j as place i sees it.
  [[nodiscard]] Found seen(std::size_t i, Index j) const {
    double squared = 0;
    for (std::size_t d = 0; d < 3; ++d)
      squared += (scaled_[i][d] - scaled_[j][d]) * (scaled_[i][d] - scaled_[j][d]);
    return {squared, places_.order[j], j};
  }
  /// From place i to place j, in the search's own unit.
  [[nodiscard]] std::array<double, 3> offset(std::size_t i, Index j) const {
    std::array<double, 3> offset;
    for (std::size_t d = 0; d < 3; ++d) offset[d] = scaled_[j][d] - scaled_[i][d];
    return offset;
  }
  /// The nearest others of place places().order[i]: at most k (0: any number) and not beyond the
  /// radius, nearest first. Any number of threads may search at once.
  void around(std::size_t i, std::size_t k, double radius, std::vector<Found>& found) const;

 private:
  struct Tree;
  DistinctPoints places_;
  std::vector<std::array<double, 3>> scaled_;  // in the places' order
  double scale_ = 1;
  std::unique_ptr<Tree> tree_;
};

}  // namespace plexway::flann
