#include <catch2/catch.hpp>
#include <limits>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>

#include "io/io_testing.hpp"
#include "tets_testing.hpp"

namespace plexway::field_domains_test {

using namespace io_testing;
using plexway::io::Edges;
using plexway::io::Tets;
using plexway::io::Triangles;
using plexway::io::write_field;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
const Tets solid = {two_positions, two_tets};
const std::vector<double> distance = {0, 1, 0.5, inf, 1e-3, 2};
const std::vector<std::int32_t> label = {0, -1, 2, 3, 4, 70000};

template <class Domain>
std::string written(const std::string& name, const Domain& domain,
                    std::span<const std::int32_t> labels = label) {
  const Folder folder;
  write_field(folder.path() / name, domain, distance, labels);
  CHECK(folder.files() == 1);
  return bytes_of(folder.path() / name);
}

/// The legacy file that `written` must be, byte by byte.
std::string legacy(const std::string& cells, const std::vector<std::int32_t>& numbers,
                   const std::vector<std::int32_t>& types, bool with_label) {
  Packer points(true);
  for (const auto& position : two_positions)
    for (const double c : position) points.put(c);
  Packer list(true);
  for (const std::int32_t n : numbers) list.put(n);
  Packer kinds(true);
  for (const std::int32_t t : types) kinds.put(t);
  Packer values(true);
  for (const double d : distance) values.put(d);
  Packer labels(true);
  for (const std::int32_t l : label) labels.put(l);
  return "# vtk DataFile Version 3.0\nwritten by plexway\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 6 double\n" +
         points.bytes() + "\nCELLS " + cells + "\n" + list.bytes() + "\nCELL_TYPES " +
         std::to_string(types.size()) + "\n" + kinds.bytes() +
         "\nPOINT_DATA 6\nSCALARS distance double 1\nLOOKUP_TABLE default\n" + values.bytes() +
         (with_label ? "\nFIELD FieldData 1\nlabel 1 6 int\n" + labels.bytes() : "") + "\n";
}

template <class Domain>
std::string misuse(const std::string& name, const Domain& domain, std::size_t values) {
  const Folder folder;
  try {
    write_field(folder.path() / name, domain, std::vector<double>(values));
  } catch (const plexway::UsageError& error) {
    CHECK(folder.files() == 0);
    std::string message = error.what();
    const auto at = message.find(folder.path().string());
    if (at == 0) message.erase(0, folder.path().string().size() + 1);
    return message;
  }
  return "no failure";
}

}  // namespace

TEST_CASE("field vtk: surfaces, solids and wireframes, byte by byte") {
  CHECK(written("d.vtk", solid) == legacy("2 10", {4, 0, 1, 2, 3, 4, 1, 0, 2, 5}, {10, 10}, true));
  CHECK(written("D.VTK", solid, {}) ==
        legacy("2 10", {4, 0, 1, 2, 3, 4, 1, 0, 2, 5}, {10, 10}, false));
  const Triangles surface = {two_positions, {{0, 1, 2}}};
  CHECK(written("d.vtk", surface) == legacy("1 4", {3, 0, 1, 2}, {5}, true));
  const Edges wires = {two_positions, {{0, 1}, {5, 2}}, {}, 6};
  CHECK(written("d.vtk", wires) == legacy("2 6", {2, 0, 1, 2, 5, 2}, {3, 3}, true));
}

TEST_CASE("field vtu: what is written of a solid reads back") {
  const std::string bytes = written("d.vtu", solid);
  CHECK(bytes.find("NumberOfPoints=\"6\" NumberOfCells=\"2\"") != std::string::npos);
  try {
    check_two(io_testing::tets<plexway::io::parse_vtu>(bytes, "d.vtu"));
  } catch (const plexway::NotBuiltError&) {
  }
}

TEST_CASE("field ply: a solid's vertices alone, a wireframe's edges") {
  const std::string points = written("d.ply", solid);
  const std::string head = points.substr(0, points.find("end_header\n") + 11);
  CHECK(head.find("element vertex 6\n") != std::string::npos);
  CHECK(head.find("element face") == std::string::npos);
  CHECK(points.size() == head.size() + 6 * (4 * 8 + 3 + 4));

  const Edges wires = {two_positions, {{0, 1}, {5, 2}}, {}, 6};
  const std::string edges = written("d.ply", wires, {});
  CHECK(edges.find("element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n") !=
        std::string::npos);
  CHECK(edges.substr(edges.size() - 16) == Packer(false)
                                               .put(std::int32_t{0})
                                               .put(std::int32_t{1})
                                               .put(std::int32_t{5})
                                               .put(std::int32_t{2})
                                               .bytes());
}

TEST_CASE("field: a wireframe without positions") {
  const Edges wires = {{}, {{0, 1}, {5, 2}}, {1.5, 2}, 6};
  CHECK(written("d.csv", wires) ==
        "vertex,distance,label\n0,0,0\n1,1,-1\n2,0.5,2\n3,inf,3\n4,0.001,4\n5,2,70000\n");
  CHECK(written("d.csv", wires, {}) == "vertex,distance\n0,0\n1,1\n2,0.5\n3,inf\n4,0.001\n5,2\n");
  const std::string npy = written("d.npy", wires);
  CHECK(npy.find("(6,)") != std::string::npos);
  // 0, 1 and the like in single precision, little endian.
  const std::string gii = written("d.func.gii", wires);
  CHECK(gii.find("NumberOfDataArrays=\"2\"") != std::string::npos);
  CHECK(gii.find("<![CDATA[distance]]>") <
        gii.find("<Data>AAAAAAAAgD8AAAA/AACAf28SgzoAAABA</Data>"));
  CHECK(gii.find("<![CDATA[label]]>") < gii.find("<Data>AAAAAAAAgL8AAABAAABAQAAAgEAAuIhH</Data>"));
  for (const std::string name : {"d.ply", "d.vtk", "d.vtu"})
    CHECK(misuse(name, wires, 6) ==
          name + ": " + name.substr(1) +
              " needs positions, and these vertices have none; .csv, .npy and .gii do without");
  CHECK(misuse("d.csv", wires, 5) == "write_field: 5 distances for 6 vertices");
  CHECK(misuse("d.csv", solid, 7) == "write_field: 7 distances for 6 vertices");
}

TEST_CASE("field csv and npy: a solid") {
  const std::string csv = written("d.csv", solid);
  CHECK_THAT(csv, Catch::StartsWith("vertex,x,y,z,distance,label\n0,0,0,0,0,0\n1,1,0,0,1,-1\n"));
  CHECK(csv.find("\n5,0.5,0.25,-1.5,2,70000\n") != std::string::npos);
}

namespace {

const std::vector<std::array<double, 3>> block = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<std::array<double, 3>> plate = {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
const std::vector<std::array<double, 3>> rod = {{2, 0, 0}, {3, 0, 0}};
const std::vector<std::array<std::uint32_t, 4>> tets = {{0, 1, 2, 3}};
const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
const std::vector<std::array<std::uint32_t, 2>> edges = {{0, 1}};
const std::vector<double> of_parts = {
    0, 1, 1, 1, 1, 2, 2, 2, std::numeric_limits<double>::infinity()};

}  // namespace

TEST_CASE("the parts of a mixed domain lie in one file") {
  const io_testing::Folder folder;
  const io::MixedPart parts[] = {{.positions = block, .tets = tets},
                                 {.positions = plate, .triangles = triangles},
                                 {.positions = rod, .edges = edges}};
  for (const char* extension : {".vtu", ".vtk"}) {
    const auto file = folder.path() / (std::string("mixed") + extension);
    io::write_field(file, parts, of_parts);
    const io::Tets back = io::read_tets(file);  // passes over what is no tetrahedron
    REQUIRE(back.positions.size() == 9);
    CHECK(back.positions[4] == plate[0]);
    CHECK(back.positions[8] == rod[1]);
    CHECK(back.tets == tets);
  }
  const auto text = folder.path() / "mixed.ply";
  io::write_field(text, parts, of_parts);
  const io::Triangles faces = io::read_triangles(text);
  CHECK(faces.positions.size() == 9);
  CHECK(faces.triangles == std::vector<std::array<std::uint32_t, 3>>{{4, 5, 6}});
}

TEST_CASE("a part of a mixed domain that names a vertex it lacks is refused") {
  const io_testing::Folder folder;
  const std::vector<std::array<std::uint32_t, 2>> wrong = {{0, 2}};
  const io::MixedPart parts[] = {{.positions = rod, .edges = wrong}};
  const std::vector<double> two = {0, 1};
  CHECK_THROWS_AS(io::write_field(folder.path() / "x.vtu", parts, two), UsageError);
  const io::MixedPart right[] = {{.positions = rod, .edges = edges}};
  CHECK_THROWS_AS(io::write_field(folder.path() / "x.vtu", right, of_parts), UsageError);
}

}  // namespace plexway::field_domains_test
