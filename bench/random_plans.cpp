// Random plans as the fuzzers make them (tests/fuzz/fuzz_plan.hpp), with errors in a table where
// those only hold bounds: rectangles cut out of a square, as a surface, as a complex of triangles
// and as the prism over it, against the visibility graph of the corners; prisms over plans with
// a crack, and paths in these. Several sources at once: in a cube against straight
// lines, in prisms over plans against the least of a field from each. And solids of several speeds:
// stacks of slabs, against Snell's law and head waves; two with rectangles or slits cut out of
// both, against a refined graph.

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

#include <plexway/complex/simplicial_complex.hpp>
#include <plexway/complex/tet_mesh.hpp>
#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/solve.hpp>

#include "fuzz/fuzz_plan.hpp"
#include "plan_errors.hpp"
#include "random_cracks.hpp"
#include "random_layers.hpp"
#include "random_sources.hpp"
#include "table.hpp"

namespace {

using bench::Distances, bench::Random;
using plexway::Accuracy;
using plexway::Index;
using plexway::PointSource;
using Errors = bench::PlanErrors;

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

}  // namespace

int main(int argc, char** argv) {
  std::size_t plans = 200;
  unsigned seed = 1;
  std::vector<std::string> only;
  bench::Report report;
  CLI::App app("Random plans as the fuzzers make them: how far distances are off");
  app.add_option("--plans", plans, "How many of each kind")->capture_default_str();
  app.add_option("--seed", seed, "Other plans by another number")->capture_default_str();
  app.add_option("--only", only,
                 "accurate, exact, plane, prism, sources, moved, boundary, least, stack, holes, "
                 "slits, crack, path")
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
    const auto of_counts = [&](const std::string& name, const std::vector<std::size_t>& counts,
                               const auto& solve) {
      for (const std::size_t count : counts)
        measure(name + ' ' + std::to_string(count), [&](Random& random, Errors& errors) {
          for (std::size_t i = 0; i < plans; ++i) solve(random, count, errors);
        });
    };
    of_counts("sources", {1, 2, 5, 20, 200, 2000}, bench::solve_cube);
    of_counts("moved", {2, 5, 20, 200, 2000}, bench::solve_moved_cube);
    measure("boundary", [&](Random& random, Errors& errors) {
      for (std::size_t i = 0; i < plans; ++i) bench::solve_from_boundary(random, errors);
    });
    for (const std::size_t count : {2, 5, 20, 200})
      measure("least " + std::to_string(count), [&](Random& random, Errors& errors) {
        solve_plans(random, plans, errors, [&](const auto& cut, auto& choices, Errors& into) {
          bench::solve_least(cut, random, count, fuzz::height_of(choices), into);
        });
      });
    const auto stacks = [&](const std::string& name, double thinnest, double thickest,
                            bool on_plane) {
      measure("stack " + name, [&](Random& random, Errors& errors) {
        for (std::size_t i = 0; i < plans; ++i)
          bench::solve_stack(random, thinnest, thickest, on_plane, errors);
      });
    };
    stacks("thin, from a plane", .02, 1.5, true);
    stacks("of cells, from a plane", .7, 1.5, true);
    stacks("thin, from anywhere", .02, 1.5, false);
    for (const bool slits : {false, true})
      measure(slits ? "slits in two speeds" : "holes in two speeds",
              [&](Random& random, Errors& errors) {
                bench::solve_pierced(random, slits, plans, errors);
              });
    for (const std::string kind : {"slit", "L", "T", "U", "any", "hole"})
      measure("crack " + kind, [&](Random& random, Errors& errors) {
        bench::solve_cracked(random, plans, kind, errors);
      });
    measure("path slit", [&](Random& random, Errors& errors) {
      bench::trace_cracked(random, plans, "slit", errors);
    });
  });
}
