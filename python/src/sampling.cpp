#include <pybind11/stl.h>

#include <vector>

#include <plexway/error.hpp>
#include <plexway/sampling/centroidal_voronoi.hpp>
#include <plexway/sampling/farthest_points.hpp>
#include <plexway/sampling/poisson_disk.hpp>
#include <plexway/shape/complex.hpp>

#include "arrays.hpp"
#include "domain.hpp"

namespace plexway::python {
namespace {

// As the complex has them.
std::vector<PointSource> inside(const Domain& domain, std::span<const PointSource> points) {
  std::vector<PointSource> there;
  for (const PointSource& point : points) there.push_back(domain.inside(point));
  return there;
}

py::tuple poisson(const Domain& domain, double radius, std::size_t count, std::uint64_t seed,
                  bool at_vertices, bool by_simplices, const py::object& spacing,
                  py::object progress) {
  Watch watch(std::move(progress));
  std::vector<double> spacings;
  if (!spacing.is_none()) spacings = numbers_of(spacing, "spacing");
  PoissonOptions options;
  options.radius = radius;
  options.count = count;
  options.seed = seed;
  options.at_vertices = at_vertices;
  options.order = by_simplices ? DartOrder::simplices : DartOrder::uniform;
  options.spacing = spacings;
  options.progress = watch.of_share();
  PoissonDisks disks = watch.run([&] {
    return with_sampled(domain.any(), [&](const auto& complex) {
      return poisson_disks(Serial{}, complex, options);
    });
  });
  return py::make_tuple(domain.outside(std::move(disks.darts)), disks.radius, disks.maximal);
}

py::tuple farthest(const Domain& domain, std::vector<Source> given, std::size_t count,
                   double radius, py::object progress) {
  const Sources start(std::move(given));
  const std::vector<PointSource> points = inside(domain, start.points(Purpose::samples));
  Watch watch(std::move(progress));
  FarthestOptions options;
  options.count = count;
  options.radius = radius;
  options.progress = watch.of_share();
  FarthestPoints found = watch.run([&] {
    return with_sampled(domain.any(), [&](const auto& complex) {
      return farthest_points(Serial{}, complex, points, options);
    });
  });
  return py::make_tuple(domain.outside(std::move(found.points)), owned(std::move(found.distance)),
                        found.covering);
}

py::tuple cvt(const Domain& domain, std::vector<Source> given, std::size_t iterations,
              double tolerance, py::object progress) {
  const Sources seeds(std::move(given));
  const std::vector<PointSource> points = inside(domain, seeds.points(Purpose::samples));
  Watch watch(std::move(progress));
  VoronoiOptions options;
  options.max_iterations = iterations;
  options.tolerance = tolerance;
  double done = 0;
  options.progress = [&](const VoronoiStep&) {
    return watch.tick(++done / static_cast<double>(iterations));
  };
  CentroidalVoronoi found = watch.run([&] {
    return with_sampled(domain.any(), [&](const auto& complex) {
      return centroidal_voronoi(Serial{}, complex, points, options);
    });
  });
  // A simplex each, or a point of a cloud; -1 where no seed is near, and behind a mask.
  const OpenSimplices* const open = domain.any().open_simplices();
  std::vector<std::int32_t> label(open == nullptr ? found.label.size() : domain.shape().simplices(),
                                  -1);
  for (Index s = 0; s < found.label.size(); ++s)
    if (found.label[s] != none)
      label[open == nullptr ? s : open->outside(s)] = static_cast<std::int32_t>(found.label[s]);
  std::vector<double> energy;
  for (const VoronoiStep& step : found.steps) energy.push_back(step.energy);
  energy.push_back(found.energy);
  return py::make_tuple(domain.outside(std::move(found.seeds)), owned(std::move(label)),
                        owned(std::move(found.cell_content)), owned(std::move(energy)),
                        found.converged);
}

}  // namespace

void bind_sampling(py::module_& module) {
  module.def("poisson", &poisson);
  module.def("farthest", &farthest);
  module.def("cvt", &cvt);
}

}  // namespace plexway::python
