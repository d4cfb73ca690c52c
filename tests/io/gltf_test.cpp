// .glb and .gltf against the rules of the specification, as gltf_peer.py reads them, and VTK where
// it is installed.

#include <cstdlib>
#include <limits>

#include <plexway/io/field.hpp>

#include "io_testing.hpp"

namespace gltf_test {

using namespace io_testing;
using namespace plexway::io;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

bool peer(const std::string& arguments, const Folder& folder) {
  static const std::string python = io_testing::python_with("numpy");
  return python.empty() || io_testing::run_peer(python, "gltf_peer.py", arguments, folder);
}

std::string quoted(const std::filesystem::path& file) {
  return std::string("'").append(file.string()).append("'");
}

const Triangles surface = {{{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {0, 0, -2}}, {{0, 1, 2}, {0, 2, 3}}};
const std::vector<double> distance = {0, 1, 1.5, inf};

}  // namespace

TEST_CASE("glTF of a surface: positions, colours, distances, labels") {
  const Folder folder;
  const std::vector<std::int32_t> label = {0, 0, 3, -1};
  for (const char* name : {"a.glb", "a.gltf"}) {
    INFO(name);
    write_field(folder.path() / name, surface, distance, label);
    CHECK(peer("check " + quoted(folder.path() / name) +
                   " --mode 4 --vertices 4 --cells 2 --distance 0,1,1.5,-1 --label 0,0,3,-1"
                   " --low 0,0,-2 --high 1,1.5,0",
               folder));
  }
}

TEST_CASE("glTF of a solid is its boundary, of wires lines, of a cloud points") {
  const Folder folder;
  // The octahedron about a vertex in the middle: eight tetrahedra.
  Tets solid{{{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}};
  for (const std::uint32_t x : {1u, 2u})
    for (const std::uint32_t y : {3u, 4u})
      for (const std::uint32_t z : {5u, 6u}) solid.tets.push_back({0, x, y, z});
  write_field(folder.path() / "solid.glb", solid, std::vector<double>{0, 1, 2, 3, 4, 5, 6});
  CHECK(peer("check " + quoted(folder.path() / "solid.glb") +
                 " --mode 4 --vertices 6 --cells 8 --distance 1,2,3,4,5,6",
             folder));
  const Edges wires{{{0, 0, 0}, {1, 2, 3}, {4, 5, 6}}, {{0, 1}, {1, 2}}, {}, 3};
  write_field(folder.path() / "wires.glb", wires, std::vector<double>{0, 1, 2});
  CHECK(peer("check " + quoted(folder.path() / "wires.glb") + " --mode 1 --vertices 3 --cells 2",
             folder));
  const Points cloud{{{0, 0, 0}, {1, 2, 3}}, {}};
  write_field(folder.path() / "cloud.glb", cloud, std::vector<double>{0, 1});
  CHECK(peer("check " + quoted(folder.path() / "cloud.glb") + " --mode 0 --vertices 2 --cells 2",
             folder));
}

TEST_CASE("glTF far from the origin keeps the shape by a translation") {
  Triangles far = surface;
  for (auto& p : far.positions) p[0] += 1e7;
  const Folder folder;
  write_field(folder.path() / "far.glb", far, distance);
  CHECK(peer("check " + quoted(folder.path() / "far.glb") +
                 " --mode 4 --vertices 4 --cells 2 --low 1e7,0,-2 --high 10000001,1.5,0",
             folder));
}

TEST_CASE("surfaces and wireframes are written in every format and read back the same") {
  const Folder folder;
  for (const std::string_view extension : triangle_output_extensions()) {
    const auto file = folder.path() / std::string("s").append(extension);
    write_triangles(file, surface);
    INFO(file);
    if (extension == ".glb" || extension == ".gltf") {
      CHECK(peer("check " + quoted(file) + " --mode 4 --vertices 4 --cells 2 --plain", folder));
      continue;
    }
    if (extension == ".vtu" || extension == ".vtk")
      continue;  // meshio_test.cpp has those of fields
    const Triangles back = read_triangles(file);
    CHECK(back.positions == surface.positions);  // small numbers fit single precision, too
    CHECK(back.triangles == surface.triangles);
  }
  const Edges wires{{{0, 0, 0}, {1, 2, 3}, {4, 5, 6}}, {{0, 1}, {1, 2}}, {}, 3};
  write_edges(folder.path() / "w.obj", wires);
  CHECK(read_edges(folder.path() / "w.obj").positions == wires.positions);
  CHECK(read_edges(folder.path() / "w.obj").edges == wires.edges);
  write_edges(folder.path() / "w.edges", wires);
  CHECK(read_edges(folder.path() / "w.edges").lengths[0] == Approx(std::sqrt(14.0)));
  CHECK_THROWS_AS(write_triangles(folder.path() / "s.xyz", surface), plexway::UsageError);
  CHECK_THROWS_AS(write_triangles(folder.path() / "s.obj", {{{0, 0, 0}}, {{0, 1, 2}}}),
                  plexway::UsageError);
  CHECK_THROWS_AS(write_edges(folder.path() / "w.obj", {{}, {{0, 1}}, {1}, 2}),
                  plexway::UsageError);
}

TEST_CASE("NumPy and VTK read what we write") {
  const Folder folder;
  write_field(folder.path() / "d.npy", surface, distance);
  const std::vector<std::int32_t> label = {0, 0, 3, -1};
  write_field(folder.path() / "d.vtu", surface, distance, label);
  write_field(folder.path() / "d.ply", surface, distance, label);
  write_field(folder.path() / "d.glb", surface, distance, label);
  CHECK(peer("numpy " + quoted(folder.path() / "d.npy") + " 0,1,1.5,inf", folder));
  CHECK(peer("vtk " + quoted(folder.path()) + " 0,1,1.5,inf 0,0,3,-1", folder));
}

}  // namespace gltf_test
