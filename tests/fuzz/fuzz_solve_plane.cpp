// Rectangles cut out of a square, in as many ways as there are to solve it: as a surface, as a
// complex of triangles in the plane, and as the prism over it. The truth is the visibility graph of
// the corners; in the prism heights and distances add up by their squares.

#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>

#include "corner_domains.hpp"
#include "fuzz_solve.hpp"

namespace {

using namespace fuzz;
using plexway::PointSource;

constexpr int cells = 8;  // along a side, in tiles of four

// No rectangle touches another one or the rim, along which the graph would see through it.
samples::CornerDomain plan_of(Choices& choices) {
  samples::CornerDomain plan;
  for (int x = 0; x < cells; x += 4)
    for (int y = 0; y < cells; y += 4) {
      const std::uint8_t b = choices.byte();
      if (b % 4 == 0) continue;
      const int left = 1 + b / 4 % 2, bottom = 1 + b / 8 % 2;
      const int right = left + 1 + b / 16 % (3 - left), top = bottom + 1 + b / 32 % (3 - bottom);
      const auto at = [](int k) { return static_cast<double>(k) / cells; };
      plan.blocks.push_back({at(x + left), at(x + right), at(y + bottom), at(y + top)});
    }
  return plan;
}

struct Prism {
  std::vector<Place> places;
  std::vector<std::array<Index, 4>> tets;
  std::vector<Index> below;  // the plan's vertex
};

// One layer over the plan, each prism cut by the order of its vertices' numbers.
Prism prism_of(const samples::Shape& plan, double height) {
  Prism prism;
  const auto n = static_cast<Index>(plan.points.size());
  for (const double z : {0., height})
    for (Index v = 0; v < n; ++v) {
      prism.places.push_back({plan.points[v][0], plan.points[v][1], z});
      prism.below.push_back(v);
    }
  for (std::array<Index, 3> f : plan.faces) {
    std::sort(f.begin(), f.end());
    prism.tets.push_back({f[0], f[1], f[2], f[2] + n});
    prism.tets.push_back({f[0], f[1], f[1] + n, f[2] + n});
    prism.tets.push_back({f[0], f[0] + n, f[1] + n, f[2] + n});
  }
  return prism;
}

template <class Distances>
void check_truth(const Distances& d, const std::vector<double>& truth, double short_by,
                 double long_by) {
  require(d.size() == truth.size(), "one distance a vertex");
  for (std::size_t v = 0; v < truth.size(); ++v) {
    const bool holds = std::isfinite(truth[v]) ? d[v] >= truth[v] * (1 - short_by) - 1e-12 &&
                                                     d[v] <= truth[v] * (1 + long_by) + 1e-12
                                               : !std::isfinite(d[v]);
    require(holds, "the distance over the visibility graph: vertex " + std::to_string(v) + " at " +
                       std::to_string(d[v]) + ", truth " + std::to_string(truth[v]));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const std::uint8_t kind = choices.byte();
  samples::CornerDomain plan = plan_of(choices);
  const int at = choices.below((cells + 1) * (cells + 1));
  plan.source = {static_cast<double>(at % (cells + 1)) / cells,
                 static_cast<double>(at / (cells + 1)) / cells};
  for (const auto& b : plan.blocks)
    if (plan.source[0] > b.left - 1e-9 && plan.source[0] < b.right + 1e-9 &&
        plan.source[1] > b.bottom - 1e-9 && plan.source[1] < b.top + 1e-9)
      return 0;  // inside, where there is nothing
  const double jitter = choices.byte() % 4 * 0.08;
  const samples::Shape shape = plan.grid(cells, jitter, choices.byte());
  std::vector<Place> places(shape.points.begin(), shape.points.end());
  const std::vector<double> truth = plan.distances(shape.points);
  const auto source = PointSource::at(0);
  return check_input({}, [&] {
    plexway::PropagateOptions options;
    switch (kind % 4) {
      case 0: {
        options.accuracy = plexway::Accuracy::exact();
        const plexway::TriangleMesh<double> mesh(places, shape.faces);
        check_truth(plexway::solve(plexway::Serial{}, mesh, source, options).distance, truth, 1e-7,
                    1e-7);
        break;
      }
      case 1: {
        const plexway::TriangleMesh<double> mesh(places, shape.faces);
        check_truth(plexway::solve(plexway::Serial{}, mesh, source, options).distance, truth, 2e-2,
                    3e-2);
        break;
      }
      case 2: {
        std::vector<double> flat;
        for (const Place& p : places) flat.insert(flat.end(), {p[0], p[1]});
        const plexway::SimplicialComplex<double, 2> complex(flat, 2, shape.faces);
        check_truth(plexway::solve(plexway::Serial{}, complex, source, options).distance, truth,
                    1e-9, 5e-2);
        break;
      }
      default: {
        const double height = 0.1 + choices.byte() / 512.;
        const Prism prism = prism_of(shape, height);
        std::vector<double> over;
        for (std::size_t v = 0; v < prism.places.size(); ++v)
          over.push_back(std::hypot(truth[prism.below[v]], prism.places[v][2]));
        const plexway::TetMesh<double> solid(prism.places, prism.tets);
        check_truth(plexway::solve(plexway::Serial{}, solid, source, options).distance, over, 1e-6,
                    5e-2);
      }
    }
  });
}
