#include <filesystem>
#include <limits>
#include <string>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>

#include "exact_data.hpp"
#include "labels/solving.hpp"
#include "paths/path_testing.hpp"

namespace plexway {
// An executor that leaves nothing but distances.
struct Forgetful {
  static constexpr ExecutorKind kind = ExecutorKind::serial;
  struct Workspace {};
};
template <>
void solve(const Forgetful&, const TriangleMesh<double>& mesh, const SourceList& sources,
           const PropagateOptions& options, Forgetful::Workspace&, DistanceField<double>& field) {
  field = solve(Serial{}, mesh, sources, options);
}
}  // namespace plexway

namespace plexway::testing::surface_path_test {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Paths from many points of a surface, checked by themselves and against the exact distance.
template <class Real, class Exact>
void check_exact(const Surface& s, const PointSource& source, Exact exact, double tolerance,
                 unsigned seed = 1) {
  const auto mesh = s.mesh<Real>();
  PathField field(mesh, s.positions);
  field.solve(Serial{}, source);
  std::mt19937 random(seed);
  for (int k = 0; k < 60; ++k) {
    const PointSource target =
        k % 2 ? PointSource::at(below(random, s.positions.size())) : anywhere(s.faces, random);
    const Position at = target.vertex != none
                            ? s.positions[target.vertex]
                            : place(s.positions, s.faces[target.simplex], target.barycentric);
    const Path path = field.trace(target);
    CAPTURE(k, at[0], at[1], at[2]);
    check_path(path, s.positions, s.faces);
    CHECK(path.source == 0);
    CHECK(apart(path.positions.front(), at) <= 1e-12);
    CHECK(path.length == Approx(exact(at)).epsilon(tolerance).margin(1e-9));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("paths in the plane are straight", "", float, double) {
  const Surface s = random_polygon(12, 200, 300, 3);
  // Convex: a polygon on a circle.
  const Index v = 40;
  check_exact<TestType>(
      s, PointSource::at(v), [&](const Position& p) { return apart(p, s.positions[v]); }, 1e-9);
}

TEST_CASE("paths from a point inside a triangle are straight") {
  const Surface s = grid(9, 7);
  const PointSource source = PointSource::in(50, {0.2, 0.5, 0.3});
  const Position from = place(s.positions, s.faces[50], source.barycentric);
  check_exact<float>(
      s, source, [&](const Position& p) { return apart(p, from); }, 1e-9);
}

TEST_CASE("paths turn around the end of a slit") {
  const Surface s = slit_square(12);
  const Position from = {0.25, 0.0, 0}, tip = {0.5, 0.5, 0};
  const PointSource source = PointSource::at(s.nearest(from[0], from[1]));
  check_exact<double>(
      s, source,
      [&](const Position& p) {
        if (p[0] <= 0.5) return apart(p, from);
        const double y = from[1] + (p[1] - from[1]) * (0.5 - from[0]) / (p[0] - from[0]);
        return y >= 0.5 ? apart(p, from) : apart(p, tip) + apart(tip, from);
      },
      1e-9);
}

TEST_CASE("paths around a prism are straight when it is unrolled") {
  const Index n = 9;
  const Surface s = prism(n, 5, 2);
  const double r = 0.5 / std::sin(std::numbers::pi / n);
  // Along the perimeter: whole sides, and the part of the last.
  const auto unrolled = [&](const Position& p) {
    double best = infinity, at = 0;
    for (Index i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * (i + 1) / n;
      const double x0 = r * std::cos(a), y0 = r * std::sin(a), x1 = r * std::cos(b),
                   y1 = r * std::sin(b);
      const double t = std::clamp((p[0] - x0) * (x1 - x0) + (p[1] - y0) * (y1 - y0), 0., 1.);
      const double off = std::hypot(p[0] - x0 - t * (x1 - x0), p[1] - y0 - t * (y1 - y0));
      if (off < best - 1e-9) best = off, at = i + t;
    }
    return at;
  };
  check_exact<float>(
      s, PointSource::at(0),
      [&](const Position& p) {
        const double u = unrolled(p);
        return std::hypot(std::min(u, n - u), p[2]);
      },
      1e-9);
}

TEST_CASE("the way over a cube from corner to corner") {
  const Surface s = cube(6);
  const auto mesh = s.mesh<float>();
  PathField field(mesh, s.positions);
  field.solve(Serial{}, PointSource::at(s.nearest(0, 0, 0)));
  const Path path = field.trace(s.nearest(1, 1, 1));
  check_path(path, s.positions, s.faces);
  CHECK(path.length == Approx(std::sqrt(5.0)).epsilon(1e-9));
}

TEST_CASE("paths on cones pass beside a sharp tip and over a blunt one") {
  const Index n = 20;
  for (const double whole : {1.2 * std::numbers::pi, 2.6 * std::numbers::pi}) {
    // From lengths: rim vertices 1 .. n, all 1 from the tip 0.
    const double angle = whole / n, side = 2 * std::sin(angle / 2);
    std::vector<Face> faces;
    std::vector<std::array<double, 3>> lengths;
    for (Index i = 0; i < n; ++i) {
      faces.push_back({0, 1 + i, 1 + (i + 1) % n});
      lengths.push_back({1, side, 1});
    }
    const TriangleMesh<double> mesh(n + 1, faces, lengths);
    PathField field(mesh);
    field.solve(Serial{}, PointSource::at(1));
    for (Index i = 0; i < n; ++i) {
      const double turn = angle * std::min(i, n - i);
      const Path path = field.trace(1 + i);
      CAPTURE(whole, i);
      CHECK(path.positions.empty());
      CHECK(
          path.length ==
          Approx(turn < std::numbers::pi ? 2 * std::sin(turn / 2) : 2).epsilon(1e-9).margin(1e-9));
    }
  }
}

TEST_CASE("paths over an edge of several triangles unfold the two sheets they use") {
  const Surface s = sheets(3, 6);
  const auto mesh = s.mesh<double>();
  PathField field(mesh, s.positions);
  const Index source = 20;
  field.solve(Serial{}, PointSource::at(source));
  const auto off = [](const Position& p) { return std::hypot(p[0], p[1]); };
  const Position from = s.positions[source];
  for (Index v = 0; v < s.positions.size(); ++v) {
    const Position& to = s.positions[v];
    const Path path = field.trace(v);
    CAPTURE(v);
    check_path(path, s.positions, s.faces);
    const bool same = from[0] * to[0] + from[1] * to[1] > (1 - 1e-9) * off(from) * off(to);
    const double across = same ? std::abs(off(from) - off(to)) : off(from) + off(to);
    CHECK(path.length == Approx(std::hypot(across, from[2] - to[2])).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("paths pass a vertex where two parts touch") {
  const Surface s = bow_tie(5);
  const auto mesh = s.mesh<float>();
  PathField field(mesh, s.positions);
  field.solve(Serial{}, PointSource::at(s.nearest(0.2, 0.4)));
  const Position joint = {1, 1, 0};
  for (Index v = 0; v < s.positions.size(); ++v) {
    const Position& p = s.positions[v];
    const Path path = field.trace(v);
    CAPTURE(v);
    check_path(path, s.positions, s.faces);
    const Position from = {0.2, 0.4, 0};
    const double exact =
        p[0] <= 1 && p[1] <= 1 ? apart(p, from) : apart(p, joint) + apart(joint, from);
    CHECK(path.length == Approx(exact).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("a path where none leads is empty") {
  Surface s = grid(3, 3);
  const Index first = static_cast<Index>(s.positions.size());
  const Surface other = grid(2, 2);
  for (const Position& p : other.positions) s.add(p[0], p[1], 5);
  for (const Face& f : other.faces) s.triangle(f[0] + first, f[1] + first, f[2] + first);
  s.add(9, 9, 9);  // in no triangle
  const auto mesh = s.mesh<float>();
  PathField field(mesh, s.positions);
  CHECK_THROWS_AS(field.trace(Index{0}), UsageError);
  field.solve(Serial{}, PointSource::at(0));
  for (const PointSource& p :
       {PointSource::at(first + 1), PointSource::at(static_cast<Index>(s.positions.size() - 1)),
        PointSource::in(static_cast<Index>(s.faces.size() - 1), {0.2, 0.3, 0.5})}) {
    const Path path = field.trace(p);
    CHECK(path.points.empty());
    CHECK(path.positions.empty());
    CHECK(path.length == infinity);
    CHECK(path.source == none);
  }
  CHECK_THROWS_AS(field.trace(Index{999}), UsageError);
  CHECK_THROWS_AS(PathField(mesh, other.positions), UsageError);

  // From a source that no triangle has to itself there is no way to go.
  const Index alone = static_cast<Index>(s.positions.size() - 1);
  const PointSource both[] = {PointSource::at(0), PointSource::at(alone)};
  field.solve(Serial{}, both);
  CHECK(field.distances().distance[alone] == 0);
  const Path none_needed = field.trace(alone);
  CHECK(none_needed.points.empty());
  CHECK(none_needed.length == 0);
  CHECK(none_needed.source == 1);
}

TEST_CASE("each solve has its own paths, to the nearest of several sources") {
  const Surface s = grid(12, 12);
  const auto mesh = s.mesh<float>();
  PathField field(mesh, s.positions);
  field.solve(Serial{}, PointSource::at(0));
  CHECK(field.trace(Index{12}).length == Approx(1));
  std::vector<PointSource> sources = {PointSource::at(s.nearest(1, 1)), PointSource::at(0),
                                      PointSource::in(100, {0.3, 0.3, 0.4})};
  sources[1].offset = 0.25;
  for (const Visibility visibility : visibilities) {
    PropagateOptions options;
    options.visibility = visibility;
    field.solve(Serial{}, std::span<const PointSource>(sources), options);
    const Position inside = place(s.positions, s.faces[100], sources[2].barycentric);
    for (Index v = 0; v < s.positions.size(); v += 3) {
      const Path path = field.trace(v);
      check_path(path, s.positions, s.faces);
      const double to[3] = {apart(s.positions[v], {1, 1, 0}), apart(s.positions[v], {0, 0, 0}),
                            apart(s.positions[v], inside)};
      const double whole[3] = {to[0], to[1] + 0.25, to[2]};
      CAPTURE(v, path.source, name(options));
      CHECK(path.length == Approx(to[path.source]).epsilon(1e-9).margin(1e-12));
      CHECK(whole[path.source] <= *std::min_element(whole, whole + 3) * (1 + 2e-2) + 1e-6);
    }
  }
}

TEST_CASE("without labels a path is found by the vertices alone") {
  const Surface s = sphere(3);
  const auto mesh = s.mesh<double>();
  PathField field(mesh, s.positions);
  field.solve(Forgetful{}, PointSource::at(0));
  std::vector<double> lengths;
  for (Index v = 0; v < s.positions.size(); v += 7) lengths.push_back(field.trace(v).length);
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const double chord = apart(s.positions[7 * k], s.positions[0]);
    const double arc = 2 * std::asin(std::min(chord / 2, 1.0));
    CHECK(lengths[k] >= chord - 1e-12);
    CHECK(lengths[k] <= arc + 1e-12);  // the polyhedron is inside the sphere
    CHECK(lengths[k] >= arc * 0.98 - 1e-12);
  }
}

TEST_CASE("paths on awkward surfaces stay there and end") {
  for (unsigned seed = 0; seed < 25; ++seed) {
    Surface s = soup(40 + 10 * (seed % 4), 120, seed);
    if (seed % 3 == 0)
      for (Position& p : s.positions) p[2] = seed % 2 ? 0 : std::round(3 * p[2]);
    const auto mesh = s.mesh<float>();
    PathField field(mesh, s.positions);
    const auto& found = field.solve(Serial{}, PointSource::at(s.faces[0][0]));
    const std::vector<double> edges = along_edges(s, s.faces[0][0]);
    for (Index v = 0; v < s.positions.size(); ++v) {
      const Path path = field.trace(v);
      CAPTURE(seed, v);
      REQUIRE(std::isinf(path.length) == std::isinf(static_cast<double>(found.distance[v])));
      if (std::isinf(path.length)) continue;
      check_path(path, s.positions, s.faces);
      CHECK(apart(path.positions.back(), s.positions[s.faces[0][0]]) <= 1e-12);
      CHECK(path.length <= edges[v] * 1.01 + 1e-12);
    }
  }
}

TEST_CASE("path lengths against exact distances on real surfaces") {
  double sum = 0, below_exact = 0;
  std::size_t count = 0;
  for (const std::filesystem::path& answer : exact_files("surfaces", ".txt")) {
    const std::string file = answer.filename().string();
    const std::size_t dot = file.find(".v");
    const io::Triangles t =
        io::read_triangles(exact_file("surfaces", file.substr(0, dot) + ".obj"));
    const std::vector<double> exact = exact_values(answer);
    const TriangleMesh<float> mesh(t.positions, t.triangles);
    PathField field(mesh, t.positions);
    const Index source = static_cast<Index>(std::stoul(file.substr(dot + 2)));
    field.solve(Serial{}, PointSource::at(source));
    std::mt19937 random(1);
    double own = 0;
    std::size_t paths = 0;
    for (int k = 0; k < 60; ++k) {
      const Index v = below(random, exact.size());
      if (!(exact[v] > 0) || std::isinf(exact[v])) continue;
      const Path path = field.trace(v);
      const double error = path.length / exact[v] - 1;
      own += error;
      ++paths;
      below_exact = std::min(below_exact, error);
      if (k % 10 == 0) {
        CAPTURE(file, v);
        check_path(path, t.positions, t.triangles, exact[v]);
        CHECK(path.positions.front() == t.positions[v]);
        CHECK(apart(path.positions.back(), t.positions[source]) <= 1e-12 * exact[v]);
      }
    }
    CAPTURE(file, own / static_cast<double>(paths));
    // Long thin triangles of a CAD part: labels there are 0.6 % off and lead the wrong way at
    // times.
    if (file.rfind("t79741", 0) != 0) CHECK(own <= 1.5e-4 * static_cast<double>(paths));
    sum += own;
    count += paths;
  }
  REQUIRE(count > 0);
  CAPTURE(sum / static_cast<double>(count), below_exact);
  CHECK(sum <= 5e-4 * static_cast<double>(count));
  CHECK(below_exact >= -1e-6);
}

TEST_CASE("a wider margin never makes a path longer, and a flat path cannot be shorter") {
  Surface s = grid(30, 30);
  const auto flat = s.mesh<double>();
  PathField on_flat(flat, s.positions);
  on_flat.solve(Serial{}, PointSource::at(0));
  const Path straight = on_flat.trace(900, {.margin = 0.2});
  CHECK(straight.length == Approx(apart(s.positions[0], s.positions[900])).epsilon(1e-12));
  for (Position& p : s.positions) p[2] = 0.15 * std::sin(11 * p[0]) * std::cos(9 * p[1]);
  const auto mesh = s.mesh<float>();
  PathField field(mesh, s.positions);
  std::mt19937 random(2);
  std::size_t windows = 0;
  for (int k = 0; k < 5; ++k) {
    field.solve(Serial{}, anywhere(s.faces, random));
    for (int i = 0; i < 10; ++i) {
      const PointSource target = anywhere(s.faces, random);
      double before = infinity;
      for (const double margin : {0., 1e-3, 1e-1}) {
        const Path path = field.trace(target, {.margin = margin});
        CAPTURE(k, i, margin);
        check_path(path, s.positions, s.faces);
        CHECK(path.length <= before * (1 + 1e-12));
        before = path.length;
        windows += path.windows;
        if (margin == 0) CHECK(path.windows == 0);
      }
    }
  }
  CHECK(windows > 0);
  // Where windows run out it says so, and more margin still does no harm.
  std::size_t capped = 0;
  for (const Index target : {960u, 30u, 930u, 500u}) {
    double before = field.trace(target, {.margin = 0}).length;
    for (const double margin : {3e-3, 6e-3, 1.2e-2, 4.8e-2, 0.3}) {
      const Path path = field.trace(target, {.margin = margin, .max_windows = 60});
      CAPTURE(target, margin);
      CHECK(path.length <= before * (1 + 1e-12));
      before = path.length;
      capped += path.capped;
    }
    CHECK_FALSE(field.trace(target).capped);
  }
  CHECK(capped > 0);
  CHECK_THROWS_AS(field.trace(0, {.margin = 1}), UsageError);
  CHECK_THROWS_AS(field.trace(0, {.margin = -1}), UsageError);
}

}  // namespace plexway::testing::surface_path_test
