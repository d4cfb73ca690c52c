// Writes the surfaces that `plexway tune` trains on and those it is judged by, as .obj:
//
//   bench_tuning_set training|validation DIR
//
// The exact answers beside them are bench_cgal_truth's work; bench/tune.sh does all.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include <plexway/io/triangles.hpp>

#include "../data/tuning_shapes.hpp"

namespace {

// Nine digits, as the surfaces had that the tables were learned from: their digest goes by bits.
double rounded(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", x);
  return std::strtod(text, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view set = argc == 3 ? argv[1] : "";
  if (set != "training" && set != "validation") {
    std::fputs("usage: bench_tuning_set training|validation DIR\n", stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[2];
    std::filesystem::create_directories(folder);
    const std::span<const samples::TuningShape> shapes =
        set == "training" ? std::span<const samples::TuningShape>(samples::tuning::training)
                          : std::span<const samples::TuningShape>(samples::tuning::validation);
    for (const samples::TuningShape& shape : shapes) {
      samples::Shape made = shape.make();
      for (samples::Point& p : made.points)
        for (double& x : p) x = rounded(x);
      plexway::io::write_triangles(folder / (std::string(shape.name) + ".obj"),
                                   {made.points, made.faces});
      std::printf("%s: %zu vertices, %zu triangles: %s\n", std::string(shape.name).c_str(),
                  made.points.size(), made.faces.size(), std::string(shape.about).c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_tuning_set: %s\n", error.what());
    return 1;
  }
}
