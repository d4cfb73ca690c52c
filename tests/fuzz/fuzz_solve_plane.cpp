// Rectangles cut out of a square, in as many ways as there are to solve it: as a surface, as a
// complex of triangles in the plane, and as the prism over it. The truth is the visibility graph of
// the corners; in the prism heights and distances add up by their squares.

#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "fuzz_plan.hpp"

namespace fuzz_solve_plane {

using namespace fuzz;
using plexway::PointSource;

PLEXWAY_FUZZER(solve_plane)(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const std::uint8_t kind = choices.byte();
  const auto cut = cut_of(choices);
  if (!cut) return 0;
  const samples::Shape& shape = cut->shape;
  const std::vector<Place>& places = cut->places;
  const std::vector<double>& truth = cut->truth;
  const auto source = PointSource::at(0);
  return check_input({}, [&] {
    plexway::PropagateOptions options;
    switch (kind % 4) {
      case 0: {
        options.accuracy = plexway::Accuracy::exact();
        const plexway::TriangleMesh<double> mesh(places, shape.faces);
        check_truth(plexway::solve(plexway::Serial{}, mesh, source, options).distance, truth,
                    {1e-7, 1e-7});
        break;
      }
      case 1: {
        const plexway::TriangleMesh<double> mesh(places, shape.faces);
        check_truth(plexway::solve(plexway::Serial{}, mesh, source, options).distance, truth,
                    {2e-2, 3e-2});
        break;
      }
      case 2: {
        const plexway::SimplicialComplex<double, 2> complex(flattened(places), 2, shape.faces);
        check_truth(plexway::solve(plexway::Serial{}, complex, source, options).distance, truth,
                    {1e-9, 5e-2});
        break;
      }
      default: {
        const Prism prism = prism_of(shape, height_of(choices));
        const plexway::TetMesh<double> solid(prism.places, prism.tets);
        check_truth(plexway::solve(plexway::Serial{}, solid, source, options).distance,
                    over(prism, truth), {1e-6, 5e-2});
      }
    }
  });
}

}  // namespace fuzz_solve_plane
