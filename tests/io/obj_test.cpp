#include <random>
#include <sstream>

#include <plexway/io/edges.hpp>

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

using plexway::io::Edges;
using plexway::io::parse_edge_list;

namespace {

using Wires = std::vector<std::array<std::uint32_t, 2>>;
using Lengths = std::vector<double>;

constexpr auto parse_obj_lines = io_testing::edges<plexway::io::parse_obj>;

std::string line_complaint(std::string_view text) { return complaint(parse_obj_lines, text); }
std::string list_complaint(std::string_view text) { return complaint(parse_edge_list, text); }

}  // namespace

TEST_CASE("obj lines: a polyline is as many edges as it has steps, every vertex is kept") {
  const Edges wires = parse_obj_lines("v 9 9 9\n" + three + "v 8 8 8\nl 2 3 4 2\nl 4 5\n", "mesh");
  CHECK(wires.positions == Positions{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {8, 8, 8}});
  CHECK(wires.edges == Wires{{1, 2}, {2, 3}, {3, 1}, {3, 4}});
  CHECK(wires.vertices == 5);
  CHECK(wires.lengths.empty());
}

TEST_CASE("obj lines: every form of a line") {
  CHECK(parse_obj_lines(three + "l 1/4 2/5 3/6", "mesh").edges == Wires{{0, 1}, {1, 2}});
  CHECK(parse_obj_lines(three + "l -3 -1\nv 5 5 5\nl -1 -2", "mesh").edges ==
        Wires{{0, 2}, {3, 2}});
  CHECK(parse_obj_lines("l 3 1\n" + three, "mesh").edges == Wires{{2, 0}});
  CHECK(parse_obj_lines(three + "l 1 1\nl 1 2\nl 2 1\n", "mesh").edges ==
        Wires{{0, 0}, {0, 1}, {1, 0}});
  CHECK(
      parse_obj_lines("o a\np 1\n" + three + "vt 0 0\nl 1 \\\n 2\\\r\n 3 # end\nf 1 2 3\n", "mesh")
          .edges == Wires{{0, 1}, {1, 2}});
}

TEST_CASE("obj lines: what is wrong is named with its line") {
  CHECK(line_complaint(three + "l 1 2\nl 2 9\n") ==
        "mesh:5: polyline 1 names vertex 9, but the file has 3 vertices");
  CHECK(line_complaint(three + "l 1 -4\n") ==
        "mesh:4: polyline 0 names vertex -4, but only 3 vertices come before it");
  CHECK(line_complaint(three + "l 0 1\n") ==
        "mesh:4: polyline 0 names vertex 0; OBJ counts from 1");
  CHECK(line_complaint(three + "l 1\n") == "mesh:4: polyline 0 has 1 vertex; it needs at least 2");
  CHECK(line_complaint(three + "l\n") == "mesh:4: polyline 0 has 0 vertices; it needs at least 2");
  CHECK(line_complaint(three + "l 1 x\n") ==
        "mesh:4: a vertex of the polyline is not a whole number: 'x'");
  CHECK_THAT(line_complaint(three + "l 1/a 2\n"), Contains("mesh:4:") && Contains("'/a'"));
  CHECK(line_complaint("v 0 0 0\nv 1 nan 2\n") == "mesh:2: coordinate y is not finite: 'nan'");
}

TEST_CASE("obj lines: a file without lines says what to do") {
  CHECK(line_complaint(three + "f 1 2 3\n") ==
        "mesh: has faces but no lines; read it as a surface");
  CHECK(line_complaint(three) == "mesh: has no lines; a wireframe needs at least one");
  CHECK(line_complaint("") == "mesh: has no lines; a wireframe needs at least one");
}

TEST_CASE("edge list: vertices, lengths, comments") {
  const Edges plain = parse_edge_list("0 1\n1 2\n7 0", "mesh");
  CHECK(plain.edges == Wires{{0, 1}, {1, 2}, {7, 0}});
  CHECK(plain.lengths == Lengths{1, 1, 1});
  CHECK(plain.vertices == 8);
  CHECK(plain.positions.empty());
  const Edges full = parse_edge_list(
      "\xEF\xBB\xBF# one\r\n% two 2 2\n\nvertices 6 # more than named\n"
      "0 1 2.5\n\n  1\t1 0\n+4 0 1e-999 # four\n% 5 5\n1 0 .5",
      "mesh");
  CHECK(full.edges == Wires{{0, 1}, {1, 1}, {4, 0}, {1, 0}});
  CHECK(full.lengths == Lengths{2.5, 0, 0, .5});
  CHECK(full.vertices == 6);
}

TEST_CASE("edge list: what is wrong is named with its line") {
  CHECK(list_complaint("0 1\n1 2 3\n") ==
        "mesh:2: edge 1 has a length, but those before it have none");
  CHECK(list_complaint("0 1 1\n1 2\n") ==
        "mesh:2: edge 1 has no length, but those before it have one");
  CHECK(list_complaint("0 1 -1\n") == "mesh:1: edge 0: its length is negative");
  CHECK(list_complaint("0 1 nan\n") == "mesh:1: the length is not finite: 'nan'");
  CHECK(list_complaint("0 1 1 7\n") ==
        "mesh:1: edge 0 is followed by '7'; a line is \"a b\" or \"a b length\"");
  CHECK(list_complaint("\n0\n") == "mesh:2: the line ends before its second vertex");
  CHECK(list_complaint("a 1\n") == "mesh:1: the edge's first vertex is not a whole number: 'a'");
  CHECK(list_complaint("0 -1\n") == "mesh:1: edge 0 names vertex -1; vertices count from 0");
  CHECK(list_complaint("vertices 3\n0 1\n1 3\n") ==
        "mesh:3: edge 1 names vertex 3, but the file has 3 vertices");
  CHECK(list_complaint("vertex 3\n") ==
        "mesh:1: this is neither an edge \"a b [length]\" nor \"vertices N\": it starts with "
        "'vertex'");
  CHECK(list_complaint("0 1\nvertices 3\n") ==
        "mesh:2: \"vertices N\" may stand only once, before all edges");
  CHECK(list_complaint("vertices 3\nvertices 3\n0 1") ==
        "mesh:2: \"vertices N\" may stand only once, before all edges");
  CHECK(list_complaint("vertices -3\n") == "mesh:1: the number of vertices is negative: -3");
  CHECK(list_complaint("vertices 3 4\n") == "mesh:1: after the number of vertices there is '4'");
  CHECK(list_complaint("# nothing\n") == "mesh: has no edges; a wireframe needs at least one");
}

TEST_CASE("edge list: a short file cannot ask for gigabytes") {
  const std::string cause = " is too high for a file this small: number the vertices without gaps";
  CHECK(list_complaint("0 4294967294\n") == "mesh:1: 4294967294" + cause);
  CHECK(list_complaint("vertices 4294967294\n") == "mesh:1: 4294967294" + cause);
  CHECK_THAT(list_complaint("0 99999999999999999999\n"), Contains("mesh:1:"));
  CHECK(parse_edge_list("0 9999999\n", "mesh").vertices == 10000000);
}

TEST_CASE("read_edges: the extension picks the format") {
  const Folder folder;
  CHECK(plexway::io::read_edges(folder.write("W.OBJ", three + "l 1 3\n")).edges == Wires{{0, 2}});
  CHECK(plexway::io::read_edges(folder.write("w.edges", "0 2 5\n")).lengths == Lengths{5});
  const auto complaint_of = [](const std::filesystem::path& file) {
    return io_testing::complaint_of(plexway::io::read_edges, file);
  };
  const auto named = [&](const char* name) { return (folder.path() / name).string(); };
  CHECK(complaint_of(named("none.edges")) == named("none.edges") + ": no such file");
  CHECK(complaint_of(folder.path()) == folder.path().string() + ": is a directory, not a file");
  CHECK(complaint_of(folder.write("w.off", "OFF 3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")) ==
        named("w.off") + ": has faces but no lines; read it as a surface");
  CHECK(complaint_of(folder.write("bad.edges", "0 1\n0\n")) ==
        named("bad.edges") + ":2: the line ends before its second vertex");
}

}  // namespace obj_test
