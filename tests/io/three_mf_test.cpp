// .3mf: objects, components, transforms, several models; archives that are broken or bombs.

#include <utility>

#include <plexway/io/mixed.hpp>

#include "io/matrix/npy.hpp"
#include "io_testing.hpp"

namespace three_mf_test {

using namespace io_testing;
using namespace plexway;
using Catch::Contains;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;

// A zip archive of files that are stored as they are.
std::string archive(const Files& files) {
  const Folder folder;
  io::OutputFile out(folder.at("a.zip"));
  io::StoredZip zip(out);
  for (const auto& [name, text] : files) {
    io::Crc32 crc;
    crc.add(text);
    zip.begin_file(name, text.size(), crc.value());
    zip.write(text);
  }
  zip.finish();
  out.commit();
  return bytes_of(folder.at("a.zip"));
}

const std::string relations =
    R"(<?xml version="1.0"?><Relationships><Relationship Id="r" Target="/3D/main.model" )"
    R"(Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>)";
const std::string mesh =
    R"(<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>)"
    R"(<vertex x="0" y="2e0" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/>)"
    R"(</triangles></mesh>)";

std::string model(const std::string& resources, const std::string& build,
                  const std::string& attributes = "") {
  return R"(<model unit="millimeter" )" + attributes + "><resources>" + resources +
         "</resources><build>" + build + "</build></model>";
}
std::string object(const std::string& id, const std::string& holds) {
  return R"(<object type="model" id=")" + id + "\">" + holds + "</object>";
}
std::string packed(const std::string& main, Files others = {}) {
  others.insert(others.begin(), {{"_rels/.rels", relations}, {"3D/main.model", main}});
  return archive(others);
}

// An archive whose only file is `count` times '<': `(count - 1) / 258` repeats of the first.
std::string deflated_archive(const std::string& name, std::size_t repeats) {
  std::string packed;
  int used = 0;
  const auto bit = [&](unsigned one) {
    if (used == 0) packed += '\0';
    packed.back() = static_cast<char>(packed.back() | static_cast<char>(one << used));
    used = (used + 1) % 8;
  };
  const auto code = [&](unsigned bits, int length) {  // from its highest bit on
    while (length-- > 0) bit((bits >> length) & 1U);
  };
  code(0b110, 3);       // the last block, of fixed codes
  code(0x30 + '<', 8);  // one letter
  for (std::size_t i = 0; i < repeats; ++i) code(0b11000101'00000, 13);  // 258 from one back
  code(0, 7);
  const std::string text(1 + 258 * repeats, '<');
  io::Crc32 crc;
  crc.add(text);
  const auto u16 = [](std::size_t x) { return static_cast<std::uint16_t>(x); };
  const auto u32 = [](std::size_t x) { return static_cast<std::uint32_t>(x); };
  const auto common = [&](Packer& out) {  // from the version to the length of the extra field
    out.put(u16(20)).put(u16(0)).put(u16(8)).put(u32(0)).put(u32(crc.value()));
    out.put(u32(packed.size())).put(u32(text.size())).put(u16(name.size())).put(u16(0));
  };
  Packer local(false), central(false), end(false);
  common(local.put(u32(0x04034b50)));
  common(central.put(u32(0x02014b50)).put(u16(20)));
  central.put(u16(0)).put(u16(0)).put(u16(0)).put(u32(0)).put(u32(0));
  const std::string front = local.bytes() + name + packed, directory = central.bytes() + name;
  end.put(u32(0x06054b50)).put(u32(0)).put(u16(1)).put(u16(1));
  end.put(u32(directory.size())).put(u32(front.size())).put(u16(0));
  return front + directory + end.bytes();
}

// False where this build lacks pugixml or zlib.
bool reads_three_mf() {
  try {
    (void)io::parse_three_mf(packed(model(object("1", mesh), R"(<item objectid="1"/>)")), "f");
    return true;
  } catch (const NotBuiltError&) {
    return false;
  }
}
std::string said(const std::string& main) { return complaint(io::parse_three_mf, packed(main)); }

}  // namespace

TEST_CASE("3MF is all items of the build, where transforms put them and their components") {
  if (!reads_three_mf()) return;
  // A quarter turn about z, twice as large, then a shift; points are rows.
  const std::string pair =
      R"(<components><component objectid="1" transform="0 2 0 -2 0 0 0 0 2 10 0 0"/>)"
      R"(<component objectid="1"/></components>)";
  const io::Triangles all =
      io::parse_three_mf(packed(model(object("1", mesh) + object("2", pair),
                                      R"(<item objectid="2" transform="1 0 0 0 1 0 0 0 1 0 0 5"/>)"
                                      R"(<item objectid="1"/>)")),
                         "f");
  CHECK(all.triangles == Faces{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}});
  CHECK(all.positions == Positions{{10, 0, 5},
                                   {10, 2, 5},
                                   {6, 0, 5},
                                   {0, 0, 5},
                                   {1, 0, 5},
                                   {0, 2, 5},
                                   {0, 0, 0},
                                   {1, 0, 0},
                                   {0, 2, 0}});
  // Slicers keep meshes in models of their own, and other namespaces have prefixes.
  const std::string elsewhere =
      R"(<components><component p:path="/3D/Objects/Part.model" objectid="1"/></components>)";
  const io::Triangles parts = io::parse_three_mf(
      packed(model(object("1", elsewhere), R"(<item objectid="1"/>)",
                   R"(xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" )"
                   R"(requiredextensions="p")"),
             {{"3D/objects/part.model", model(object("1", mesh), "")}}),
      "f");
  CHECK(parts.triangles == Faces{{0, 1, 2}});
  // A model without a unit is in millimeters, and a number too small for a double is 0.
  const auto unitless = replaced(model(object("1", mesh), ""), R"(unit="millimeter")", "");
  CHECK(io::parse_three_mf(packed(model(object("1", elsewhere), R"(<item objectid="1"/>)"),
                                  {{"3D/objects/part.model", replaced(unitless, "2e0", "1e-400")}}),
                           "f")
            .positions[2] == std::array<double, 3>{0, 0, 0});
  // In a mirror triangles still look outwards.
  CHECK(io::parse_three_mf(
            packed(model(object("1", mesh),
                         R"(<item objectid="1" transform="1 0 0 0 1 0 0 0 -1 0 0 0"/>)")),
            "f")
            .triangles == Faces{{0, 2, 1}});
  // Supports, and what else does not belong to the surface.
  std::string helps = R"(<components><component objectid="1"/>)", helpers = object("1", mesh);
  for (const std::string type : {"support", "solidsupport", "other", "surface"}) {
    helps += R"(<component objectid=")" + type + R"("/>)";
    helpers += replaced(object(type, mesh), R"("model")", "\"" + type + "\"");
  }
  const io::Triangles printed = io::parse_three_mf(
      packed(model(helpers + object("all", helps + "</components>"), R"(<item objectid="all"/>)")),
      "f");
  CHECK(printed.triangles == Faces{{0, 1, 2}, {3, 4, 5}});
  CHECK(printed.report.passed_over_text() ==
        "1 objects of type support, 1 objects of type solidsupport, 1 objects of type other");
  // By its name or by its first bytes.
  const Folder folder;
  const std::string one = packed(model(object("1", mesh), R"(<item objectid="1"/>)"));
  for (const char* name : {"a.3mf", "a.what"})
    CHECK(io::read_cells(folder.write(name, one)).triangles.size() == 1);
}

TEST_CASE("3MF as other programs pack it") {
  if (!reads_three_mf()) return;
  const std::string corpus = std::string(PLEXWAY_SOURCE_DIR) + "/tests/fuzz/corpus/three_mf/";
  const io::Mixed library = io::read_cells(corpus + "lib3mf.3mf");
  CHECK(library.positions.size() == 8);
  CHECK(library.triangles.size() == 12);
  const io::Mixed deflated = io::read_cells(corpus + "deflated.3mf");
  CHECK(deflated.triangles.size() == 800);
  CHECK(deflated.report.passed_over_text() == "2 beams, 1 stacks of slices");
}

TEST_CASE("3MF that is broken, or asks for more than it is worth, is refused in one line") {
  if (!reads_three_mf()) return;
  const std::string item = R"(<item objectid="1"/>)";
  const std::string good = packed(model(object("1", mesh), item));
  CHECK_THAT(complaint(io::parse_three_mf, "PK\x03\x04"), Contains("has no directory"));
  CHECK_THAT(complaint(io::parse_three_mf, archive({{"a.txt", "a"}})),
             Contains("is a zip archive without '_rels/.rels'"));
  CHECK_THAT(complaint(io::parse_three_mf, archive({{"_rels/.rels", "<a/>"}})),
             Contains("names no 3D model"));
  CHECK_THAT(complaint(io::parse_three_mf, replaced(good, "v3=\"2\"", "v3=\"1\"")),
             Contains("is damaged (size or checksum)"));
  for (std::size_t size = 0; size < good.size(); size += 7)
    CHECK_FALSE(complaint(io::parse_three_mf, good.substr(0, size)).empty());
  const auto broken = [&](const std::string& from, const std::string& to) {
    return said(model(object("1", replaced(mesh, from, to)), item));
  };
  CHECK_THAT(broken("v3=\"2\"", "v3=\"3\""),
             Contains("triangle 0 names vertex 3, but the file has 3 vertices"));
  CHECK_THAT(broken("v3=\"2\"", "v3=\"two\""), Contains("v3 is not a whole number: 'two'"));
  CHECK_THAT(broken("2e0", "nan"), Contains("vertex 2: y is not finite: 'nan'"));
  CHECK_THAT(broken("2e0", ""), Contains("vertex 2: y is missing"));
  for (const char* other : {"2#0", "2 0", "+-2", "2e0x"})
    CHECK_THAT(broken("2e0", other), Contains("vertex 2: "));
  CHECK_THAT(broken("</mesh>", ""), Contains("not whole XML"));
  CHECK_THAT(said(model(object("1", ""), item)), Contains("object '1' has no mesh"));
  CHECK_THAT(said(model(object("2", mesh), item)),
             Contains("refers to object '1', which does not exist"));
  CHECK_THAT(said(model(object("1", mesh), "")), Contains("has no faces"));
  CHECK_THAT(said(model(object("1", mesh), R"(<item objectid="1" transform="1 0 0"/>)")),
             Contains("one of a transform's 12 numbers is missing"));
  CHECK_THAT(said(model(object("1", mesh), item, R"(requiredextensions="sc" xmlns:sc="a/secure")")),
             Contains("needs the extension 'a/secure'"));
  CHECK_THAT(said(model(object("1", mesh), item,
                        "requiredextensions=\"p\tsc\" xmlns:p=\"a/production/\" "
                        R"(xmlns:sc="a/secure")")),
             Contains("needs the extension 'a/secure'"));
  CHECK_THAT(broken("2e0", "1e400"), Contains("vertex 2: y is not finite: '1e400'"));
  CHECK_THAT(said(model(object("1", mesh) + object("1", mesh), item)),
             Contains("has two objects '1'"));
  CHECK_THAT(complaint(io::parse_three_mf, archive({{"a.txt", "a"}, {"A.txt", "a"}})),
             Contains("has two files 'A.txt'"));
  // A tree of XML is larger than its text.
  CHECK_THAT(complaint(io::parse_three_mf, deflated_archive("_rels/.rels", 1)),
             Contains("not whole XML"));
  CHECK_THAT(complaint(io::parse_three_mf, deflated_archive("_rels/.rels", 17000)),
             Contains("more XML than an archive of this size"));
  const Folder folder;
  const auto file = folder.write("a.3mf", good);
  if (std::system(("gzip -nk " + file.string()).c_str()) == 0)
    CHECK_THAT(complaint_of(io::read_cells, file.string() + ".gz"), Contains("already packed"));
  // Round in a circle, and two to the power of thirty times.
  CHECK_THAT(
      said(model(object("1", R"(<components><component objectid="1"/></components>)"), item)),
      Contains("repeat each other"));
  std::string twice = object("0", mesh);
  for (int i = 1; i <= 30; ++i) {
    const std::string one = "<component objectid=\"" + std::to_string(i - 1) + "\"/>";
    twice += object(std::to_string(i), "<components>" + one + one + "</components>");
  }
  CHECK_THAT(said(model(twice, R"(<item objectid="30"/>)")), Contains("repeat each other"));
  // Many names for one packed file, which says that it comes to much.
  CHECK_THAT(complaint_of(io::read_cells,
                          std::string(PLEXWAY_SOURCE_DIR) + "/tests/fuzz/corpus/three_mf/bomb.3mf"),
             Contains("unpacks to more than 16 MiB plus 50 times its size"));
}

}  // namespace three_mf_test
