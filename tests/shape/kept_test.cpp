// Prepared files: the same bits as the shape built, whatever the kind, and a refusal for anything
// that is not as it was written.

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/shape/warnings.hpp>

#include "complexes/common/kept_archive.hpp"
#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "complexes/test_wires.hpp"
#include "folder.hpp"

namespace plexway::kept_test {
using namespace detail;

namespace {

namespace meshes = plexway::testing;
using Catch::Matchers::Contains;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Not a bit apart, in what is asked of a domain.
void check_same(const AnyDomain& built, const AnyDomain& opened,
                std::span<const PointSource> sources) {
  REQUIRE(opened.vertices() == built.vertices());
  CHECK(opened.simplices() == built.simplices());
  CHECK(opened.components() == built.components());
  CHECK(opened.mean_edge() == built.mean_edge());
  CHECK(opened.precision() == built.precision());
  CHECK(opened.triangulation().flips == built.triangulation().flips);
  CHECK(opened.triangulation().inserted_vertices == built.triangulation().inserted_vertices);
  CHECK(opened.shape().data().index() == built.shape().data().index());
  CHECK(std::ranges::equal(opened.shape().positions(), built.shape().positions()));
  // The rest of the shape is copied from the file by the first of any number that ask.
  const auto same_corners = [&] {
    std::size_t same = 0;
    for (std::size_t s = 0; s < built.shape().simplices(); ++s)
      same += std::ranges::equal(opened.shape().corners(s), built.shape().corners(s));
    return same;
  };
  std::size_t elsewhere = 0;
  std::thread second([&] { elsewhere = same_corners(); });
  CHECK(same_corners() == built.shape().simplices());
  second.join();
  CHECK(elsewhere == built.shape().simplices());
  CHECK(opened.shape().simplices() == built.shape().simplices());
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::accurate()}) {
    if (accuracy == Accuracy::accurate() && built.kind() == DomainKind::wireframe) continue;
    PropagateOptions options;
    options.accuracy = accuracy;
    for (const PointSource& source : sources) {
      const auto before = built.solve(Serial{}, source, options);
      const auto after = opened.solve(Serial{}, source, options);
      CHECK(after.doubles() == before.doubles());
      CHECK(after.statistics().expansions == before.statistics().expansions);
      const PointSource target = PointSource::at(static_cast<Index>(built.vertices() - 1));
      const auto way = built.path_field(Serial{}, std::span(&source, 1), options).trace(target);
      const auto other = opened.path_field(Serial{}, std::span(&source, 1), options).trace(target);
      CHECK(way.length == other.length);
      CHECK(way.positions == other.positions);
    }
    const auto before = built.solve(Serial{}, SourceList(sources), options);
    const auto after = opened.solve(Serial{}, SourceList(sources), options);
    CHECK(std::ranges::equal(after.label(), before.label()));
  }
}

void check_kept(const AnyShape& shape, std::span<const PointSource> sources,
                Triangulation triangulation = Triangulation::automatic) {
  const ::testing::Folder folder;
  for (const Precision precision : {Precision::float32, Precision::float64}) {
    const BuildOptions options{.precision = precision, .triangulation = triangulation};
    const AnyDomain built(shape, options);
    const auto file = folder.at("kept.plexway");
    built.keep(file);
    // The same build is the same file.
    const std::string bytes = bytes_of(file);
    built.keep(file);
    CHECK(bytes == bytes_of(file));
    AnyDomain(shape, options).keep(file);
    CHECK(bytes == bytes_of(file));
    const AnyDomain opened = AnyDomain::read(file, {}, options);
    check_same(built, opened, sources);
    // And kept again.
    opened.keep(folder.at("again.plexway"));
    CHECK(bytes == bytes_of(folder.at("again.plexway")));
    // What has no triangles to choose is not built anew for a choice of these.
    if (opened.kind() != DomainKind::surface)
      check_same(built,
                 AnyDomain::read(file, {},
                                 {.precision = precision, .triangulation = Triangulation::input}),
                 sources);
    // Built anew where something else is asked for.
    const BuildOptions others{
        .precision = precision == Precision::float32 ? Precision::float64 : Precision::float32,
        .triangulation = triangulation};
    check_same(AnyDomain(shape, others), AnyDomain(AnyShape::read(file), others), sources);
  }
}

const std::vector<PointSource> at_vertices = {PointSource::at(0), PointSource::at(17)};
const std::vector<PointSource> in_simplices = {PointSource::at(3),
                                               PointSource::in(7, {0.2, 0.3, 0.5})};

// Slender enough for flips and for refinement.
meshes::Surface stretched() {
  meshes::Surface s = meshes::sphere(3);
  for (auto& p : s.positions) p[2] *= 6;
  return s;
}

}  // namespace

TEST_CASE("kept surfaces open with the same bits") {
  const auto shape = [](const meshes::Surface& s) {
    return AnyShape::surface(s.positions, s.faces);
  };
  SECTION("with a border") { check_kept(shape(meshes::slit_square(9)), in_simplices); }
  SECTION("one-sided") { check_kept(shape(meshes::moebius(12)), at_vertices); }
  SECTION("pages of a book") { check_kept(shape(meshes::sheets(3, 4)), at_vertices); }
  SECTION("pinched") { check_kept(shape(meshes::bow_tie(4)), at_vertices); }
  SECTION("a soup") { check_kept(shape(meshes::soup(40, 90, 3)), at_vertices); }
  SECTION("on Delaunay triangles") {
    check_kept(shape(stretched()), in_simplices, Triangulation::delaunay);
  }
  SECTION("on refined triangles") {
    check_kept(shape(stretched()), in_simplices, Triangulation::refined);
  }
  SECTION("as they pay") { check_kept(shape(stretched()), in_simplices); }
  SECTION("by lengths") {
    const meshes::Surface s = meshes::sphere(2);
    check_kept(AnyShape::surface(s.positions.size(), s.faces, meshes::lengths_of(s)), in_simplices);
  }
}

TEST_CASE("kept solids open with the same bits") {
  const auto shape = [](const meshes::Solid& s) { return AnyShape::solid(s.positions, s.tets); };
  const std::vector<PointSource> inside = {PointSource::at(2),
                                           {.simplex = 5, .barycentric = {0.1, 0.2, 0.3, 0.4}}};
  SECTION("convex") { check_kept(shape(meshes::solid_cube(4)), inside); }
  SECTION("with reflex edges") { check_kept(shape(meshes::walled(4)), inside); }
  SECTION("that touch in an edge") { check_kept(shape(meshes::edge_touch(2)), inside); }
  SECTION("that touch in a vertex") { check_kept(shape(meshes::vertex_touch(2)), inside); }
}

TEST_CASE("a kept solid by lengths alone knows its notches") {
  const meshes::Solid s = meshes::walled(4);
  const AnyDomain built(AnyShape::solid(s.positions.size(), s.tets, s.lengths()));
  const ::testing::Folder folder;
  built.keep(folder.at("kept.plexway"));
  const AnyDomain opened = AnyDomain::read(folder.at("kept.plexway"));
  PropagateOptions options;
  options.accuracy = Accuracy::fast();
  const PointSource source = PointSource::at(0);
  const AnyField before = built.solve(Serial{}, source, options);
  const AnyField after = opened.solve(Serial{}, source, options);
  CHECK(after.doubles() == before.doubles());
  const auto said = [&](const AnyDomain& domain, const AnyField& field) {
    std::vector<std::string> texts;
    for (const Warning& warning : warnings(domain, field, source, options))
      texts.push_back(warning.text);
    return texts;
  };
  CHECK_FALSE(said(built, before).empty());
  CHECK(said(opened, after) == said(built, before));
}

TEST_CASE("kept wireframes and graphs open with the same bits") {
  const auto wires = meshes::random_wires(5, 60, 150);
  check_kept(AnyShape::wireframe(wires.vertices, wires.edges, wires.lengths), at_vertices);
}

#ifdef PLEXWAY_HAS_FLANN
TEST_CASE("kept clouds open with the same bits") {
  io::Points points;
  std::mt19937 random(4);
  for (std::size_t i = 0; i < 400; ++i) {
    const double a = 6 * meshes::uniform(random), z = 2 * meshes::uniform(random);
    points.positions.push_back({std::cos(a), std::sin(a), z});
  }
  points.positions.push_back(points.positions[7]);  // a twin
  check_kept(AnyShape::cloud(points), at_vertices);
}
#endif

TEST_CASE("what cannot be kept is refused with the reason") {
  const ::testing::Folder folder;
  const auto file = folder.at("kept.plexway");
  SimplexShape simplices;
  simplices.dimension = 2;
  simplices.vertices = 3;
  simplices.axes = 2;
  simplices.positions = {0, 0, 1, 0, 0, 1};
  simplices.corners = {0, 1, 2};
  CHECK_THROWS_WITH(AnyDomain(AnyShape::simplices(simplices)).keep(file),
                    Contains("prepared files are for surfaces"));
  MixedShape mixed;
  mixed.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mixed.parts.push_back({.first_vertex = 0, .vertices = 3, .triangles = {{0, 1, 2}}});
  CHECK_THROWS_AS(AnyDomain(AnyShape::mixed(mixed)).keep(file), UsageError);
  const AnyShape triangle = AnyShape::surface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  BuildOptions measured;
  measured.lengths = std::make_shared<const MeasuredLengths>(MeasuredLengths{
      .triangles = {{1, 1, 1}}, .tets = {}, .edges = {}, .speeds = {}, .violations = {}});
  CHECK_THROWS_WITH(AnyDomain(triangle, measured).keep(file),
                    support_of_keeping(DomainKind::surface, true, false).sentence());
  BuildOptions masked;
  masked.mask = std::make_shared<const Mask>(3, 1);
  CHECK_THROWS_WITH(AnyDomain(triangle, masked).keep(file),
                    support_of_keeping(DomainKind::surface, false, true).sentence());
  CHECK(folder.files() == 0);
  AnyDomain(triangle).keep(file);
  ReadOptions as;
  as.as = DomainKind::solid;
  CHECK_THROWS_AS(AnyShape::read(file, as), UsageError);
}

TEST_CASE("kept files that are foreign, cut short or damaged anywhere are refused") {
  const ::testing::Folder folder;
  const auto file = folder.at("kept.plexway");
  const meshes::Surface s = stretched();
  AnyDomain(AnyShape::surface(s.positions, s.faces), {.triangulation = Triangulation::refined})
      .keep(file);
  const std::string good = bytes_of(file);
  const auto refused = [&](const std::string& bytes, const char* why) {
    folder.write("bad.plexway", bytes);
    CHECK_THROWS_AS(AnyDomain::read(folder.at("bad.plexway")), InputError);
    CHECK_THROWS_WITH(AnyDomain::read(folder.at("bad.plexway")),
                      Contains("bad.plexway: ") && Contains(why));
  };
  refused("", "is empty");
  refused("OFF\n3 1 0\n", "no prepared domain");
  refused(good.substr(0, 64), "cut short");
  refused(good.substr(0, good.size() - 64), "cut short");
  refused(good.substr(0, good.size() / 2), "cut short");
  refused(good + std::string(64, '\0'), "cut short");
  std::string other = good;
  other[12] = static_cast<char>(other[12] + 1);
  refused(other, "another version");
  other = good;
  std::reverse(other.begin() + 8, other.begin() + 12);
  refused(other, "byte order");
  // A bit here and there.
  std::mt19937 random(1);
  for (std::size_t at = 16; at < good.size(); at += 1 + random() % (good.size() / 300)) {
    other = good;
    other[at] = static_cast<char>(other[at] ^ (1 << random() % 8));
    refused(other, "damaged");
  }
}

TEST_CASE("changed parts behind a right checksum are refused, or do no harm") {
  const ::testing::Folder folder;
  const auto file = folder.at("kept.plexway");
  const meshes::Surface s = stretched();
  const auto triangulation = GENERATE(Triangulation::input, Triangulation::refined);
  AnyDomain(AnyShape::surface(s.positions, s.faces), {.triangulation = triangulation}).keep(file);
  const std::string good = bytes_of(file);
  std::mt19937 random(2);
  std::size_t refused = 0;
  for (int n = 0; n < 400; ++n) {
    std::string bytes = good;
    const std::size_t at = 64 + random() % (bytes.size() - 128) / 4 * 4;
    const std::uint32_t word =
        static_cast<std::uint32_t>(n % 2 == 0 ? random() : ~std::uint32_t{0} >> random() % 32);
    std::memcpy(bytes.data() + at, &word, sizeof(word));
    seal(std::as_writable_bytes(std::span(bytes)));
    folder.write("bad.plexway", bytes);
    try {
      const AnyDomain opened =
          AnyDomain::read(folder.at("bad.plexway"), {}, {.triangulation = triangulation});
      PropagateOptions options;
      options.accuracy = Accuracy::fast();
      const auto field = opened.solve(Serial{}, PointSource::in(3, {0.2, 0.3, 0.5}), options);
      CHECK(field.size() == opened.vertices());
    } catch (const InputError&) {
      ++refused;
    } catch (const EndlessError&) {
    } catch (const UsageError&) {
    }
  }
  CHECK(refused > 100);
}

}  // namespace plexway::kept_test
