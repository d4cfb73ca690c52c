// What each choice inside the library costs: the default against itself without vectorised steps,
// against the policies that run the literal K = 1 hinge kernel, and against other schedules. All of
// them take turns with the default in one process, so the ratios hold whatever the machine does.

#include "solver.hpp"

namespace bench::policy {

using plexway::PropagateOptions, plexway::Schedule, plexway::Visibility;

struct Variant {
  std::string name;
  PropagateOptions options;
};

std::vector<Variant> variants() {
  std::vector<Variant> all(1, {"saddles (default)", one_label()});
  const auto add = [&](const char* name) -> PropagateOptions& {
    return all.emplace_back(Variant{name, one_label()}).options;
  };
  add("saddles, plain step").vectorised = false;
  add("centroid (hinge kernel)").visibility = Visibility::centroid;
  add("tuned (hinge kernel)").visibility = Visibility::tuned;
  add("upper_bound (hinge kernel)").visibility = Visibility::upper_bound;
  add("saddles, step 2").step = 2;
  add("saddles, first in first out").schedule = Schedule::fifo;
  add("saddles, nearest first").schedule = Schedule::priority;
  return all;
}

template <class Real>
Row measure(const Surface& surface, const Variant& variant, const std::vector<Truth>& truths,
            const Effort& effort) {
  const plexway::TriangleMesh<Real> mesh(surface.positions, surface.faces);
  Solver solver(mesh, variant.options);
  const auto sources = rotating_sources(surface, effort.sources);
  const double vertices = static_cast<double>(surface.positions.size());
  const Times times = take_turns(
      sources, effort, [&](Index v) { solver.solve(v, one_label()); }, [&](Index v) { solver(v); });
  double expansions = 0, updates = 0, reached = 0;
  for (const Index v : sources) {
    solver(v);
    expansions += static_cast<double>(solver.statistics().expansions);
    updates += static_cast<double>(solver.statistics().updates);
    reached += static_cast<double>(solver.statistics().reached_simplices);
  }
  Row row = {
      {"ns_per_vertex", 1e9 * times.second / vertices},
      {"default_ns_per_vertex", 1e9 * times.first / vertices},
      {"ratio", times.ratio},
      {"expansions_per_face", expansions / reached},
      {"updates_per_face", updates / reached},
      {"ns_per_expansion", 1e9 * times.second * static_cast<double>(sources.size()) / expansions}};
  Errors errors;
  for (const Truth& truth : truths) {
    solver(truth.source);
    errors.add(truth, solver.distance());
  }
  add_errors(row, errors);
  return row;
}

void run(Arguments& arguments) {
  Meshes meshes;
  Effort effort;
  bool twice = false;
  meshes.add_options(arguments);
  effort.add_options(arguments);
  arguments.add_limit();
  arguments.option("--double", &twice, "Double instead of float");
  Table& table = arguments.table(
      "mesh; vertices; variant; ns_per_vertex: ns/V %.1f; default_ns_per_vertex: default ns/V %.1f;"
      "ratio: ratio to default %.2f; ns_per_expansion: ns/expansion %.1f;"
      "expansions_per_face: expansions/face %.2f; updates_per_face: updates/face %.2f;"
      "mean: error mean %.1e; max %.1e; note");
  if (meshes.files.empty()) meshes.sizes = {50000};
  meshes.each([&](const Surface& surface, const std::vector<Truth>& truths) {
    for (const Variant& variant : variants())
      table.measure({{"mesh", surface.name},
                     {"vertices", surface.positions.size()},
                     {"variant", variant.name}},
                    arguments.limit, [&] {
                      return twice ? measure<double>(surface, variant, truths, effort)
                                   : measure<float>(surface, variant, truths, effort);
                    });
  });
}
const Command command("policy", "policies and schedules against the default", run);

}  // namespace bench::policy
