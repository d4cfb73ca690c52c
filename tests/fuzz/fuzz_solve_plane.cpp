// Rectangles cut out of a square, in as many ways as there are to solve it: as a surface, as a
// complex of triangles in the plane, and as the prism over it. The truth is the visibility graph of
// the corners; in the prism heights and distances add up by their squares.

#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>

#include "fuzz_plan.hpp"

using namespace fuzz;
using plexway::PointSource;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const std::uint8_t kind = choices.byte();
  const auto plan = plan_of(choices);
  if (!plan) return 0;
  const double jitter = choices.byte() % 4 * 0.08;
  const samples::Shape shape = plan->grid(plan_cells, jitter, choices.byte());
  std::vector<Place> places(shape.points.begin(), shape.points.end());
  const std::vector<double> truth = plan->distances(shape.points);
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
        std::vector<double> flat;
        for (const Place& p : places) flat.insert(flat.end(), {p[0], p[1]});
        const plexway::SimplicialComplex<double, 2> complex(flat, 2, shape.faces);
        check_truth(plexway::solve(plexway::Serial{}, complex, source, options).distance, truth,
                    {1e-9, 5e-2});
        break;
      }
      default: {
        const double height = 0.1 + choices.byte() / 512.;
        const Prism prism = prism_of(shape, height);
        std::vector<double> over;
        for (std::size_t v = 0; v < prism.places.size(); ++v)
          over.push_back(std::hypot(truth[prism.below[v]], prism.places[v][2]));
        const plexway::TetMesh<double> solid(prism.places, prism.tets);
        check_truth(plexway::solve(plexway::Serial{}, solid, source, options).distance, over,
                    {1e-6, 5e-2});
      }
    }
  });
}
