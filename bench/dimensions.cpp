// Flat domains of two, three and four dimensions with boxes as obstacles: errors of strings and of
// the plain step against the shortest ways by brute force, and how much longer strings take. Around
// a ball of cells, whose faces are many and small, only the time.

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
  std::string domains = "all";
  bool in_float = false;
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
template <class Real, int N>
class Race {
 public:
  explicit Race(unsigned turns) : turns_(turns) {}

  void run(const SimplicialComplex<Real, N>& domain, Index source) {
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

template <class Real, int N>
Row boxes(const Settings& effort, std::size_t cells, unsigned most, std::size_t density) {
  Deviations strings, plain;
  Race<Real, N> race(effort.turns);
  for (unsigned seed = effort.first; seed < effort.first + effort.draws; ++seed) {
    const auto obstacles = plexway::testing::random_obstacles<N>(seed, cells, most);
    const auto domain = obstacles.template complex<Real>();
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

/// The cube without the cells whose centres are within `radius` of its own centre.
template <class Real, int N>
Row ball(const Settings& effort, std::size_t cells, double radius) {
  const auto grid = plexway::testing::cube_grid<N>(cells);
  const auto domain = grid.template complex<Real>([&](const auto& cell) {
    double sum = 0;
    for (const double x : grid.centre(cell)) sum += (x - .5) * (x - .5);
    return sum < radius * radius;
  });
  Race<Real, N> race(effort.turns);
  for (const Index source : spread_numbers(effort.sources, grid.vertex_count()))
    if (!domain.corners_at(domain.inside_vertex(source)).empty()) race.run(domain, source);
  Row row = {{"domain", "a ball of cells"}, {"N", N}, {"cells", cells}};
  row.update(race.row());
  return row;
}

/// So many cells a side, and boxes at most.
struct Boxes {
  std::size_t cells;
  unsigned most;
};

template <class Real, int N>
void fill(Table& table, const Settings& effort, std::vector<Boxes> usual, std::size_t density,
          std::size_t ball_cells) {
  if (effort.dimension != 0 && effort.dimension != N) return;
  if (effort.cells != 0) {
    usual = {{effort.cells, usual.back().most}};
    ball_cells = effort.cells;
  }
  if (effort.domains != "ball")
    for (const auto& [cells, most] : usual) table.add(boxes<Real, N>(effort, cells, most, density));
  if (effort.domains != "boxes") table.add(ball<Real, N>(effort, ball_cells, .3));
}
template <class Real>
void fill(Table& table, const Settings& effort) {
  fill<Real, 2>(table, effort, {{16, 4}}, 2, 60);
  fill<Real, 3>(table, effort, {{8, 3}, {12, 4}, {16, 4}}, 24, 20);
  fill<Real, 4>(table, effort, {{6, 2}, {8, 2}}, 5, 8);
}

void run(Arguments& arguments) {
  Settings settings;
  arguments.positive("--draws", &settings.draws, "Random domains of each kind");
  arguments.option("--first", &settings.first, "The first of them");
  arguments.option("--dimension", &settings.dimension, "2, 3 or 4 alone");
  arguments.option("--cells", &settings.cells, "So many a side instead of the usual numbers");
  arguments.option("--domains", &settings.domains, "One kind alone", {"all", "boxes", "ball"});
  arguments.option("--density", &settings.density,
                   "So many times the points on faces for the truth");
  arguments.option("--sources", &settings.sources, "Sources in each");
  arguments.option("--targets", &settings.targets, "Random vertices for each");
  arguments.option("--turns", &settings.turns, "How often each is timed, 0: errors alone");
  arguments.option("--float", &settings.in_float, "Lengths in float instead of double");
  Table& table = arguments.table(
      "domain; N; cells: cells a side; simplices %.0f; distances; mean: strings: mean %.1e;"
      "worst %.1e; worst_draw: draw; below: most below %.1e; below_draw: draw; long: > 1e-3 long;"
      "plain_mean: plain step: mean %.1e; plain_worst: worst %.1e; ns: strings: ns/simplex %.0f;"
      "ratio: x plain step %.1f");
  settings.in_float ? fill<float>(table, settings) : fill<double>(table, settings);
}
const Command command("dimensions", "boxes in 2, 3 and 4 dimensions, against brute force", run);

}  // namespace bench::dimensions
