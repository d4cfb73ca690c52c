// Clouds of a few points, each with its nearest ones: coinciding, in rows, in space.

#include <plexway/cloud/point_cloud.hpp>

#include "fuzz_solve.hpp"

PLEXWAY_FUZZER(solve_cloud)(const std::uint8_t* data, std::size_t size) {
  using namespace fuzz;
  Choices choices(data, size);
  const auto options = options_of(choices);
  const std::size_t k = 2 + choices.below(8);
  const bool flat = choices.byte() % 2 == 0;
  std::vector<Place> points;
  while (choices.more() && points.size() < 60) {
    points.push_back(choices.place());
    if (flat) points.back()[2] = 0;
  }
  if (points.size() < 2) return 0;
  const Index source = choices.below(points.size());
  plexway::Neighbours near;
  near.begin.push_back(0);
  std::vector<Index> others(points.size());
  for (Index i = 0; i < points.size(); ++i) {
    std::iota(others.begin(), others.end(), Index{0});
    others.resize(points.size());
    std::stable_sort(others.begin(), others.end(), [&](Index a, Index b) {
      return Graph::straight(points[i], points[a]) < Graph::straight(points[i], points[b]);
    });
    std::size_t taken = 0;
    for (const Index other : others)
      if (other != i && taken < k) {
        near.of.push_back(other);
        ++taken;
      }
    near.begin.push_back(static_cast<Index>(near.of.size()));
  }
  return check_input({}, [&] {
    const plexway::PointCloud<double> cloud(points, near);
    const auto field =
        plexway::solve(plexway::Serial{}, cloud, plexway::PointSource::at(source), options);
    require(field.distance.size() == points.size(), "one distance a point");
    require(field.distance[source] == 0, "0 at the source");
    for (const double d : field.distance)
      require(!std::isnan(d) && d >= 0, "no NaN, nothing negative");
  });
}
