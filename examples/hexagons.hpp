// A domain of one's own: a map of hexagons, as board games have it. Each is a vertex, a step to a
// neighbour costs what a function says. Less than 60 lines, and all executors and sources work on
// it.
#pragma once

#include <vector>

#include <plexway/carried.hpp>

namespace examples {

using plexway::Index;

/// `columns` x `rows` hexagons; each has up to six neighbours: in its own row, and two in
/// each of the rows below and above.
template <class Real>
class HexagonMap : public plexway::CarriedDomain<HexagonMap<Real>, plexway::Wireframe<Real>> {
  using Base = plexway::CarriedDomain<HexagonMap, plexway::Wireframe<Real>>;

 public:
  /// `cost(a, b)` of the step between neighbours, >= 0.
  template <class Cost>
  HexagonMap(Index columns, Index rows, const Cost& cost)
      : HexagonMap(columns, steps_of(columns, rows), columns * rows, cost) {}

  [[nodiscard]] Index at(Index column, Index row) const { return width_ * row + column; }
  /// Its simplices are the steps.
  [[nodiscard]] const std::vector<std::array<Index, 2>>& steps() const { return steps_; }

 private:
  using Steps = std::vector<std::array<Index, 2>>;

  template <class Cost>
  HexagonMap(Index columns, Steps steps, Index hexagons, const Cost& cost)
      : Base(plexway::Wireframe<Real>(hexagons, steps, costs_of(steps, cost))),
        width_(columns),
        steps_(std::move(steps)) {}

  static Steps steps_of(Index columns, Index rows) {
    Steps steps;
    for (Index v = 0; v < columns * rows; ++v) {
      const bool first = v % columns == 0, last = v % columns == columns - 1;
      if (!first) steps.push_back({v - 1, v});
      if (v >= columns) steps.push_back({v - columns, v});
      if (v >= columns && !last) steps.push_back({v - columns + 1, v});
    }
    return steps;
  }
  template <class Cost>
  static std::vector<double> costs_of(const Steps& steps, const Cost& cost) {
    std::vector<double> costs;
    for (const auto& [a, b] : steps) costs.push_back(cost(a, b));
    return costs;
  }

  Index width_;
  Steps steps_;
};

}  // namespace examples
