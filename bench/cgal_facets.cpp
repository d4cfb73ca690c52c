// How much of the errors around a ball in a cube are its facets' and not the solver's: exact
// distances for the triangles as they are, at some vertices in shadow. The shortest path around a
// convex obstacle lies on the hull of the obstacle and the two ends (Sharir and Schorr 1986), so
// CGAL's exact paths on that hull are the answer.
//
//   bench_cgal_facets FOLDER NAME SOURCE [SAMPLES]
//
// reads NAME.node, NAME.ele and the round ball's distances, NAME.vSOURCE.txt.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;

/// On the hull of the ball and both ends; NaN where an end is not on it.
double around(std::vector<Point> ball, const Point& from, const Point& to) {
  ball.push_back(from);
  ball.push_back(to);
  Mesh hull;
  CGAL::convex_hull_3(ball.begin(), ball.end(), hull);
  Mesh::Vertex_index a, b;
  for (const auto v : hull.vertices()) {
    if (hull.point(v) == from) a = v;
    if (hull.point(v) == to) b = v;
  }
  if (!a.is_valid() || !b.is_valid()) return std::nan("");
  CGAL::Surface_mesh_shortest_path<Traits> paths(hull);
  paths.add_source_point(a);
  const double d = paths.shortest_distance_to_source_points(b).first;
  return d < 0 ? std::nan("") : d;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "bench_cgal_facets FOLDER NAME SOURCE [SAMPLES]\n";
    return 2;
  }
  const std::string base = std::string(argv[1]) + "/" + argv[2];
  const std::size_t source = std::stoul(argv[3]), samples = argc > 4 ? std::stoul(argv[4]) : 200;
  std::size_t count = 0, skip = 0;
  std::ifstream nodes(base + ".node"), tets(base + ".ele"), exact(base + ".v" + argv[3] + ".txt");
  nodes >> count >> skip >> skip >> skip;
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    double x = 0, y = 0, z = 0;
    nodes >> skip >> x >> y >> z;
    points.emplace_back(x, y, z);
  }
  std::map<std::array<std::size_t, 3>, int> faces;
  tets >> count >> skip >> skip;
  for (std::size_t t = 0; t < count; ++t) {
    std::array<std::size_t, 4> c{};
    tets >> skip >> c[0] >> c[1] >> c[2] >> c[3];
    std::sort(c.begin(), c.end());
    for (std::size_t i = 0; i < 4; ++i)
      ++faces[{c[i == 0 ? 1 : 0], c[i < 2 ? 2 : 1], c[i < 3 ? 3 : 2]}];
  }
  std::vector<double> round(points.size());
  for (double& d : round) exact >> d;
  if (!nodes || !tets || !exact || source >= points.size()) {
    std::cerr << base << ": cannot be read\n";
    return 1;
  }
  std::set<std::size_t> on_ball;
  for (const auto& [face, times] : faces)
    if (times == 1)
      for (const std::size_t v : face)
        if (CGAL::squared_distance(points[v], Point(0, 0, 0)) < .64) on_ball.insert(v);
  std::vector<Point> ball;
  for (const std::size_t v : on_ball) ball.push_back(points[v]);
  std::vector<std::size_t> shadow;
  for (std::size_t v = 0; v < points.size(); ++v)
    if (round[v] > 1.001 * std::sqrt(CGAL::squared_distance(points[v], points[source])))
      shadow.push_back(v);
  double sum = 0, size = 0;
  int compared = 0;
  for (std::size_t k = 0; k < samples && !shadow.empty(); ++k) {
    const std::size_t v = shadow[(2 * k + 1) * shadow.size() / (2 * samples)];
    const double error = around(ball, points[source], points[v]) / round[v] - 1;
    if (std::isnan(error)) continue;
    sum += error, size += std::abs(error), ++compared;
  }
  std::printf(
      "%s: %d of %zu vertices in shadow: facets against the round ball: mean %.1e, size %.1e\n",
      argv[2], compared, shadow.size(), sum / compared, size / compared);
  return 0;
}
