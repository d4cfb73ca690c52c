// Windows beside the default, one label a triangle: time in turns, and how far both are off.

#include "solver.hpp"

namespace bench::windows {

using plexway::Accuracy;

template <class Real>
plexway::TriangleMesh<Real> mesh_of(const Surface& surface) {
  return {surface.positions, surface.faces};
}

/// Errors, and of how many vertices the estimate is not too small.
template <class Mesh>
void judge(Solver<Mesh>& solver, const std::vector<Truth>& truths, Row& row) {
  Errors errors;
  std::size_t held = 0, compared = 0;
  for (const Truth& truth : truths) {
    solver(truth.source);
    errors.add(truth, solver.distance());
    const auto& estimate = solver.field().error;
    for (std::size_t v = 0; v < estimate.size(); ++v) {
      const double exact = truth.distance[v], found = static_cast<double>(solver.distance()[v]);
      if (!std::isfinite(exact) || !std::isfinite(found)) continue;
      // Single precision alone is off by this much.
      const double rounding = 1e-6 * exact;
      held += std::abs(found - exact) <= static_cast<double>(estimate[v]) + rounding;
      ++compared;
    }
  }
  add_errors(row, errors);
  if (compared > 0) row["held"] = static_cast<double>(held) / static_cast<double>(compared);
}

template <class Real>
Row measure(const Surface& surface, const std::vector<Truth>& truths, Accuracy accuracy,
            Solver<plexway::TriangleMesh<float>>& fast, const Effort& effort) {
  const double vertices = static_cast<double>(surface.positions.size());
  const auto mesh = mesh_of<Real>(surface);
  plexway::PropagateOptions options;
  options.accuracy = accuracy;
  Solver solver(mesh, options);
  const Times times = take_turns(
      rotating_sources(surface, effort.sources), effort, [&](Index source) { fast(source); },
      [&](Index source) { solver(source); });
  Row row = {{"ns", 1e9 * times.second / vertices},
             {"ratio", times.ratio},
             {"turns", static_cast<double>(solver.statistics().expansions) / vertices},
             {"bytes", static_cast<double>(solver.workspace().bytes()) / vertices}};
  judge(solver, truths, row);
  return row;
}

void run(Arguments& arguments) {
  Meshes meshes;
  std::vector<double> accuracies = {Accuracy::accurate().error()};
  bool no_exact = false;
  std::size_t compared = 0;
  Effort effort;
  meshes.add_options(arguments);
  arguments.option("--accuracy", &accuracies, "Mean relative errors to ask for");
  arguments.option("--no-exact", &no_exact, "Leave exact windows out");
  arguments.option("--compared", &compared,
                   "Take the exact windows of so many sources for the truth, not the files");
  effort.add_options(arguments);
  Table& table = arguments.table(
      "mesh; vertices; accuracy; ns: ns/V %.0f; ratio: time / fast %.2f; turns: turns/V %.1f;"
      "mean: error mean %.1e; p99 %.1e; max %.1e; below: most below %.1e; wrong;"
      "held: estimate holds %.4f; bytes: bytes/V %.0f");
  meshes.each([&](const Surface& surface, std::vector<Truth> truths) {
    if (compared > 0) {  // beside the exact solver's own distances
      truths.clear();
      const auto mesh = mesh_of<double>(surface);
      Solver exact(mesh, by_accuracy("exact"));
      for (const Index source : rotating_sources(surface, compared)) {
        exact(source);
        truths.push_back({source, exact.distance()});
      }
    }
    const auto mesh = mesh_of<float>(surface);
    Solver fast(mesh, one_label());
    const auto add = [&](const std::string& name, const Row& measured) {
      table.add(
          Row{{"mesh", surface.name}, {"vertices", surface.positions.size()}, {"accuracy", name}}
              .update(measured));
    };
    Row row;
    judge(fast, truths, row);
    add("fast", row);
    for (const double error : accuracies) {
      std::array<char, 32> name{};
      std::snprintf(name.data(), name.size(), "%g", error);
      add(name.data(), measure<float>(surface, truths, Accuracy(error), fast, effort));
    }
    if (!no_exact) add("exact", measure<double>(surface, truths, Accuracy::exact(), fast, effort));
  });
}
const Command command("windows", "windows beside labels: time in turns, errors, estimates", run);

}  // namespace bench::windows
