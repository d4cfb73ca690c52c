// A way through a building is a shortest path in the air of its rooms: a solid full of obstacles.
// Two floors of 12 x 9 m, walls with doors, a stairwell; how far is it from the entrance hall?
#include <cmath>
#include <cstdio>
#include <string_view>

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

// A character is half a metre; rows run along y. # is wall, S where the ceiling is open.
constexpr std::string_view floors[2][18] = {
    {"########################", "#.......#.....#........#", "#.......#.....#........#",
     "#.......#.....#........#", "#.............#........#", "#.......#.....#........#",
     "#.......#.....#........#", "####.####.....####.#####", "#......................#",
     "#......................#", "#####.########..########", "#........#..........#SS#",
     "#........#..........#SS#", "#........#..........#SS#", "#........#...........SS#",
     "#........#...........SS#", "#........#..........#SS#", "########################"},
    {"########################", "#..........#...........#", "#..........#...........#",
     "#..........#...........#", "#..........#...........#", "#..........#...........#",
     "#####.############.#####", "#......................#", "#......................#",
     "######.#########.#######", "#...........#......#...#", "#...........#......#...#",
     "#...........#..........#", "#...........#..........#", "#...........#......#...#",
     "#...........#......#...#", "#...........#......#...#", "########################"}};

int main() {
  // Storeys of 2.5 m: four layers of air, one of ceiling, four layers of air, a roof.
  const plexway::KuhnGrid<3> grid({24, 18, 10}, {.5, .5, .5});
  const auto built = [&](const auto& cell) {
    const bool up = cell[2] >= 5;
    if (cell[2] % 5 == 4) return up || floors[0][cell[1]][cell[0]] != 'S';
    return floors[up][cell[1]][cell[0]] == '#';
  };
  std::vector<std::array<double, 3>> points;
  for (plexway::Index v = 0; v < grid.vertex_count(); ++v) points.push_back(grid.position(v));
  const plexway::TetMesh<double> air(points, grid.simplices(built));
  const auto field =
      solve(plexway::Serial{}, air, plexway::PointSource::at(grid.nearest({1, 1, 0})));

  struct Goal {
    const char* name;
    std::array<double, 3> at;
    double exact;  // of a string pulled tight around the door posts, where that is easy
  };
  const double door = std::hypot(3, 1) + .5 + std::hypot(2, 1);
  bool fits = true;
  for (const Goal& goal : {Goal{"in the same room", {3, 3, 0}, std::hypot(2, 2)},
                           Goal{"in the next, by its door", {6.5, 1, 0}, door},
                           Goal{"at the foot of the stairs", {11, 6, 0}, 0},
                           Goal{"in the office upstairs", {2, 8, 2.5}, 0},
                           Goal{"in the hall upstairs", {10.5, 1, 2.5}, 0}}) {
    const double found = field.distance[grid.nearest(goal.at)];
    const double crow = std::hypot(goal.at[0] - 1, goal.at[1] - 1, goal.at[2]);
    std::printf("%-26s %6.2f m, %5.2f m as the crow flies\n", goal.name, found, crow);
    fits = fits && std::isfinite(found) && found > crow * (1 - 1e-9);
    if (goal.exact > 0) fits = fits && std::abs(found / goal.exact - 1) < 1e-3;
  }
  return fits ? 0 : 1;
}
