// Graphs: loops, doubles, edges without length. Compared with walking all edges until none helps.

#include <plexway/wireframe/wireframe.hpp>

#include "fuzz_solve.hpp"

PLEXWAY_FUZZER(solve_wires)(const std::uint8_t* data, std::size_t size) {
  using namespace fuzz;
  Choices choices(data, size);
  const auto options = options_of(choices);
  const bool many = choices.byte() % 2 == 1;
  Graph graph;
  graph.vertices = 1 + choices.below(30);
  const Index source = choices.below(graph.vertices);
  while (choices.more() && graph.edges.size() < 120) {
    graph.edges.push_back({choices.below(graph.vertices), choices.below(graph.vertices)});
    graph.lengths.push_back(choices.number());
  }
  return check_input({}, [&] {
    const plexway::Wireframe<double> wires(graph.vertices, graph.edges, graph.lengths);
    const auto at = plexway::PointSource::at(source);
    const auto field =
        many ? plexway::solve(plexway::OpenMP{2}, wires, at, plexway::PropagateOptions{})
             : plexway::solve(plexway::Serial{}, wires, at, options);
    check_field(field.distance, graph, source, 1e-12);
    const auto walked = graph.walk(source);
    for (std::size_t v = 0; v < walked.size(); ++v)
      require(field.distance[v] == walked[v] ||
                  std::abs(field.distance[v] - walked[v]) <= 1e-12 * walked[v],
              "the same as walking all edges");
  });
}
