// Executors beside one serial thread, in turns: one field from one source and from many, and many
// fields at once, by several threads and on a graphics processor. Also how far their distances are
// from Serial's and from exact answers, and whether every solve has the same bits.

#include <algorithm>
#include <thread>

#include "solver.hpp"
#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

namespace bench::executors {

using plexway::OpenMP, plexway::PointSource, plexway::Serial;
using Mesh = plexway::TriangleMesh<float>;

struct Work {
  std::size_t sources = 1;
  bool batch = false;  ///< one field a source

  [[nodiscard]] std::string name() const {
    return std::to_string(sources) + (batch ? " fields" : sources > 1 ? " sources" : " source");
  }
};

/// One executor at one piece of work.
template <class Executor>
class Runner {
 public:
  Runner(const Mesh& mesh, const Executor& executor, const plexway::PropagateOptions& options,
         std::vector<PointSource> sources, bool batch)
      : mesh_(mesh), executor_(executor), options_(options), sources_(std::move(sources)) {
    if (batch) rows_.resize(sources_.size() * mesh.vertex_count());
  }
  void operator()() {
    if (rows_.empty())
      plexway::solve(executor_, mesh_, sources_, options_, workspace_, field_);
    else
      solve_each(executor_, mesh_, sources_, options_, workspace_, std::span<float>(rows_));
  }
  [[nodiscard]] const std::vector<float>& found() const {
    return rows_.empty() ? field_.distance : rows_;
  }
  [[nodiscard]] std::size_t expansions() const { return field_.statistics.expansions; }
  [[nodiscard]] const auto& workspace() const { return workspace_; }

 private:
  const Mesh& mesh_;
  Executor executor_;
  plexway::PropagateOptions options_;
  std::vector<PointSource> sources_;
  plexway::WorkspaceOf<Executor, Mesh> workspace_;
  plexway::DistanceField<float> field_;
  std::vector<float> rows_;
};

template <class Executor>
Row measure(const Surface& surface, const std::vector<Truth>& truths, const Work& work,
            const Executor& executor, const plexway::PropagateOptions& options,
            const Effort& effort) {
  const Mesh mesh(surface.positions, surface.faces);
  std::vector<PointSource> sources;
  for (const Index v : rotating_sources(surface, work.sources))
    sources.push_back(PointSource::at(v));
  Runner runner(mesh, executor, options, sources, work.batch);
  Runner serial(mesh, Serial{}, options, sources, work.batch);
  const double first =
      seconds([&] { runner(); });  // what is for a device goes there, shaders compile
  serial();
  const std::vector<float> bits = runner.found();
  std::vector<double> serial_times, times;
  double spent = 0;
  std::size_t others = 0;
  for (std::size_t n = 0; n < effort.repeats && (n == 0 || spent < effort.budget); ++n) {
    serial_times.push_back(seconds([&] { serial(); }));
    times.push_back(seconds([&] { runner(); }));
    others += runner.found() != bits;
    spent += serial_times.back() + times.back();
  }
  Apart apart;
  apart.add(serial.found(), runner.found());
  Row row = {{"serial_ms", 1e3 * median(serial_times)},
             {"ms", 1e3 * median(times)},
             {"speed", median(serial_times) / median(times)},
             {"first_ms", 1e3 * first},
             {"others", others},
             {"apart", apart.mean()},
             {"most", apart.most}};
  if (!work.batch)
    row["expansions"] =
        static_cast<double>(runner.expansions()) / static_cast<double>(mesh.face_count());
#ifdef PLEXWAY_HAS_GL
  if constexpr (std::is_same_v<Executor, plexway::GL>) {
    row["rounds"] = runner.workspace().rounds();
    row["device"] = gl_device(executor).renderer;
  }
#endif
  Errors errors;
  if (work.sources == 1)
    for (const Truth& truth : truths) {
      Runner one(mesh, executor, options, {PointSource::at(truth.source)}, false);
      one();
      errors.add(truth, one.found());
    }
  add_errors(row, errors);
  return row;
}

void run(Arguments& arguments) {
  Effort effort{0, 5, 30};
  Meshes meshes;
  std::size_t many = 1000, batch = 64, batch_vertices = 200000;
  std::vector<int> threads = {1,
                              static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u))};
  std::string accuracy = "fast";
  bool gl = false;
  int device = 0;
  meshes.add_options(arguments, "--sizes");
  arguments.option("--many", &many, "Sources of the field from many; 0: without");
  arguments.option("--batch", &batch, "Fields in one call; 0: without");
  arguments.option("--batch-vertices", &batch_vertices, "Fields at once only up to so many");
  arguments.option("--threads", &threads, "Of OpenMP; `none` leaves it out");
  arguments.option("--accuracy", &accuracy, "What is asked for", {"fast", "accurate", "exact"});
  arguments.option("--gl", &gl, "Also compute shaders, by labels");
  arguments.option("--device", &device, "Number in `plexway info --devices`");
  arguments.option("--repeats", &effort.repeats, "Timed solves");
  arguments.option("--budget", &effort.budget, "Seconds for them");
  arguments.add_limit();
  Table& table = arguments.table(
      "mesh; vertices; work; executor; serial_ms: serial ms %.1f; ms %.1f;"
      "speed: times as fast %.2f; first_ms: first ms %.0f; others: other bits;"
      "expansions: expansions/F %.2f; rounds; apart: from Serial, mean %.1e; most: max %.1e;"
      "mean: error mean %.1e; max %.1e; device; note");
  if (meshes.files.empty() && meshes.sizes.empty()) meshes.sizes = {50000, 1000000};
  const auto options = by_accuracy(accuracy);
  meshes.each([&](const Surface& surface, const std::vector<Truth>& truths) {
    for (const Work& work : {Work{1, false}, Work{many, false}, Work{batch, true}}) {
      if (work.sources == 0 || (work.batch && surface.positions.size() > batch_vertices)) continue;
      // A driver does not survive a fork: only the child may meet it.
      const auto add = [&](const std::string& name, const auto& executor) {
        table.measure({{"mesh", surface.name},
                       {"vertices", surface.positions.size()},
                       {"work", work.name()},
                       {"executor", name}},
                      arguments.limit,
                      [&] { return measure(surface, truths, work, executor, options, effort); });
      };
      for (const int n : threads) add("OpenMP, " + std::to_string(n), OpenMP{.threads = n});
#ifdef PLEXWAY_HAS_GL
      if (gl) add("GL", plexway::GL{.device = device});
#endif
    }
  });
}
const Command command("executors", "threads and graphics processors beside one serial thread", run);

}  // namespace bench::executors
