// .drc and glTF packed by Draco: what the library writes reads back, and broken files are refused.

#include "io_testing.hpp"

#if PLEXWAY_IO_DRACO

#include <draco/compression/expert_encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include <plexway/io/mixed.hpp>

#include "io/base64.hpp"

namespace draco_test {

using namespace io_testing;
using namespace plexway;
using Catch::Contains;

namespace {

constexpr int side = 12;

std::array<float, 3> place(int x, int y) {
  return {static_cast<float>(x), static_cast<float>(y), std::sin(static_cast<float>(x + y) / 3)};
}

// A bent grid whose two halves have other normals, so that Draco has a seam.
std::unique_ptr<draco::Mesh> grid() {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2 * side * side);
  const int at = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int up = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  draco::FaceIndex face(0);
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int half = 0; half < 2; ++half, ++face) {
        const auto a = place(x, y), b = half == 0 ? place(x + 1, y) : place(x + 1, y + 1),
                   c = half == 0 ? place(x + 1, y + 1) : place(x, y + 1);
        const std::array<float, 3> n = {x < side / 2 ? 1.F : 0.F, x < side / 2 ? 0.F : 1.F, 0};
        builder.SetAttributeValuesForFace(at, face, a.data(), b.data(), c.data());
        builder.SetAttributeValuesForFace(up, face, n.data(), n.data(), n.data());
      }
  return builder.Finalize();
}

std::unique_ptr<draco::PointCloud> points() {
  draco::PointCloudBuilder builder;
  builder.Start(side * side);
  const int at = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (int i = 0; i < side * side; ++i)
    builder.SetAttributeValueForPoint(at, draco::PointIndex(static_cast<std::uint32_t>(i)),
                                      place(i / side, i % side).data());
  return builder.Finalize(false);
}

template <class Shape>
std::string encoded(const Shape& shape, int method, int bits, int speed = 5) {
  draco::ExpertEncoder encoder(shape);
  encoder.SetEncodingMethod(method);
  encoder.SetSpeedOptions(speed, speed);
  if (bits > 0) encoder.SetAttributeQuantization(0, bits);
  draco::EncoderBuffer buffer;
  REQUIRE(encoder.EncodeToBuffer(&buffer).ok());
  return {buffer.data(), buffer.size()};
}

// A .gltf of one mesh that Draco packed; more of its only node, of its accessor and of its JSON.
std::string gltf_of(const std::string& bytes, const std::string& node, const std::string& accessor,
                    const std::string& more) {
  return R"({"asset":{"version":"2.0"},)" + more + R"("nodes":[{"mesh":0)" + node +
         R"(}],"buffers":[{"uri":"data:;base64,)" + io::encode_base64(bytes) +
         R"(","byteLength":1}],"bufferViews":[{"buffer":0,"byteLength":)" +
         std::to_string(bytes.size()) + R"(}],"accessors":[{"type":"VEC3",)" + accessor +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":{)" +
         R"("KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}]})";
}
const std::string needed = R"("extensionsRequired":["KHR_draco_mesh_compression"],)";
io::Mixed parse_gltf(std::string_view bytes, std::string_view name) {
  return io::parse_gltf(bytes, name);
}

io::Mixed read(const std::string& bytes) { return io::parse_draco(bytes, "f"); }

// Each place of the grid is there, to `tolerance`.
void check_places(const Positions& found, double tolerance) {
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      const auto p = place(x, y);
      CHECK(std::any_of(found.begin(), found.end(), [&](const auto& q) {
        return std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]) <= tolerance;
      }));
    }
}

}  // namespace

TEST_CASE("Draco's meshes and points read back, however they are encoded") {
  const auto mesh = grid();
  for (const int bits : {0, 14})
    for (const int speed : {0, 5, 10})
      for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        INFO(bits << " bits, speed " << speed << ", method " << method);
        const io::Mixed cells = read(encoded(*mesh, method, bits, speed));
        CHECK(cells.triangles.size() == 2 * side * side);
        check_places(cells.positions, bits == 0 ? 0 : 12. / (1 << 14));
        CHECK(cells.positions.size() == (side + 1) * (side + 1));  // without a seam
        double area = 0, longest = 0;
        for (const auto& [a, b, c] : cells.triangles) {
          const auto &p = cells.positions[a], &q = cells.positions[b], &r = cells.positions[c];
          area += ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
          longest = std::max(longest, std::hypot(q[0] - p[0], q[1] - p[1]));
        }
        CHECK(area == Approx(side * side).epsilon(1e-3));
        CHECK(longest < 1.5);
      }
  // Without normals, and with a triangle that has a corner twice.
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(9);
  const int at = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (int i = 0; i < 8; ++i) {
    const int x[] = {0, 1, 2, 3, 3, 2, 1, 0, 0}, y[] = {0, 0, 0, 0, 3, 3, 3, 3, 0};
    const auto a = place(x[i], y[i]), b = place(x[i + 1], y[i + 1]), c = place(1 + i / 4, 2);
    builder.SetAttributeValuesForFace(at, draco::FaceIndex(static_cast<std::uint32_t>(i)), a.data(),
                                      b.data(), c.data());
  }
  const auto none = place(5, 5), end = place(6, 5);
  builder.SetAttributeValuesForFace(at, draco::FaceIndex(8), none.data(), none.data(), end.data());
  const auto ring = builder.Finalize();
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    CHECK(read(encoded(*ring, method, 0)).triangles.size() == 8);
  const auto cloud = points();
  for (const int method :
       {draco::POINT_CLOUD_SEQUENTIAL_ENCODING, draco::POINT_CLOUD_KD_TREE_ENCODING}) {
    const io::Mixed cells = read(encoded(*cloud, method, 16));
    CHECK(cells.positions.size() == side * side);
    CHECK(cells.triangles.empty());
    check_places(cells.positions, 12. / (1 << 16));
  }
  const Folder folder;
  const std::string bytes = encoded(*mesh, draco::MESH_EDGEBREAKER_ENCODING, 14);
  for (const char* name : {"a.drc", "a.what"})
    CHECK(io::read_cells(folder.write(name, bytes)).triangles.size() == 2 * side * side);
}

TEST_CASE("glTF packed by Draco is read where its nodes put it") {
  const std::string bytes = encoded(*grid(), draco::MESH_EDGEBREAKER_ENCODING, 14);
  // As many points as Draco counts, along the seam twice as many.
  const std::string gltf =
      gltf_of(bytes, R"(,"translation":[0,0,7])", R"("componentType":5126,"count":182)", needed);
  try {
    const io::Mixed cells = io::parse_gltf(gltf, "f");
    CHECK(cells.positions.size() == (side + 1) * (side + 1));
    CHECK(cells.triangles.size() == 2 * side * side);
    for (const auto& p : cells.positions) CHECK(std::abs(p[2] - 7) <= 1.001);
    const auto said = [&](const std::string& from, const std::string& to) {
      return complaint(parse_gltf, replaced(gltf, from, to));
    };
    CHECK_THAT(said("182", "181"), Contains("has 181 points, but Draco packed 182"));
    for (const char* id : {"-1", "1.7"})
      CHECK_THAT(said(R"({"POSITION":0}}}}]}])", R"({"POSITION":)" + std::string(id) + "}}}}]}]"),
                 Contains("no whole number"));
    CHECK_THAT(said(R"({"POSITION":0}}}}]}])", R"({"POSITION":4294967296}}}}]}])"),
               Contains("names no POSITION"));
    // Nodes that share it: what is packed is decoded once.
    std::string twice = R"({"mesh":0})";
    for (int i = 0; i < 30; ++i) {
      const std::string below = std::to_string(i) + "," + std::to_string(i);
      twice += R"(,{"children":[)" + below + "]}";
    }
    CHECK_THAT(said(R"([{"mesh":0,"translation":[0,0,7]}])",
                    "[" + twice + R"(],"scenes":[{"nodes":[30]}])"),
               Contains("repeat each other"));
    // In a mirror triangles still look outwards.
    const auto area = [](const io::Mixed& of) {
      double sum = 0;
      for (const auto& [a, b, c] : of.triangles) {
        const auto &p = of.positions[a], &q = of.positions[b], &r = of.positions[c];
        sum += ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
      }
      return sum;
    };
    CHECK(area(cells) == Approx(side * side).epsilon(1e-3));
    const io::Mixed mirrored =
        parse_gltf(replaced(gltf, R"("translation":[0,0,7])", R"("scale":[-1,1,1])"), "f");
    CHECK(area(mirrored) == Approx(side * side).epsilon(1e-3));
    CHECK_THAT(said(R"({"POSITION":0}}}}]}])", R"({"POSITION":9}}}}]}])"),
               Contains("has no points in space"));
    CHECK_THAT(said(R"({"bufferView":0)", R"({"bufferView":3)"), Contains("names '3'"));
    CHECK_THAT(said(R"(,"attributes":{"POSITION":0}}}})", "}}}"), Contains("not what glTF has"));
  } catch (const NotBuiltError&) {
  }
}

TEST_CASE("glTF says whether whole numbers that Draco packed stand for -1 to 1") {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int at = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_INT16);
  const std::array<std::int16_t, 3> a{0, 0, 0}, b{1000, 0, 0}, c{0, -32768, 0};
  builder.SetAttributeValuesForFace(at, draco::FaceIndex(0), a.data(), b.data(), c.data());
  const std::string bytes = encoded(*builder.Finalize(), draco::MESH_SEQUENTIAL_ENCODING, 0);
  const auto range = [&](const std::string& accessor) {
    std::array<double, 2> found{};
    for (const auto& p : parse_gltf(gltf_of(bytes, "", accessor, needed), "f").positions)
      found = {std::max(found[0], p[0]), std::min(found[1], p[1])};
    return found;
  };
  try {
    CHECK(range(R"("componentType":5122)") == std::array<double, 2>{1000, -32768});
    CHECK(range(R"("componentType":5122,"normalized":true)") ==
          std::array<double, 2>{1000. / 32767, -1});
    // Where Draco is not needed the same numbers are there unpacked; here they are others.
    const std::string unpacked = R"("bufferView":0,"componentType":5120,"count":1)";
    CHECK(parse_gltf(gltf_of(bytes, "", unpacked, ""), "f").positions ==
          Positions{{'D', 'R', 'A'}});
    CHECK_THAT(complaint(parse_gltf, gltf_of(bytes, "", unpacked, needed)),
               Contains("has 1 points, but Draco packed 3"));
  } catch (const NotBuiltError&) {
  }
}

TEST_CASE("Draco that is broken, or asks for more than it is worth, is refused in one line") {
  const auto said = [](const std::string& bytes) {
    return complaint([](std::string_view b, std::string_view n) { (void)io::parse_draco(b, n); },
                     bytes);
  };
  CHECK_THAT(said("DRACX"), Contains("is no Draco file"));
  CHECK_THAT(said(std::string("DRACO\1\1\1\1\0\0", 11)), Contains("version 1.1"));
  // Headers that promise 2^28 faces or points.
  const std::string many = "\xFF\xFF\xFF\x7F";
  for (const char* head : {"DRACO\2\2\1\0", "DRACO\2\2\1\1", "DRACO\2\3\0\0", "DRACO\2\3\0\1"})
    CHECK_THAT(said(std::string(head, 9) + std::string(3, '\0') + many + many + "\1" + many),
               Contains("does not unpack"));
  const auto mesh = grid();
  const auto cloud = points();
  // A tree of points counts them again, and takes the square of their numbers.
  std::string again = encoded(*cloud, draco::POINT_CLOUD_KD_TREE_ENCODING, 14);
  const std::string_view count("\x90\0\0\0", 4);
  const std::size_t second = again.find(count, again.find(count) + 4);
  REQUIRE(second != again.npos);
  // No bits and 2^32 - 1 points, which would take seconds to count.
  again.replace(second - 4, 8, std::string(4, '\0') + "\xFF\xFF\xFF\xFF");
  const auto start = std::chrono::steady_clock::now();
  CHECK_THAT(said(again), Contains("does not unpack"));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(1));
  draco::PointCloudBuilder wide;
  wide.Start(1);
  const std::array<std::uint8_t, 100> numbers{};
  for (const auto& [kind, size] : {std::pair{draco::GeometryAttribute::POSITION, 3},
                                   std::pair{draco::GeometryAttribute::GENERIC, 100}})
    wide.SetAttributeValueForPoint(
        wide.AddAttribute(kind, static_cast<std::int8_t>(size), draco::DT_UINT8),
        draco::PointIndex(0), numbers.data());
  CHECK_THAT(said(encoded(*wide.Finalize(false), draco::POINT_CLOUD_KD_TREE_ENCODING, 0)),
             Contains("does not unpack"));
  std::minstd_rand random(1);
  for (const std::string& good : {encoded(*mesh, draco::MESH_EDGEBREAKER_ENCODING, 14),
                                  encoded(*mesh, draco::MESH_EDGEBREAKER_ENCODING, 10, 0),
                                  encoded(*mesh, draco::MESH_SEQUENTIAL_ENCODING, 14),
                                  encoded(*cloud, draco::POINT_CLOUD_KD_TREE_ENCODING, 14),
                                  encoded(*cloud, draco::POINT_CLOUD_SEQUENTIAL_ENCODING, 14)}) {
    for (int i = 0; i < 500; ++i) {
      std::string bad = good;
      if (i % 5 == 0)
        bad.resize(random() % bad.size());
      else
        bad[random() % bad.size()] = static_cast<char>(random());
      try {
        for (const auto& p : io::parse_draco(bad, "f").positions)
          for (const double c : p) REQUIRE(std::isfinite(c));
      } catch (const InputError& error) {
        CHECK_THAT(error.what(), Catch::StartsWith("f: "));
      }
    }
  }
}

}  // namespace draco_test

#endif
