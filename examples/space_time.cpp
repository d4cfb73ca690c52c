// A drone must pass a gate that slides shut. Where the gate is depends on when one gets there, so
// the domain is space-time: x, y, z and t, four dimensions. One solve answers all arrival times.
// The length of a flight counts a second as much as a metre: sqrt(dx^2 + dy^2 + dz^2 + dt^2).
#include <cmath>
#include <cstdio>
#include <vector>

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

// A wall across x from 1.75 to 2.25 m; the gate in it covers y < speed * t, over all z.
constexpr double wall_from = 1.75, wall_to = 2.25, speed = 0.5;
using Event = std::array<double, 4>;  // x, y, z, t

// The exact answer. z and the direction along which the gate's edge moves are free; what is left is
// a plane, where the way is a string pulled tight over the two corners of the wall.
double exact(const Event& a, const Event& b) {
  const double norm = std::hypot(speed, 1.);
  const auto height = [&](const Event& e) { return (e[1] - speed * e[3]) / norm; };
  const auto along = [&](const Event& e) { return (speed * e[1] + e[3]) / norm; };
  std::vector<std::array<double, 2>> string;  // the upper convex hull of ends and corners
  for (const std::array<double, 2> p :
       {std::array{a[0], height(a)}, {wall_from, 0}, {wall_to, 0}, {b[0], height(b)}}) {
    for (std::size_t n = string.size(); n > 1; --n) {
      const auto &o = string[n - 2], &q = string[n - 1];
      if ((q[1] - o[1]) * (p[0] - o[0]) <= (p[1] - o[1]) * (q[0] - o[0])) string.pop_back();
    }
    string.push_back(p);
  }
  double planar = 0;
  for (std::size_t i = string.size() - 1; i > 0; --i)
    planar += std::hypot(string[i][0] - string[i - 1][0], string[i][1] - string[i - 1][1]);
  return std::hypot(planar, b[2] - a[2], along(b) - along(a));
}

int main() {
  // A grid that moves with the gate, whose edge is then a plane y' = 0 of it; y = y' + speed t.
  const plexway::KuhnGrid<4> grid({16, 16, 2, 8}, {.25, .25, .5, .5}, {0, -2.5, 0, 0});
  const auto in_gate = [&](const auto& cell) {
    const auto p = grid.centre(cell);
    return p[0] > wall_from && p[0] < wall_to && p[1] < 0;
  };
  std::vector<double> events = grid.positions();
  for (std::size_t i = 0; i < events.size(); i += 4) events[i + 1] += speed * events[i + 3];
  const plexway::SimplicialComplex<double, 4> domain(events, 4, grid.simplices(in_gate));
  const auto at = [&](Event e) { return grid.nearest({e[0], e[1] - speed * e[3], e[2], e[3]}); };
  const Event start = {.25, .25, 0, 0};
  const auto field = plexway::solve(plexway::Serial{}, domain, plexway::PointSource::at(at(start)));
  std::printf("%zu 4-simplices, one solve.\n", domain.simplex_count());
  std::printf("arrival   if the gate were open   around the gate   exact\n");
  bool fits = true;
  for (double t = .5; t <= 4; t += .5) {
    const Event goal = {3.75, .25, 1, t};
    const double found = field.distance[at(goal)], right = exact(start, goal);
    std::printf("%5.1f s %23.3f %17.3f %7.3f\n", t, std::hypot(3.5, 1, t), found, right);
    fits = fits && std::abs(found / right - 1) < 1e-9;
  }
  std::printf(fits ? "all exact to nine digits\n" : "WRONG\n");
  return fits ? 0 : 1;
}
