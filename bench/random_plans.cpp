// Random plans as the fuzzers make them (tests/fuzz/fuzz_plan.hpp), with errors in a table where
// those only hold bounds: rectangles cut out of a square, as a surface, as a complex of triangles
// and as the prism over it, against the visibility graph of the corners. Several sources at once in
// a cube, against straight lines. And solids of several speeds: stacks of slabs, against Snell's
// law and head waves; two with rectangles or slits cut out of both, against a refined graph.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <plexway/complex/kuhn_grid.hpp>
#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/solve.hpp>

#include "data/pierced_layers.hpp"
#include "data/random_stacks.hpp"
#include "fuzz/fuzz_pierced.hpp"
#include "table.hpp"

namespace {

using plexway::Accuracy;
using plexway::Index;
using plexway::PointSource;
using Distances = std::vector<double>;
using Random = std::mt19937;  // the same numbers with every library

// What fields are off, as a share of the distance; a row of the table.
class Errors {
 public:
  void add(const Distances& found, const Distances& truth) {
    double longest = 0;
    for (std::size_t v = 0; v < truth.size(); ++v) {
      if (!(truth[v] > 1e-12)) continue;
      const double off = found[v] / truth[v] - 1;
      ++vertices_;
      sum_ += std::abs(off);
      far_ += off > bounds[0];
      off_ += std::abs(off) > 1e-3;
      longest = std::max(longest, off);
      shortest_ = std::min(shortest_, off);
    }
    ++plans_;
    longest_ = std::max(longest_, longest);
    for (std::size_t i = 0; i < bounds.size(); ++i) above_[i] += longest > bounds[i];
  }
  void print(const std::string& name, bench::Table& table) const {
    table.add({{"domain", name},
               {"plans", plans_},
               {"vertices", vertices_},
               {"mean", sum_ / static_cast<double>(std::max<std::size_t>(vertices_, 1))},
               {"long", longest_},
               {"short", shortest_},
               {"off", off_},
               {"far", far_},
               {"above1", above_[0]},
               {"above3", above_[1]},
               {"above5", above_[2]}});
  }

 private:
  static constexpr std::array<double, 3> bounds = {.01, .03, .05};
  std::size_t plans_ = 0, vertices_ = 0, off_ = 0, far_ = 0;
  double sum_ = 0, longest_ = 0, shortest_ = 0;
  std::array<std::size_t, 3> above_{};
};

// Plans with enough room for the source, by `solve(cut, choices, errors)`.
template <class Solve>
void solve_plans(Random& random, std::size_t plans, Errors& errors, const Solve& solve) {
  while (plans > 0) {
    std::array<std::uint8_t, 16> bytes;
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
    fuzz::Choices choices(bytes.data(), bytes.size());
    const auto cut = fuzz::cut_of(choices);
    if (!cut) continue;
    solve(*cut, choices, errors);
    --plans;
  }
}

void solve_surface(const fuzz::Cut& cut, Accuracy accuracy, Errors& errors) {
  plexway::PropagateOptions options;
  options.accuracy = accuracy;
  const plexway::TriangleMesh<double> mesh(cut.places, cut.shape.faces);
  errors.add(plexway::solve(plexway::Serial{}, mesh, PointSource::at(0), options).distance,
             cut.truth);
}

void solve_plane(const fuzz::Cut& cut, Errors& errors) {
  const plexway::SimplicialComplex<double, 2> complex(fuzz::flattened(cut.places), 2,
                                                      cut.shape.faces);
  errors.add(plexway::solve(plexway::Serial{}, complex, PointSource::at(0)).distance, cut.truth);
}

void solve_prism(const fuzz::Cut& cut, fuzz::Choices& choices, Errors& errors) {
  const fuzz::Prism prism = fuzz::prism_of(cut.shape, fuzz::height_of(choices));
  const plexway::TetMesh<double> solid(prism.places, prism.tets);
  errors.add(plexway::solve(plexway::Serial{}, solid, PointSource::at(0)).distance,
             fuzz::over(prism, cut.truth));
}

// So many vertices of a cube of 6 to 20 cells a side.
void solve_cube(Random& random, std::size_t count, Errors& errors) {
  const std::size_t n = 6 + random() % 15;
  const double cell = 1. / static_cast<double>(n);
  const plexway::KuhnGrid<3> grid({n, n, n}, {cell, cell, cell});
  std::vector<fuzz::Place> places;
  for (Index v = 0; v < grid.vertex_count(); ++v) places.push_back(grid.position(v));
  const plexway::TetMesh<double> cube(places, grid.simplices());
  std::vector<PointSource> sources(count);
  for (PointSource& source : sources)
    source = PointSource::at(static_cast<Index>(random() % grid.vertex_count()));
  Distances truth;
  for (const fuzz::Place& p : places) {
    truth.push_back(10);
    for (const PointSource& source : sources)
      truth.back() = std::min(truth.back(), fuzz::Graph::straight(p, places[source.vertex]));
  }
  errors.add(plexway::solve(plexway::Serial{}, cube, sources).distance, truth);
}

// From a vertex on a plane between two slabs, or from any.
void solve_stack(Random& random, double thinnest, double thickest, bool on_plane, Errors& errors) {
  const samples::Stack stack = samples::random_stack(random, 20, thinnest, thickest);
  plexway::MixedComplex<double> domain;
  std::vector<samples::Position> places;
  std::vector<plexway::MixedComplex<double>::Piece> pieces;
  for (std::size_t k = 0; k < stack.blocks.size(); ++k) {
    const auto& [positions, tets] = stack.blocks[k];
    places.insert(places.end(), positions.begin(), positions.end());
    auto timed = positions;
    for (auto& p : timed)
      for (double& x : p) x /= stack.layers.v[k];
    pieces.push_back(domain.add(plexway::TetMesh<double>(timed, tets), positions));
    if (k > 0) domain.weld(pieces[k - 1], pieces[k], plexway::WeldOptions{.tolerance = 1e-9});
  }
  const auto& planes = stack.layers.z;
  Index source;
  do {
    source = static_cast<Index>(random() % places.size());
  } while (on_plane && std::find(planes.begin(), planes.end(), places[source][2]) == planes.end());
  Distances truth;
  for (const auto& p : places) truth.push_back(stack.layers.time(places[source], p));
  errors.add(plexway::solve(plexway::Serial{}, domain, PointSource::at(source)).distance, truth);
}

// Two solids of two speeds with rectangles or slits cut out of both.
void solve_pierced(Random& random, bool slits, std::size_t plans, Errors& errors) {
  while (plans > 0) {
    std::array<std::uint8_t, 16> bytes;
    for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random() >> 24);
    fuzz::Choices choices(bytes.data(), bytes.size());
    auto plan = fuzz::plan_of(choices);
    if (!plan) continue;
    if (slits) plan->blocks = fuzz::slits_of(plan->blocks);
    if (std::any_of(plan->blocks.begin(), plan->blocks.end(), [&](const auto& b) {
          return b.left == b.right && std::abs(plan->source[0] - b.left) < 1e-9;
        }))
      continue;  // from a slit, or in its line
    if (const auto solved = fuzz::solve_pierced(*plan, choices)) {
      errors.add(solved->found, solved->truth);
      --plans;
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t plans = 200;
  unsigned seed = 1;
  std::vector<std::string> only;
  bench::Report report;
  CLI::App app("Random plans as the fuzzers make them: how far distances are off");
  app.add_option("--plans", plans, "How many of each kind")->capture_default_str();
  app.add_option("--seed", seed, "Other plans by another number")->capture_default_str();
  app.add_option("--only", only, "accurate, exact, plane, prism, sources, stack, holes, slits")
      ->delimiter(',');
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  bench::Table table({{"domain", "domain"},
                      {"plans", "plans"},
                      {"vertices", "vertices"},
                      {"mean", "mean"},
                      {"long", "most too long"},
                      {"short", "most too short"},
                      {"off", "vertices off by .1 %"},
                      {"far", "above 1 %"},
                      {"above1", "plans above 1 %"},
                      {"above3", "above 3 %"},
                      {"above5", "above 5 %"}});
  const auto measure = [&](const std::string& name,
                           const std::function<void(Random&, Errors&)>& solve) {
    const std::string kind = name.substr(0, name.find(' '));
    if (!only.empty() && std::find(only.begin(), only.end(), kind) == only.end()) return;
    Random random(seed);
    Errors errors;
    solve(random, errors);
    errors.print(name, table);
  };
  const auto of_plans = [&](const std::string& name, const auto& solve) {
    measure(name,
            [&](Random& random, Errors& errors) { solve_plans(random, plans, errors, solve); });
  };
  return report.write(table, [&] {
    of_plans("accurate", [](const auto& cut, auto&, Errors& errors) {
      solve_surface(cut, Accuracy::accurate(), errors);
    });
    of_plans("exact", [](const auto& cut, auto&, Errors& errors) {
      solve_surface(cut, Accuracy::exact(), errors);
    });
    of_plans("plane", [](const auto& cut, auto&, Errors& errors) { solve_plane(cut, errors); });
    of_plans("prism", [](const auto& cut, auto& choices, Errors& errors) {
      solve_prism(cut, choices, errors);
    });
    for (const std::size_t count : {1, 2, 5, 20})
      measure("sources " + std::to_string(count), [&](Random& random, Errors& errors) {
        for (std::size_t i = 0; i < plans; ++i) solve_cube(random, count, errors);
      });
    const auto stacks = [&](const std::string& name, double thinnest, double thickest,
                            bool on_plane) {
      measure("stack " + name, [&](Random& random, Errors& errors) {
        for (std::size_t i = 0; i < plans; ++i)
          solve_stack(random, thinnest, thickest, on_plane, errors);
      });
    };
    stacks("thin, from a plane", .02, 1.5, true);
    stacks("of cells, from a plane", .7, 1.5, true);
    stacks("thin, from anywhere", .02, 1.5, false);
    for (const bool slits : {false, true})
      measure(slits ? "slits in two speeds" : "holes in two speeds",
              [&](Random& random, Errors& errors) { solve_pierced(random, slits, plans, errors); });
  });
}
