#include <plexway/surface/normals.hpp>

#include <plexway/common/blocks.hpp>

#include "complexes/cloud/neighbourhood.hpp"
#include "complexes/common/geometry.hpp"

namespace plexway {
using namespace detail;

TangentPlanes fit_planes(const GivenPoints& points, const Neighbours& neighbours, int threads) {
  check(points, neighbours);
  TangentPlanes planes;
  planes.normal.resize(points.size());
  planes.variation.resize(points.size());
  for_blocks(points.size(), 4096, threads, {}, [&](std::size_t first, std::size_t last) {
    Neighbourhood around;
    for (std::size_t i = first; i < last; ++i) {
      around.set_neighbours(points, neighbours, static_cast<Index>(i));
      const LocalFrame frame = fit_frame(around.offset, around.weight);
      planes.normal[i] = frame.normal;
      planes.variation[i] = frame.variation;
    }
  });
  return planes;
}

std::vector<std::array<double, 3>> estimate_normals(const GivenPoints& points,
                                                    const Neighbours& neighbours, int threads) {
  return fit_planes(points, neighbours, threads).normal;
}

}  // namespace plexway
