// The exact answers beside the surfaces are the work of `bench_cgal truth`; bench/tune.sh does all.

#include <cstdio>
#include <cstdlib>

#include <plexway/io/triangles.hpp>

#include "data/tuning_shapes.hpp"
#include "measure.hpp"

namespace bench::tuning_set {

// Nine digits, as the surfaces had that the tables were learned from: their digest goes by bits.
double rounded(double x) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", x);
  return std::strtod(text.data(), nullptr);
}

void run(Arguments& arguments) {
  std::string set, folder;
  arguments.required("SET", &set, "training or validation");
  arguments.required("DIR", &folder, "Where the surfaces go, as .obj");
  arguments.parse();
  if (set != "training" && set != "validation") throw Exit(2, "neither training nor validation");
  std::filesystem::create_directories(folder);
  const std::span<const samples::TuningShape> shapes =
      set == "training" ? std::span<const samples::TuningShape>(samples::tuning::training)
                        : std::span<const samples::TuningShape>(samples::tuning::validation);
  for (const samples::TuningShape& shape : shapes) {
    samples::Shape made = shape.make();
    for (samples::Point& p : made.points)
      for (double& x : p) x = rounded(x);
    plexway::io::write_triangles(std::filesystem::path(folder) / (std::string(shape.name) + ".obj"),
                                 {made.points, made.faces});
    std::printf("%s: %zu vertices, %zu triangles: %s\n", std::string(shape.name).c_str(),
                made.points.size(), made.faces.size(), std::string(shape.about).c_str());
  }
}
const Command command("tuning_set", "writes the surfaces that `plexway tune` trains on", run);

}  // namespace bench::tuning_set
