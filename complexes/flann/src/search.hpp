#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <plexway/complex/distinct_points.hpp>

namespace plexway::flann {

/// A point found, and how far it is in squares of the search's own unit.
struct Found {
  double squared;
  Index point;
  friend auto operator<=>(const Found&, const Found&) = default;
};

/// The points' distinct places in FLANN's k-d tree.
class Search {
 public:
  explicit Search(std::span<const std::array<double, 3>> points);
  ~Search();

  [[nodiscard]] const DistinctPoints& places() const { return places_; }
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
