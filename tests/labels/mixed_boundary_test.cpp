#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

// Surfaces that lie on a solid, or end on it: nothing that they add makes a path shorter than the
// solid's own, or than the straight line.
namespace mixed_boundary_test {
namespace {

using namespace plexway;
using Position = std::array<double, 3>;

double apart(const Position& p, const Position& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

// Tetrahedra, and triangles of their boundary with vertices of their own.
struct Skinned {
  std::vector<Position> positions, skin;
  std::vector<std::array<Index, 4>> tets;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<Index> on_skin;  // by vertex of the solid, or none

  // Of the faces at the boundary those that `takes`.
  template <class Takes>
  void add_skin(const Takes& takes) {
    std::map<std::array<Index, 3>, int> faces;
    for (const auto& t : tets)
      for (std::size_t i = 0; i < 4; ++i) {
        std::array<Index, 3> face{};
        for (std::size_t j = 0, k = 0; j < 4; ++j)
          if (j != i) face[k++] = t[j];
        std::sort(face.begin(), face.end());
        ++faces[face];
      }
    on_skin.assign(positions.size(), none);
    for (const auto& [face, count] : faces) {
      if (count != 1 || !takes()) continue;
      std::array<Index, 3> own = face;
      for (Index& v : own) {
        if (on_skin[v] == none) {
          on_skin[v] = static_cast<Index>(skin.size());
          skin.push_back(positions[v]);
        }
        v = on_skin[v];
      }
      triangles.push_back(own);
    }
  }
};

Skinned block(const std::array<std::size_t, 3>& cells, const KuhnGrid<3>::Absent& absent) {
  const KuhnGrid<3> grid(cells,
                         {1. / static_cast<double>(cells[0]), 1. / static_cast<double>(cells[1]),
                          1. / static_cast<double>(cells[2])});
  Skinned made;
  for (Index v = 0; v < grid.vertex_count(); ++v) made.positions.push_back(grid.position(v));
  made.tets = grid.simplices(absent);
  return made;
}

TEST_CASE("a solid with a cavity welded to its own boundary has its own distances") {
  const auto inside = [](const auto& cell) {
    return std::all_of(cell.begin(), cell.end(), [](auto c) { return c >= 3 && c < 6; });
  };
  Skinned s = block({9, 9, 9}, inside);
  s.add_skin([] { return true; });
  const TetMesh<double> alone(s.positions, s.tets);
  MixedComplex<double> domain;
  const auto solid = domain.add(alone, s.positions);
  const auto skin = domain.add(TriangleMesh<double>(s.skin, s.triangles), s.skin);
  domain.weld(solid, skin, {.tolerance = 1e-9});
  for (const Index source : {Index{0}, Index{450}, Index{333}}) {
    const auto own = solve(Serial{}, alone, PointSource::at(source));
    const auto both = solve(Serial{}, domain, PointSource::at(solid.vertex(source)));
    for (Index v = 0; v < s.positions.size(); ++v) {
      CAPTURE(source, v);
      if (!std::isfinite(own.distance[v])) continue;
      REQUIRE(both.distance[solid.vertex(v)] == Approx(own.distance[v]).epsilon(1e-9));
    }
  }
}

TEST_CASE("light from a solid bends where a fin ends") {
  const KuhnGrid<3> grid({16, 16, 8}, {.125, .125, .125}, {-1, -1, -1});
  std::vector<Position> block, fin;
  for (Index v = 0; v < grid.vertex_count(); ++v) block.push_back(grid.position(v));
  std::vector<std::array<Index, 3>> triangles;
  for (Index j = 0; j <= 8; ++j)
    for (Index i = 0; i <= 8; ++i) {
      fin.push_back({0, -.5 + i / 8., j / 8.});
      if (i == 0 || j == 0) continue;
      const Index a = (j - 1) * 9 + i - 1;
      triangles.push_back({a, a + 1, a + 10});
      triangles.push_back({a, a + 10, a + 9});
    }
  MixedComplex<double> domain;
  const auto solid = domain.add(TetMesh<double>(block, grid.simplices()), block);
  const auto sheet = domain.add(TriangleMesh<double>(fin, triangles), fin);
  domain.weld(solid, sheet, {.tolerance = 1e-9});
  const Position from = {.25, -.75, -.25};
  const auto field = solve(Serial{}, domain, PointSource::at(solid.vertex(grid.nearest(from))));
  // Over the line y from -.5 to .5 at the fin's foot.
  for (Index v = 0; v < fin.size(); ++v) {
    const double off = std::hypot(from[0], from[2]), z = fin[v][2], span = fin[v][1] - from[1];
    const double y = std::clamp(from[1] + span * off / (off + z), -.5, .5);
    const double truth = std::hypot(off, y - from[1]) + std::hypot(z, fin[v][1] - y);
    CAPTURE(fin[v][1], z);
    REQUIRE(field.distance[sheet.vertex(v)] > truth * (1 - 1e-9));
    CHECK(field.distance[sheet.vertex(v)] < truth * (1 + 2e-3));
  }
  CHECK(field.distance[sheet.vertex(4 * 9)] == Approx(std::sqrt(.1875) + .5).epsilon(1e-9));
}

TEST_CASE("no welding of a random solid with its own surface is below the straight line") {
  std::size_t fields = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    const auto share = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
    const std::size_t n = 3 + random() % 3;
    std::vector<char> gone(n * n * n);
    const double empty = .35 * share();
    for (char& cell : gone) cell = share() < empty;
    Skinned s =
        block({n, n, n}, [&](const auto& c) { return gone[c[0] + n * (c[1] + n * c[2])] != 0; });
    if (s.tets.empty()) continue;
    const double moved = random() % 2 == 0 ? 0 : .15 / static_cast<double>(n);
    for (Position& p : s.positions)
      for (double& x : p)
        if (x > .01 && x < .99) x += moved * (2 * share() - 1);
    const double covered = random() % 2 == 0 ? 1 : .2 + .8 * share();
    s.add_skin([&] { return share() < covered; });
    if (s.triangles.empty()) continue;
    MixedComplex<double> domain;
    const auto solid = domain.add(TetMesh<double>(s.positions, s.tets), s.positions);
    const auto skin = domain.add(TriangleMesh<double>(s.skin, s.triangles), s.skin);
    domain.weld(
        solid, skin,
        {.tolerance = 1e-9, .all_edges = random() % 3 == 0, .all_vertices = random() % 3 == 0});
    for (const bool in_skin : {false, true}) {
      const Index v = s.tets[random() % s.tets.size()][0];
      const Index f = static_cast<Index>(random() % s.triangles.size());
      Position from = s.positions[v];
      if (in_skin)
        for (std::size_t k = 0; k < 3; ++k)
          from[k] = .5 * s.skin[s.triangles[f][0]][k] + .3 * s.skin[s.triangles[f][1]][k] +
                    .2 * s.skin[s.triangles[f][2]][k];
      const PointSource source = in_skin ? PointSource::in(skin.simplex(f), {.5, .3, .2})
                                         : PointSource::at(solid.vertex(v));
      const auto field = solve(Serial{}, domain, source);
      constexpr double radius = .6;
      const auto near = solve(Serial{}, domain, source, {.radius = radius});
      ++fields;
      const auto check = [&](const auto& piece, const std::vector<Position>& at) {
        for (Index w = 0; w < at.size(); ++w) {
          CAPTURE(seed, in_skin, w);
          const double least = apart(at[w], from) * (1 - 1e-9);
          REQUIRE(field.distance[piece.vertex(w)] >= least);
          const double there = near.distance[piece.vertex(w)];
          REQUIRE(there >= least);
          if (std::isfinite(there)) REQUIRE(there <= radius);
        }
      };
      check(solid, s.positions);
      check(skin, s.skin);
    }
  }
  CHECK(fields > 60);
}

}  // namespace
}  // namespace mixed_boundary_test
