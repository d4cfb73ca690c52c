// Flat domains of two, three and four dimensions with boxes as obstacles: errors of strings and of
// the plain step against the shortest ways by brute force, and how much longer strings take.

#include <cmath>
#include <random>

#include "labels/simplex_obstacles.hpp"
#include "solver.hpp"

namespace bench::dimensions {

using plexway::PointSource, plexway::PropagateOptions, plexway::SimplicialComplex;

struct Settings {
  unsigned first = 1, draws = 40, sources = 2, targets = 100, turns = 3;
  std::size_t density = 1, cells = 0;
  int dimension = 0;
};

PropagateOptions plain_step() {
  PropagateOptions options = one_label();
  options.visibility = plexway::Visibility::centroid;
  return options;
}

/// Relative errors of many draws.
struct Deviations {
  double sum = 0, worst = 0, below = 0;
  unsigned worst_draw = 0, below_draw = 0;
  std::size_t count = 0, long_by_1e_3 = 0;

  void add(double found, double right, unsigned draw) {
    const double e = std::isinf(right) == std::isinf(found)
                         ? std::isinf(right) ? 0 : found / right - 1
                         : std::numeric_limits<double>::infinity();
    sum += std::abs(e);
    if (e > worst) worst = e, worst_draw = draw;
    if (e < below) below = e, below_draw = draw;
    long_by_1e_3 += e > 1e-3;
    ++count;
  }
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

/// Processor time of both, in so many turns.
template <int N>
class Race {
 public:
  explicit Race(unsigned turns) : turns_(turns) {}

  void run(const SimplicialComplex<double, N>& domain, Index source) {
    Solver solver(domain);
    const auto timed = [&](const PropagateOptions& options, double& sum) {
      sum += processor_seconds([&] { solver.solve(source, options); });
    };
    for (unsigned turn = 0; turn < turns_; ++turn) {
      timed({}, strings_);
      timed(plain_step(), plain_);
    }
    simplices_ += static_cast<double>(domain.simplex_count());
    ++solves_;
  }
  [[nodiscard]] Row row() const {
    Row row = {{"simplices", simplices_ / solves_}};
    if (turns_ > 0) {
      row["ns"] = 1e9 * strings_ / (turns_ * simplices_);
      row["ratio"] = strings_ / plain_;
    }
    return row;
  }

 private:
  unsigned turns_;
  double strings_ = 0, plain_ = 0, simplices_ = 0, solves_ = 0;
};

template <int N>
Row boxes(const Settings& effort, std::size_t cells, unsigned most, std::size_t density) {
  Deviations strings, plain;
  Race<N> race(effort.turns);
  for (unsigned seed = effort.first; seed < effort.first + effort.draws; ++seed) {
    const auto obstacles = plexway::testing::random_obstacles<N>(seed, cells, most);
    const auto domain = obstacles.template complex<double>();
    plexway::testing::ShortestWays<N> ways(obstacles, effort.density * density);
    std::mt19937 random(seed);
    const auto any = [&] {
      for (;;) {
        const Index v = plexway::testing::below(random, obstacles.grid.vertex_count());
        if (!domain.corners_at(domain.inside_vertex(v)).empty()) return v;
      }
    };
    for (unsigned n = 0; n < effort.sources; ++n) {
      const Index source = any();
      ways.start(obstacles.grid.position(source));
      const auto by_strings = plexway::testing::solve(domain, PointSource::at(source));
      const auto by_steps = plexway::testing::solve(domain, PointSource::at(source), plain_step());
      if (n == 0) race.run(domain, source);
      for (unsigned k = 0; k < effort.targets; ++k) {
        const Index v = any();
        if (v == source) continue;
        const double right = ways.to(obstacles.grid.position(v));
        strings.add(by_strings[v], right, seed);
        plain.add(by_steps[v], right, seed);
      }
    }
  }
  Row row = {{"domain", "1 to " + std::to_string(most) + " boxes"},
             {"N", N},
             {"cells", cells},
             {"distances", strings.count},
             {"mean", strings.mean()},
             {"worst", strings.worst},
             {"worst_draw", strings.worst_draw},
             {"below", strings.below},
             {"below_draw", strings.below_draw},
             {"long", strings.long_by_1e_3},
             {"plain_mean", plain.mean()},
             {"plain_worst", plain.worst}};
  row.update(race.row());
  return row;
}

/// So many cells a side, and boxes at most.
struct Boxes {
  std::size_t cells;
  unsigned most;
};

template <int N>
void fill(Table& table, const Settings& effort, std::vector<Boxes> usual, std::size_t density) {
  if (effort.dimension != 0 && effort.dimension != N) return;
  if (effort.cells != 0) usual = {{effort.cells, usual.back().most}};
  for (const auto& [cells, most] : usual) table.add(boxes<N>(effort, cells, most, density));
}
void run(Arguments& arguments) {
  Settings settings;
  arguments.positive("--draws", &settings.draws, "Random domains of each kind");
  arguments.option("--first", &settings.first, "The first of them");
  arguments.option("--dimension", &settings.dimension, "2, 3 or 4 alone");
  arguments.option("--cells", &settings.cells, "So many a side instead of the usual numbers");
  arguments.option("--density", &settings.density,
                   "So many times the points on faces for the truth");
  arguments.option("--sources", &settings.sources, "Sources in each");
  arguments.option("--targets", &settings.targets, "Random vertices for each");
  arguments.option("--turns", &settings.turns, "How often each is timed, 0: errors alone");
  Table& table = arguments.table(
      "domain; N; cells: cells a side; simplices %.0f; distances; mean: strings: mean %.1e;"
      "worst %.1e; worst_draw: draw; below: most below %.1e; below_draw: draw; long: > 1e-3 long;"
      "plain_mean: plain step: mean %.1e; plain_worst: worst %.1e; ns: strings: ns/simplex %.0f;"
      "ratio: x plain step %.1f");
  fill<2>(table, settings, {{16, 4}}, 2);
  fill<3>(table, settings, {{8, 3}, {12, 4}, {16, 4}}, 24);
  fill<4>(table, settings, {{6, 2}, {8, 2}}, 5);
}
const Command command("dimensions", "boxes in 2, 3 and 4 dimensions, against brute force", run);

}  // namespace bench::dimensions
