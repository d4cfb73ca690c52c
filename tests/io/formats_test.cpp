// The table of formats: docs/reference/formats.md, first bytes, and files of other programs.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <sstream>

#include <plexway/io/edges.hpp>
#include <plexway/io/formats.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/simplices.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "io_testing.hpp"

namespace formats_test {

using namespace io_testing;
using namespace plexway;
using Catch::Contains;

namespace {

// What stands between the marks of docs/reference/formats.md.
std::string page() {
  std::string text = "| extension | format | holds | read | passed over |\n|---|---|---|---|---|\n";
  for (const io::Format& format : io::formats()) {
    std::string extensions, kinds;
    std::istringstream list{std::string(format.extensions)};
    for (std::string one; list >> one;) extensions += (extensions.empty() ? "`" : " `") + one + "`";
    for (const auto& [kind, name] :
         {std::pair(DomainKind::surface, "surface"), std::pair(DomainKind::solid, "solid"),
          std::pair(DomainKind::wireframe, "wireframe"), std::pair(DomainKind::cloud, "cloud"),
          std::pair(DomainKind::simplices, "simplices")})
      if (format.may_hold(kind)) kinds.append(kinds.empty() ? "" : ", ").append(name);
    text += "| " + extensions + " | " + std::string(format.name) + " | " + kinds + " | " +
            std::string(format.taken) + " | " + std::string(format.passed_over) + " |\n";
  }
  return text;
}

std::string complaint_of(const std::filesystem::path& file) {
  return io_testing::complaint_of(io::read_cells, file);
}

const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

}  // namespace

TEST_CASE("docs/reference/formats.md has the table of formats") {
  const std::string text = bytes_of(std::string(PLEXWAY_SOURCE_DIR) + "/docs/reference/formats.md");
  const std::string from = "<!-- formats -->\n", to = "<!-- /formats -->";
  const std::size_t begin = text.find(from);
  REQUIRE(begin != text.npos);
  CHECK(text.substr(begin + from.size(), text.find(to) - begin - from.size()) == page());
}

TEST_CASE("a file's kind is told by its first bytes where its name does not say") {
  const Folder folder;
  CHECK(io::read_cells(folder.write("mesh.dat", off)).triangles.size() == 1);
  CHECK(io::read_cells(folder.write("mesh",
                                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty "
                                    "float x\nproperty float y\nproperty float z\n"
                                    "end_header\n1 2 3\n"))
            .positions.size() == 1);
  CHECK(io::read_cells(folder.write("a.stl.bak",
                                    "solid x\nfacet\nouter loop\nvertex 0 0 0\n"
                                    "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                                    "endsolid\n"))
            .triangles.size() == 1);
  CHECK(io::read_cells(folder.write("a.mesh2",
                                    "MeshVersionFormatted 1 Dimension 2 Vertices 3 0 0 0 "
                                    "1 0 0 0 1 0 Triangles 1 1 2 3 0 End"))
            .triangles.size() == 1);
  // FreeSurfer's names are open, and some of its files are text.
  Packer brain(true);
  brain.put(std::int32_t{3}).put(std::int32_t{1});
  for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) brain.put(x);
  for (const int v : {0, 1, 2}) brain.put(std::int32_t{v});
  const std::string binary = "\xFF\xFF\xFEmade by hand\n\n" + brain.bytes();
  for (const char* name : {"lh.sphere.reg", "lh.pial.T1", "lh.orig.nofix", "lh.smoothwm"})
    CHECK(io::read_triangles(folder.write(name, binary)).triangles == Faces{{0, 1, 2}});
  CHECK(io::read_triangles(folder.write("lh.pial.asc",
                                        "#!ascii version of lh.pial\n3 1\n0 0 0 0\n"
                                        "1 0 0 0\n0 1 0 0\n0 1 2 0\n"))
            .triangles == Faces{{0, 1, 2}});
  CHECK(io::read_points(folder.write("cloud.asc", "0 0 0\n1 0 0\n")).positions.size() == 2);
  // So are bytes that are in memory already.
  for (const char* name : {"mesh.off", "mesh.dat", "mesh"})
    CHECK(io::parse_cells(off, name).triangles == Faces{{0, 1, 2}});
  CHECK(io::parse_points("0 0 0\n1 0 0\n", "a.xyz").positions == Positions{{0, 0, 0}, {1, 0, 0}});
  CHECK(io::parse_points(off, "a.off").positions.size() == 3);
  CHECK_THROWS_WITH(io::parse_cells("", "a.off"), Contains("a.off"));
  CHECK_THROWS_WITH(io::parse_cells("no mesh", "a.dat"), Contains("a.dat: unknown extension"));
}

TEST_CASE("what cannot be read is named, with what turns it into something that can") {
  const Folder folder;
  CHECK_THAT(complaint_of(folder.write("a.dae", "x")), Contains("save the surface as .stl"));
  CHECK_THAT(complaint_of(folder.write("a.meshb", "x")), Contains("transmesh"));
  CHECK_THAT(complaint_of(folder.write("a.nii", "x")), Contains("voxels"));
  CHECK_THAT(complaint_of(folder.write("a.laz", "x")), Contains("pdal"));
  const std::string unknown = complaint_of(folder.write("a.plyy", "x"));
  CHECK_THAT(unknown, Contains("unknown extension '.plyy'") && Contains("did you mean '.ply'?"));
  for (const io::Format& format : io::formats()) {
    std::istringstream list{std::string(format.extensions)};
    for (std::string one; list >> one;) CHECK_THAT(unknown, Contains(one));
  }
  CHECK_THAT(complaint_of(folder.path() / "none.dat"), Contains("no such file"));
}

TEST_CASE("bytes in memory have no other file beside them") {
  const Folder folder;
  for (const char* name : {"a.node", "a.ele"}) {
    CHECK(complaint([&](std::string_view bytes, std::string_view) { io::parse_cells(bytes, name); },
                    "1 3 0 0\n0 0 0 0\n") ==
          std::string(name) +
              ": is one of two files, .node and .ele: give their name instead of bytes, or save "
              "them as one, such as .mesh or .vtu");
    CHECK_THROWS_WITH(io::parse_points("1 3 0 0\n0 0 0 0\n", name), Contains("instead of bytes"));
  }
  // Not even where it does.
  const auto node = folder.write("b.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
  folder.write("b.ele", "1 4 0\n0 0 1 2 3\n");
  CHECK(io::read_cells(node).tets.size() == 1);
  CHECK_THROWS_WITH(io::parse_cells(bytes_of(node), node), Contains("instead of bytes"));
  folder.write("b.bin", std::string(36, '\0'));
  const std::string gltf =
      R"({"buffers":[{"uri":"b.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
  try {
    CHECK(io::read_cells(folder.write("b.gltf", gltf)).positions.size() == 1);
    CHECK_THROWS_WITH(io::parse_cells(gltf, folder.at("b.gltf")), Contains("in another file"));
  } catch (const NotBuiltError&) {
  }
}

TEST_CASE("files packed by gzip are read, and bombs are not") {
  const Folder folder;
  // gzip's own bytes of `off`, and of 200 MB of zeros.
  const auto file = folder.write("a.off", off);
  if (std::system(("gzip -nk " + file.string()).c_str()) != 0) return;
  try {
    CHECK(io::read_cells(file.string() + ".gz").triangles.size() == 1);
  } catch (const NotBuiltError&) {
    return;
  }
  const std::string packed = bytes_of(file.string() + ".gz");
  CHECK(io::read_cells(folder.write("b.gz", packed)).triangles.size() == 1);
  CHECK_THAT(complaint_of(folder.write("cut.off.gz", packed.substr(0, packed.size() / 2))),
             Contains("does not unpack"));
  const auto line =
      folder.write("a.simplices", "dimension 1\nvertices 2 1\n0\n1\nsimplices 1\n0 1\n");
  REQUIRE(std::system(("gzip -nk " + line.string()).c_str()) == 0);
  CHECK(io::read_simplices(line.string() + ".gz").positions == std::vector<double>{0, 1});
  const auto bomb = folder.path() / "bomb.off.gz";
  REQUIRE(std::system(("head -c 200000000 /dev/zero | gzip > " + bomb.string()).c_str()) == 0);
  CHECK_THAT(complaint_of(bomb), Contains("does not unpack"));
}

TEST_CASE("OBJ holds faces, lines and points, whichever there are") {
  const Folder folder;
  const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0 nan nan nan\nv 0 1 0 1 0.5\n";
  const io::Mixed all = io::read_cells(folder.write("all.obj", four + "f 1 2 3 4 1\nl 1 2 4\n"));
  CHECK(all.positions.size() == 4);
  CHECK(all.triangles == Faces{{0, 1, 2}, {0, 2, 3}});
  CHECK(all.report.split_polygons == 1);
  CHECK(all.edges.size() == 2);
  CHECK(io::read_cells(folder.write("p.obj", four)).triangles.empty());
  CHECK(io::read_points(folder.write("q.obj", four)).positions.size() == 4);
  const std::string ell = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 5 6 1 2 3 4\n";
  const io::Triangles notched = io::read_triangles(folder.write("ell.obj", ell));
  double area = 0;
  for (const auto& [a, b, c] : notched.triangles) {
    const auto& p = notched.positions;
    const double part =
        (p[b][0] - p[a][0]) * (p[c][1] - p[a][1]) - (p[b][1] - p[a][1]) * (p[c][0] - p[a][0]);
    CHECK(part > 0);
    area += part / 2;
  }
  CHECK(area == Approx(3));
}

TEST_CASE("PLY holds strips and edges beside faces, and lines that end as on old Macs") {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float "
      "y\nproperty float z\n";
  const std::string four = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n";
  const Folder folder;
  const io::Mixed strips = io::read_cells(folder.write(
      "s.ply", head + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
                   four + "8 0 1 2 3 -1 3 1 0\n"));
  CHECK(strips.triangles == Faces{{0, 1, 2}, {1, 3, 2}, {3, 1, 0}});
  CHECK_FALSE(io::is_ply_cloud(folder.path() / "s.ply"));
  const std::string edges = head +
                            "element edge 2\nproperty int vertex1\nproperty int vertex2\n"
                            "property uchar red\nend_header\n" +
                            four;
  CHECK(io::read_edges(folder.write("e.ply", edges + "0 1 9\n1 3 9\n")).edges.size() == 2);
  CHECK_FALSE(io::is_ply_cloud(folder.path() / "e.ply"));
  CHECK_THAT(complaint_of(folder.write("f.ply", edges + "0 1 9\n1 4 9\n")),
             Contains("edge 1 names vertex 4, but the file has 4 vertices"));
  std::string mac = head + "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
                    four + "4 0 2 3 1\n";
  const io::Mixed plain = io::read_cells(folder.write("n.ply", mac));
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  const io::Mixed same = io::read_cells(folder.write("m.ply", mac));
  CHECK(same.positions == plain.positions);
  CHECK(same.triangles == plain.triangles);
  std::string obj = "# by hand\rv 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r";
  CHECK(io::read_triangles(folder.write("m.obj", obj)).triangles.size() == 1);
}

TEST_CASE("hexahedra, prisms and pyramids become tetrahedra that fill them and fit together") {
  // Two unit cubes, one of them split into a pyramid, prisms and so on, by VTK's types.
  const std::string head =
      "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ";
  const std::string cube = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 ";
  struct Case {
    std::string text;
    double volume;
    std::size_t tets;
  };
  const Case cases[] = {
      {"8 float\n" + cube + "\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n", 1, 6},
      {"8 float\n" + cube + "\nCELLS 1 9\n8 0 1 3 2 4 5 7 6\nCELL_TYPES 1\n11\n", 1, 6},
      {"8 float\n" + cube + "\nCELLS 1 7\n6 0 1 3 4 5 7\nCELL_TYPES 1\n13\n", .5, 3},
      {"8 float\n" + cube + "\nCELLS 1 7\n6 0 3 1 4 7 5\nCELL_TYPES 1\n13\n", .5, 3},
      {"8 float\n" + cube + "\nCELLS 1 6\n5 0 1 2 3 6\nCELL_TYPES 1\n14\n", 1. / 3, 2},
      {"8 float\n" + cube + "\nCELLS 2 14\n6 0 1 3 4 5 7\n6 1 2 3 5 6 7\nCELL_TYPES 2\n13 13\n", 1,
       6},
      // Three of four bases: a cell of which two corners are one.
      {"8 float\n" + cube + "\nCELLS 1 9\n8 0 1 2 2 4 5 6 6\nCELL_TYPES 1\n12\n", .5, 3},
  };
  for (const Case& one : cases) {
    const io::Mixed cells = io::parse_vtk(head + one.text, "f");
    double volume = 0;
    for (const auto& tet : cells.tets) {
      std::array<std::array<double, 3>, 3> s{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          s[i][k] = cells.positions[tet[i + 1]][k] - cells.positions[tet[0]][k];
      const double part = s[0][0] * (s[1][1] * s[2][2] - s[1][2] * s[2][1]) +
                          s[0][1] * (s[1][2] * s[2][0] - s[1][0] * s[2][2]) +
                          s[0][2] * (s[1][0] * s[2][1] - s[1][1] * s[2][0]);
      CHECK(part > 0);
      volume += part / 6;
    }
    CHECK(volume == Approx(one.volume));
    CHECK(cells.tets.size() == one.tets);
    CHECK(cells.report.split_cells >= 1);
  }
  // A tetrahedron on half a face, on the other diagonal and on the same.
  const std::string nine = "9 float\n" + cube + " 2 .5 .5\nCELLS 2 14\n8 0 1 2 3 4 5 6 7\n";
  CHECK(complaint(io::parse_vtk, head + nine + "4 1 2 5 8\nCELL_TYPES 2\n12 10\n") ==
        "mesh: the triangle of vertices 1, 2 and 5 is half a face of a hexahedron or prism that is "
        "cut along the other diagonal: they need a pyramid between, or save it as tetrahedra");
  CHECK(io::parse_vtk(head + nine + "4 1 2 6 8\nCELL_TYPES 2\n12 10\n", "f").tets.size() == 7);
  // A grid of cubes whose vertices have shuffled numbers: every face inside is in two tetrahedra.
  constexpr std::uint32_t n = 4;
  std::vector<std::uint32_t> number(n * n * n);
  for (std::uint32_t i = 0; i < number.size(); ++i) number[i] = i * 29 % 64;
  std::vector<std::string> points(number.size());
  std::string text;
  std::size_t count = 0;
  const auto at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return number[(z * n + y) * n + x];
  };
  for (std::uint32_t z = 0; z < n; ++z)
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        points[at(x, y, z)] =
            std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + " ";
        if (x + 1 == n || y + 1 == n || z + 1 == n) continue;
        text += "8";
        for (const std::uint32_t v :
             {at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z), at(x, y, z + 1),
              at(x + 1, y, z + 1), at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)})
          text += " " + std::to_string(v);
        text += "\n";
        ++count;
      }
  std::string all = head + std::to_string(number.size()) + " float\n";
  for (const std::string& p : points) all += p;
  all += "\nCELLS " + std::to_string(count) + " " + std::to_string(9 * count) + "\n" + text +
         "CELL_TYPES " + std::to_string(count) + "\n";
  for (std::size_t c = 0; c < count; ++c) all += "12 ";
  const io::Mixed grid = io::parse_vtk(all, "f");
  CHECK(grid.tets.size() == 6 * count);
  std::map<std::array<std::uint32_t, 3>, int> faces;
  for (const auto& t : grid.tets)
    for (std::size_t out = 0; out < 4; ++out) {
      std::array<std::uint32_t, 3> face{};
      for (std::size_t i = 0, k = 0; i < 4; ++i)
        if (i != out) face[k++] = t[i];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  std::size_t single = 0;
  for (const auto& [face, times] : faces) {
    CHECK(times <= 2);
    single += times == 1 ? 1 : 0;
  }
  CHECK(single == 6 * (n - 1) * (n - 1) * 2);
}

TEST_CASE("small things that other programs write") {
  const Folder folder;
  CHECK(io::read_triangles(folder.write("a.off", "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"))
            .triangles.size() == 1);
  CHECK(io::read_cells(folder.write("a.vtk",
                                    "# vtk DataFile Version 1.0\nl\nASCII\nDATASET "
                                    "POLYDATA\nPOINTS 3 float 0 0 0\n1 0 0 1 1 0\n"
                                    "LINES 1 4 3\n0 1 2\n"))
            .edges.size() == 2);
  CHECK(io::read_cells(folder.write("b.msh",
                                    "$Comments\nby $hand\n\n$EndComments\n$MeshFormat\n"
                                    "2.2 0 8\n$EndMeshFormat\n$Comments\nx\n$EndComments\n"
                                    "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
                                    "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n"))
            .triangles.size() == 1);
  CHECK_THAT(complaint_of(folder.write("c.msh", "$Comments\nx\n")), Contains("$EndComments"));
  const std::string medit =
      "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n"
      "1 1 0 0\n0 1 0 0\n";
  const io::Mixed flat = io::read_cells(folder.write(
      "d.mesh", medit + "Quadrilaterals 1\n1 2 3 4 0\nEdges 1\n1 3 0\nCorners 1\n1\n"));
  CHECK(flat.triangles.size() == 2);
  CHECK(flat.edges.size() == 1);
  std::string stl(84, '\0');
  stl[80] = 1;
  Packer facet(false);
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) facet.put(x);
  stl += facet.bytes() + std::string(2, '\0');
  CHECK(io::parse_stl(stl, "f").report.notes.empty());
  const io::Triangles more = io::parse_stl(stl + "made by hand", "f");
  CHECK(more.triangles.size() == 1);
  REQUIRE(more.report.notes.size() == 1);
  CHECK(more.report.notes[0] == "12 bytes behind the last of 1 facets are passed over");
  CHECK_THAT(complaint(io::parse_stl, stl + std::string(100, '\1')),
             Contains("takes 134 bytes, but the file has 234"));
}

TEST_CASE("colours of points are no normals, and headers may stand in comments") {
  const io::Points coloured =
      io::parse_point_table("0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 9 9 9\n", "f");
  CHECK(coloured.positions.size() == 3);
  CHECK(coloured.normals.empty());
  REQUIRE(coloured.report.notes.size() == 1);
  CHECK_THAT(coloured.report.notes[0], Contains("colours by their range, 0 to 255"));
  const io::Points grey =
      io::parse_point_table("0 0 0 .1 .2 .3\n1 0 0 .9 .1 .1\n0 1 0 0 .2 0\n", "f");
  CHECK(grey.normals.empty());
  CHECK_THAT(grey.report.notes.at(0), Contains("0 to 1"));
  const io::Points pts = io::parse_point_table("2\n1 2 3 77 255 0 1\n4 5 6 -9 0 0 0\n", "f");
  CHECK(pts.positions == Positions{{1, 2, 3}, {4, 5, 6}});
  const io::Points compare = io::parse_point_table("//X,Y,Z,Rf,Nx,Ny,Nz\n1,2,3,.5,0,0,1\n", "f");
  CHECK(compare.positions == Positions{{1, 2, 3}});
  CHECK(compare.normals == Positions{{0, 0, 1}});
  CHECK(io::parse_point_table("# z y x\n1 2 3\n", "f").positions == Positions{{3, 2, 1}});
  CHECK_THAT(complaint(io::parse_point_table, "1 2 3 4 5 6 7\n"), Contains("has 7 columns"));
  CHECK_THAT(complaint(io::parse_point_table, "0 0 0 300 0 0\n"), Contains("no unit vector"));
}

TEST_CASE("glTF's numbers may be quantized, sparse or in a file beside it") {
  const Folder folder;
  const std::string whole =
      R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization"],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"nodes":[{"mesh":0}],)"
      R"("buffers":[{"uri":"my%20numbers.bin","byteLength":27}],"bufferViews":[)"
      R"({"buffer":0,"byteOffset":0,"byteLength":24,"byteStride":8},{"buffer":0,"byteOffset":24,"byteLength":3}],)"
      R"("accessors":[{"bufferView":0,"componentType":5122,"count":3,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}]})";
  Packer numbers(false);
  for (const int x : {0, 0, 0, 7, 1000, 0, 0, 7, 0, -500, 0, 7})
    numbers.put(static_cast<std::int16_t>(x));
  const std::string bytes = numbers.bytes() + std::string("\0\1\2", 3);
  const auto file = folder.write("a.gltf", whole);
  try {
    CHECK_THAT(complaint_of(file), Contains("my numbers.bin: no such file"));
    static_cast<void>(folder.write("my numbers.bin", bytes));
    const io::Mixed cells = io::read_cells(file);
    CHECK(cells.positions == Positions{{0, 0, 0}, {1000, 0, 0}, {0, -500, 0}});
    CHECK(cells.triangles == Faces{{0, 1, 2}});
    std::string elsewhere = whole;
    elsewhere.replace(elsewhere.find("my%20"), 5, "../");
    CHECK_THAT(complaint_of(folder.write("b.gltf", elsewhere)), Contains("does not lie beside it"));
    std::string normalized = whole;
    normalized.replace(normalized.find(R"("count":3)"), 9, R"("normalized":true,"count":3)");
    CHECK(io::read_cells(folder.write("c.gltf", normalized)).positions[1][0] ==
          Approx(1000. / 32767));
    std::string sparse = whole;
    sparse.replace(sparse.find(R"("count":3)"), 9,
                   R"("count":3,"sparse":{"count":1,"indices":{"bufferView":1,"byteOffset":2,)"
                   R"("componentType":5121},"values":{"bufferView":0,"byteOffset":8}})");
    CHECK(io::read_cells(folder.write("d.gltf", sparse)).positions ==
          Positions{{0, 0, 0}, {1000, 0, 0}});
  } catch (const NotBuiltError&) {
  }
}

}  // namespace formats_test
