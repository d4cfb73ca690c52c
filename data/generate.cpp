// Writes the samples: `generate DIR [NAME...]` or `generate --list`.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scan_shapes.hpp"
#include "shapes.hpp"
#include "solid_shapes.hpp"

namespace {

using namespace samples;

template <class Number>
void put(std::string& out, Number value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

template <class... Values>
void print(std::string& out, const char* format, Values... values) {
  char line[128];
  const int length = std::snprintf(line, sizeof line, format, values...);
  out.append(line, static_cast<std::size_t>(length));
}

std::string as_obj(const Shape& shape) {
  std::string out;
  for (const auto& [x, y, z] : shape.points) print(out, "v %.7g %.7g %.7g\n", x, y, z);
  for (const auto& [a, b, c] : shape.faces) print(out, "f %u %u %u\n", a + 1, b + 1, c + 1);
  for (const auto& [a, b] : shape.lines) print(out, "l %u %u\n", a + 1, b + 1);
  return out;
}

std::string as_mesh(const Shape& shape) {
  std::string out = "MeshVersionFormatted 2\nDimension 3\nVertices\n";
  print(out, "%zu\n", shape.points.size());
  for (const auto& [x, y, z] : shape.points) print(out, "%.7g %.7g %.7g 0\n", x, y, z);
  print(out, "Tetrahedra\n%zu\n", shape.tets.size());
  for (const auto& [a, b, c, d] : shape.tets)
    print(out, "%u %u %u %u 0\n", a + 1, b + 1, c + 1, d + 1);
  return out + "End\n";
}

std::string as_off(const Shape& shape) {
  std::string out = "OFF\n";
  print(out, "%zu %zu 0\n", shape.points.size(), shape.faces.size());
  for (const auto& [x, y, z] : shape.points) print(out, "%.7g %.7g %.7g\n", x, y, z);
  for (const auto& [a, b, c] : shape.faces) print(out, "3 %u %u %u\n", a, b, c);
  return out;
}

std::string as_ply(const Shape& shape) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  print(out, "element vertex %zu\n", shape.points.size());
  out += "property float x\nproperty float y\nproperty float z\n";
  print(out, "element face %zu\n", shape.faces.size());
  out += "property list uchar int vertex_indices\nend_header\n";
  for (const Point& p : shape.points)
    for (const double c : p) put(out, static_cast<float>(c));
  for (const auto& face : shape.faces) {
    put(out, std::uint8_t{3});
    for (const Index v : face) put(out, v);
  }
  return out;
}

std::string as_xyz(const Shape& shape) {
  std::string out;
  for (const auto& [x, y, z] : shape.points) print(out, "%.7g %.7g %.7g\n", x, y, z);
  return out;
}

/// Organised in rows of 64, as ball_scan makes it.
std::string as_pcd(const Shape& shape) {
  std::string out =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
      "TYPE F F F\nCOUNT 1 1 1\n";
  print(out, "WIDTH 64\nHEIGHT %zu\nVIEWPOINT 0 0 3 1 0 0 0\n", shape.points.size() / 64);
  print(out, "POINTS %zu\nDATA binary\n", shape.points.size());
  for (const Point& p : shape.points)
    for (const double c : p) put(out, static_cast<float>(c));
  return out;
}

std::string as_stl(const Shape& shape) {
  std::string out = "a sample of plexway";
  out.resize(80, ' ');
  put(out, static_cast<std::uint32_t>(shape.faces.size()));
  for (const auto& [a, b, c] : shape.faces) {
    const Point p = shape.points[a];
    const Point normal = unit(cross(shape.points[b] - p, shape.points[c] - p));
    for (const Point& row : {normal, p, shape.points[b], shape.points[c]})
      for (const double x : row) put(out, static_cast<float>(x));
    put(out, std::uint16_t{0});
  }
  return out;
}

struct Sample {
  std::string_view file;
  std::string_view about;
  Shape (*make)();
  bool kept;  ///< lies in the source tree; the others are made when a benchmark needs them
};

constexpr std::array all_samples = {
    Sample{"knot.ply", "trefoil knot tube, closed, 5120 vertices, binary PLY", knot, true},
    Sample{"torus.obj", "torus, closed, 1152 vertices", torus, true},
    Sample{"hills.off", "open height field on irregular points", hills, true},
    Sample{"ell.obj", "flat L, not convex", ell, true},
    Sample{"slit.off", "flat square with a slit", slit, true},
    Sample{"moebius.obj", "Moebius strip: not orientable, one boundary", moebius, true},
    Sample{"two_parts.obj", "two spheres and a lone vertex: parts out of reach", two_parts, true},
    Sample{"box.stl", "box as a binary STL soup", box, true},
    Sample{"elbow.off", "closed surface of a thick L, 12 vertices", elbow, true},
    Sample{"elbow.mesh", "the solid inside it, 1152 tetrahedra", elbow_solid, true},
    Sample{"vessels.obj", "tree of vessels: a wireframe of 763 vertices", vessels, true},
    Sample{"roll.xyz", "points of a rolled-up sheet of paper: a cloud of 2400", roll, true},
    Sample{"scan.pcd", "a ball seen by a depth camera: an organised cloud, binary PCD", ball_scan,
           true},
    Sample{"sphere.obj", "unit sphere, 10242 vertices", [] { return geodesic_sphere(32); }, false},
    Sample{"bumpy-50k.ply", "bumpy closed surface, 50412 vertices", [] { return bumpy(71); },
           false},
    Sample{"bumpy-400k.ply", "the same surface, 400002 vertices", [] { return bumpy(200); }, false},
    Sample{"bumpy-1m.ply", "the same surface, 998562 vertices", [] { return bumpy(316); }, false},
};

void write(const std::filesystem::path& directory, const Sample& sample) {
  const Shape shape = sample.make();
  const std::filesystem::path file = directory / sample.file;
  const std::string extension = file.extension().string();
  const std::string bytes = extension == ".obj"    ? as_obj(shape)
                            : extension == ".off"  ? as_off(shape)
                            : extension == ".ply"  ? as_ply(shape)
                            : extension == ".mesh" ? as_mesh(shape)
                            : extension == ".xyz"  ? as_xyz(shape)
                            : extension == ".pcd"  ? as_pcd(shape)
                                                   : as_stl(shape);
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.string());
  std::printf("%s: %zu vertices, %zu simplices\n", file.string().c_str(), shape.points.size(),
              shape.faces.size() + shape.tets.size() + shape.lines.size());
}

/// A sample's name is its file's, with or without extension (which may name several); "million" is
/// all bumpy ones.
bool named(const Sample& sample, std::string_view name) {
  return name == sample.file || name == sample.file.substr(0, sample.file.find('.')) ||
         (name == "million" && sample.file.starts_with("bumpy"));
}

int usage() {
  std::fputs(
      "usage: generate DIR [NAME...]   write the samples named, or those kept in the tree\n"
      "       generate --list          show the names; 'million' stands for all bumpy ones\n",
      stderr);
  return 2;
}

}  // namespace

int main(int argc, char** argv) try {
  const std::vector<std::string_view> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments[0] == "--help") return usage();
  if (arguments[0] == "--list") {
    for (const Sample& sample : all_samples)
      std::printf("%-16s %s%s\n", std::string(sample.file).c_str(),
                  std::string(sample.about).c_str(), sample.kept ? "" : " (not kept in the tree)");
    return 0;
  }
  if (arguments[0].starts_with('-')) return usage();
  const std::vector<std::string_view> names(arguments.begin() + 1, arguments.end());
  for (const auto name : names)
    if (std::none_of(all_samples.begin(), all_samples.end(),
                     [&](const Sample& sample) { return named(sample, name); })) {
      std::fprintf(stderr, "generate: no sample '%s'; see generate --list\n",
                   std::string(name).c_str());
      return 2;
    }
  std::filesystem::create_directories(arguments[0]);
  for (const Sample& sample : all_samples) {
    const bool wanted =
        names.empty() ? sample.kept
                      : std::any_of(names.begin(), names.end(),
                                    [&](std::string_view name) { return named(sample, name); });
    if (wanted) write(arguments[0], sample);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "generate: %s\n", error.what());
  return 1;
}
