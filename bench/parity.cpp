// How far executors and orders of updates are from the exact distances, and from each other: no
// order is right, so two executors differ by as much as two schedules of one do.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "compare.hpp"

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

namespace {

using namespace plexway;
using Mesh = TriangleMesh<float>;
using Distances = std::vector<float>;

struct Kind {
  std::string name;
  std::function<Distances(const Mesh&, const PointSource&)> solve;
};

Kind serial(const std::string& name, const PropagateOptions& options) {
  return {name, [options](const Mesh& mesh, const PointSource& source) {
            return plexway::solve(Serial{}, mesh, std::span<const PointSource>(&source, 1), options)
                .distance;
          }};
}

std::vector<Kind> all_kinds() {
  PropagateOptions options = bench::one_label();
  std::vector<Kind> kinds = {serial("Serial", options)};
  for (const double step : {0.25, 0.5, 2.}) {
    options.step = step;
    kinds.push_back(serial("Serial, step " + std::to_string(step).substr(0, 4), options));
  }
  options = bench::one_label();
  options.schedule = Schedule::priority;
  kinds.push_back(serial("Serial, priority", options));
  options = bench::one_label();
  options.vectorised = false;
  kinds.push_back(serial("Serial, not vectorised", options));
  if (openmp_built()) {
    const auto team = [](int threads, bool vectorised) {
      return [threads, vectorised](const Mesh& mesh, const PointSource& source) {
        PropagateOptions some = bench::one_label();
        some.vectorised = vectorised;
        return plexway::solve(OpenMP{.threads = threads}, mesh,
                              std::span<const PointSource>(&source, 1), some)
            .distance;
      };
    };
    kinds.push_back({"OpenMP, 1 thread", team(1, true)});
    kinds.push_back({"OpenMP, 2 threads", team(2, true)});
    kinds.push_back({"OpenMP, not vectorised", team(2, false)});
  }
#ifdef PLEXWAY_HAS_GL
  try {
    (void)gl_device(GL{});
    kinds.push_back({"GL", [](const Mesh& mesh, const PointSource& source) {
                       return plexway::solve(GL{}, mesh, source).distance;
                     }});
  } catch (const Error& error) {
    std::cerr << "GL left out: " << error.what() << '\n';
  }
#endif
  return kinds;
}

struct Totals {
  double error = 0, worst = 0, difference = 0, most = 0;
};

/// Mean and largest relative difference.
void differences(const Distances& one, const Distances& other, double& mean, double& most) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < one.size(); ++v) {
    const double a = static_cast<double>(one[v]), b = static_cast<double>(other[v]);
    if (!(a > 0) || !std::isfinite(a) || !std::isfinite(b)) continue;
    sum += std::abs(b / a - 1);
    most = std::max(most, std::abs(b / a - 1));
    ++count;
  }
  mean += sum / static_cast<double>(std::max<std::size_t>(count, 1));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::string truth;
  bench::Report report;
  CLI::App app("Executors and schedules against exact distances and against Serial: one table");
  app.add_option("MESH", meshes, "Surfaces")->required();
  app.add_option("--truth", truth, "Folder of NAME.vID.txt (default: the mesh's own)");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table({{"executor", "executor"},
                      {"solves", "solves"},
                      {"error", "error mean", "%.2e"},
                      {"worst", "max", "%.1e"},
                      {"difference", "from Serial, mean", "%.1e"},
                      {"most", "max", "%.1e"},
                      {"asked", "asked"}});
  return report.write(table, [&] {
    const std::vector<Kind> kinds = all_kinds();
    std::vector<Totals> totals(kinds.size());
    std::size_t solves = 0;
    for (const std::string& path : meshes) {
      const bench::Surface surface = bench::read_surface(path);
      const Mesh mesh(surface.positions, surface.faces);
      const auto folder =
          truth.empty() ? std::filesystem::path(path).parent_path() : std::filesystem::path(truth);
      for (const bench::Truth& exact : bench::read_truths(folder, surface)) {
        Distances reference;
        for (std::size_t k = 0; k < kinds.size(); ++k) {
          const Distances found = kinds[k].solve(mesh, PointSource::at(exact.source));
          if (k == 0) reference = found;
          bench::Errors errors;
          errors.add(exact, std::vector<double>(found.begin(), found.end()));
          const auto summary = errors.summary();
          if (!summary) continue;
          totals[k].error += summary->mean;
          totals[k].worst = std::max(totals[k].worst, summary->max);
          differences(reference, found, totals[k].difference, totals[k].most);
        }
        ++solves;
      }
    }
    const double n = static_cast<double>(std::max<std::size_t>(solves, 1));
    for (std::size_t k = 0; k < kinds.size(); ++k)
      table.add({{"executor", kinds[k].name},
                 {"solves", solves},
                 {"error", totals[k].error / n},
                 {"worst", totals[k].worst},
                 {"difference", totals[k].difference / n},
                 {"most", totals[k].most},
                 {"asked", kinds[k].name.rfind("Serial", 0) == 0 ? "" : "1e-4, 1e-3"}});
  });
}
