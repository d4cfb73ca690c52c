#include <plexway/io/edges.hpp>

#include "io_testing.hpp"

namespace edges_test {

using namespace io_testing;
using Catch::Contains;
using plexway::io::Edges;
using plexway::io::parse_edge_list;

namespace {

using Wires = std::vector<std::array<std::uint32_t, 2>>;
using Lengths = std::vector<double>;

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

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

}  // namespace edges_test
