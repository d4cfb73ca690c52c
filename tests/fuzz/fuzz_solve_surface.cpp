// Soups of triangles: many on an edge, flat ones, vertices that coincide, parts that hang apart.

#include <plexway/solve.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "fuzz_solve.hpp"

namespace fuzz_solve_surface {

namespace {

using namespace fuzz;
using plexway::PointSource;

struct Soup {
  std::vector<Place> places;
  std::vector<std::array<Index, 3>> faces;
};

Soup soup_of(Choices& choices) {
  Soup soup;
  soup.places.resize(3 + choices.below(14));
  for (Place& p : soup.places) p = choices.place();
  while (choices.more() && soup.faces.size() < 60) {
    const Index a = choices.below(soup.places.size()), b = choices.below(soup.places.size()),
                c = choices.below(soup.places.size());
    if (a != b && b != c && c != a) soup.faces.push_back({a, b, c});
  }
  return soup;
}

template <class Real>
void check(const Soup& soup, Index source, const plexway::PropagateOptions& options) {
  const plexway::TriangleMesh<Real> mesh(soup.places, soup.faces);
  const Graph graph = Graph::of(soup.faces, soup.places);
  const auto field = plexway::solve(plexway::Serial{}, mesh, PointSource::at(source), options);
  check_field(field.distance, graph, source, slack_of<Real>);
  check_straight(field.distance, soup.places, source, slack_of<Real>);
}

// Exact distances: symmetric, and a metric.
void check_exact(const Soup& soup, Index a, Index b) {
  const plexway::TriangleMesh<double> mesh(soup.places, soup.faces);
  const Graph graph = Graph::of(soup.faces, soup.places);
  // On soups of many triangles an edge there may be more windows than anyone can wait for.
  plexway::PropagateOptions bounded;
  bounded.max_expansions = 20000;
  bounded.accuracy = plexway::Accuracy::exact();
  const auto from_a = plexway::solve(plexway::Serial{}, mesh, PointSource::at(a), bounded);
  const auto from_b = plexway::solve(plexway::Serial{}, mesh, PointSource::at(b), bounded);
  if (!from_a.complete || !from_b.complete) return;
  check_field(from_a.distance, graph, a, 1e-7);
  check_straight(from_a.distance, soup.places, a, 1e-7);
  const double there = from_a.distance[b], back = from_b.distance[a];
  require(there == back || std::abs(there - back) <= 1e-6 * there,
          "exact: the same there and back");
  for (std::size_t v = 0; v < soup.places.size(); ++v)
    if (std::isfinite(from_a.distance[v]))
      require(there <= (from_a.distance[v] + from_b.distance[v]) * (1 + 1e-6),
              "exact: the triangle inequality");
}

}  // namespace

PLEXWAY_FUZZER(solve_surface)(const std::uint8_t* data, std::size_t size) {
  Choices choices(data, size);
  const auto options = options_of(choices);
  const std::uint8_t kind = choices.byte();
  const Index a = choices.below(3), b = choices.below(3);
  const Soup soup = soup_of(choices);
  return check_input({}, [&] {
    if (kind % 4 == 0)
      check_exact(soup, a, b);
    else if (kind % 4 == 1)
      check<float>(soup, a, options);
    else
      check<double>(soup, a, options);
  });
}

}  // namespace fuzz_solve_surface
