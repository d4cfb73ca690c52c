// One source by pieces (OpenMP::piece) against Serial, on a surface by labels or windows, and on a
// wireframe. Counts are the same on any machine and with any number of threads, and so must be the
// bits: `--repeats` solves with 1, 2, 3 and 8 threads are compared (0 differ). Times are taken in
// turns. The model says what recorded counts come to on more threads: each superstep's runs are
// dealt to the threads longest first, a run costs its expansions and some, a superstep what a
// barrier does.

#include "labels/workspace_state.hpp"
#include "piece_model.hpp"
#include "scenes.hpp"
#include "solver.hpp"

namespace bench::pieces {

using plexway::OpenMP, plexway::PropagateOptions;

struct Settings {
  std::vector<std::size_t> sizes = {0, 2048, 8192};  // 0: what OpenMP takes by itself
  int threads = 2;
  std::size_t repeats = 4;  // of solves that must have the same bits
  std::string accuracy = "fast";
  Effort effort{.sources = 3};
};

/// A simplex is what pieces count: a triangle, a vertex of a wireframe.
template <class Domain>
void measure(const std::string& name, const Domain& domain, std::size_t simplices,
             const std::vector<Index>& sources, const PropagateOptions& options,
             const Settings& settings, Table& table) {
  using Real = plexway::RealOf<Domain>;
  const double faces = static_cast<double>(simplices);
  Solver alone(domain, options);
  for (const std::size_t size : settings.sizes) {
    plexway::Workspace<Real> workspace;
    plexway::DistanceField<Real> field;
    const auto by_pieces = [&](int threads, Index source) {
      plexway::solve(OpenMP{threads, 128, size}, domain, plexway::PointSource::at(source), options,
                     workspace, field);
    };
    plexway::SuperstepCounts& counts = workspace.state().pieces.counts();
    counts.keeps_log = true;
    double serial = 0, expansions = 0, supersteps = 0, letters = 0, bytes = 0;
    double model[4] = {};
    const double once = seconds([&] { by_pieces(1, 0); });
    const plexway::DistanceField<Real> first = field;
    std::size_t others = 0;
    for (std::size_t i = 0; i < settings.repeats; ++i) {
      constexpr int threads[] = {1, 2, 3, 8};
      by_pieces(threads[i % 4], 0);
      others += field.distance != first.distance || field.error != first.error;
    }
    for (const Index source : sources) {
      alone(source);
      const double by_one = static_cast<double>(alone.statistics().expansions);
      serial += by_one / faces;
      by_pieces(1, source);
      expansions += static_cast<double>(field.statistics.expansions) / faces;
      supersteps += static_cast<double>(counts.supersteps);
      letters += static_cast<double>(counts.letters) / faces;
      bytes += static_cast<double>(counts.bytes) / faces;
      for (std::size_t i = 0; const std::size_t threads : {2, 4, 8, 64})
        model[i++] += by_one / modelled(counts.log, threads, {});
    }
    counts.keeps_log = false;
    const Times times = take_turns(
        sources, settings.effort, [&](Index source) { alone(source); },
        [&](Index source) { by_pieces(settings.threads, source); });
    const double n = static_cast<double>(sources.size());
    table.add({{"mesh", name},
               {"faces", simplices},
               {"size", size},
               {"supersteps", supersteps / n},
               {"serial", serial / n},
               {"expansions", expansions / n},
               {"letters", letters / n},
               {"bytes", bytes / n},
               {"others", others},
               {"kept_by_one", static_cast<double>(alone.workspace().bytes()) / faces},
               {"kept_by_pieces", static_cast<double>(workspace.bytes()) / faces},
               {"cut_ns", 1e9 * (once - times.second) / faces},
               {"model2", model[0] / n},
               {"model4", model[1] / n},
               {"model8", model[2] / n},
               {"model64", model[3] / n},
               {"serial_ms", 1e3 * times.first},
               {"ms", 1e3 * times.second},
               {"speed", 1 / times.ratio}});
  }
}

template <class Real>
void measure_surface(const Surface& surface, const Settings& settings, Table& table) {
  const plexway::TriangleMesh<Real> mesh(surface.positions, surface.faces);
  measure(surface.name, mesh, mesh.face_count(), rotating_sources(surface, settings.effort.sources),
          by_accuracy(settings.accuracy), settings, table);
}

/// A grid, or a lattice, of n points a side, each pushed by up to 0.3.
void measure_wires(Index n, bool cubed, const Settings& settings, Table& table) {
  const Wires made = lattice(cubed ? "lattice" : "grid", n, n, cubed ? n : 1, 0.3);
  const plexway::Wireframe<float> wires(made.positions, made.edges);
  measure(made.name, wires, made.positions.size(),
          spread_numbers(settings.effort.sources, made.positions.size()), {}, settings, table);
}

void run(Arguments& arguments) {
  Settings settings;
  Meshes meshes;
  std::vector<Index> grids, lattices;
  arguments.option("MESH", &meshes.files, "Surfaces");
  arguments.option("--generated", &meshes.sizes, "Bumpy spheres of about so many vertices");
  arguments.option("--grid", &grids, "Wireframes: grids of so many points squared");
  arguments.option("--lattice", &lattices, "Wireframes: lattices of so many points cubed");
  arguments.option("--sizes", &settings.sizes, "Triangles (vertices of wireframes) a piece");
  arguments.option("--threads", &settings.threads, "Threads of the runs that are timed");
  arguments.option("--accuracy", &settings.accuracy, "What is asked for; exact is in double",
                   {"fast", "accurate", "exact"});
  arguments.option("--repeats", &settings.repeats, "Solves whose bits are compared");
  arguments.positive("--sources", &settings.effort.sources, "Sources a mesh");
  arguments.positive("--budget", &settings.effort.budget, "Seconds a row");
  Table& table = arguments.table(
      "mesh; faces: triangles; size: a piece; supersteps %.0f;"
      "serial: expansions a triangle, Serial %.3f; expansions: pieces %.3f;"
      "letters: letters a triangle %.3f; bytes: their bytes %.1f; others: other bits;"
      "kept_by_one: bytes kept a triangle, Serial %.0f; kept_by_pieces: pieces %.0f;"
      "cut_ns: cutting, ns a triangle %.0f; model2: model, 2 threads %.2f; model4: 4 %.2f;"
      "model8: 8 %.2f; model64: 64 %.2f; serial_ms: Serial, ms %.1f; ms: pieces, ms %.1f;"
      "speed %.2f");
  meshes.each([&](const Surface& surface, const auto&) {
    settings.accuracy == "exact" ? measure_surface<double>(surface, settings, table)
                                 : measure_surface<float>(surface, settings, table);
  });
  for (const Index n : grids) measure_wires(n, false, settings, table);
  for (const Index n : lattices) measure_wires(n, true, settings, table);
}
const Command command("pieces", "one source by pieces beside Serial: counts, bits, times", run);

}  // namespace bench::pieces
