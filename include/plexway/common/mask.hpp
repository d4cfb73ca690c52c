#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// Where no path may go: simplices that are closed, and vertices, which close all simplices about
/// them. A domain is built of what is open, with the vertices that it had:
///
/// @code
///   Mask mask(positions.size(), faces.size());
///   mask.close_vertex(17);
///   TriangleMesh<float> mesh(positions, mask.open(faces));
///
/// @endcode
/// Its edge is boundary like any other: paths run along it and bend at its corners. Vertices keep
/// their numbers, and those that are in no open simplex are reached from nowhere; simplices are
/// numbered without the closed ones, see `number`.
class Mask {
 public:
  /// All open.
  Mask(std::size_t vertices, std::size_t simplices)
      : vertex_(vertices, 0), simplex_(simplices, 0) {}

  /// Throw UsageError for a number that is out of range.
  void close_vertex(Index vertex);
  /// Likewise.
  void close_simplex(Index simplex);

  /// One a vertex: not 0 where it is closed itself.
  [[nodiscard]] std::span<const char> closed_vertices() const { return vertex_; }
  /// One a simplex: not 0 where it is closed itself, not by a vertex.
  [[nodiscard]] std::span<const char> closed_simplices() const { return simplex_; }
  /// May a path enter the simplex with that number and these corners? (Not checked.)
  [[nodiscard]] bool is_open(std::span<const Index> corners, std::size_t simplex) const {
    if (simplex_[simplex] != 0) return false;
    for (const Index v : corners)
      if (vertex_[v] != 0) return false;
    return true;
  }

  /// The simplices that are open, in their order. Throws UsageError if there is not one row a
  /// simplex, or a corner is out of range.
  template <std::size_t N>
  [[nodiscard]] std::vector<std::array<Index, N>> open(
      std::span<const std::array<Index, N>> simplices) const;
  /// Likewise.
  template <std::size_t N>
  [[nodiscard]] std::vector<std::array<Index, N>> open(
      const std::vector<std::array<Index, N>>& simplices) const {
    return open(std::span<const std::array<Index, N>>(simplices));
  }
  /// What belongs to them, such as their lengths. Throws likewise, and if there is not one row of
  /// `rows` a simplex.
  template <std::size_t N, class Row>
  [[nodiscard]] std::vector<Row> open_rows(std::span<const std::array<Index, N>> simplices,
                                           const std::vector<Row>& rows) const {
    check(simplices);
    check_rows(rows.size());
    std::vector<Row> kept;
    for (std::size_t s = 0; s < simplices.size(); ++s)
      if (is_open(simplices[s], s)) kept.push_back(rows[s]);
    return kept;
  }
  /// The number of each simplex among the open ones, or none. Throws likewise.
  template <std::size_t N>
  [[nodiscard]] std::vector<Index> number(std::span<const std::array<Index, N>> simplices) const {
    check(simplices);
    std::vector<Index> numbers;
    Index next = 0;
    for (std::size_t s = 0; s < simplices.size(); ++s)
      numbers.push_back(is_open(simplices[s], s) ? next++ : none);
    return numbers;
  }

 private:
  void check_rows(std::size_t rows) const;
  void check_vertex(Index largest) const;
  template <std::size_t N>
  void check(std::span<const std::array<Index, N>> simplices) const {
    check_rows(simplices.size());
    Index largest = 0;
    for (const auto& corners : simplices)
      for (const Index v : corners) largest = v > largest ? v : largest;
    if (!simplices.empty()) check_vertex(largest);
  }
  std::vector<char> vertex_, simplex_;
};

template <std::size_t N>
std::vector<std::array<Index, N>> Mask::open(
    std::span<const std::array<Index, N>> simplices) const {
  check(simplices);
  std::vector<std::array<Index, N>> kept;
  for (std::size_t s = 0; s < simplices.size(); ++s)
    if (is_open(simplices[s], s)) kept.push_back(simplices[s]);
  return kept;
}

}  // namespace plexway
