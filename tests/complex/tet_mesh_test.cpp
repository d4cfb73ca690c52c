#include <catch2/catch.hpp>

#include <limits>
#include <set>
#include <string>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complex/test_solids.hpp"

using namespace plexway;
using namespace plexway::testing;
using Catch::Matchers::Contains;

namespace {

template <class Make>
std::string error_of(Make make) {
  try {
    make();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

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
  CHECK(l.reflex_edges().size() == 1);  // one straight row
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
  const auto error = [](const Solid& s) { return error_of([&] { return s.mesh<TestType>(); }); };
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
  CHECK_THAT(error_of([&] { return TetMesh<TestType>(27, c.tets, lengths); }), Contains("tet 4"));
  lengths.pop_back();
  CHECK_THAT(error_of([&] { return TetMesh<TestType>(27, c.tets, lengths); }), Contains("lengths"));
}
