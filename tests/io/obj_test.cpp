#include <cmath>
#include <random>
#include <sstream>

#include "io_testing.hpp"

// Another's reader, as an oracle where it is installed. It reads single precision, replaces bad
// numbers by 0 and does not join lines, so it judges well-formed files only.
#if __has_include(<tiny_obj_loader.h>)
#define PLEXWAY_TEST_TINYOBJ 1
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>
#pragma GCC diagnostic pop
#endif

namespace obj_test {

using namespace io_testing;
using Catch::Contains;

namespace {

constexpr auto parse_obj = io_testing::triangles<plexway::io::parse_obj>;

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

std::string obj_complaint(std::string_view text) { return complaint(parse_obj, text); }

}  // namespace

TEST_CASE("obj: vertices keep their order and count, used or not") {
  const auto mesh = parse_obj("v 9 9 9\n" + three + "v 8 8 8\nv 0 0 0\nf 2 3 4\n", "mesh");
  CHECK(mesh.positions ==
        Positions{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {8, 8, 8}, {0, 0, 0}});
  CHECK(mesh.triangles == Faces{{1, 2, 3}});
}

TEST_CASE("obj: every form of a face") {
  CHECK(parse_obj(three + "f 1/4 2/5 3/6", "mesh").triangles == Faces{{0, 1, 2}});
  CHECK(parse_obj(three + "f 1//4 2//5 3//6", "mesh").triangles == Faces{{0, 1, 2}});
  CHECK(parse_obj(three + "f 1/4/7 2/5/8 3/-6/-9", "mesh").triangles == Faces{{0, 1, 2}});
  CHECK(parse_obj(three + "f -3 -2 -1\nv 5 5 5\nf -1 -2 -3", "mesh").triangles ==
        Faces{{0, 1, 2}, {3, 2, 1}});
  CHECK(parse_obj("f 3 2 1\n" + three, "mesh").triangles == Faces{{2, 1, 0}});
  CHECK(parse_obj(three + "f 1 1 2", "mesh").triangles == Faces{{0, 0, 1}});
}

TEST_CASE("obj: convex polygons become fans") {
  const auto mesh = parse_obj(three + "v 1 1 0\nv .4 1.2 0\nf 2 4 3 1\nf 5 3 1 2 4\n", "mesh");
  CHECK(mesh.triangles == Faces{{1, 3, 2}, {1, 2, 0}, {4, 2, 0}, {4, 0, 1}, {4, 1, 3}});
  CHECK(mesh.report.split_polygons == 2);
}

TEST_CASE("obj: numbers of every form") {
  const auto mesh =
      parse_obj("v +1 -2.5e+1 .5\nv 1e-999 -0 1.\nv 1E3 4.9e-324 0.0000 0.5\nf 1 2 3", "mesh");
  CHECK(mesh.positions == Positions{{1, -25, 0.5}, {0, 0, 1}, {1000, 4.9e-324, 0}});
}

TEST_CASE("obj: blanks, comments, line ends and joined lines") {
  const Positions positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::string text :
       {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "\xEF\xBB\xBFv 0 0 0\n  v\t1 0  0   \n\n\nv 0 1 0 # three\n#v 1 1 1\nf 1 2 3 # end",
        "v 0 \\\n0 0\nv 1 0 0\nv \\\r\n0 1 0\nf 1 \\\n 2\\\n 3\n",
        "o a\ng b\nmtllib c:\\d\\\nusemtl v 1 2 3\nvt 0 0\nvn 0 0 1\ns off\nl 1 2\np 1\nvp 1 2\n"
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"}) {
    INFO(text);
    const auto mesh = parse_obj(text, "mesh");
    CHECK(mesh.positions == positions);
    CHECK(mesh.triangles == Faces{{0, 1, 2}});
  }
}

TEST_CASE("obj: bad numbers are named with their line") {
  CHECK(obj_complaint("v 0 0 0\nv 1 nan 2\n") == "mesh:2: coordinate y is not finite: 'nan'");
  CHECK(obj_complaint("v 0 0 -inf\n") == "mesh:1: coordinate z is not finite: '-inf'");
  CHECK(obj_complaint("\n\nv 1e999 0 0\n") == "mesh:3: coordinate x is not finite: '1e999'");
  CHECK(obj_complaint("v 1 2\n") == "mesh:1: the line ends before coordinate z");
  CHECK(obj_complaint("v\n") == "mesh:1: the line ends before coordinate x");
  CHECK(obj_complaint("v 1 2 abc\n") == "mesh:1: coordinate z is not a number: 'abc'");
  CHECK(obj_complaint("v 1 2 3,5\n") == "mesh:1: coordinate z is not a number: '3,5'");
  CHECK(obj_complaint("v 1 +-2 3\n") == "mesh:1: coordinate y is not a number: '+-2'");
  CHECK(obj_complaint("v 1 2 \\3\n") == "mesh:1: coordinate z is not a number: '\\3'");
  CHECK(obj_complaint("v 1 \\\n2 \\\nq\n") == "mesh:3: coordinate z is not a number: 'q'");
}

TEST_CASE("obj: bad faces are named with their line") {
  CHECK(obj_complaint(three + "f 1 2 3\nf 1 2 9\n") ==
        "mesh:5: face 1 names vertex 9, but the file has 3 vertices");
  CHECK(obj_complaint(three + "f 1 2 4\nf 1 2 9\nv 1 1 1\n") ==
        "mesh:5: face 1 names vertex 9, but the file has 4 vertices");
  CHECK(obj_complaint(three + "f 1 2 -4\n") ==
        "mesh:4: face 0 names vertex -4, but only 3 vertices come before it");
  CHECK(obj_complaint(three + "f 0 1 2\n") == "mesh:4: face 0 names vertex 0; OBJ counts from 1");
  CHECK(obj_complaint(three + "f 1 2 99999999999999999999\n") ==
        "mesh:4: a vertex of the face is too large: '99999999999999999999'");
  CHECK_THAT(obj_complaint(three + "f 1 2 -9223372036854775808\n"), Contains("mesh:4: face 0"));
  CHECK_THAT(obj_complaint(three + "f 1 2 4294967296\n"), Contains("names vertex 4294967296"));
  CHECK(obj_complaint(three + "f 1 2 x\n") ==
        "mesh:4: a vertex of the face is not a whole number: 'x'");
  CHECK_THAT(obj_complaint(three + "f 1/a 2 3\n"), Contains("mesh:4:") && Contains("'/a'"));
  CHECK(obj_complaint(three + "f 1 2 3\nf 1 2") ==
        "mesh:5: face 1 has 2 corners; it needs at least 3");
  CHECK(obj_complaint(three + "f\n") == "mesh:4: face 0 has 0 corners; it needs at least 3");
}

TEST_CASE("obj: no faces") {
  const std::string cause = "mesh: has no faces; a surface needs at least one triangle";
  CHECK(obj_complaint("") == cause);
  CHECK(obj_complaint(three) == cause);
  CHECK(obj_complaint(three + "l 1 2 3\n") == cause);
  CHECK(obj_complaint(std::string("\0\1\2 garbage \xFF\n", 15)) == cause);
}

TEST_CASE("obj: a message shows nothing that is not printable and stays short") {
  const std::string message = obj_complaint("v 1 2 " + std::string(100, '\x01') + "\n");
  CHECK(message == "mesh:1: coordinate z is not a number: '" + std::string(32, '?') + "...'");
}

TEST_CASE("read_triangles: what is wrong with the file itself") {
  const Folder folder;
  const auto complaint_of = [](const std::filesystem::path& file) {
    return io_testing::complaint_of(plexway::io::read_triangles, file);
  };
  const auto named = [&](const char* name) { return (folder.path() / name).string(); };
  CHECK(complaint_of(named("none.obj")) == named("none.obj") + ": no such file");
  CHECK(complaint_of(folder.path()) == folder.path().string() + ": is a directory, not a file");
  std::filesystem::create_directory(named("dir.obj"));
  CHECK(complaint_of(named("dir.obj")) == named("dir.obj") + ": is a directory, not a file");
  CHECK(complaint_of(folder.write("empty.ply", "")) == named("empty.ply") + ": is empty");
  CHECK(complaint_of(folder.write("mesh.xyz", "0 0 0\n")) ==
        named("mesh.xyz") + ": has no faces; a surface needs at least one triangle");
  CHECK_THAT(complaint_of(folder.write("mesh", "0 0 0\n")),
             Contains(": no extension, and its first bytes do not tell what it is; read are "
                      "surfaces .obj .off .ply .stl .gii"));
  CHECK(complaint_of(folder.write("mesh.obj", three + "f 1 2 4")) ==
        named("mesh.obj") + ":4: face 0 names vertex 4, but the file has 3 vertices");
}

TEST_CASE("read_triangles: the extension picks the format in any case, and any size is read") {
  const Folder folder;
  std::string text;
  for (int i = 0; i < 20000; ++i) text += three;
  text += "f 1 60000 3\n";
  const auto mesh = plexway::io::read_triangles(folder.write("MESH.Obj", text));
  CHECK(mesh.positions.size() == 60000);
  CHECK(mesh.triangles == Faces{{0, 59999, 2}});
}

#ifdef PLEXWAY_TEST_TINYOBJ
TEST_CASE("obj: agrees with tinyobjloader on random well-formed files") {
  std::mt19937 random(5);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int round = 0; round < 20; ++round) {
    std::ostringstream text;
    text.precision(9);
    const int vertices = 4 + below(60);
    for (int i = 0; i < vertices; ++i)
      text << "v " << below(2000) / 7.0 - 100 << ' ' << below(9) << ' ' << below(99) * 1e-5 << '\n';
    for (int i = 0; i < 40; ++i) {
      text << 'f';
      for (int c = 0; c < 3; ++c) {
        const int v = below(vertices);
        text << ' ' << (below(2) != 0 ? v + 1 : v - vertices);
        if (below(2) != 0) text << "//1";
      }
      text << '\n';
    }
    const auto mesh = parse_obj(text.str(), "mesh");
    tinyobj::ObjReader oracle;
    REQUIRE(oracle.ParseFromString(text.str(), ""));
    const auto& coordinates = oracle.GetAttrib().vertices;
    REQUIRE(coordinates.size() == 3 * mesh.positions.size());
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      CHECK(mesh.positions[i / 3][i % 3] == Approx(coordinates[i]).epsilon(1e-5));
    std::vector<std::uint32_t> corners;
    for (const auto& shape : oracle.GetShapes())
      for (const auto& corner : shape.mesh.indices)
        corners.push_back(static_cast<std::uint32_t>(corner.vertex_index));
    REQUIRE(corners.size() == 3 * mesh.triangles.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
      CHECK(mesh.triangles[i / 3][i % 3] == corners[i]);
  }
}
#endif

}  // namespace obj_test
