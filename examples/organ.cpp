// How soon does what enters an organ by its artery get everywhere? It runs along a tree of vessels,
// twenty times as fast as through the tissue between: a wireframe and a solid in one domain, and
// distances are times. One solve finds for every point the best place to leave the vessels.
#include <cmath>
#include <cstdio>
#include <vector>

#include <plexway/complex/kuhn_grid.hpp>
#include <plexway/executors/serial_mixed.hpp>
#include <plexway/io/field.hpp>

using Point = std::array<double, 3>;

struct Tree {
  std::vector<Point> points;
  std::vector<std::array<plexway::Index, 2>> edges;
  std::vector<double> seconds;

  // A vessel of eight pieces from a point, then two of 0.7 times its length, `levels` deep.
  void grow(plexway::Index from, double turn, double tilt, double length, int levels) {
    for (int i = 0; i < 8; ++i) {
      Point p = points[from];
      p[0] += length / 8 * std::cos(turn) * std::cos(tilt);
      p[1] += length / 8 * std::sin(turn) * std::cos(tilt);
      p[2] += length / 8 * std::sin(tilt);
      points.push_back(p);
      edges.push_back({from, plexway::Index(points.size() - 1)});
      seconds.push_back(length / 8 / 20);
      from = edges.back()[1];
    }
    if (levels == 0) return;
    grow(from, turn + .7, tilt * -.6 + .3, .7 * length, levels - 1);
    grow(from, turn - .6, tilt * -.6 - .3, .7 * length, levels - 1);
  }
};

int main(int argc, char** argv) {
  const plexway::KuhnGrid<3> grid({30, 24, 16}, {.1, .1, .1}, {0, -1.2, -.8});
  const auto outside = [&](const auto& cell) {
    const auto c = grid.centre(cell);
    return std::pow((c[0] - 1.5) / 1.5, 2) + std::pow(c[1] / 1.2, 2) + std::pow(c[2] / .8, 2) > 1;
  };
  std::vector<Point> tissue;
  const std::vector<double> flat = grid.positions();
  for (std::size_t i = 0; i < flat.size(); i += 3)
    tissue.push_back({flat[i], flat[i + 1], flat[i + 2]});
  const auto tets = grid.simplices(outside);
  Tree tree{{{0, 0, 0}}, {}, {}};
  tree.grow(0, 0, 0, .9, 4);

  plexway::MixedComplex<double> body;
  const auto organ = body.add(plexway::TetMesh<double>(tissue, tets), tissue);
  const auto vessels = body.add(
      plexway::Wireframe<double>(tree.points.size(), tree.edges, tree.seconds), tree.points);
  const std::size_t outlets = body.weld(vessels, organ, {.tolerance = .06});
  const auto field =
      propagate(plexway::Serial{}, body, plexway::PointSource::at(vessels.vertex(0)));

  double last = 0, mean = 0;
  std::size_t reached = 0;
  for (plexway::Index v = 0; v < tissue.size(); ++v) {
    const double t = field.distance[organ.vertex(v)];
    if (std::isfinite(t)) last = std::max(last, t), mean += t, ++reached;
  }
  std::printf("%zu tetrahedra, %zu pieces of vessel, %zu places where they meet\n", tets.size(),
              tree.edges.size(), outlets);
  std::printf("the tissue is supplied after %.3f s in the mean, all of it after %.3f s;\n",
              mean / double(reached), last);
  std::printf("through tissue alone the far end would wait 3 s\n");
  const plexway::io::MixedPart parts[] = {{.positions = tissue, .tets = tets},
                                          {.positions = tree.points, .edges = tree.edges}};
  if (argc > 1) plexway::io::write_field(argv[1], parts, field.distance);
  return last < 1.5 && outlets > 20 ? 0 : 1;
}
