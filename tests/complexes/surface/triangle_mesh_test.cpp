#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "complexes/test_meshes.hpp"

namespace plexway::testing::triangle_mesh_test {
using namespace detail;

namespace {

/// What must hold for the records of any surface.
template <class Real>
void check_records(const TriangleMesh<Real>& mesh, const Surface& s) {
  const auto triangles = mesh.triangles();
  const Index faces = static_cast<Index>(mesh.face_count());
  REQUIRE(triangles.size() == faces + 1);
  REQUIRE(mesh.face_count() == s.faces.size());
  REQUIRE(mesh.vertex_count() == s.positions.size());

  const std::set<Index> names(mesh.vertices_inside().begin(), mesh.vertices_inside().end());
  CHECK(names.size() == s.positions.size());  // a permutation
  CHECK((names.empty() || *names.rbegin() + 1 == names.size()));

  std::set<Index> seen;
  bool corners_right = true, links_right = true, lengths_right = true, angles_right = true;
  for (Index f = 0; f < faces; ++f) {
    const TriangleRecord<Real>& t = triangles[f];
    const Index outside = t.face & ~reversed;
    seen.insert(outside);
    const bool turned = (t.face & reversed) != 0;
    for (Index i = 0; i < 3; ++i) {
      const Index caller = turned && i != 0 ? 3 - i : i;
      corners_right &= t.corner[i] == mesh.inside_vertex(s.faces[outside][caller]);
      lengths_right &= t.length[i] >= 0 && std::isfinite(t.length[i]);
      const Real c = t.cosine[i], sine = t.sine(i);
      angles_right &= std::abs(c * c + sine * sine - 1) < 8 * std::numeric_limits<Real>::epsilon();
      const Index g = t.across[i] >> Across::face_shift, j = t.across[i] & Across::edge_mask;
      if (g == faces) continue;
      const TriangleRecord<Real>& u = triangles[g];
      lengths_right &= u.length[j] == t.length[i];
      // Ends of the shared edge are the same vertices, the same way around exactly if flipped.
      const bool flip = (t.across[i] & Across::flip) != 0;
      links_right &= t.corner[i] == u.corner[flip ? j : (j + 1) % 3];
      links_right &= t.corner[(i + 1) % 3] == u.corner[flip ? (j + 1) % 3 : j];
      // Around the edge and home again, in two steps if it is no fan.
      Index at = t.across[i], steps = 1;
      while (at >> Across::face_shift != f || (at & Across::edge_mask) != i) {
        at = triangles[at >> Across::face_shift].across[at & Across::edge_mask];
        if (++steps > 3 * faces) break;
      }
      links_right &= (t.across[i] & Across::fan) ? steps > 2 : steps == 2;
    }
  }
  CHECK(seen.size() == faces);
  CHECK(corners_right);
  CHECK(links_right);
  CHECK(lengths_right);
  CHECK(angles_right);

  std::vector<Index> corners;
  bool complete = true;
  std::vector<std::vector<Index>> expected(mesh.vertex_count());
  for (Index f = 0; f < faces; ++f)
    for (Index i = 0; i < 3; ++i) expected[triangles[f].corner[i]].push_back(3 * f + i);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    mesh.corners_at(v, corners);
    std::sort(corners.begin(), corners.end());
    complete &= corners == expected[v];
    const Index one = mesh.corner_at(v);
    complete &=
        expected[v].empty() ? one == none : std::count(corners.begin(), corners.end(), one) == 1;
  }
  CHECK(complete);
}

long euler(const SurfaceSummary& s) {
  return static_cast<long>(s.vertices - s.unreferenced_vertices) - static_cast<long>(s.edges) +
         static_cast<long>(s.faces);
}

template <class Real>
std::size_t count_flips(const TriangleMesh<Real>& mesh) {
  std::size_t flips = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    for (const Index a : mesh.triangles()[f].across) flips += (a & Across::flip) != 0;
  return flips;
}

}  // namespace

TEMPLATE_TEST_CASE("records of every kind of surface are consistent", "", float, double) {
  Surface holes =
      cut(grid(9, 7), [](double x, double y) { return std::hypot(x - .4, y - .5) > .2; });
  for (const Surface& s :
       {grid(1, 1), grid(7, 5, 3, .1), holes, slit_square(6), random_polygon(6, 60, 90, 1), cube(3),
        tetrahedron(), sphere(2), prism(7, 3, 2), moebius(11), sheets(3, 4), sheets(5, 2),
        bow_tie(3), soup(20, 40, 1), soup(8, 60, 2), soup(300, 90, 3)}) {
    CAPTURE(s.positions.size(), s.faces.size());
    check_records(s.mesh<TestType>(), s);
    const Surface other = renamed(s, 5, true, true).surface;
    check_records(other.mesh<TestType>(), other);
  }
}

TEST_CASE("summary of a grid") {
  const SurfaceSummary s = grid(5, 3).mesh<float>().summary();
  CHECK(s.vertices == 24);
  CHECK(s.faces == 30);
  CHECK(s.boundary_edges == 16);
  CHECK(s.edges == 53);
  CHECK(euler(s) == 1);
  CHECK(s.non_manifold_edges == 0);
  CHECK(s.pinched_vertices == 0);
  CHECK(s.unreferenced_vertices == 0);
  CHECK(s.degenerate_faces == 0);
  CHECK(s.violated_faces == 0);
  CHECK(s.components == 1);
  CHECK(s.orientable);
}

TEST_CASE("summary of closed surfaces") {
  for (const Surface& surface : {tetrahedron(), cube(1), cube(4), sphere(3)}) {
    const SurfaceSummary s = surface.mesh<double>().summary();
    CHECK(euler(s) == 2);
    CHECK(s.boundary_edges == 0);
    CHECK(2 * s.edges == 3 * s.faces);
    CHECK(s.components == 1);
    CHECK(s.orientable);
  }
  CHECK(tetrahedron().mesh<double>().summary().mean_edge == Approx(1));
  CHECK(tetrahedron().mesh<double>().unit() == Approx(1));
}

TEST_CASE("an open prism is an annulus") {
  const SurfaceSummary s = prism(7, 3, 2).mesh<float>().summary();
  CHECK(euler(s) == 0);
  CHECK(s.boundary_edges == 14);
}

TEST_CASE("a moebius band is not orientable") {
  const auto mesh = moebius(11).mesh<float>();
  CHECK_FALSE(mesh.summary().orientable);
  CHECK(euler(mesh.summary()) == 0);
  CHECK(mesh.summary().boundary_edges == 22);
  CHECK(mesh.summary().components == 1);
  CHECK(count_flips(mesh) > 0);
}

TEST_CASE("faces given the wrong way round are turned over") {
  for (const Surface& surface : {grid(6, 6), cube(3), prism(8, 2, 1)}) {
    const Surface messy = renamed(surface, 3, true, true).surface;
    const auto mesh = messy.mesh<double>();
    CHECK(mesh.summary().orientable);
    CHECK(count_flips(mesh) == 0);
    bool any = false;
    for (Index f = 0; f < messy.faces.size(); ++f) {
      const auto [inside, turned] = mesh.inside_face(f);
      any |= turned;
      CHECK(mesh.triangles()[inside].face == (f | (turned ? reversed : 0)));
    }
    CHECK(any);
  }
  CHECK(grid(2, 2).mesh<float>().inside_face(99).first == none);
}

TEST_CASE("three and more triangles on an edge form a fan") {
  for (const Index count : {3u, 4u, 7u}) {
    const auto mesh = sheets(count, 4).mesh<float>();
    CHECK(mesh.summary().non_manifold_edges == 4);
    CHECK(mesh.summary().pinched_vertices == 0);
    CHECK(mesh.summary().components == 1);
    CHECK(mesh.summary().edges == 4 + count * 52);
    CHECK(mesh.summary().boundary_edges == count * 12);
    std::size_t fans = 0;
    for (const auto& t : mesh.triangles())
      for (const Index a : t.across) fans += (a & Across::fan) != 0;
    CHECK(fans == 4 * count);
  }
}

TEST_CASE("two sheets on an edge are no fan") {
  const SurfaceSummary s = sheets(2, 4).mesh<float>().summary();
  CHECK(s.non_manifold_edges == 0);
  CHECK(s.orientable);
}

TEST_CASE("pinched vertices join components") {
  const auto mesh = bow_tie(3).mesh<float>();
  CHECK(mesh.summary().pinched_vertices == 1);
  REQUIRE(mesh.pinched().size() == 1);
  CHECK(mesh.pinched()[0] == mesh.inside_vertex(15));
  CHECK(mesh.summary().components == 1);
  CHECK(mesh.summary().boundary_edges == 24);
}

TEST_CASE("two fans of closed surfaces in one vertex are pinched") {
  Surface s = tetrahedron();
  const Surface other = tetrahedron();
  for (Index v = 1; v < 4; ++v)
    s.add(-other.positions[v][0], -other.positions[v][1], -other.positions[v][2]);
  for (const Face& f : other.faces) {
    Face g{};
    for (std::size_t i = 0; i < 3; ++i) g[i] = f[i] == 0 ? 0 : f[i] + 3;
    s.triangle(g[0], g[1], g[2]);
  }
  const auto mesh = s.mesh<double>();
  CHECK(mesh.summary().pinched_vertices == 1);
  CHECK(mesh.summary().components == 1);
  CHECK(mesh.summary().boundary_edges == 0);
}

TEST_CASE("components and unreferenced vertices are counted") {
  Surface s = grid(2, 2);
  s.add(50, 50, 50);
  const Index a = s.add(5, 5), b = s.add(6, 5), c = s.add(5, 6);
  s.triangle(a, b, c);
  s.add(9, 9);
  const auto mesh = s.mesh<float>();
  CHECK(mesh.summary().components == 2);
  CHECK(mesh.summary().unreferenced_vertices == 2);
  CHECK(mesh.corner_at(mesh.inside_vertex(9)) == none);
  std::vector<Index> corners(3);
  mesh.corners_at(mesh.inside_vertex(9), corners);
  CHECK(corners.empty());
}

TEMPLATE_TEST_CASE("triangles without area and edges without length", "", float, double) {
  Surface s = grid(2, 1);  // vertices 0..5
  const Index far = s.add(3, 0), same = s.add(3, 0), middle = s.add(1.5, 0);
  s.triangle(2, far, middle);  // on a line
  s.triangle(2, far, same);    // an edge without length
  const Index x = s.add(7, 7), y = s.add(7, 7), z = s.add(7, 7);
  s.triangle(x, y, z);  // a point
  const auto mesh = s.mesh<TestType>();
  CHECK(mesh.summary().degenerate_faces == 3);
  check_records(mesh, s);
}

TEMPLATE_TEST_CASE("a surface without any extent", "", float, double) {
  Surface s;
  for (int i = 0; i < 4; ++i) s.add(1, 2, 3);
  s.quad(0, 1, 2, 3);
  const auto mesh = s.mesh<TestType>();
  CHECK(mesh.summary().degenerate_faces == 2);
  CHECK(mesh.unit() > 0);
  check_records(mesh, s);
}

TEMPLATE_TEST_CASE("lengths alone say the same as coordinates", "", float, double) {
  for (const Surface& s : {grid(5, 4), sphere(2), moebius(9), sheets(3, 3), bow_tie(2),
                           random_polygon(5, 40, 60, 4)}) {
    const auto a = s.mesh<TestType>();
    const TriangleMesh<TestType> b(s.positions.size(), s.faces, lengths_of(s));
    check_records(b, s);
    CHECK(a.unit() == Approx(b.unit()).epsilon(1e-14));
    CHECK(a.summary().edges == b.summary().edges);
    CHECK(a.summary().boundary_edges == b.summary().boundary_edges);
    CHECK(a.summary().components == b.summary().components);
    CHECK(a.summary().pinched_vertices == b.summary().pinched_vertices);
    double worst = 0;
    for (Index f = 0; f < s.faces.size(); ++f) {
      const auto [fa, ta] = a.inside_face(f);
      const auto [fb, tb] = b.inside_face(f);
      REQUIRE(ta == tb);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto &ra = a.triangles()[fa], &rb = b.triangles()[fb];
        worst = std::max({worst, std::abs(double(ra.length[i] - rb.length[i])),
                          std::abs(double(ra.cosine[i] - rb.cosine[i])),
                          std::abs(double(ra.sine(i) - rb.sine(i)))});
      }
    }
    CHECK(worst < (sizeof(TestType) == 4 ? 3e-7 : 1e-9));
  }
}

TEST_CASE("lengths that break the triangle inequality are flattened and counted") {
  const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}};
  const std::vector<std::array<double, 3>> lengths = {{1, 1, 5}, {1, 1, 1}};
  const TriangleMesh<float> mesh(4, faces, lengths);
  CHECK(mesh.summary().violated_faces == 1);
  CHECK(mesh.summary().degenerate_faces == 1);
}

TEST_CASE("lengths that differ by rounding on both sides are made one") {
  const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}};
  const TriangleMesh<double> mesh(4, faces,
                                  std::vector<std::array<double, 3>>{{1, 1, 1}, {1 + 1e-12, 1, 1}});
  Surface s;
  s.positions.resize(4);
  s.faces = faces;
  check_records(mesh, s);
}

TEST_CASE("saddles are where paths may bend") {
  const auto saddle_at = [](const Surface& s, Index vertex) {
    const auto mesh = s.mesh<double>();
    std::vector<Index> corners;
    mesh.corners_at(mesh.inside_vertex(vertex), corners);
    std::size_t marked = 0;
    for (const Index c : corners) marked += mesh.triangles()[c / 3].saddle(c % 3);
    CHECK((marked == 0 || marked == corners.size()));
    return marked != 0;
  };
  const Surface ell = cut(grid(4, 4), [](double x, double y) { return x < .5 || y < .5; });
  CHECK(saddle_at(ell, ell.nearest(.5, .5)));
  CHECK_FALSE(saddle_at(ell, ell.nearest(0, 0)));
  CHECK_FALSE(saddle_at(ell, ell.nearest(.25, .25)));
  CHECK_FALSE(saddle_at(ell, ell.nearest(.5, .75)));
  for (Index v = 0; v < 8; ++v) CHECK_FALSE(saddle_at(cube(1), v));
  CHECK(saddle_at(bow_tie(2), 8));
  CHECK(saddle_at(slit_square(4), slit_square(4).nearest(.5, .5)));
}

TEST_CASE("bytes count the records") {
  const auto single = sphere(4).mesh<float>();
  const auto twice = sphere(4).mesh<double>();
  const double faces = static_cast<double>(single.face_count());
  const double vertices = static_cast<double>(single.vertex_count());
  CHECK(double(single.bytes()) >= 64 * faces + 32 * vertices);
  CHECK(double(single.bytes()) <= 68 * (faces + 1) + 32 * vertices + 1024);
  CHECK(double(twice.bytes()) >= 96 * faces + 32 * vertices);
  CHECK(double(twice.bytes()) <= 108 * (faces + 1) + 32 * vertices + 1024);
}

TEST_CASE("coordinates near the ends of the range") {
  for (const double scale : {1e-300, 1e-30, 1e30, 1e300}) {
    Surface s = sphere(1);
    for (Position& p : s.positions)
      for (double& c : p) c *= scale;
    const auto mesh = s.mesh<double>();
    check_records(mesh, s);
    CHECK(mesh.unit() / scale == Approx(sphere(1).mesh<double>().unit()));
    check_records(s.mesh<float>(), s);
  }
}

// Which vertices bend paths is no matter of how finely a surface is cut.

namespace {

/// Of the corners, how many are at saddles.
double share_of_saddles(const Surface& s) {
  const TriangleMesh<float> mesh(s.positions, s.faces);
  std::size_t saddles = 0;
  for (const auto& t : mesh.triangles().first(mesh.face_count()))
    for (std::size_t i = 0; i < 3; ++i) saddles += t.saddle(i);
  return static_cast<double>(saddles) / (3 * static_cast<double>(mesh.face_count()));
}

/// Points of a grid that is moved a little within the plane, lifted, turned and rounded.
Surface lifted(Index n, double digit, const std::function<Position(double, double)>& lift) {
  std::mt19937 random(n);
  Surface s = grid(n, n);
  for (Position& p : s.positions) {
    const bool rim = p[0] == 0 || p[0] == 1 || p[1] == 0 || p[1] == 1;
    const double by = rim ? 0 : 0.3 / n;
    p = lift(p[0] + by * (2 * uniform(random) - 1), p[1] + by * (2 * uniform(random) - 1));
    p = {0.8 * p[0] + 0.6 * p[2], p[1], 0.8 * p[2] - 0.6 * p[0]};
    p = {p[0], 0.8 * p[1] + 0.6 * p[2], 0.8 * p[2] - 0.6 * p[1]};
    if (digit > 0)
      for (double& x : p) x = std::round(x / digit) * digit;
  }
  return s;
}

}  // namespace

TEST_CASE("a surface that is a saddle everywhere has saddles however flat or fine it is") {
  // Excess is curvature times area: 2.5e-3 to 1.6e-6 here, where less than 1e-5 may be rounding.
  for (const double height : {0.5, 0.2, 0.08})
    for (const Index n : {20, 60, 120}) {
      CAPTURE(height, n);
      const Surface s = lifted(n, 0, [&](double x, double y) {
        return Position{x, y, height * (x * x - y * y)};
      });
      // Vertices on the boundary, 4 / n of all, have other reasons.
      CHECK(share_of_saddles(s) > 0.9 - 4.0 / n);
    }
}

TEST_CASE("the share of saddles stays under refinement where curvature changes its sign") {
  const auto egg_box = [](double x, double y) {
    return Position{x, y, 0.02 * std::sin(9 * x) * std::sin(7 * y + 1)};
  };
  const double coarse = share_of_saddles(lifted(40, 0, egg_box));
  CHECK(coarse > 0.3);
  CHECK(coarse < 0.7);
  for (const Index n : {80, 160, 320}) {
    CAPTURE(n);
    CHECK(share_of_saddles(lifted(n, 0, egg_box)) == Approx(coarse).margin(0.05));
    // As files in single precision have it.
    CHECK(share_of_saddles(lifted(n, 1e-7, egg_box)) == Approx(coarse).margin(0.05));
  }
}

TEST_CASE("rounding of coordinates makes no saddles where a surface unrolls") {
  for (const Index n : {40, 150})
    for (const double digit : {0., 1e-7, 1e-6}) {
      CAPTURE(n, digit);
      const auto plane = [](double x, double y) { return Position{x, y, 0}; };
      // Moved along the straight lines on it only: else it does not unroll.
      const auto cylinder = [&](double x, double y) {
        x = std::round(x * n) / n;
        return Position{std::cos(x), std::sin(x), y};
      };
      CHECK(share_of_saddles(lifted(n, digit, plane)) < 0.02);
      CHECK(share_of_saddles(lifted(n, digit, cylinder)) < 0.02);
    }
}

}  // namespace plexway::testing::triangle_mesh_test
