// A way through a building is a shortest path in the air of its rooms: a solid with many obstacles.
// Two floors of 12 x 9 m, walls with doors, a stairwell; from the entrance, how far is every room?
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include <plexway/complex/kuhn_grid.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/executors/serial_solid.hpp>

// One character is half a metre; rows run along y. # is wall, S the stairwell through the ceiling.
constexpr std::string_view ground[] = {
    "########################", "#.......#.....#........#", "#.......#.....#........#",
    "#.......#.....#........#", "#.............#........#", "#.......#.....#........#",
    "#.......#.....#........#", "####.####.....####.#####", "#......................#",
    "#......................#", "#####.########..########", "#........#..........#SS#",
    "#........#..........#SS#", "#........#..........#SS#", "#........#...........SS#",
    "#........#...........SS#", "#........#..........#SS#", "########################"};
constexpr std::string_view upper[] = {
    "########################", "#..........#...........#", "#..........#...........#",
    "#..........#...........#", "#..........#...........#", "#..........#...........#",
    "#####.############.#####", "#......................#", "#......................#",
    "######.#########.#######", "#...........#......#SS.#", "#...........#......#SS.#",
    "#...........#......#SS.#", "#...........#......#SS.#", "#...........#......#SS.#",
    "#...........#...........", "#...........#......#...#", "########################"};

int main() {
  // Storeys of 2.5 m: four layers of air, one of ceiling, four layers of air.
  const plexway::KuhnGrid<3> grid({24, 18, 10}, {.5, .5, .5}, {0, 0, 0});
  const auto solid_part = [&](const auto& cell) {
    const char below = ground[cell[1]][cell[0]], above = upper[cell[1]][cell[0]];
    if (cell[2] < 5) return cell[2] == 4 ? below != 'S' : below == '#';
    return above == '#' || cell[2] == 9;
  };
  std::vector<std::array<double, 3>> points;
  const std::vector<double> flat = grid.positions();
  for (std::size_t i = 0; i < flat.size(); i += 3)
    points.push_back({flat[i], flat[i + 1], flat[i + 2]});
  const plexway::TetMesh<double> air(points, grid.simplices(solid_part));
  const auto field =
      propagate(plexway::Serial{}, air, plexway::PointSource::at(grid.nearest({1, 1, 0})));

  struct Goal {
    const char* name;
    std::array<double, 3> at;
    double exact;  // of a string pulled tight in the plan, where it is known
  };
  const double door = std::hypot(4.5 - 1, 2 - 1);
  const Goal goals[] = {{"the same room", {3, 3, 0}, std::hypot(2, 2)},
                        {"the next, through the door", {6.5, 1, 0}, door + std::hypot(2, 1)},
                        {"under the stairwell", {11, 6, 0}, 0},
                        {"the office upstairs", {2, 8, 2.5}, 0},
                        {"the hall upstairs", {10.5, 1, 2.5}, 0}};
  bool fits = true;
  std::printf("%zu tetrahedra of air, %zu edges where ways bend\n", air.tet_count(),
              air.summary().reflex_edges);
  for (const Goal& goal : goals) {
    const double found = field.distance[grid.nearest(goal.at)];
    const double straight = std::hypot(goal.at[0] - 1, goal.at[1] - 1, goal.at[2]);
    std::printf("%-28s %6.2f m (%5.2f m as the crow flies)\n", goal.name, found, straight);
    fits = fits && std::isfinite(found) && found >= straight * .999;
    if (goal.exact > 0) fits = fits && std::abs(found / goal.exact - 1) < .02;
  }
  std::printf(fits ? "as it should be\n" : "WRONG\n");
  return fits ? 0 : 1;
}
