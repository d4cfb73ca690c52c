// What no path leads to, in every format that results are written in, read back from the bytes as
// docs/reference/formats.md says.

#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include <plexway/io/field.hpp>

#include "io/base64.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace unreached_test {

using namespace cli_testing;
using io_testing::bytes_of;
using io_testing::Folder;
using Json = nlohmann::json;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

template <class Number>
Number number_at(const std::string& bytes, std::size_t at, bool big_endian = false) {
  REQUIRE(at + sizeof(Number) <= bytes.size());
  std::array<char, sizeof(Number)> raw;
  for (std::size_t k = 0; k < raw.size(); ++k)
    raw[big_endian ? raw.size() - 1 - k : k] = bytes[at + k];
  return std::bit_cast<Number>(raw);
}

template <class Number>
std::vector<double> numbers_at(const std::string& bytes, std::size_t at, std::size_t count,
                               std::size_t stride, bool big_endian = false) {
  std::vector<double> found;
  for (std::size_t k = 0; k < count; ++k)
    found.push_back(static_cast<double>(number_at<Number>(bytes, at + k * stride, big_endian)));
  return found;
}

/// Where what follows the words begins.
std::size_t after(const std::string& bytes, const std::string& words, std::size_t from = 0) {
  const std::size_t at = bytes.find(words, from);
  INFO("looking for '" << words << "'");
  REQUIRE(at != bytes.npos);
  return at + words.size();
}

std::vector<double> in_npy(const std::string& bytes) {
  const std::size_t data = 10 + number_at<std::uint16_t>(bytes, 8);
  REQUIRE(bytes.substr(0, data).find("'<f8'") != bytes.npos);
  return numbers_at<double>(bytes, data, (bytes.size() - data) / 8, 8);
}

std::vector<double> in_ply(const std::string& bytes) {
  const std::size_t data = after(bytes, "end_header\n");
  const std::map<std::string, std::size_t> sizes = {{"double", 8}, {"uchar", 1}, {"int", 4}};
  std::istringstream head(bytes.substr(0, data));
  std::size_t count = 0, stride = 0, place = 0;
  bool of_vertices = false;
  for (std::string line; std::getline(head, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "element") {
      of_vertices = second == "vertex";
      if (of_vertices) count = std::stoul(third);
    } else if (first == "property" && of_vertices) {
      if (third == "quality") place = stride;
      stride += sizes.at(second);
    }
  }
  REQUIRE(place > 0);
  return numbers_at<double>(bytes, data + place, count, stride);
}

std::vector<double> in_vtu(const std::string& bytes) {
  const std::size_t array = after(bytes, "Name=\"distance\"");
  const std::size_t offset = std::stoul(bytes.substr(after(bytes, "offset=\"", array)));
  const std::size_t raw = after(bytes, "_", after(bytes, "<AppendedData encoding=\"raw\">"));
  const std::size_t size = number_at<std::uint64_t>(bytes, raw + offset);
  return numbers_at<double>(bytes, raw + offset + 8, size / 8, 8);
}

std::vector<double> in_vtk(const std::string& bytes) {
  const std::size_t count = std::stoul(bytes.substr(after(bytes, "POINT_DATA ")));
  const std::size_t data = after(bytes, "SCALARS distance double 1\nLOOKUP_TABLE default\n");
  return numbers_at<double>(bytes, data, count, 8, true);
}

/// -1 stands for unreached there, since glTF knows no infinity; anything else below 0 is wrong.
std::vector<double> in_gltf(const std::string& bytes) {
  Json json;
  std::string data;
  if (bytes.starts_with("glTF")) {
    const auto length = number_at<std::uint32_t>(bytes, 12);
    json = Json::parse(bytes.substr(20, length));
    data = bytes.substr(20 + length + 8);
  } else {
    json = Json::parse(bytes);
    const std::string uri = json["buffers"][0]["uri"];
    REQUIRE(plexway::io::decode_base64(uri.substr(after(uri, ";base64,")), data));
  }
  const std::size_t n = json["meshes"][0]["primitives"][0]["attributes"]["_DISTANCE"];
  const Json accessor = json["accessors"][n];
  REQUIRE(accessor["componentType"] == 5126);  // float
  const Json view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  auto found = numbers_at<float>(
      data, view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0}),
      accessor["count"], 4);
  for (double& d : found) {
    CHECK((d >= 0 || d == -1));
    if (d == -1) d = inf;
  }
  return found;
}

std::vector<double> in_gii(const std::string& bytes) {
  REQUIRE(bytes.find("DataType=\"NIFTI_TYPE_FLOAT32\"") != bytes.npos);
  REQUIRE(bytes.find("Encoding=\"Base64Binary\" Endian=\"LittleEndian\"") != bytes.npos);
  const std::size_t from = after(bytes, "<Data>");
  std::string data;
  REQUIRE(plexway::io::decode_base64(bytes.substr(from, bytes.find('<', from) - from), data));
  return numbers_at<float>(data, 0, data.size() / 4, 4);
}

std::vector<double> in_csv(const std::string& bytes) { return csv_column(bytes, "distance"); }

using Reader = std::vector<double> (*)(const std::string&);
const std::map<std::string, Reader> readers = {
    {".csv", in_csv}, {".npy", in_npy}, {".gii", in_gii},  {".ply", in_ply},
    {".vtu", in_vtu}, {".vtk", in_vtk}, {".glb", in_gltf}, {".gltf", in_gltf}};

struct Case {
  std::string kind;
  std::vector<std::string> arguments;
  std::vector<double> truth;
};

const std::string square_and_triangle =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 9 9 9\n"
    "f 1 2 3\nf 1 3 4\nf 5 6 7\n";
const std::string two_lines = "v 0 0 0\nv 0 0 2\nv 3 0 0\nv 4 0 0\nl 1 2\nl 3 4\n";
const std::string two_tets =
    "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "5 0 0 0\n6 0 0 0\n5 1 0 0\n5 0 1 0\nTetrahedra\n2\n1 2 3 4 0\n5 6 7 8 0\nEnd\n";

}  // namespace

TEST_CASE("unreached: inf in every format, -1 in glTF, as the page of formats says") {
  const Folder in;
  const std::string surface = in.write("surface.obj", square_and_triangle).string();
  const std::string wires = in.write("wires.obj", two_lines).string();
  const std::string solid = in.write("solid.mesh", two_tets).string();
  std::string points;
  for (const int x : {0, 100})
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j)
        points += std::to_string(x + i) + ' ' + std::to_string(j) + " 0\n";
  std::vector<double> of_points;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) of_points.push_back(std::hypot(i, j));
  of_points.resize(50, inf);
  const std::vector<Case> cases = {
      {"surface", {surface}, {0, 1, std::sqrt(2), 1, inf, inf, inf, inf}},
      {"wires", {wires}, {0, 2, inf, inf}},
      {"solid", {solid}, {0, 1, 1, 1, inf, inf, inf, inf}},
      {"cloud", {in.write("cloud.xyz", points).string(), "--k", "8"}, of_points},
      {"mixed",
       {surface, wires, "--weld", "0"},
       {0, 1, std::sqrt(2), 1, inf, inf, inf, inf, 0, 2, inf, inf}},
  };
  for (const std::string_view extension : plexway::io::field_extensions())
    CHECK(readers.contains(std::string(extension)));
  for (const Case& it : cases)
    for (const auto& [extension, read] : readers) {
      const Folder out;
      const std::string file = out.at("d" + extension).string();
      std::vector<std::string> arguments = it.arguments;
      arguments.insert(arguments.begin(), "distance");
      arguments.insert(arguments.end(),
                       {"--source", "vertex:0", "--precision", "double", "--quiet", "--out", file});
      const auto run = run_tool(arguments);
      INFO(it.kind << extension << ": " << run.err);
      if (it.kind == "cloud" && run.code == 4) continue;  // neighbours are found by a library
      REQUIRE(run.code == 0);
      const std::vector<double> found = read(bytes_of(file));
      REQUIRE(found.size() == it.truth.size());
      for (std::size_t v = 0; v < found.size(); ++v) {
        CAPTURE(v);
        if (std::isinf(it.truth[v]))
          CHECK(found[v] == inf);
        else
          CHECK(found[v] == Approx(it.truth[v]).margin(1e-6));
      }
    }
}

TEST_CASE("unreached: matrices and paths") {
  const Folder folder;
  const std::string surface = folder.write("surface.obj", square_and_triangle).string();
  const std::string few = folder.at("few.csv").string();
  ran({"pairs", surface, "-s", "vertex:0", "-s", "vertex:4", "-q", "--out", few});
  CHECK(bytes_of(few).find("inf") != std::string::npos);
  for (const char* type : {"float16", "float32", "float64"}) {
    const std::string all = folder.at("all.npy").string();
    ran({"pairs", surface, "--sources", "all", "--type", type, "-q", "--out", all});
    const std::string bytes = bytes_of(all);
    const std::size_t data = 10 + number_at<std::uint16_t>(bytes, 8);
    const std::string name = type;
    for (std::size_t n = 0; n < 64; ++n) {
      const bool one_part = n / 8 < 4 && n % 8 < 4,
                 other = n / 8 >= 4 && n / 8 < 7 && n % 8 >= 4 && n % 8 < 7;
      CAPTURE(type, n);
      double d = 0;
      if (name == "float16")  // infinity in half precision
        d = number_at<std::uint16_t>(bytes, data + 2 * n) == 0x7C00 ? inf : 0;
      else if (name == "float32")
        d = static_cast<double>(number_at<float>(bytes, data + 4 * n));
      else
        d = number_at<double>(bytes, data + 8 * n);
      CHECK(std::isinf(d) == !(one_part || other || n % 9 == 0));
    }
  }
  const std::string path = folder.at("p.json").string();
  const auto run = ran({"path", surface, "--from", "vertex:0", "--to", "vertex:4", "--to",
                        "vertex:2", "--json", "--out", path});
  const Json paths = run.json()["paths"];
  CHECK(paths[0]["length"].is_null());
  CHECK(paths[1]["length"].get<double>() == Approx(std::sqrt(2)));
  CHECK(bytes_of(path).find("null") != std::string::npos);
}

}  // namespace unreached_test
