// How soon does what enters an organ by its artery get everywhere? It runs along a tree of vessels
// twenty times as fast as through the tissue between: a wireframe and a solid in one domain, and
// distances are times. One solve finds for every point the best place to leave the vessels.
//   example_organ [OUT]    writes the field (.vtu ...), or draws a picture (.png)
#include <cmath>
#include <cstdio>
#include <span>
#include <string_view>

#include <plexway/io/field.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

#ifdef PLEXWAY_HAS_RENDER
#include <plexway/render/picture.hpp>

// The tissue cut open, with all of the vessels.
void draw(const char* file, plexway::render::Part tissue, plexway::render::Part vessels) {
  vessels.whole = true;
  plexway::render::Scene scene;
  scene.parts = {tissue, vessels};
  scene.sources = {vessels.positions[0]};
  plexway::render::PictureOptions options;
  options.clip = plexway::render::Clip{{0, 0, 1}, 0.05};
  options.width = 640, options.height = 480;
  options.view = plexway::render::View{-20, 50};
  options.title = "seconds";
  plexway::render::write_png(file, plexway::render::picture(scene, options), 256);
}
#endif

struct Tree {
  std::vector<std::array<double, 3>> points = {{0, 0, 0}};
  std::vector<std::array<plexway::Index, 2>> edges;
  std::vector<double> seconds;
  // A vessel of eight pieces, then two of 0.7 times its length, `levels` deep.
  void grow(plexway::Index from, double turn, double tilt, double length, int levels) {
    for (int i = 0; i < 8; ++i, from = edges.back()[1]) {
      auto [x, y, z] = points[from];
      points.push_back({x + length / 8 * std::cos(turn) * std::cos(tilt),
                        y + length / 8 * std::sin(turn) * std::cos(tilt),
                        z + length / 8 * std::sin(tilt)});
      edges.push_back({from, plexway::Index(points.size() - 1)});
      seconds.push_back(length / 8 / 20);
    }
    for (const double side : {.7, -.6})
      if (levels > 0) grow(from, turn + side, side / 2 - tilt / 2, .7 * length, levels - 1);
  }
};

int main(int argc, char** argv) {
  const plexway::KuhnGrid<3> grid({30, 24, 16}, {.1, .1, .1}, {0, -1.2, -.8});
  const auto outside = [&](const auto& cell) {
    const auto c = grid.centre(cell);
    return std::hypot((c[0] - 1.5) / 1.5, c[1] / 1.2, c[2] / .8) > 1;
  };
  std::vector<std::array<double, 3>> tissue;
  for (plexway::Index v = 0; v < grid.vertex_count(); ++v) tissue.push_back(grid.position(v));
  const auto tets = grid.simplices(outside);
  Tree tree;
  tree.grow(0, 0, 0, .9, 4);
  plexway::MixedComplex<double> body;
  const auto organ = body.add(plexway::TetMesh<double>(tissue, tets), tissue);
  const auto vessels = body.add(
      plexway::Wireframe<double>(tree.points.size(), tree.edges, tree.seconds), tree.points);
  const std::size_t outlets = body.weld(vessels, organ, {.tolerance = .06});
  const auto field = solve(plexway::Serial{}, body, plexway::PointSource::at(vessels.vertex(0)));

  double last = 0;
  for (plexway::Index v = 0; v < tissue.size(); ++v)
    if (const double t = field.distance[organ.vertex(v)]; std::isfinite(t))
      last = std::max(last, t);
  std::printf("%zu tetrahedra and %zu pieces of vessel meet at %zu places.\n", tets.size(),
              tree.edges.size(), outlets);
  std::printf("All is supplied after %.2f s; through tissue alone the far end waits 3 s.\n", last);
  const plexway::io::MixedPart parts[] = {{.positions = tissue, .tets = tets},
                                          {.positions = tree.points, .edges = tree.edges}};
  const std::string_view out = argc > 1 ? argv[1] : "";
#ifdef PLEXWAY_HAS_RENDER
  if (out.ends_with(".png")) {
    const auto values = std::span<const double>(field.distance);
    draw(argv[1], {.positions = tissue, .tets = tets, .value = values.first(tissue.size())},
         {.positions = tree.points,
          .edges = tree.edges,
          .colour = plexway::render::Colour{245, 240, 235}});
    return 0;
  }
#endif
  if (!out.empty()) plexway::io::write_field(argv[1], parts, field.distance);
  return last < 1.5 && outlets > 20 ? 0 : 1;
}
