#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <plexway/io/tets.hpp>

#include "io_testing.hpp"

namespace io_testing {

using TetList = std::vector<std::array<std::uint32_t, 4>>;

/// Two tetrahedra over a triangle, and a vertex that none of them uses.
inline const Positions two_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                        {0, 0, 1}, {9, 9, 9}, {0.5, 0.25, -1.5}};
inline const TetList two_tets = {{0, 1, 2, 3}, {1, 0, 2, 5}};
/// Their vertices as text: coordinates alone.
inline const std::array<std::string, 6> two_rows = {"0 0 0", "1 0 0", "0 1 0",
                                                    "0 0 1", "9 9 9", ".5 2.5e-1 -1.5"};

inline void check_two(const plexway::io::Tets& solid) {
  CHECK(solid.positions == two_positions);
  CHECK(solid.tets == two_tets);
}

/// Coordinates that only shortest decimals or all 64 bits carry through.
inline plexway::io::Tets awkward_solid() {
  return {{{0.1, 1.0 / 3, -0.0},
           {1e-308, 5e-324, 1.7976931348623157e308},
           {-2.2250738585072014e-308, 123456789.123456789, 1e22},
           {3, -4, 5},
           {0.30000000000000004, 2.0 / 3, 1e-5}},
          {{0, 1, 2, 3}, {4, 3, 2, 0}, {1, 1, 2, 4}}};
}

}  // namespace io_testing
