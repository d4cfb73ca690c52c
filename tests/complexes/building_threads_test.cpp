#include <array>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/test_meshes.hpp"
#include "complexes/test_solids.hpp"
#include "message_of.hpp"

namespace plexway::testing::building_threads_test {
using namespace detail;

// Domains of several blocks, built by several threads: the bits of one.

namespace {

constexpr std::array<int, 3> several = {2, 3, 8};

/// All that a mesh says, as numbers.
class Said {
 public:
  template <class Number>
  void add(Number number) {
    if constexpr (std::is_same_v<Number, float>)
      numbers_.push_back(std::bit_cast<std::uint32_t>(number));
    else if constexpr (std::is_same_v<Number, double>)
      numbers_.push_back(std::bit_cast<std::uint64_t>(number));
    else
      numbers_.push_back(static_cast<std::uint64_t>(number));
  }
  template <class Row>
  void add_row(const Row& row) {
    for (const auto& number : row) add(number);
  }
  bool operator==(const Said&) const = default;

 private:
  std::vector<std::uint64_t> numbers_;
};

template <class Real>
Said said(const TriangleMesh<Real>& mesh) {
  Said all;
  for (const TriangleRecord<Real>& t : mesh.triangles()) {
    all.add_row(t.across);
    all.add_row(t.length);
    all.add_row(t.cosine);
    all.add_row(t.signed_sine);
    all.add_row(t.corner);
    all.add(t.face);
  }
  all.add_row(mesh.vertices_inside());
  all.add_row(mesh.pinched());
  for (const auto& p : mesh.positions()) all.add_row(p);
  std::vector<Index> corners;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    all.add(mesh.corner_at(v));
    mesh.corners_at(v, corners);
    all.add_row(corners);
    for (const auto& end : mesh.chords_at(v)) all.add(end.vertex), all.add(end.length);
  }
  for (Index f = 0; f < mesh.face_count(); ++f) all.add(mesh.inside_face(f).first);
  const SurfaceSummary& s = mesh.summary();
  for (const std::size_t n :
       {s.vertices, s.faces, s.edges, s.boundary_edges, s.non_manifold_edges, s.pinched_vertices,
        s.unreferenced_vertices, s.degenerate_faces, s.violated_faces, s.refracting_edges,
        s.components, static_cast<std::size_t>(s.orientable)})
    all.add(n);
  all.add(s.mean_edge);
  return all;
}

template <class Real>
Said said(const TetMesh<Real>& mesh) {
  Said all;
  for (const TetRecord& t : mesh.tets()) {
    all.add_row(t.across);
    all.add_row(t.corner);
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    all.add(mesh.inside_vertex(v));
    all.add_row(mesh.corners_at(v));
  }
  all.add_row(mesh.pinched());
  for (const auto& crack : mesh.cracks()) all.add_row(crack);
  const SolidSummary& s = mesh.summary();
  for (const std::size_t n :
       {s.vertices, s.tets, s.faces, s.edges, s.boundary_faces, s.components, s.reflex_edges,
        s.reflex_vertices, s.pinched_vertices, s.pinched_edges, s.degenerate_tets, s.inverted_tets,
        s.unreferenced_vertices, std::size_t{s.first_degenerate}, std::size_t{s.first_inverted}})
    all.add(n);
  all.add(s.mean_edge);
  return all;
}

void shake(Surface& s, double by, unsigned seed) {
  std::mt19937 random(seed);
  for (Position& p : s.positions)
    for (double& x : p) x += by * (uniform(random) - 0.5);
}

SurfaceHints by(int threads) {
  SurfaceHints hints;
  hints.threads = threads;
  return hints;
}

// Each of several blocks of faces, and of vertices where there is one of many.
std::vector<Surface> surfaces() {
  Surface bumpy = grid(181, 130);
  shake(bumpy, 2e-3, 1);
  Surface band = moebius(900, 22);
  Surface fans = sheets(5, 60);
  // Several sheets, edges with more than two triangles, a soup, vertices of no triangle.
  Surface mixed = renamed(bumpy, 3, true, true).surface;
  const Index first = static_cast<Index>(mixed.positions.size());
  const Surface crowd = soup(4000, 9000, 5);
  mixed.positions.insert(mixed.positions.end(), crowd.positions.begin(), crowd.positions.end());
  for (Face f : crowd.faces) {
    for (Index& v : f) v += first;
    mixed.faces.push_back(f);
  }
  mixed.positions.push_back(mixed.positions.front());  // an edge of no length, a flat triangle
  mixed.faces.push_back({0, mixed.faces[0][0] == 0 ? mixed.faces[0][1] : mixed.faces[0][0],
                         static_cast<Index>(mixed.positions.size() - 1)});
  return {bumpy, renamed(bumpy, 2, true).surface, renamed(band, 4, true, true).surface,
          renamed(fans, 6, true, true).surface, mixed};
}

}  // namespace

TEST_CASE("surfaces built by several threads are those of one") {
  for (const Surface& s : surfaces()) {
    REQUIRE(s.faces.size() > building_block);
    const Said single = said(TriangleMesh<float>(s.positions, s.faces, by(1)));
    const Said twice = said(TriangleMesh<double>(s.positions, s.faces, by(1)));
    const auto lengths = lengths_of(s);
    const Said measured = said(TriangleMesh<float>(s.positions.size(), s.faces, lengths, by(1)));
    for (const int threads : several) {
      CHECK(said(TriangleMesh<float>(s.positions, s.faces, by(threads))) == single);
      CHECK(said(TriangleMesh<double>(s.positions, s.faces, by(threads))) == twice);
      CHECK(said(TriangleMesh<float>(s.positions.size(), s.faces, lengths, by(threads))) ==
            measured);
    }
  }
}

TEST_CASE("several threads build what hints say as one does") {
  Surface s = grid(150, 120);
  shake(s, 2e-3, 8);
  auto lengths = lengths_of(s);
  for (std::size_t f = 0; f < lengths.size(); f += 3)
    for (double& l : lengths[f]) l *= 1.25;  // speeds that jump
  // An order in which nearly all that blocks have to say is to vertices of others.
  std::vector<Index> order(s.faces.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::mt19937 random(9);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[below(random, i)]);
  const auto with = [&](int threads, bool refracts) {
    SurfaceHints hints = by(threads);
    hints.order = order;
    hints.samples = !refracts;
    hints.refracts = refracts;
    return refracts ? said(TriangleMesh<float>(s.positions.size(), s.faces, lengths, hints))
                    : said(TriangleMesh<float>(s.positions, s.faces, hints));
  };
  for (const bool refracts : {false, true}) {
    const Said one = with(1, refracts);
    for (const int threads : several) CHECK(with(threads, refracts) == one);
  }
}

TEST_CASE("Delaunay triangles by several threads are those of one") {
  Surface s = grid(140, 130, 1, 3);
  shake(s, 8e-3, 10);
  for (const auto wanted :
       {Retriangulation::keep, Retriangulation::flips, Retriangulation::refined}) {
    const auto one = triangulate<float>(s.positions, s.faces, wanted, 1);
    if (wanted == Retriangulation::flips) CHECK(one.delaunay->summary().flips > 1000);
    for (const int threads : several) {
      const auto more = triangulate<float>(s.positions, s.faces, wanted, threads);
      CHECK(said(more.mesh) == said(one.mesh));
      REQUIRE(more.delaunay.has_value() == one.delaunay.has_value());
      for (Index f = 0; more.delaunay && f < s.faces.size(); f += 97) {
        const auto point = PointSource::in(f, {0.2, 0.3, 0.5});
        const auto a = one.delaunay->to_intrinsic(point), b = more.delaunay->to_intrinsic(point);
        CHECK((a.simplex == b.simplex && a.barycentric == b.barycentric));
      }
    }
  }
  const auto open = triangulate<float>(s.positions, s.faces, {}, 1);
  CHECK(triangulate<float>(s.positions, s.faces, {}, 3).done == open.done);
}

TEST_CASE("solids built by several threads are those of one") {
  std::vector<Solid> all = {solid_cube(16), l_shape(30), vertex_touch(24), edge_touch(24)};
  for (Solid& s : all) {
    std::mt19937 random(11);
    for (Tet& t : s.tets)
      if (random() % 2) std::swap(t[0], t[1]);
    for (std::size_t i = s.tets.size(); i > 1; --i)
      std::swap(s.tets[i - 1], s.tets[below(random, i)]);
  }
  for (const Solid& s : all) {
    REQUIRE(s.tets.size() > building_block);
    const Said single = said(TetMesh<float>(s.positions, s.tets, 1));
    const Said twice = said(TetMesh<double>(s.positions, s.tets, 1));
    const Said measured = said(TetMesh<float>(s.positions.size(), s.tets, s.lengths(), 1));
    for (const int threads : several) {
      CHECK(said(TetMesh<float>(s.positions, s.tets, threads)) == single);
      CHECK(said(TetMesh<double>(s.positions, s.tets, threads)) == twice);
      CHECK(said(TetMesh<float>(s.positions.size(), s.tets, s.lengths(), threads)) == measured);
    }
  }
}

TEST_CASE("of what is wrong in several blocks the first is named, by any number of threads") {
  const Surface sound = grid(160, 130);
  Surface far = sound, twins = sound, open = sound, long_one = sound, small = sound;
  const Index last = static_cast<Index>(sound.faces.size() - 1);
  const Index second = building_block + 40;
  for (const Index f : {second, last}) {
    far.faces[f][1] = 4000000;
    twins.faces[f][2] = twins.faces[f][0];
  }
  twins.faces[last][0] = twins.faces[last][1];
  open.positions[17000][2] = open.positions[20000][0] = std::numeric_limits<double>::quiet_NaN();
  for (const Index v : {Index{300}, Index{20000}}) long_one.positions[v][0] = 1.7e308;
  long_one.positions[300][1] = -1.7e308;
  for (const Index v : small.faces[second])
    small.positions[v] = small.positions[small.faces[second][0]];
  small.positions[small.faces[second][1]][0] += 1e-14;
  for (const Surface* s : {&far, &twins, &open, &long_one, &small}) {
    const auto with = [&](int threads) {
      return message_of<Error>([&] { TriangleMesh<float>(s->positions, s->faces, by(threads)); });
    };
    const std::string one = with(1);
    CHECK(!one.empty());
    for (const int threads : several) CHECK(with(threads) == one);
  }
  CHECK(message_of<Error>([&] {
          TriangleMesh<float>(far.positions, far.faces, by(3));
        }).starts_with("face " + std::to_string(second) + ":"));
  CHECK(message_of<Error>([&] {
          TriangleMesh<float>(twins.positions, twins.faces, by(3));
        }).starts_with("face " + std::to_string(second) + ":"));
  CHECK(message_of<Error>([&] {
          TriangleMesh<float>(open.positions, open.faces, by(3));
        }).starts_with("vertex 17000:"));

  const Solid cube = solid_cube(16);
  Solid outside = cube, thrice = cube;
  outside.tets[17000][0] = outside.tets[20000][1] = 4000000;
  for (const Index t : {20500u, 17u, 18000u}) {
    thrice.tets.push_back(thrice.tets[t]);
    thrice.tets.push_back(thrice.tets[t]);
  }
  for (const Solid* s : {&outside, &thrice}) {
    const auto with = [&](int threads) {
      return message_of<Error>([&] { TetMesh<float>(s->positions, s->tets, threads); });
    };
    const std::string one = with(1);
    CHECK(one.starts_with("tet"));
    for (const int threads : several) CHECK(with(threads) == one);
  }
}

}  // namespace plexway::testing::building_threads_test
