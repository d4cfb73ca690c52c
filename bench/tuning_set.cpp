// Writes the surfaces that `plexway tune` trains on and those it is judged by, as .obj:
//
//   bench_tuning_set training|validation DIR
//
// The exact answers beside them are bench_cgal_truth's work; bench/tune.sh does all.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "../data/tuning_shapes.hpp"

namespace {

void write(const std::filesystem::path& file, const samples::Shape& shape) {
  std::string out;
  char line[128];
  for (const auto& [x, y, z] : shape.points) {
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", x, y, z);
    out += line;
  }
  for (const auto& [a, b, c] : shape.faces) {
    std::snprintf(line, sizeof line, "f %u %u %u\n", a + 1, b + 1, c + 1);
    out += line;
  }
  std::ofstream stream(file, std::ios::binary);
  stream << out;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
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
      const samples::Shape made = shape.make();
      write(folder / (std::string(shape.name) + ".obj"), made);
      std::printf("%s: %zu vertices, %zu triangles: %s\n", std::string(shape.name).c_str(),
                  made.points.size(), made.faces.size(), std::string(shape.about).c_str());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_tuning_set: %s\n", error.what());
    return 1;
  }
}
