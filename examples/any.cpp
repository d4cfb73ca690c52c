// A domain of any kind from a file: whatever it is, the distances of its vertices, and the way to
// the farthest.
//
//   any knot.ply distances.vtu

#include <cmath>
#include <cstdio>
#include <exception>

#include <plexway/any_domain.hpp>

int main(int argc, char** argv) {
  using namespace plexway;
  if (argc != 3) {
    std::fprintf(stderr, "usage: any INPUT OUT\n");
    return 2;
  }
  try {
    const AnyDomain domain = AnyDomain::read(argv[1]);
    const PointSource source = PointSource::at(0);
    const AnyField field = domain.solve(Serial{}, source);
    std::size_t farthest = 0;
    for (std::size_t v = 0; v < field.size(); ++v)
      if (std::isfinite(field[v]) && field[v] > field[farthest]) farthest = v;
    domain.shape().write_field(argv[2], field.doubles());
    std::printf("%.*s, %zu vertices; the farthest is vertex %zu at %.6f\n",
                static_cast<int>(domain.shape().kind_name().size()),
                domain.shape().kind_name().data(), domain.vertices(), farthest, field[farthest]);

    const AnyPathField paths = domain.path_field(Serial{}, std::span(&source, 1));
    const Path path = paths.trace(PointSource::at(static_cast<Index>(farthest)));
    std::printf("a way of %zu points, %.6f long\n", path.points.size(), path.length);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
