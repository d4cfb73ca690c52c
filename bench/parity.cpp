// How far executors and orders of updates are from the exact distances, and from each other: no
// order is right, so two executors differ by as much as two schedules of one do.

#include <iostream>

#include <plexway/error.hpp>

#include "solver.hpp"
#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

namespace bench::parity {

using Mesh = plexway::TriangleMesh<float>;

struct Kind {
  std::string name;
  std::function<std::vector<float>(const Mesh&, Index)> solve;
  double error = 0, worst = 0, difference = 0, most = 0;
};

template <class Executor>
Kind kind(const std::string& name, const Executor& executor,
          const plexway::PropagateOptions& options = one_label()) {
  return {
      name, [=](const Mesh& mesh, Index source) {
        return plexway::solve(executor, mesh, plexway::PointSource::at(source), options).distance;
      }};
}

std::vector<Kind> all_kinds() {
  const plexway::Serial serial;
  std::vector<Kind> kinds = {kind("Serial", serial)};
  plexway::PropagateOptions options = one_label();
  for (const double step : {0.25, 0.5, 2.}) {
    options.step = step;
    kinds.push_back(kind("Serial, step " + std::to_string(step).substr(0, 4), serial, options));
  }
  options = one_label();
  options.schedule = plexway::Schedule::priority;
  kinds.push_back(kind("Serial, priority", serial, options));
  options = one_label();
  options.vectorised = false;
  kinds.push_back(kind("Serial, not vectorised", serial, options));
  if (plexway::openmp_built()) {
    kinds.push_back(kind("OpenMP, 1 thread", plexway::OpenMP{.threads = 1}));
    kinds.push_back(kind("OpenMP, 2 threads", plexway::OpenMP{.threads = 2}));
    kinds.push_back(kind("OpenMP, not vectorised", plexway::OpenMP{.threads = 2}, options));
  }
#ifdef PLEXWAY_HAS_GL
  try {
    (void)gl_device(plexway::GL{});
    kinds.push_back(kind("GL", plexway::GL{}, {}));
  } catch (const plexway::Error& error) {
    std::cerr << "GL left out: " << error.what() << '\n';
  }
#endif
  return kinds;
}

void run(Arguments& arguments) {
  Meshes meshes;
  meshes.add_options(arguments);
  Table& table = arguments.table(
      "executor; solves; error: error mean %.2e; worst: max %.1e;"
      "difference: from Serial, mean %.1e; most: max %.1e; asked");
  std::vector<Kind> kinds = all_kinds();
  std::size_t solves = 0;
  meshes.each([&](const Surface& surface, const std::vector<Truth>& truths) {
    const Mesh mesh(surface.positions, surface.faces);
    for (const Truth& exact : truths) {
      std::vector<float> reference;
      for (Kind& one : kinds) {
        const auto found = one.solve(mesh, exact.source);
        if (reference.empty()) reference = found;
        Errors errors;
        errors.add(exact, found);
        const auto summary = errors.summary();
        if (!summary) continue;
        one.error += summary->mean;
        one.worst = std::max(one.worst, summary->max);
        Apart apart;
        apart.add(reference, found);
        one.difference += apart.mean();
        one.most = std::max(one.most, apart.most);
      }
      ++solves;
    }
  });
  const double n = static_cast<double>(std::max<std::size_t>(solves, 1));
  for (const Kind& one : kinds)
    table.add({{"executor", one.name},
               {"solves", solves},
               {"error", one.error / n},
               {"worst", one.worst},
               {"difference", one.difference / n},
               {"most", one.most},
               {"asked", one.name.starts_with("Serial") ? "" : "1e-4, 1e-3"}});
}
const Command command("parity", "executors and schedules beside exact answers and Serial", run);

}  // namespace bench::parity
