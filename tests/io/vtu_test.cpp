#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/pvtu.hpp>

#include "folder.hpp"
#include "io/solid/vtu_data.hpp"
#include "tets_testing.hpp"

namespace plexway::vtu_test {

using namespace io_testing;
using Catch::Contains;

namespace {

constexpr auto parse_vtu = io_testing::tets<plexway::io::parse_vtu>;

/// Whether this build reads .vtu at all.
bool reads_vtu() {
  try {
    parse_vtu("<VTKFile/>", "probe");
  } catch (const plexway::NotBuiltError&) {
    return false;
  } catch (const plexway::InputError&) {
  }
  return true;
}

std::string base64(const std::string& bytes) {
  static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

struct Form {
  std::string format = "ascii";  ///< or binary, raw, appended (base64)
  bool big = false;
  bool long_header = false;
  bool split_header = false;  ///< base64 with the header encoded by itself
};

/// A writer that shares nothing with the library's. Two pieces: the first holds a triangle and the
/// first tetrahedron, the second the other with points of its own.
class Writer {
 public:
  explicit Writer(const Form& form) : form_(form) {}

  template <class Number>
  std::string array(const std::string& type, const std::string& name,
                    const std::vector<Number>& values, const std::string& more = "") {
    std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" " + more;
    if (form_.format == "ascii") {
      tag += " format=\"ascii\">\n";
      for (const Number value : values) {
        std::ostringstream text;
        text << +value;
        tag += text.str() + " ";
      }
      return tag + "\n</DataArray>\n";
    }
    Packer data(form_.big);
    for (const Number value : values) data.put(value);
    Packer header(form_.big);
    if (form_.long_header)
      header.put(static_cast<std::uint64_t>(data.bytes().size()));
    else
      header.put(static_cast<std::uint32_t>(data.bytes().size()));
    std::string block = header.bytes() + data.bytes();
    if (form_.format != "raw")
      block = form_.split_header ? base64(header.bytes()) + base64(data.bytes()) : base64(block);
    if (form_.format == "binary")
      return tag +
             " format=\"binary\">\n <InformationKey name=\"k\"><Value>1</Value></InformationKey>\n "
             " " +
             block + "\n</DataArray>\n";
    tag += " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
    appended_ += block;
    return tag;
  }

  std::string file() {
    const std::string three = "NumberOfComponents=\"3\"";
    std::string text =
        "<?xml version=\"1.0\"?>\n<!-- made by a test -->\n<VTKFile type=\"UnstructuredGrid\" "
        "version=\"0.1\" byte_order=\"";
    text += form_.big ? "BigEndian\"" : "LittleEndian\"";
    if (form_.long_header) text += " header_type='UInt64'";
    text +=
        ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<PointData>\n";
    text += array<double>("Float64", "types", {1, 2, 3, 4, 5});
    text += "</PointData>\n<Points>\n";
    text +=
        array<double>("Float64", "Points", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 9, 9, 9}, three);
    text += "</Points>\n<Cells>\n";
    text += array<std::int64_t>("Int64", "connectivity", {0, 1, 2, 0, 1, 2, 3});
    text += array<std::int64_t>("Int64", "offsets", {3, 7});
    text += array<std::uint8_t>("UInt8", "types", {5, 10});
    text +=
        "</Cells>\n</Piece>\n<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>\n"
        "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<Cells>\n";
    text += array<std::uint8_t>("UInt8", "types", {24});
    text += array<std::int32_t>("Int32", "offsets", {10});
    text += array<std::uint16_t>("UInt16", "connectivity", {1, 0, 2, 3, 3, 3, 3, 3, 3, 3});
    text += "</Cells>\n<Points>\n";
    text += array<float>("Float32", "P", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5F, 0.25F, -1.5F}, three);
    text += "</Points>\n</Piece>\n</UnstructuredGrid>\n";
    if (!appended_.empty())
      text += "<AppendedData encoding=\"" + std::string(form_.format == "raw" ? "raw" : "base64") +
              "\">\n  _" + appended_ + "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
  }

 private:
  Form form_;
  std::string appended_;
};

void check_pieces(const plexway::io::Tets& solid) {
  CHECK(solid.positions == Positions{{0, 0, 0},
                                     {1, 0, 0},
                                     {0, 1, 0},
                                     {0, 0, 1},
                                     {9, 9, 9},
                                     {0, 0, 0},
                                     {1, 0, 0},
                                     {0, 1, 0},
                                     {0.5, 0.25, -1.5}});
  CHECK(solid.tets == TetList{{0, 1, 2, 3}, {6, 5, 7, 8}});
}

std::string vtu_complaint(std::string_view bytes) { return complaint(parse_vtu, bytes); }

}  // namespace

TEST_CASE("vtu: ascii, base64, appended base64 and raw, either byte order and header") {
  if (!reads_vtu()) return;
  for (const std::string format : {"ascii", "binary", "raw", "appended"}) {
    for (const int bits : {0, 1, 2, 3, 4, 5, 6, 7}) {
      const Form form{format, (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
      INFO(format << " " << bits);
      check_pieces(parse_vtu(Writer(form).file(), "mesh"));
    }
  }
}

TEST_CASE("vtu: files that VTK 9.1 wrote, compressed ones among them") {
  for (const char* name : {"appended_base64.vtu", "appended_raw.vtu", "appended_zlib.vtu",
                           "inline_zlib.vtu", "xml_zlib.vtu"}) {
    INFO(name);
    const auto folder = std::filesystem::path(PLEXWAY_SOURCE_DIR) / "tests/fuzz/corpus/vtu";
    try {
      const auto solid = plexway::io::read_tets(folder / name);
      CHECK(solid.positions ==
            Positions{{0.1, 0.5, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {3, 5, 6}});
      CHECK(solid.tets == TetList{{0, 1, 2, 3}, {4, 3, 2, 1}});
    } catch (const plexway::NotBuiltError&) {
    }
  }
}

TEST_CASE("vtu: files that VTK 9.1 compressed by LZ4 and LZMA, in several blocks") {
  if (!reads_vtu()) return;
  for (const char* name :
       {"binary_lz4.vtu", "appended_lz4.vtu", "binary_lzma.vtu", "appended_lzma.vtu"}) {
    INFO(name);
    const auto file = std::filesystem::path(PLEXWAY_SOURCE_DIR) / "tests/fuzz/corpus/vtu" / name;
    try {
      const auto solid = plexway::io::read_tets(file);
      REQUIRE(solid.positions.size() == 216);
      for (std::size_t v = 0; v < 216; ++v)
        CHECK(solid.positions[v] == std::array<double, 3>{double(v % 6), double(v / 6 % 6),
                                                          static_cast<double>(v / 36) / 2});
      REQUIRE(solid.tets.size() == 750);
      CHECK(solid.tets[0] == std::array<std::uint32_t, 4>{0, 1, 7, 43});
      CHECK(solid.tets[749] == std::array<std::uint32_t, 4>{172, 208, 214, 215});
    } catch (const plexway::NotBuiltError& missing) {
      CHECK_THAT(missing.what(), Contains("install libl"));
      continue;
    }
    // Whatever stands in the blocks, it is refused or comes to as many bytes.
    std::ifstream in(file, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    std::size_t refused = 0;
    for (std::size_t at = 1100; at < whole.size() - 100; at += 97) {
      std::string bad = whole;
      bad[at] = static_cast<char>(bad[at] ^ 1);
      try {
        (void)parse_vtu(bad, "mesh");
      } catch (const plexway::InputError&) {
        ++refused;
      }
    }
    CHECK(refused > 0);
  }
}

TEST_CASE("vtu: files cut off anywhere are refused") {
  if (!reads_vtu()) return;
  for (const std::string format : {"ascii", "binary", "raw", "appended"}) {
    const std::string whole = Writer({format, false, false, false}).file();
    // An array that ends at the end of the file is whole without the closing tags behind it.
    const auto end = whole.rfind(format == "raw" || format == "appended" ? "\n</App" : "</VTK");
    for (std::size_t size = 0; size < end; ++size) {
      INFO(format << " " << size);
      REQUIRE_THAT(vtu_complaint(whole.substr(0, size)), Catch::StartsWith("mesh:"));
    }
  }
}

TEST_CASE("vtu: what is wrong is named with its line") {
  if (!reads_vtu()) return;
  const std::string ascii = Writer({}).file();
  CHECK(vtu_complaint("") == "mesh:1: the XML is broken: No document element found");
  CHECK(vtu_complaint("<a/>") == "mesh:1: expected the element VTKFile");
  CHECK(vtu_complaint("\n<VTKFile type='PolyData'/>") ==
        "mesh: has no tetrahedra; it has no cells at all");
  CHECK(vtu_complaint("<VTKFile type='UnstructuredGrid'/>") ==
        "mesh: has no tetrahedra; it has no cells at all");
  CHECK_THAT(vtu_complaint("<VTKFile>\n<Piece>\n</VTKFile>\n"),
             Catch::StartsWith("mesh:3: the XML is broken: "));
  CHECK(vtu_complaint(replaced(ascii, "LittleEndian", "Middle")) ==
        "mesh:3: the byte order is 'Middle'");
  CHECK(vtu_complaint(replaced(ascii, "\"5\" NumberOfCells", "\"x\" NumberOfCells")) ==
        "mesh:5: NumberOfPoints is not a whole number: 'x'");
  CHECK(vtu_complaint(replaced(ascii, "9 9 9", "9 9 nan")) ==
        "mesh:13: coordinate z is not finite: 'nan'");
  CHECK(vtu_complaint(replaced(ascii, "9 9 9", "9 9")) ==
        "mesh:14: the file ends before coordinate z");
  CHECK(vtu_complaint(replaced(ascii, "9 9 9", "9 9 9 9")) ==
        "mesh:13: points goes on after its last value with '9'");
  CHECK(vtu_complaint(replaced(ascii, "0 1 2 3 \n", "0 1 2 5 \n")) ==
        "mesh:18: a cell names point 5, but there are 5 points");
  CHECK(vtu_complaint(replaced(ascii, "3 7 \n", "7 3 \n")) == "mesh:21: offset 3 follows 7");
  CHECK(vtu_complaint(replaced(ascii, "5 10 \n", "10 10 \n")) ==
        "mesh:24: cell 0, a tetrahedron of type 10, has 3 points");
  CHECK(vtu_complaint(replaced(ascii, "\"connectivity\"", "\"c\"")) ==
        "mesh:5: the piece has no array 'connectivity'");
  CHECK(vtu_complaint(replaced(ascii, "\"Points\" NumberOfComponents=\"3\"", "\"Points\" ")) ==
        "mesh:12: points need NumberOfComponents=\"3\"");
  CHECK(vtu_complaint(replaced(ascii, "\"5\" NumberOfCells", "\"500\" NumberOfCells")) ==
        "mesh:12: there should be 500 points, but only 32 bytes follow");

  const std::string raw = Writer({"raw", false, false, false}).file();
  CHECK(vtu_complaint(replaced(raw, "\"offsets\"  format=\"appended\" offset=\"",
                               "\"offsets\"  format=\"appended\" offset=\"9")) ==
        "mesh:14: array 'offsets' starts at byte 9228 of 371 that are appended");
  std::string bad = raw;
  bad.replace(bad.find("  _") + 3 + 44 + 4, 8, Packer(false).put(1.0 / 0.0).bytes());
  CHECK(vtu_complaint(bad) == "mesh:10: array 'Points': byte 0: coordinate x is not finite");
  CHECK(vtu_complaint(replaced(raw, "\"5\" NumberOfCells", "\"6\" NumberOfCells")) ==
        "mesh:10: array 'Points': byte 0: there should be 6 points, but only 120 bytes follow");
  CHECK(vtu_complaint(replaced(raw, "\"5\" NumberOfCells", "\"4\" NumberOfCells")) ==
        "mesh:10: array 'Points': byte 96: points goes on for 24 bytes after its last value");
  CHECK(
      vtu_complaint(replaced(raw, "byte_order",
                             "compressor=\"vtkBlosc2DataCompressor\" "
                             "byte_order")) ==
      "mesh:10: data packed by 'vtkBlosc2DataCompressor' are not read; save the file with zlib or "
      "without compression");
  const std::string inline64 = Writer({"binary", false, false, false}).file();
  CHECK_THAT(vtu_complaint(replaced(inline64, "eAAAA", "eAAA-")),
             Contains("its base64 holds something else"));
}

TEST_CASE("vtu: without tetrahedra it says what there is") {
  if (!reads_vtu()) return;
  std::string text = replaced(Writer({}).file(), "5 10 \n", "5 9 \n");
  CHECK(vtu_complaint(replaced(text, "24 \n", "25 \n")) ==
        "mesh:32: cell 0, a hexahedron of type 25, has 10 points");
}

TEST_CASE(
    "bad vtu: what the arrays of a file unpack to is in proportion to it, shared ones included") {
  using plexway::io::decode_vtu_array;
  plexway::io::VtuEncoding encoding;
  std::string plain = {8, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8};
  std::uint64_t room = 20;
  CHECK(decode_vtu_array(plain, false, encoding, "a", room).size() == 8);
  CHECK(room == 12);
  CHECK(decode_vtu_array(plain, false, encoding, "a", room).size() == 8);
  CHECK_THROWS_WITH(
      decode_vtu_array(plain, false, encoding, "a", room),
      Contains("a: would unpack to more than the 4 bytes") && Contains("out of proportion"));
  // Thirty blocks of 64 kB in a few bytes, refused before any is unpacked.
  encoding.packing = plexway::io::VtuPacking::zlib;
  Packer header(false);
  for (const std::uint32_t n : {30u, 65536u, 0u}) header.put(n);
  for (int b = 0; b < 30; ++b) header.put(80u);
  room = 1 << 20;
  CHECK_THROWS_WITH(decode_vtu_array(header.bytes(), false, encoding, "a", room),
                    Contains("a: would unpack") || Contains("zlib1g-dev"));
  room = std::uint64_t{1} << 40;
  Packer endless(false);
  for (const std::uint32_t n : {3u, 4294967295u, 4294967295u, 1u, 1u, 1u}) endless.put(n);
  CHECK_THROWS_AS(decode_vtu_array(endless.bytes(), false, encoding, "a", room), plexway::Error);
}

namespace {

/// As ParaView writes one: ids that its point data name, and the neighbour's cell as a ghost.
std::string part(const std::string& point_data, const std::string& cell_data,
                 const std::string& types = "5 9") {
  return R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
  <UnstructuredGrid>
    <Piece NumberOfPoints="5" NumberOfCells="2">
      )" +
         point_data +
         R"(
      )" +
         cell_data +
         R"(
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
          0 0 0  1 0 0  1 1 0  0 1 0  2 0 0
        </DataArray>
      </Points>
      <Cells>
        <DataArray type="Int64" Name="connectivity" format="ascii">1 4 2 0 1 2 3</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">3 7</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">)" +
         types + R"(</DataArray>
      </Cells>
    </Piece>
  </UnstructuredGrid>
</VTKFile>
)";
}
std::string array(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + values +
         "</DataArray>";
}
using Corners = std::vector<std::array<Index, 3>>;

}  // namespace

TEST_CASE("a .pvtu names its files beside it") {
  const ::testing::Folder folder;
  const auto file = folder.write("d.pvtu", R"(<?xml version="1.0"?>
<VTKFile type="PUnstructuredGrid" version="0.1">
  <PUnstructuredGrid GhostLevel="1">
    <PPoints><PDataArray type="Float32" NumberOfComponents="3"/></PPoints>
    <Piece Source="d/d_0.vtu"/>
    <Piece Source="d/a&amp;b.vtu"/>
  </PUnstructuredGrid>
</VTKFile>
)");
  CHECK(io::read_pvtu(file) == std::vector{folder.at("d/d_0.vtu"), folder.at("d/a&b.vtu")});
  const auto refused = [&](const std::string& text, const std::string& why) {
    const auto wrong = folder.write("wrong.pvtu", text);
    CHECK_THROWS_WITH(io::read_pvtu(wrong), Catch::Contains("wrong.pvtu") && Catch::Contains(why));
    CHECK_THROWS_AS(io::read_pvtu(wrong), InputError);
  };
  refused("<VTKFile type=\"PPolyData\"/>", "'PPolyData'");
  refused("<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid/></VTKFile>", "no pieces");
  refused(
      "<VTKFile "
      "type=\"PUnstructuredGrid\"><PUnstructuredGrid>\n<Piece/></PUnstructuredGrid></VTKFile>",
      "wrong.pvtu:2: a piece has no Source");
  refused(
      "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"a.vtu\"/>\n"
      "<Piece Source=\"./a.vtu\"/></PUnstructuredGrid></VTKFile>",
      "wrong.pvtu:2: names './a.vtu' a second time");
  refused("<VTKFile", "the XML is broken");
  CHECK_THROWS_AS(io::read_pvtu(folder.at("none.pvtu")), InputError);
}

TEST_CASE("a part has the ids of its points, and not its neighbours' cells") {
  const ::testing::Folder folder;
  const auto read = [&](const std::string& text) {
    return io::read_surface_part(folder.write("part.vtu", text), 3);
  };
  const SurfaceFilePart plain = read(part("", ""));
  CHECK(plain.number == 3);
  CHECK(plain.name.ends_with("part.vtu"));
  CHECK(plain.ids.empty());
  CHECK(plain.positions.size() == 5);
  CHECK(plain.triangles == Corners{{1, 4, 2}, {0, 1, 2}, {0, 2, 3}});

  const std::vector<std::uint64_t> ids = {10, 11, 12, 13, 9'000'000'000};
  const std::string numbers = "10 11 12 13 9000000000";
  for (const std::string& data :
       {"<PointData GlobalIds=\"Ids\">" + array("Int64", "Ids", numbers) + "</PointData>",
        "<PointData>" + array("UInt32", "original", "0 1 2 3 4") +
            array("Int64", "GlobalPointIds", numbers) + "</PointData>",
        "<PointData>" + array("UInt64", "original", numbers) + "</PointData>"})
    CHECK(read(part(data, "")).ids == ids);
  CHECK(read(part("<PointData>" + array("UInt64", "original", numbers) + "</PointData>", ""))
            .ids_name == "original");
  // A duplicate cell (1), not one that is refined or hidden (8, 32); levels as they were.
  const auto with_ghosts = [&](const std::string& name, const std::string& marks) {
    return read(part("", "<CellData>" + array("UInt8", name, marks) + "</CellData>")).triangles;
  };
  CHECK(with_ghosts("vtkGhostType", "1 0") == Corners{{0, 1, 2}, {0, 2, 3}});
  CHECK(with_ghosts("vtkGhostType", "32 8").size() == 3);
  CHECK(with_ghosts("vtkGhostLevels", "0 2") == Corners{{1, 4, 2}});
  CHECK(with_ghosts("vtkGhostType", "1 1").empty());

  const auto refused = [&](const std::string& text, const std::string& why) {
    CHECK_THROWS_WITH(read(text), Catch::Contains("part.vtu") && Catch::Contains(why));
  };
  refused(part("<PointData>" + array("Int64", "original", "0 1 2 -3 4") + "</PointData>", ""),
          "is -3");
  refused(part("<PointData>" + array("Int64", "original", "0 1 2") + "</PointData>", ""),
          "5 numbers of points");
  refused(part("", "", "5 10"), "cells besides polygons");
}

}  // namespace plexway::vtu_test
