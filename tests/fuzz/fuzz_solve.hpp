#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/fields.hpp>
#include <plexway/solve.hpp>

#include "fuzz_reader.hpp"

/// Random small complexes made of a fuzzer's bytes, and what every field on them must keep to.
namespace fuzz {

using plexway::Index;
using Place = std::array<double, 3>;

/// A fuzzer's bytes as numbers; zeros where they have ended.
class Choices {
 public:
  Choices(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  [[nodiscard]] bool more() const { return at_ != end_; }
  std::uint8_t byte() { return at_ == end_ ? std::uint8_t{0} : *at_++; }
  Index below(std::size_t n) {
    const std::size_t high = byte();  // first, whatever the compiler
    return static_cast<Index>((high << 8 | byte()) % n);
  }
  /// Mostly on a coarse lattice, where much coincides; now and then of another size by far.
  double number() {
    const std::uint8_t b = byte();
    if (b < 160) return b % 8;
    if (b < 240) return byte() / 32. + b / 1024.;
    return std::ldexp(1 + byte() / 256., static_cast<int>(b % 16) - 8);
  }
  Place place() { return {number(), number(), number()}; }

 private:
  const std::uint8_t *at_, *end_;
};

/// What a field is compared with: vertices, and edges with their lengths.
struct Graph {
  std::size_t vertices = 0;
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> lengths;

  /// Every edge of these simplices, straight in space.
  template <class Simplices, class Places>
  static Graph of(const Simplices& simplices, const Places& places) {
    Graph graph;
    graph.vertices = places.size();
    for (const auto& s : simplices)
      for (std::size_t i = 0; i < s.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          graph.edges.push_back({s[i], s[j]});
          graph.lengths.push_back(straight(places[s[i]], places[s[j]]));
        }
    return graph;
  }
  template <class P>
  static double straight(const P& a, const P& b) {
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
  }

  /// Along edges alone, by looking at all of them until none helps.
  [[nodiscard]] std::vector<double> walk(Index from) const {
    std::vector<double> d(vertices, std::numeric_limits<double>::infinity());
    d[from] = 0;
    for (bool better = true; better;) {
      better = false;
      for (std::size_t e = 0; e < edges.size(); ++e)
        for (const auto& [a, b] :
             {std::pair(edges[e][0], edges[e][1]), std::pair(edges[e][1], edges[e][0])})
          if (d[a] + lengths[e] < d[b]) {
            d[b] = d[a] + lengths[e];
            better = true;
          }
    }
    return d;
  }
};

/// What must hold whatever the complex: 0 at the source, nowhere NaN, inf exactly where no edges
/// lead, no vertex farther than a neighbour and the edge between.
template <class Distances>
void check_field(const Distances& d, const Graph& graph, Index source, double slack) {
  require(d.size() == graph.vertices, "one distance a vertex");
  const std::vector<double> walked = graph.walk(source);
  require(d[source] == 0, "0 at the source");
  for (std::size_t v = 0; v < d.size(); ++v) {
    require(!std::isnan(d[v]) && d[v] >= 0, "no NaN, nothing negative");
    require(std::isfinite(d[v]) == std::isfinite(walked[v]), "inf exactly where no path leads");
    if (std::isfinite(walked[v]))
      require(d[v] <= walked[v] * (1 + slack),
              "no farther than along edges: vertex " + std::to_string(v) + " from " +
                  std::to_string(source) + " at " + std::to_string(d[v]) + ", along edges " +
                  std::to_string(walked[v]));
  }
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const auto [a, b] = graph.edges[e];
    if (!std::isfinite(d[a])) continue;
    const double most = std::max<double>(d[a], d[b]);
    require(std::abs(double{d[a]} - double{d[b]}) <= graph.lengths[e] + slack * most,
            "no vertex farther than a neighbour and the edge between: " + std::to_string(a) +
                " at " + std::to_string(d[a]) + ", " + std::to_string(b) + " at " +
                std::to_string(d[b]) + ", edge " + std::to_string(graph.lengths[e]));
  }
}

/// And where edges are straight in space: nothing below the straight line.
template <class Distances, class Places>
void check_straight(const Distances& d, const Places& places, Index source, double slack) {
  for (std::size_t v = 0; v < d.size(); ++v) {
    const double line = Graph::straight(places[v], places[source]);
    require(d[v] >= line * (1 - slack), "nothing below the straight line: vertex " +
                                            std::to_string(v) + " at " + std::to_string(d[v]) +
                                            ", straight " + std::to_string(line));
  }
}

template <class Real>
constexpr double slack_of = sizeof(Real) == 4 ? 2e-5 : 1e-9;

inline plexway::PropagateOptions options_of(Choices& choices) {
  plexway::PropagateOptions options;
  options.schedule = std::array{plexway::Schedule::dual_queue, plexway::Schedule::fifo,
                                plexway::Schedule::priority}[choices.below(3)];
  return options;
}

}  // namespace fuzz
