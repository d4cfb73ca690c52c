// The executor that runs compute shaders beside one serial thread: a field from one source, a field
// from many, and many fields of one source each in few launches.

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "compare.hpp"

#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

namespace {

using bench::Index;
using bench::Surface;
using plexway::PointSource;

struct Work {
  std::size_t sources = 1;
  bool batch = false;  // one field a source

  [[nodiscard]] std::string name() const {
    if (batch) return std::to_string(sources) + " fields";
    return sources == 1 ? "1 source" : std::to_string(sources) + " sources";
  }
};

struct Difference {
  double sum = 0, max = 0;
  std::size_t count = 0;

  void add(std::span<const float> serial, std::span<const float> found) {
    for (std::size_t v = 0; v < serial.size(); ++v) {
      if (!(serial[v] > 0) || std::isinf(serial[v])) continue;
      const double error = std::abs(static_cast<double>(found[v]) / serial[v] - 1);
      sum += error;
      max = std::max(max, error);
      ++count;
    }
  }
};

nlohmann::ordered_json measure(const Surface& surface, const Work& work, plexway::GL executor,
                               const bench::Effort& effort) {
  using namespace plexway;
  const TriangleMesh<float> mesh(surface.positions, surface.faces);
  std::vector<PointSource> sources;
  for (const Index v : bench::rotating_sources(surface, work.sources))
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
            bench::one_label(), workspace, field);
  };
  const auto device = [&] {
    if (work.batch)
      solve_each(executor, mesh, sources, bench::one_label(), there, all);
    else
      solve(executor, mesh, sources, bench::one_label(), there, one);
  };
  serial();
  const double first = bench::seconds(device);  // the surface goes to the device, shaders compile
  std::vector<double> serial_times, device_times;
  double spent = 0;
  for (std::size_t n = 0; n < effort.repeats && (n == 0 || spent < effort.budget); ++n) {
    serial_times.push_back(bench::seconds(serial) * share);
    device_times.push_back(bench::seconds(device));
    spent += serial_times.back() / share + device_times.back();
  }
  Difference difference;
  if (work.batch) {
    const std::span<const float> row(all.data() + (few - 1) * mesh.vertex_count(),
                                     mesh.vertex_count());
    difference.add(field.distance, row);
  } else {
    difference.add(field.distance, one.distance);
  }
  const double serial_time = bench::median(serial_times), device_time = bench::median(device_times);
  nlohmann::ordered_json row;
  row["serial_ms"] = 1e3 * serial_time;
  row["gl_ms"] = 1e3 * device_time;
  row["speedup"] = serial_time / device_time;
  row["first_ms"] = 1e3 * first;
  row["rounds"] = there.rounds();
  if (!work.batch)
    row["expansions_per_face"] =
        static_cast<double>(one.statistics.expansions) / static_cast<double>(mesh.face_count());
  row["device_bytes_per_face"] =
      static_cast<double>(there.bytes()) / static_cast<double>(mesh.face_count());
  row["mean_difference"] =
      difference.sum / static_cast<double>(std::max<std::size_t>(difference.count, 1));
  row["max_difference"] = difference.max;
  row["device"] = gl_device(executor).renderer;
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  bench::Effort effort{16, 5, 30};
  std::vector<std::string> meshes;
  std::vector<std::size_t> sizes;
  std::size_t many = 1000, batch = 256;
  double limit = 600;
  plexway::GL executor;
  bench::Report report;
  CLI::App app("The gl executor beside one serial thread, single precision: one table");
  app.add_option("MESH", meshes, "Surfaces");
  app.add_option("--sizes", sizes, "Bumpy spheres of about so many vertices")->delimiter(',');
  app.add_option("--many", many, "Sources of the field from many")->capture_default_str();
  app.add_option("--batch", batch, "Fields in one call, of surfaces with at most 200000 vertices")
      ->capture_default_str();
  app.add_option("--device", executor.device, "Number in `plexway info --devices`");
  app.add_option("--batch-bytes", executor.batch_bytes, "Bytes on the device for a launch's fields")
      ->capture_default_str();
  app.add_option("--repeats", effort.repeats, "Timed solves")->capture_default_str();
  app.add_option("--budget", effort.budget, "Seconds for them")->capture_default_str();
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  if (meshes.empty() && sizes.empty()) sizes = {50000, 1000000};

  bench::Table table({{"surface", "surface"},
                      {"vertices", "vertices"},
                      {"work", "work"},
                      {"serial_ms", "serial ms", "%.1f"},
                      {"gl_ms", "gl ms", "%.1f"},
                      {"speedup", "times as fast", "%.2f"},
                      {"first_ms", "first ms", "%.0f"},
                      {"rounds", "rounds"},
                      {"expansions_per_face", "expansions/F", "%.2f"},
                      {"device_bytes_per_face", "device bytes/F", "%.0f"},
                      {"mean_difference", "mean difference", "%.1e"},
                      {"max_difference", "max", "%.1e"},
                      {"device", "device"},
                      {"note", "note"}});
  std::vector<std::function<Surface()>> surfaces;
  for (const std::string& mesh : meshes)
    surfaces.push_back([&mesh] { return bench::read_surface(mesh); });
  for (const std::size_t size : sizes)
    surfaces.push_back([size] { return bench::bumpy_surface(size); });
  return report.write(table, [&] {
    for (const auto& make : surfaces) {
      const Surface surface = make();
      for (const Work& work : {Work{1, false}, Work{many, false}, Work{batch, true}}) {
        if (work.sources == 0 || (work.batch && surface.positions.size() > 200000)) continue;
        std::cerr << surface.name << ", " << work.name() << std::endl;
        nlohmann::ordered_json row = {{"surface", surface.name},
                                      {"vertices", surface.positions.size()},
                                      {"work", work.name()}};
        // A driver does not survive a fork: only the child may meet it.
        row.update(
            bench::isolated(limit, [&] { return measure(surface, work, executor, effort); }));
        table.add(std::move(row));
      }
    }
  });
}

#else

int main() {
  std::cerr << "this build has no executor gl: install libegl-dev and libgl-dev\n";
  return 4;
}

#endif
