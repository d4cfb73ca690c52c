// The executor that runs compute shaders beside one serial thread: a field from one source, a field
// from many, and many fields of one source each in few launches.

#ifdef PLEXWAY_HAS_GL

#include <cmath>

#include <plexway/executors/gl.hpp>

#include "solver.hpp"

namespace bench::gl {

using namespace plexway;

struct Work {
  std::size_t sources = 1;
  bool batch = false;  // one field a source

  [[nodiscard]] std::string name() const {
    if (batch) return std::to_string(sources) + " fields";
    return sources == 1 ? "1 source" : std::to_string(sources) + " sources";
  }
};

Row measure(const Surface& surface, const Work& work, GL executor, const Effort& effort) {
  const TriangleMesh<float> mesh(surface.positions, surface.faces);
  std::vector<PointSource> sources;
  for (const Index v : rotating_sources(surface, work.sources))
    sources.push_back(PointSource::at(v));
  Workspace<float> workspace;
  DistanceField<float> field, one;
  GLWorkspace there;
  std::vector<float> all(work.batch ? sources.size() * mesh.vertex_count() : 0);
  // In a batch the serial thread solves a few, and is taken to need as long for each of the others.
  const std::size_t few = work.batch ? std::min<std::size_t>(sources.size(), 16) : 1;
  const double share =
      static_cast<double>(work.batch ? sources.size() : 1) / static_cast<double>(few);
  const auto serial = [&] {
    for (std::size_t k = 0; k < few; ++k)
      solve(Serial{}, mesh,
            work.batch ? std::span<const PointSource>(&sources[k], 1)
                       : std::span<const PointSource>(sources),
            one_label(), workspace, field);
  };
  const auto device = [&] {
    if (work.batch)
      solve_each(executor, mesh, sources, one_label(), there, all);
    else
      solve(executor, mesh, sources, one_label(), there, one);
  };
  serial();
  const double first = seconds(device);  // the surface goes to the device, shaders compile
  std::vector<double> serial_times, device_times;
  double spent = 0;
  for (std::size_t n = 0; n < effort.repeats && (n == 0 || spent < effort.budget); ++n) {
    serial_times.push_back(seconds(serial) * share);
    device_times.push_back(seconds(device));
    spent += serial_times.back() / share + device_times.back();
  }
  Apart difference;
  if (work.batch) {
    const std::span<const float> row(all.data() + (few - 1) * mesh.vertex_count(),
                                     mesh.vertex_count());
    difference.add(field.distance, row);
  } else {
    difference.add(field.distance, one.distance);
  }
  const double serial_time = median(serial_times), device_time = median(device_times);
  Row row = {{"serial_ms", 1e3 * serial_time},
             {"gl_ms", 1e3 * device_time},
             {"speedup", serial_time / device_time},
             {"first_ms", 1e3 * first},
             {"rounds", there.rounds()}};
  if (!work.batch)
    row["expansions_per_face"] =
        static_cast<double>(one.statistics.expansions) / static_cast<double>(mesh.face_count());
  row["device_bytes_per_face"] =
      static_cast<double>(there.bytes()) / static_cast<double>(mesh.face_count());
  row["mean_difference"] = difference.mean();
  row["max_difference"] = difference.most;
  row["device"] = gl_device(executor).renderer;
  return row;
}

void run(Arguments& arguments) {
  Effort effort{16, 5, 30};
  Meshes meshes;
  std::size_t many = 1000, batch = 256;
  GL executor;
  meshes.add_options(arguments, "--sizes");
  arguments.option("--many", &many, "Sources of the field from many");
  arguments.option("--batch", &batch,
                   "Fields in one call, of surfaces with at most 200000 vertices");
  arguments.option("--device", &executor.device, "Number in `plexway info --devices`");
  arguments.option("--batch-bytes", &executor.batch_bytes,
                   "Bytes on the device for a launch's fields");
  arguments.option("--repeats", &effort.repeats, "Timed solves");
  arguments.option("--budget", &effort.budget, "Seconds for them");
  arguments.add_limit();
  Table& table = arguments.table(
      "surface; vertices; work; serial_ms: serial ms %.1f; gl_ms: gl ms %.1f;"
      "speedup: times as fast %.2f; first_ms: first ms %.0f; rounds;"
      "expansions_per_face: expansions/F %.2f; device_bytes_per_face: device bytes/F %.0f;"
      "mean_difference: mean difference %.1e; max_difference: max %.1e; device; note");
  if (meshes.files.empty() && meshes.sizes.empty()) meshes.sizes = {50000, 1000000};
  meshes.each([&](const Surface& surface, const auto&) {
    for (const Work& work : {Work{1, false}, Work{many, false}, Work{batch, true}}) {
      if (work.sources == 0 || (work.batch && surface.positions.size() > 200000)) continue;
      // A driver does not survive a fork: only the child may meet it.
      table.measure({{"surface", surface.name},
                     {"vertices", surface.positions.size()},
                     {"work", work.name()}},
                    arguments.limit, [&] { return measure(surface, work, executor, effort); });
    }
  });
}
const Command command("gl", "compute shaders beside one serial thread", run);

}  // namespace bench::gl

#endif
