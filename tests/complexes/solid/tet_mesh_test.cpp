#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <plexway/error.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_solids.hpp"
#include "message_of.hpp"

namespace plexway::testing::tet_mesh_test {
using namespace detail;

using Catch::Matchers::Contains;

namespace {

std::size_t distinct_edges(const Solid& s) {
  std::set<std::pair<Index, Index>> edges;
  for (const Tet& t : s.tets)
    for (const auto& [i, j] : tet_edge_ends) edges.insert(std::minmax(t[i], t[j]));
  return edges.size();
}

}  // namespace

TEMPLATE_TEST_CASE("a cube is counted", "", float, double) {
  const Solid s = solid_cube(4);
  const auto mesh = s.mesh<TestType>();
  const SolidSummary& c = mesh.summary();
  CHECK(c.vertices == 125);
  CHECK(c.tets == 6 * 64);
  CHECK(c.boundary_faces == 6 * 16 * 2);
  CHECK(c.faces == (4 * c.tets + c.boundary_faces) / 2);
  CHECK(c.edges == distinct_edges(s));
  CHECK(c.reflex_edges == 0);
  CHECK(c.reflex_vertices == 0);
  CHECK(c.pinched_edges == 0);
  CHECK(c.pinched_vertices == 0);
  CHECK(c.components == 1);
  CHECK(c.degenerate_tets == 0);
  CHECK(c.embedded);
  CHECK(mesh.embedded());
  CHECK(mesh.bytes() > 384 * 48);
}

TEMPLATE_TEST_CASE("reflex edges and what only touches is found", "", float, double) {
  const auto l = l_shape(4).mesh<TestType>();
  CHECK(l.summary().reflex_edges == 4);
  CHECK(l.summary().reflex_vertices == 5);
  CHECK(walled(8).mesh<TestType>().summary().reflex_edges == 16);
  const auto e = edge_touch(4).mesh<TestType>();
  CHECK(e.summary().pinched_edges == 2);
  CHECK(e.summary().pinched_vertices == 0);
  CHECK(e.summary().reflex_edges == 0);
  CHECK(e.summary().components == 1);
  const auto v = vertex_touch(4).mesh<TestType>();
  CHECK(v.summary().pinched_edges == 0);
  CHECK(v.summary().pinched_vertices == 1);
  CHECK(v.summary().components == 1);
}

TEST_CASE("inverted and flat tetrahedra are counted") {
  Solid s = solid_cube(2, 0);
  std::swap(s.tets[3][0], s.tets[3][1]);
  std::size_t inverted = 0, positive = 0;
  Index first = none;
  for (const Tet& t : s.tets) {
    const auto at = [&](Index i, std::size_t d) {
      return s.positions[t[i]][d] - s.positions[t[0]][d];
    };
    const double volume = at(1, 0) * (at(2, 1) * at(3, 2) - at(2, 2) * at(3, 1)) -
                          at(1, 1) * (at(2, 0) * at(3, 2) - at(2, 2) * at(3, 0)) +
                          at(1, 2) * (at(2, 0) * at(3, 1) - at(2, 1) * at(3, 0));
    if (volume < 0 && inverted == 0) first = static_cast<Index>(&t - s.tets.data());
    (volume < 0 ? inverted : positive)++;
  }
  CHECK(s.mesh<double>().summary().inverted_tets == inverted);
  CHECK(s.mesh<double>().summary().first_inverted == first);
  CHECK(s.mesh<double>().summary().first_degenerate == none);
  // A flat one on two triangles of the boundary.
  Solid flat;
  flat.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {7, 7, 7}};
  flat.tets = {{0, 1, 2, 4}, {1, 3, 2, 4}, {0, 1, 2, 3}};
  const auto mesh = flat.mesh<double>();
  CHECK(mesh.summary().degenerate_tets == 1);
  CHECK(mesh.summary().first_degenerate == 2);
  CHECK(mesh.summary().unreferenced_vertices == 1);
  CHECK(mesh.summary().boundary_faces == 6);
}

TEST_CASE("a sliver that rounding has folded over refuses no solid") {
  for (const double fold : {-1e-9, 0., 1e-9}) {
    // Two tetrahedra on a square, and a sliver between them and the one below.
    Solid s;
    s.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, fold}, {.5, .5, 1}, {.5, .5, -1}};
    s.tets = {{0, 1, 2, 4}, {1, 3, 2, 4}, {0, 1, 2, 3}, {0, 1, 3, 5}, {0, 3, 2, 5}};
    const auto mesh = s.mesh<double>();
    CHECK(mesh.summary().boundary_faces == 8);
    const auto field = solve(Serial{}, mesh, PointSource::at(4));
    CHECK(field.distance[5] == Approx(2));
  }
}

TEMPLATE_TEST_CASE("bad solids name what is wrong", "", float, double) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto error = [](const Solid& s) { return message_of([&] { return s.mesh<TestType>(); }); };
  for (const double bad : {nan, infinity, -infinity}) {
    Solid s = solid_cube(2);
    s.positions[7][1] = bad;
    CHECK_THAT(error(s), Contains("vertex 7"));
  }
  Solid s = solid_cube(2);
  s.tets[5][2] = 27;
  CHECK_THAT(error(s), Contains("tet 5") && Contains("vertex 27"));
  s.tets[5] = {0, 1, 2, 1};
  CHECK_THAT(error(s), Contains("tet 5") && Contains("vertex 1 occurs twice"));
  s.tets.clear();
  CHECK_THAT(error(s), Contains("no tetrahedra"));

  Solid fan;
  fan.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.1, 0.1, 2}};
  fan.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 2, 5}};
  CHECK_THAT(error(fan), Contains("tets 0, 1 and 2 share face 0 1 2"));
  for (std::uint32_t k = 0; k < 400; ++k) {
    fan.positions.push_back({0.1, 0.1, 3.0 + k});
    fan.tets.push_back({0, 1, 2, 6 + k});
  }
  CHECK_THAT(error(fan), Contains("tets 0, 1, 2 and 400 more share face 0 1 2: at most two can"));
  fan.tets = {{0, 1, 2, 3}, {0, 1, 2, 5}};
  CHECK_THAT(error(fan), Contains("tets 0 and 1 lie on the same side of face 0 1 2"));
  fan.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  CHECK(error(fan).empty());

  const Solid c = solid_cube(2);
  auto lengths = c.lengths();
  lengths[4][3] = -1;
  CHECK_THAT(message_of([&] { return TetMesh<TestType>(27, c.tets, lengths); }), Contains("tet 4"));
  lengths.pop_back();
  CHECK_THAT(message_of([&] { return TetMesh<TestType>(27, c.tets, lengths); }),
             Contains("lengths"));
}

// By what tetrahedra have in common alone: sets of vertices, no faces and no fans.
TEST_CASE("edges, pinched vertices and components of solids full of holes, by brute force", "") {
  struct Grid {
    std::size_t cells;
    double kept;
    std::vector<int> threads;
  };
  // The last has vertices enough for several threads.
  const std::vector<Grid> grids = {
      {4, 0.9, {1}}, {5, 0.5, {1}}, {6, 0.2, {1}}, {6, 0.05, {1}}, {27, 0.08, {1, 2, 5}}};
  std::minstd_rand random(3);
  std::uniform_real_distribution<double> share(0, 1);
  for (const Grid& grid : grids) {
    const KuhnGrid<3> kuhn({grid.cells, grid.cells, grid.cells}, {1, 1, 1});
    std::vector<Tet> tets;
    for (const Tet& t : kuhn.simplices())
      if (share(random) < grid.kept) tets.push_back(t);
    std::vector<std::array<double, 3>> positions;
    for (Index v = 0; v < kuhn.vertex_count(); ++v) positions.push_back(kuhn.position(v));

    // Tetrahedra with a vertex in common are of one component; those at a vertex touch nowhere else
    // unless chains of them have a second vertex in common.
    std::vector<std::vector<Index>> at(positions.size());
    std::set<std::pair<Index, Index>> edges;
    for (Index t = 0; t < tets.size(); ++t) {
      for (const Index v : tets[t]) at[v].push_back(t);
      for (const auto& [i, j] : tet_edge_ends) edges.insert(std::minmax(tets[t][i], tets[t][j]));
    }
    const auto groups = [&](const std::vector<Index>& of, auto&& keys_of) {
      std::map<Index, Index> above;
      const auto top = [&](Index k) {
        while (above.at(k) != k) k = above.at(k);
        return k;
      };
      for (const Index t : of) {
        Index first = none;
        for (const Index k : keys_of(t)) {
          above.try_emplace(k, k);
          if (first == none)
            first = top(k);
          else if (const Index other = top(k); other != first)
            above[std::max(first, other)] = std::min(first, other), first = std::min(first, other);
        }
      }
      return std::count_if(above.begin(), above.end(),
                           [](const auto& k) { return k.first == k.second; });
    };
    std::size_t pinched = 0;
    for (Index v = 0; v < at.size(); ++v)
      pinched += groups(at[v], [&](Index t) {
                   std::vector<Index> others;
                   std::ranges::copy_if(tets[t], std::back_inserter(others),
                                        [&](Index w) { return w != v; });
                   return others;
                 }) > 1;
    std::vector<Index> all(tets.size());
    for (Index t = 0; t < all.size(); ++t) all[t] = t;
    const auto components = groups(all, [&](Index t) { return tets[t]; });
    CAPTURE(grid.cells, grid.kept, tets.size(), pinched, components);
    CHECK((pinched > 0 || grid.kept > 0.8));

    for (const int threads : grid.threads) {
      const TetMesh<float> mesh(positions, tets, threads);
      CHECK(mesh.summary().edges == edges.size());
      CHECK(mesh.summary().pinched_vertices == pinched);
      CHECK(mesh.pinched().size() == pinched);
      CHECK(std::ranges::is_sorted(mesh.pinched()));
      CHECK(mesh.summary().components == static_cast<std::size_t>(components));
      const Solid solid = {positions, tets};
      const TetMesh<float> by_lengths(positions.size(), tets, solid.lengths(), threads);
      CHECK(by_lengths.summary().edges == edges.size());
      CHECK(by_lengths.summary().pinched_vertices == pinched);
      CHECK(by_lengths.summary().components == static_cast<std::size_t>(components));
    }
  }
}

// Lengths between centred coordinates may pass a tetrahedron at once, so near and far offsets must
// not change what is refused.
TEST_CASE("small tetrahedra are refused by their size beside the extent, whatever the offset", "") {
  const auto error = [](double offset, double size) {
    std::vector<std::array<double, 3>> positions;
    for (const double scale : {1.0, size}) {
      positions.push_back({offset, offset, -offset});
      for (std::size_t d = 0; d < 3; ++d) {
        positions.push_back(positions.back());
        positions.back() = {offset, offset, -offset};
        positions.back()[d] += scale;
      }
    }
    const std::vector<Tet> tets = {{0, 1, 2, 3}, {4, 5, 6, 7}};
    return message_of([&] { TetMesh<float>(positions, tets); });
  };
  constexpr double least = 128 * double{std::numeric_limits<float>::epsilon()};
  for (const double offset : {0.0, 10.0, 1e5}) {
    CAPTURE(offset);
    for (const double share : {1.01, 2.5, 3.5, 5.0, 100.0})
      CHECK(error(offset, share * least) == "");
    for (const double share : {0.99, 0.3})
      CHECK_THAT(error(offset, share * least), Contains("tet 1"));
  }
}

}  // namespace plexway::testing::tet_mesh_test
