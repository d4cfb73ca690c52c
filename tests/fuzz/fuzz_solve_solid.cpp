// Parts of a grid of tetrahedra, with vertices moved: notches, tunnels, parts that touch in a
// vertex.

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "fuzz_solve.hpp"

namespace fuzz_solve_solid {

namespace {

using namespace fuzz;
using plexway::PointSource;

constexpr int side = 3;  // vertices

struct Grid {
  std::vector<Place> places;
  std::vector<std::array<Index, 4>> tets;
};

Grid grid_of(Choices& choices) {
  Grid grid;
  const int moved = choices.byte() % 4;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) {
        Place p = {double(x), double(y), double(z)};
        if (moved > 0)
          for (double& c : p) c += (choices.byte() / 256. - 0.5) * 0.2 * moved;
        grid.places.push_back(p);
      }
  const auto number = [](int x, int y, int z) {
    return static_cast<Index>((x * side + y) * side + z);
  };
  constexpr int steps[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int x = 0; x + 1 < side; ++x)
    for (int y = 0; y + 1 < side; ++y)
      for (int z = 0; z + 1 < side; ++z) {
        const std::uint8_t some = choices.byte();
        for (int n = 0; n < 6; ++n) {
          if (some >> n & 1) continue;
          int at[3] = {x, y, z};
          std::array<Index, 4> tet{number(x, y, z)};
          for (std::size_t k = 0; k < 3; ++k) {
            ++at[steps[n][k]];
            tet[k + 1] = number(at[0], at[1], at[2]);
          }
          grid.tets.push_back(tet);
        }
      }
  return grid;
}

template <class Domain>
void check(const Domain& domain, const Grid& grid, Index source, double slack,
           const plexway::PropagateOptions& options) {
  const auto field = plexway::solve(plexway::Serial{}, domain, PointSource::at(source), options);
  check_field(field.distance, Graph::of(grid.tets, grid.places), source, slack);
  check_straight(field.distance, grid.places, source, slack);
}

}  // namespace

PLEXWAY_FUZZER(solve_solid)(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const auto options = options_of(choices);
  const std::uint8_t kind = choices.byte();
  const Index source = choices.below(side * side * side);
  const Grid grid = grid_of(choices);
  return check_input({}, [&] {
    if (kind % 4 == 0)
      check(plexway::TetMesh<float>(grid.places, grid.tets), grid, source, slack_of<float>,
            options);
    else if (kind % 4 == 1)
      check(plexway::TetMesh<double>(grid.places, grid.tets), grid, source, slack_of<double>,
            options);
    else
      check(plexway::SimplicialComplex<double, 3>({grid.places[0].data(), 3 * grid.places.size()},
                                                  3, grid.tets),
            grid, source, slack_of<double>, options);
  });
}

}  // namespace fuzz_solve_solid
