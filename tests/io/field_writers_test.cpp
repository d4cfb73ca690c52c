#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <span>
#include <sstream>

#include <plexway/error.hpp>
#include <plexway/io/field.hpp>

#include "io_testing.hpp"

namespace field_writers_test {

using namespace io_testing;
using Catch::Contains;
using plexway::io::Triangles;
using plexway::io::write_field;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

const Triangles surface = {{{0, 0, 0}, {0.1, 0, 0}, {1.0 / 3, 1e-300, -2}, {4, 5, 6}},
                           {{0, 1, 2}, {2, 1, 0}}};
const std::vector<double> distance = {0, 0.1, 2.0 / 3, inf};
const std::vector<std::int32_t> label = {0, 0, 7, -1};

/// Takes numbers off the front of bytes; the tests run on little endian machines.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {
    static_assert(std::endian::native == std::endian::little);
  }

  template <class Number>
  Number take() {
    REQUIRE(bytes_.size() >= sizeof(Number));
    Number value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return value;
  }

  template <class Number>
  std::vector<Number> take_many(std::size_t count) {
    std::vector<Number> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(take<Number>());
    return values;
  }

  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

std::string written(const std::string& name, bool with_label) {
  const Folder folder;
  write_field(folder.path() / name, surface, distance,
              with_label ? std::span<const std::int32_t>(label) : std::span<const std::int32_t>());
  CHECK(folder.files() == 1);  // no temporary file is left
  return bytes_of(folder.path() / name);
}

std::string attribute(const std::string& tag, const std::string& name) {
  const auto at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) return "";
  const auto from = at + name.size() + 3;
  return tag.substr(from, tag.find('"', from) - from);
}

template <class Failure>
std::string failure(const std::filesystem::path& file, std::span<const double> values = distance,
                    std::span<const std::int32_t> labels = {}) {
  return message_of<Failure>([&] { write_field(file, surface, values, labels); });
}

}  // namespace

TEST_CASE("field csv: the shortest numbers that read back the same, inf for unreached") {
  CHECK(written("d.csv", false) ==
        "vertex,x,y,z,distance\n0,0,0,0,0\n1,0.1,0,0,0.1\n"
        "2,0.3333333333333333,1e-300,-2,0.6666666666666666\n3,4,5,6,inf\n");
  CHECK(written("D.CSV", true) ==
        "vertex,x,y,z,distance,label\n0,0,0,0,0,0\n1,0.1,0,0,0.1,0\n"
        "2,0.3333333333333333,1e-300,-2,0.6666666666666666,7\n3,4,5,6,inf,-1\n");
}

TEST_CASE("field npy: a version 1.0 array of doubles") {
  const std::string bytes = written("d.npy", true);
  CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  Cursor cursor(std::string_view(bytes).substr(8));
  const std::size_t header = cursor.take<std::uint16_t>();
  CHECK((10 + header) % 64 == 0);
  const std::string dict = bytes.substr(10, header);
  CHECK_THAT(dict, Catch::StartsWith("{'descr': '<f8', 'fortran_order': False, 'shape': (4,), }"));
  CHECK(dict.back() == '\n');
  Cursor data(std::string_view(bytes).substr(10 + header));
  CHECK(data.take_many<double>(4) == distance);
  CHECK(data.at_end());
}

TEST_CASE("field ply: reads back as the same surface, with quality, colour and label") {
  for (const bool with_label : {false, true}) {
    const std::string bytes = written("d.ply", with_label);
    const Triangles back = io_testing::triangles<plexway::io::parse_ply>(bytes, "d.ply");
    CHECK(back.positions == surface.positions);
    CHECK(back.triangles == surface.triangles);

    const auto end = bytes.find("end_header\n") + 11;
    std::istringstream header(bytes.substr(0, end));
    std::vector<std::string> properties;
    for (std::string line; std::getline(header, line);)
      if (line.starts_with("property")) properties.push_back(line.substr(9));
    std::vector<std::string> expected = {"double x",  "double y",    "double z",  "double quality",
                                         "uchar red", "uchar green", "uchar blue"};
    if (with_label) expected.emplace_back("int label");
    expected.emplace_back("list uchar int vertex_indices");
    CHECK(properties == expected);

    Cursor cursor(std::string_view(bytes).substr(end));
    std::vector<std::vector<std::uint8_t>> colours;
    for (std::size_t i = 0; i < 4; ++i) {
      cursor.take_many<double>(3);
      CHECK(cursor.take<double>() == distance[i]);
      colours.push_back(cursor.take_many<std::uint8_t>(3));
      if (with_label) {
        CHECK(cursor.take<std::int32_t>() == label[i]);
      }
    }
    CHECK(colours[3] == std::vector<std::uint8_t>{128, 128, 128});
    const auto brightness = [&](std::size_t i) {
      return 2 * colours[i][0] + 5 * colours[i][1] + colours[i][2];
    };
    CHECK(brightness(0) < brightness(1));
    CHECK(brightness(1) < brightness(2));
  }
}

TEST_CASE("field vtu: every array lies where the XML says") {
  for (const bool with_label : {false, true}) {
    const std::string bytes = written("d.vtu", with_label);
    const auto appended = bytes.find("<AppendedData encoding=\"raw\">");
    REQUIRE(appended != std::string::npos);
    const std::string xml = bytes.substr(0, appended);
    const auto data = bytes.find('_', appended) + 1;
    CHECK_THAT(xml, Contains("type=\"UnstructuredGrid\"") && Contains("header_type=\"UInt64\"") &&
                        Contains("byte_order=\"LittleEndian\"") &&
                        Contains("NumberOfPoints=\"4\" NumberOfCells=\"2\""));
    std::map<std::string, std::string> tags;
    for (auto at = xml.find("<DataArray"); at != std::string::npos;
         at = xml.find("<DataArray", at + 1)) {
      const std::string tag = xml.substr(at, xml.find("/>", at) - at);
      tags[attribute(tag, "Name")] = tag;
    }
    CHECK(tags.size() == (with_label ? 6 : 5));

    std::size_t end = data;
    const auto block = [&](const std::string& name, const std::string& type, std::uint64_t size) {
      INFO(name);
      CHECK(attribute(tags[name], "type") == type);
      CHECK(attribute(tags[name], "format") == "appended");
      const auto from = data + std::stoull(attribute(tags[name], "offset"));
      Cursor cursor(std::string_view(bytes).substr(from));
      CHECK(cursor.take<std::uint64_t>() == size);
      end = std::max<std::size_t>(end, from + 8 + size);
      return cursor;
    };
    CHECK(block("distance", "Float64", 32).take_many<double>(4) == distance);
    if (with_label) {
      CHECK(block("label", "Int32", 16).take_many<std::int32_t>(4) == label);
    }
    CHECK(attribute(tags["Points"], "NumberOfComponents") == "3");
    auto points = block("Points", "Float64", 96);
    for (const auto& position : surface.positions)
      for (const double c : position) CHECK(points.take<double>() == c);
    CHECK(block("connectivity", "Int64", 48).take_many<std::int64_t>(6) ==
          std::vector<std::int64_t>{0, 1, 2, 2, 1, 0});
    CHECK(block("offsets", "Int64", 16).take_many<std::int64_t>(2) ==
          std::vector<std::int64_t>{3, 6});
    CHECK(block("types", "UInt8", 2).take_many<std::uint8_t>(2) == std::vector<std::uint8_t>{5, 5});
    CHECK(bytes.substr(end) == "\n  </AppendedData>\n</VTKFile>\n");
  }
}

TEST_CASE("write_field: every sample of the tree survives the way through a file") {
  const Folder folder;
  for (const char* name : {"knot.ply", "torus.obj", "hills.off", "ell.obj", "slit.off",
                           "moebius.obj", "two_parts.obj", "box.stl"}) {
    INFO(name);
    const auto file = std::filesystem::path(PLEXWAY_SOURCE_DIR) / "data" / name;
    const Triangles mesh = plexway::io::read_triangles(file);
    const std::vector<double> zero(mesh.positions.size(), 0.0);
    write_field(folder.path() / "out.ply", mesh, zero);
    const Triangles back = plexway::io::read_triangles(folder.path() / "out.ply");
    CHECK(back.positions == mesh.positions);
    CHECK(back.triangles == mesh.triangles);
  }
}

TEST_CASE("write_field: wrong calls") {
  const Folder folder;
  using plexway::UsageError;
  CHECK(failure<UsageError>(folder.path() / "d.xyz") ==
        (folder.path() / "d.xyz").string() +
            ": unknown extension '.xyz'; known are .csv .npy .gii .ply .vtk .vtu .glb .gltf");
  const std::vector<double> short_one(3);
  CHECK_THAT(failure<UsageError>(folder.path() / "d.csv", short_one),
             Contains("3 distances for 4 vertices"));
  const std::vector<std::int32_t> labels(5);
  CHECK_THAT(failure<UsageError>(folder.path() / "d.csv", distance, labels),
             Contains("5 labels for 4 vertices"));
  CHECK(folder.files() == 0);
  CHECK(plexway::io::field_extensions().size() == 8);
}

TEST_CASE("write_field: what the system refuses is told, and leaves nothing behind") {
  const Folder folder;
  const auto none = folder.path() / "none" / "d.csv";
  CHECK(failure<plexway::Error>(none) ==
        "cannot write " + none.string() + ": No such file or directory");
  const auto directory = folder.path() / "d.csv";
  std::filesystem::create_directory(directory);
  CHECK(failure<plexway::Error>(directory) ==
        "cannot write " + directory.string() + ": Is a directory");
  CHECK(folder.files() == 1);

  if (std::filesystem::exists("/dev/full")) {
    for (const char* name : {"full.csv", "full.npy", "full.ply", "full.vtk", "full.vtu"}) {
      const auto full = folder.path() / name;
      std::filesystem::create_symlink("/dev/full", full);
      CHECK(failure<plexway::Error>(full) ==
            "cannot write " + full.string() + ": No space left on device");
    }
    CHECK(std::filesystem::is_character_file("/dev/full"));
    CHECK(folder.files() == 6);
  }
}

TEST_CASE("write_field: an old file is replaced whole, links stay links") {
  const Folder folder;
  const auto file = folder.write("d.csv", std::string(100000, 'x'));
  const auto link = folder.path() / "link.csv";
  std::filesystem::create_symlink("d.csv", link);
  write_field(link, surface, distance);
  CHECK(std::filesystem::is_symlink(link));
  CHECK_THAT(bytes_of(file), Catch::StartsWith("vertex,x,y,z,distance\n") && !Contains("xx"));
  CHECK(folder.files() == 2);
}

TEST_CASE("write_field: more than a buffer's worth") {
  const Folder folder;
  Triangles strip;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    strip.positions.push_back({i * 0.5, i % 2 * 1.0, 1.0 / (i + 1)});
    if (i >= 2) strip.triangles.push_back({i - 2, i - 1, i});
  }
  const std::vector<double> far(strip.positions.size(), 0.25);
  write_field(folder.path() / "d.ply", strip, far);
  const Triangles back = plexway::io::read_triangles(folder.path() / "d.ply");
  CHECK(back.positions == strip.positions);
  CHECK(back.triangles == strip.triangles);
  write_field(folder.path() / "d.csv", strip, far);
  std::istringstream csv(bytes_of(folder.path() / "d.csv"));
  std::string line;
  std::getline(csv, line);
  for (const auto& [x, y, z] : strip.positions) {
    std::getline(csv, line);
    double a = 0;
    double b = 0;
    double c = 0;
    REQUIRE(std::sscanf(line.c_str(), "%*d,%lf,%lf,%lf,0.25", &a, &b, &c) == 3);
    REQUIRE((a == x && b == y && c == z));
  }
}

TEST_CASE("an estimate of the error is a column behind all others") {
  const std::vector<double> error = {0, 0.25, 1.0 / 3, 0};
  const Folder folder;
  const auto with = [&](const char* name) {
    write_field(folder.path() / name, surface, distance, label, error);
    return bytes_of(folder.path() / name);
  };
  const auto bytes = [&](bool turned) {
    std::string all;
    for (const double e : error) {
      std::string one(sizeof e, '\0');
      std::memcpy(one.data(), &e, sizeof e);
      if (turned) std::reverse(one.begin(), one.end());
      all += one;
    }
    return all;
  };
  CHECK(with("d.csv") ==
        "vertex,x,y,z,distance,label,error\n0,0,0,0,0,0,0\n1,0.1,0,0,0.1,0,0.25\n"
        "2,0.3333333333333333,1e-300,-2,0.6666666666666666,7,0.3333333333333333\n"
        "3,4,5,6,inf,-1,0\n");
  const std::string ply = with("d.ply");
  CHECK_THAT(ply, Contains("property int label\nproperty double error\nelement face"));
  Cursor cursor(std::string_view(ply).substr(ply.find("end_header\n") + 11));
  for (const double e : error) {
    cursor.take_many<double>(4);
    cursor.take_many<std::uint8_t>(3);
    cursor.take<std::int32_t>();
    CHECK(cursor.take<double>() == e);
  }
  CHECK_THAT(with("d.vtu"), Contains("Name=\"error\"") && Contains(bytes(false)));
  CHECK_THAT(with("d.vtk"), Contains("FIELD FieldData 2\nlabel 1 4 int\n") &&
                                Contains("\nerror 1 4 double\n" + bytes(true)));
  CHECK_THAT(with("d.gltf"), Contains("_ERROR"));
  CHECK(with("d.npy") == written("d.npy", true));
  CHECK_THROWS_AS(write_field(folder.path() / "e.csv", surface, distance, {}, {error.data(), 3}),
                  plexway::UsageError);
}

}  // namespace field_writers_test
