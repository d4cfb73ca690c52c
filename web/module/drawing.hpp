#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <plexway/shape/shape.hpp>

namespace plexway::web {

/// A shape as a graphics processor takes it: in float, from its centre. Solids show their boundary,
/// mixed domains all that they have, clouds nothing but their vertices.
class Drawing {
 public:
  Drawing() = default;
  /// Throws UsageError for a shape that is in no space of three dimensions. Cost: O(n log n) for
  /// solids, else linear.
  explicit Drawing(const AnyShape& shape);

  [[nodiscard]] const std::array<double, 3>& centre() const { return centre_; }
  /// Diagonal of the box around it.
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] std::array<double, 3> placed(const std::array<double, 3>& point) const {
    return {point[0] - centre_[0], point[1] - centre_[1], point[2] - centre_[2]};
  }

  /// 0 positions, 1 corners of triangles, 2 ends of edges; and how many numbers.
  [[nodiscard]] std::pair<const void*, std::size_t> array(int which) const;

  [[nodiscard]] const std::vector<float>& positions() const { return positions_; }
  [[nodiscard]] const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<std::array<Index, 2>>& edges() const { return edges_; }
  /// The simplex of the shape that a triangle or an edge belongs to.
  [[nodiscard]] Index simplex_of_triangle(std::size_t t) const { return triangle_simplex_[t]; }
  [[nodiscard]] Index simplex_of_edge(std::size_t e) const { return edge_simplex_[e]; }

 private:
  void add_boundary(const std::vector<std::array<Index, 4>>& tets, Index first_simplex);

  std::array<double, 3> centre_ = {0, 0, 0};
  double size_ = 0;
  std::vector<float> positions_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<std::array<Index, 2>> edges_;
  std::vector<Index> triangle_simplex_, edge_simplex_;
};

}  // namespace plexway::web
