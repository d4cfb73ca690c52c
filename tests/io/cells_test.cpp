#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/paths.hpp>
#include <plexway/io/simplices.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "io_testing.hpp"

namespace plexway::cells_test {

// Files that may hold any kind: what is written reads back, what others write, and cells of several
// dimensions in one file, the same in every format.

using namespace io_testing;
using Catch::Contains;

namespace {

// Four triangles, one vertex apart from them, and numbers that single precision has.
io::Triangles pyramid() {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.75}, {7, 7, 7}},
          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

// Nothing where this build does not read the format.
std::optional<io::Mixed> read(const std::filesystem::path& file) {
  try {
    return io::read_cells(file);
  } catch (const NotBuiltError&) {
    return std::nullopt;
  }
}

io::Mixed parse_gltf(std::string_view bytes, std::string_view name) {
  return io::parse_gltf(bytes, name);
}
io::Mixed gltf_of(const std::string& json) { return parse_gltf(json, "mesh"); }

// A .gltf of one triangle 0 0 0, 1 0 0, 0 1 0 as two primitives' worth of numbers.
std::string gltf(const std::string& nodes, const std::string& primitive,
                 const std::string& more = "") {
  return R"({"asset":{"version":"2.0")" + more + R"(},"nodes":[)" + nodes +
         R"(],"meshes":[{"primitives":[)" + primitive +
         R"(]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,)"
         R"("byteLength":6}],"buffers":[{"byteLength":42,"uri":"data:;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"
         R"("}]})";
}

constexpr const char* indexed = R"({"attributes":{"POSITION":0},"indices":1})";

bool reads_gltf() {
  try {
    gltf_of(gltf(R"({"mesh":0})", indexed));
  } catch (const NotBuiltError&) {
    return false;
  }
  return true;
}

}  // namespace

TEST_CASE("surfaces that are written as .vtu .vtk .glb .gltf read back") {
  const Folder folder;
  const io::Triangles surface = pyramid();
  const std::vector<double> distance = {0, 1, 1.5, 1, 0.9, std::numeric_limits<double>::infinity()};
  for (const char* name : {"s.vtu", "s.vtk", "s.glb", "s.gltf"}) {
    for (const bool field : {false, true}) {
      if (field)
        io::write_field(folder.at(name), surface, distance);
      else
        io::write_triangles(folder.at(name), surface);
      const auto cells = read(folder.at(name));
      if (!cells) continue;
      INFO(name);
      CHECK(cells->triangles.size() == 4);
      CHECK(cells->tets.empty());
      const bool gltf = std::string_view(name).find(".gl") != std::string_view::npos;
      // glTF has no vertices that nothing names.
      if (!gltf) CHECK(cells->positions == surface.positions);
      for (std::size_t t = 0; t < 4; ++t)
        for (std::size_t k = 0; k < 3; ++k)
          CHECK(cells->positions.at(cells->triangles[t][k]) ==
                surface.positions[surface.triangles[t][k]]);
    }
  }
}

TEST_CASE("wires, points and paths that are written read back") {
  const Folder folder;
  io::Edges wires{{{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0.25}}, {{0, 1}, {1, 2}}, {}, 3};
  const std::vector<double> distance = {0, 1, 1.5};
  for (const char* name : {"w.vtu", "w.vtk", "w.glb"}) {
    INFO(name);
    io::write_field(folder.at(name), wires, distance);
    if (const auto cells = read(folder.at(name))) {
      CHECK(cells->edges == wires.edges);
      CHECK(cells->positions == wires.positions);
    }
    const io::Points cloud{wires.positions, {}, {}};
    io::write_field(folder.at(name), cloud, distance);
    if (const auto cells = read(folder.at(name))) {
      CHECK(cells->edges.empty());
      CHECK(cells->triangles.empty());
      CHECK(cells->positions == wires.positions);
    }
  }
  Path path;
  path.positions = wires.positions;
  path.points.resize(3);
  path.length = 2, path.source = 0;
  io::write_paths(folder.at("p.vtp"), {&path, 1});
  if (const auto cells = read(folder.at("p.vtp"))) {
    CHECK(cells->edges == wires.edges);
    CHECK(cells->positions == wires.positions);
  }
}

TEST_CASE("polygons of .vtp and legacy POLYDATA become triangles") {
  const std::string five = "0 0 0  1 0 0  1 1 0  0 1 0  0.5 0.5 1";
  const auto check = [](const io::Mixed& cells) {
    CHECK(cells.positions.size() == 5);
    CHECK(cells.triangles ==
          Faces{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 1, 4}, {1, 0, 4}});
    CHECK(cells.edges == std::vector<std::array<std::uint32_t, 2>>{{3, 4}, {4, 0}});
  };
  check(io::parse_vtk("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n" +
                          five +
                          "\nLINES 1 4\n3 3 4 0\nPOLYGONS 3 13\n4 0 1 2 3\n3 0 1 4\n3 1 2 4\n"
                          "TRIANGLE_STRIPS 1 5\n4 2 1 4 0\nPOINT_DATA 5\nSCALARS a float\n",
                      "f"));
  check(io::parse_vtk(
      "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n" + five +
          "\nLINES 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n3 4 0\n"
          "POLYGONS 4 10\nOFFSETS vtktypeint64\n0 4 7 10\nCONNECTIVITY vtktypeint64\n"
          "0 1 2 3 0 1 4 1 2 4\nTRIANGLE_STRIPS 2 4\nOFFSETS vtktypeint64\n0 4\n"
          "CONNECTIVITY vtktypeint64\n2 1 4 0\n",
      "f"));
  const auto list = [](const std::string& name, const std::string& corners,
                       const std::string& ends) {
    return "<" + name + "><DataArray type=\"Int64\" Name=\"connectivity\">" + corners +
           "</DataArray><DataArray type=\"Int64\" Name=\"offsets\">" + ends + "</DataArray></" +
           name + ">";
  };
  const std::string vtp =
      "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"5\" NumberOfVerts=\"0\" "
      "NumberOfLines=\"1\" NumberOfPolys=\"3\" NumberOfStrips=\"1\"><Points><DataArray "
      "type=\"Float64\" NumberOfComponents=\"3\">" +
      five + "</DataArray></Points>" + list("Lines", "3 4 0", "3") +
      list("Strips", "2 1 4 0", "4") + list("Polys", "0 1 2 3 0 1 4 1 2 4", "4 7 10") +
      "</Piece></PolyData></VTKFile>";
  try {
    check(io::parse_vtu(vtp, "f"));
  } catch (const NotBuiltError&) {
  }
  CHECK(complaint(io_testing::tets<io::parse_vtk>,
                  "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n") ==
        "mesh:5: the file has no POINTS");
  CHECK(complaint(io::parse_vtk,
                  "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n"
                  "POLYGONS 1 4\n3 0 0 1\n") ==
        "mesh:8: a cell names point 1, but there are 1 points");
}

TEST_CASE("tetrahedra win over what is beside them, and what no domain is made of is refused") {
  const std::string points =
      "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 5 float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n";
  const std::string both = points + "CELLS 3 12\n4 0 1 2 3\n3 0 1 2\n2 3 4\nCELL_TYPES 3\n10 5 3\n";
  const io::Tets solid = io_testing::tets<io::parse_vtk>(both, "f");
  CHECK(solid.tets.size() == 1);
  CHECK(solid.report.passed_over_text() == "1 triangles, 1 lines");
  CHECK(io::parse_vtk(both, "f").triangles.size() == 1);
  CHECK(complaint(io::parse_vtk,
                  points + "CELLS 2 11\n4 0 1 2 3\n5 0 1 2 3 4\nCELL_TYPES 2\n10 41\n") ==
        "mesh: has 1 sets of points, which are not read: a domain without them would have holes");
}

TEST_CASE("glTF is where its nodes put it") {
  if (!reads_gltf()) return;
  const io::Mixed plain = gltf_of(gltf(R"({"mesh":0})", indexed));
  CHECK(plain.triangles == Faces{{0, 1, 2}});
  CHECK(plain.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  // Twice: as it is, and below a node that turns it by 90 degrees about z, scales and moves it.
  const io::Mixed twice = gltf_of(
      gltf(R"({"mesh":0},{"children":[2],"rotation":[0,0,0.7071067811865476,0.7071067811865476],)"
           R"("translation":[10,0,0]},{"mesh":0,"scale":[2,3,4]})",
           indexed, R"(},"scenes":[{"nodes":[0,1]}],"x":{)"));
  REQUIRE(twice.positions.size() == 6);
  CHECK(twice.triangles == Faces{{0, 1, 2}, {3, 4, 5}});
  const Positions moved = {{10, 0, 0}, {10, 2, 0}, {7, 0, 0}};
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(twice.positions[3 + v][k] == Approx(moved[v][k]).margin(1e-12));
}

TEST_CASE("glTF in a mirror looks outwards") {
  if (!reads_gltf()) return;
  CHECK(gltf_of(gltf(R"({"mesh":0,"scale":[1,1,-1]})", indexed)).triangles == Faces{{0, 2, 1}});
  CHECK(gltf_of(gltf(R"({"mesh":0,"scale":[1,-1,-1]})", indexed)).triangles == Faces{{0, 1, 2}});
}

TEST_CASE("glTF's seams are closed, but not those in files of plexway") {
  if (!reads_gltf()) return;
  // The same numbers behind two accessors, as exporters write a seam.
  const std::string two =
      R"({"attributes":{"POSITION":0}},{"attributes":{"POSITION":2},"indices":1})";
  std::string seam = gltf(R"({"mesh":0})", two);
  const std::string last = R"("count":3,"type":"SCALAR"}])";
  seam.replace(seam.find(last), last.size(),
               R"("count":3,"type":"SCALAR"},{"bufferView":0,"componentType":5126,"count":3,)"
               R"("type":"VEC3"}])");
  CHECK(gltf_of(seam).positions.size() == 3);
  CHECK(gltf_of(seam).triangles.size() == 2);
  std::string own = seam;
  own.replace(own.find(R"("version":"2.0")"), 15, R"("version":"2.0","generator":"plexway")");
  CHECK(gltf_of(own).positions.size() == 6);
}

TEST_CASE("glTF that is packed, elsewhere or broken is refused in one line") {
  if (!reads_gltf()) return;
  const std::string good = gltf(R"({"mesh":0})", indexed);
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string broken = good;
    REQUIRE(broken.find(from) != broken.npos);
    return complaint(parse_gltf, broken.replace(broken.find(from), from.size(), to));
  };
  CHECK_THAT(said(R"("nodes")", R"("extensionsRequired":["EXT_meshopt_compression"],"nodes")"),
             Contains("is packed (EXT_meshopt_compression), which is not read; unpack it"));
  CHECK_THAT(said("data:;base64,", "mesh.bin?"), Contains("in another file"));
  CHECK_THAT(said(R"("byteLength":36)", R"("byteLength":35)"), Contains("fewer numbers"));
  CHECK_THAT(said(R"("byteLength":6})", R"("byteLength":600})"), Contains("outside its buffer"));
  CHECK_THAT(said(R"("POSITION":0)", R"("POSITION":1)"), Contains("not of type VEC3"));
  CHECK_THAT(said(R"("mesh":0)", R"("mesh":4)"), Contains("names '4' of 1 meshes"));
  CHECK_THAT(said(R"("mesh":0)", R"("children":[0])"), Contains("circle"));
  std::string twice = R"({"mesh":0})";  // and the next one, two to the power of thirty times
  for (int i = 0; i < 30; ++i) {
    const std::string below = std::to_string(i) + "," + std::to_string(i);
    twice += R"(,{"children":[)" + below + "]}";
  }
  CHECK_THAT(said(R"([{"mesh":0}])", "[" + twice + R"(],"scenes":[{"nodes":[30]}])"),
             Contains("repeat each other"));
  CHECK_THAT(said(R"("nodes")", R"("nodes)"), Contains("JSON is broken"));
  CHECK_THAT(complaint(parse_gltf, "glTF"), Contains("ends inside its header"));
  CHECK_THAT(complaint(parse_gltf, "{}"), Contains("has no points"));
  CHECK_THAT(complaint(parse_gltf, R"({"meshes":[[1]],"nodes":[{"mesh":0}]})"),
             Contains("has no points"));
}

// Cells of several dimensions in one file, the same in every format.

namespace {

const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 0\n2 1 0\n3 1 0\n";

// A tetrahedron, two triangles, a line, a polyline of two, and a single point.
void check_cells(const io::Mixed& cells) {
  REQUIRE(cells.positions.size() == 7);
  CHECK(cells.positions[4] == std::array<double, 3>{1, 1, 0});
  CHECK(cells.tets == std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}});
  CHECK(cells.triangles == std::vector<std::array<std::uint32_t, 3>>{{1, 4, 2}, {0, 1, 3}});
  CHECK(cells.edges == std::vector<std::array<std::uint32_t, 2>>{{4, 5}, {4, 5}, {5, 6}});
}

std::string vtk(const std::string& cells, const std::string& types) {
  return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 7 double\n" +
         points + cells + types;
}

std::string gmsh(const std::string& elements) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n";
  std::size_t at = 0;
  for (int i = 0; i < 7; ++i) {
    const std::size_t end = points.find('\n', at);
    text += std::to_string(10 + i) + " " + points.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return text + "$EndNodes\n$Elements\n" + elements + "$EndElements\n";
}

}  // namespace

TEST_CASE("lines, triangles and tetrahedra come from one .vtk") {
  const std::string file = vtk("CELLS 6 22\n3 1 4 2\n4 0 1 2 3\n2 4 5\n3 4 5 6\n3 0 1 3\n1 6\n",
                               "CELL_TYPES 6\n5 10 3 4 5 1\n");
  check_cells(io::parse_vtk(file, "f"));
  // As a solid, as before.
  CHECK(io_testing::tets<io::parse_vtk>(file, "f").tets.size() == 1);
}

TEST_CASE("lines, triangles and tetrahedra come from one .vtu") {
  const std::string file =
      "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"7\" "
      "NumberOfCells=\"6\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">" +
      points +
      "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\">"
      "1 4 2 0 1 2 3 4 5 4 5 6 0 1 3 6</DataArray><DataArray type=\"Int64\" Name=\"offsets\">"
      "3 7 9 12 15 16</DataArray><DataArray type=\"UInt8\" Name=\"types\">5 10 3 4 5 1</DataArray>"
      "</Cells></Piece></UnstructuredGrid></VTKFile>";
  try {
    check_cells(io::parse_vtu(file, "f"));
    CHECK(io_testing::tets<io::parse_vtu>(file, "f").tets.size() == 1);
  } catch (const NotBuiltError&) {
  }
}

TEST_CASE("lines, triangles and tetrahedra come from one .msh") {
  const std::string file = gmsh(
      "7\n1 2 2 1 1 11 14 12\n2 4 2 1 1 10 11 12 13\n3 1 2 1 1 14 15\n4 1 0 14 15\n5 1 0 15 16\n"
      "6 2 0 10 11 13\n7 15 0 16\n");
  check_cells(io::parse_gmsh(file, "f"));
  CHECK(io_testing::tets<io::parse_gmsh>(file, "f").tets.size() == 1);
  CHECK_THROWS_WITH(io::parse_gmsh(gmsh("1\n7 2 0 10 11 99\n"), "f.msh"),
                    Contains("triangle 7 names node 99"));
}

TEST_CASE("cells of kinds that are not known are refused, as a domain would have holes") {
  CHECK_THROWS_WITH(
      io::parse_vtk(vtk("CELLS 2 9\n2 4 5\n5 0 1 4 2 3\n", "CELL_TYPES 2\n3 42\n"), "f.vtk"),
      Contains("f.vtk: has 1 polyhedra, which are not read"));
  CHECK_THROWS_WITH(io::parse_gmsh(gmsh("1\n1 777 0 10 11 14 12 13\n"), "f.msh"),
                    Contains("elements of an unknown type"));
}

TEST_CASE("simplices of any dimension come from a text") {
  const auto flat = io::parse_simplices(
      "# two triangles\ndimension 2\nvertices 4 2\n0 0\n1 0\n0 1 # here\n1 1\nsimplices 2\n0 1 2\n"
      "1 3 2\n",
      "f");
  CHECK(flat.dimension == 2);
  CHECK(flat.axes == 2);
  CHECK(flat.positions == std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1});
  CHECK(flat.corners == std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2});
  const auto lengths =
      io::parse_simplices("dimension 1\nvertices 3\nsimplices 2\n0 1 2.5\n1 2 1\n", "f");
  CHECK(lengths.axes == 0);
  CHECK(lengths.lengths == std::vector<double>{2.5, 1});
  const auto fails = [](const std::string& text, const std::string& why) {
    CHECK_THROWS_WITH(io::parse_simplices(text, "f.simplices"), Contains(why));
  };
  fails("dimension 5\n", "f.simplices:1: simplices of dimension 5");
  fails("dimension 2\nvertices 3 1\n", "need at least 2 coordinates");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 2 1\n", "f.simplices:4: simplex 0 names vertex 2");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 1\n", "ends before the length");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 1 -1\n", "negative");
  fails("dimension 1\nvertices 2\nsimplices 2\n0 1 1\n", "ends before simplex 1");
  fails("dimension 1\nvertices 99999999999\nsimplices 1\n0 1 1\n", "too short");
  fails("dimension 1\nvertices 2\nsimplices 99999999999\n0 1 1\n", "ends before simplex 1");
  fails("dimension 1\nvertices 2\nsimplices 1\n0 1 1\n0 1 1\n", "behind the last simplex");
}

// .glb and .gltf against the rules of the specification, as gltf_peer.py reads them, and VTK where
// it is installed.

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

}  // namespace plexway::cells_test
