#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "strings/solid_space.hpp"

/// Ways around a vertex of the boundary.
namespace plexway::detail::strings {

/// The solid near a vertex as seen from there: directions, and the faces between them. Strings turn
/// about rows of edges; unfolded, a way from one direction to another is as long as its angles.
class Corner {
 public:
  /// A row of edges at the vertex, the way from there, and the angle up to there.
  struct Row {
    Index place;
    Point along;
    double turned;
  };
  /// The rows that the shortest way through the solid passes, if it turns less than pi: a string
  /// that comes to the vertex and goes on in these directions is shorter beside it, to first order.
  /// False if there is none.
  bool find(const SolidSpace& space, Index vertex, const Point& in, const Point& out);
  /// Another one, that begins at another row.
  bool find_other(const SolidSpace& space);
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  [[nodiscard]] double turned() const { return turned_; }

 private:
  struct Side {
    Point normal, inward[2];  // of a face, and of its edges at the vertex, in its plane
  };
  struct Node {
    Index place;
    Point along;
    double turned;
    std::size_t before;
    bool done, left_out = false;
  };
  void look(const SolidSpace& space, Index vertex);
  [[nodiscard]] bool is_open(const SolidSpace& space, const Node& a, const Node& b) const;

  std::vector<Side> sides_;
  std::vector<Node> nodes_;
  std::vector<Row> rows_;
  double turned_ = 0;
};

}  // namespace plexway::detail::strings
