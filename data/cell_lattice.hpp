#pragma once

// A cube of cells, some left out at random, each cut into tetrahedra; as fine as one likes.

#include <algorithm>
#include <array>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

namespace samples {

/// Adds the six tetrahedra of a cell; number(corner) is that of a corner.
template <class Number>
void add_cell(const std::array<int, 3>& cell, const Number& number,
              std::vector<std::array<plexway::Index, 4>>& tets) {
  std::array<std::size_t, 3> axis = {0, 1, 2};
  do {
    std::array<int, 3> at = cell;
    std::array<plexway::Index, 4> tet = {number(at), 0, 0, 0};
    for (std::size_t e = 0; e < 3; ++e) {
      ++at[axis[e]];
      tet[e + 1] = number(at);
    }
    tets.push_back(tet);
  } while (std::next_permutation(axis.begin(), axis.end()));
}

struct CellLattice {
  int side, cuts;         ///< cells along each axis; parts of each along each axis
  std::vector<char> out;  ///< cells that are left out
  std::vector<std::array<double, 3>> places;
  std::vector<std::array<plexway::Index, 4>> tets;

  static std::vector<char> left_out(int side, double share, std::mt19937& random) {
    std::vector<char> out(static_cast<std::size_t>(side * side * side));
    for (char& o : out) o = static_cast<double>(random()) / 4294967296. < share ? 1 : 0;
    return out;
  }
  CellLattice(int side_cells, std::vector<char> cells_out, int parts)
      : side(side_cells), cuts(parts), out(std::move(cells_out)) {
    const int most = side * cuts + 1;
    number_.assign(static_cast<std::size_t>(most * most * most), plexway::none);
    for (int k = 0; k + 1 < most; ++k)
      for (int j = 0; j + 1 < most; ++j)
        for (int i = 0; i + 1 < most; ++i)
          if (out[static_cast<std::size_t>((k / cuts * side + j / cuts) * side + i / cuts)] == 0)
            add_cell(
                {i, j, k}, [this](const auto& at) { return number(at); }, tets);
  }
  /// Of a corner of cells; none where all of them are left out.
  [[nodiscard]] plexway::Index vertex(const std::array<int, 3>& at) const {
    return number_[slot({at[0] * cuts, at[1] * cuts, at[2] * cuts})];
  }
  [[nodiscard]] std::array<int, 3> any_vertex(std::mt19937& random) const {
    for (;;) {
      std::array<int, 3> at;
      for (int& x : at) x = static_cast<int>(random() % static_cast<unsigned>(side + 1));
      if (vertex(at) != plexway::none) return at;
    }
  }
  template <class Visit>
  void each_vertex(const Visit& visit) const {
    for (int k = 0; k <= side; ++k)
      for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i)
          if (vertex({i, j, k}) != plexway::none) visit(std::array<int, 3>{i, j, k});
  }

 private:
  [[nodiscard]] std::size_t slot(const std::array<int, 3>& at) const {
    const int most = side * cuts + 1;
    return static_cast<std::size_t>((at[2] * most + at[1]) * most + at[0]);
  }
  plexway::Index number(const std::array<int, 3>& at) {
    plexway::Index& n = number_[slot(at)];
    if (n == plexway::none) {
      n = static_cast<plexway::Index>(places.size());
      places.push_back({double(at[0]) / cuts, double(at[1]) / cuts, double(at[2]) / cuts});
    }
    return n;
  }
  std::vector<plexway::Index> number_;
};

}  // namespace samples
