#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <plexway/io/triangles.hpp>

#include "complexes/test_meshes.hpp"
#include "data/corner_domains.hpp"
#include "exact_data.hpp"
#include "windows/windows_solving.hpp"

namespace plexway::testing::windows_exact_test {
using namespace detail;

namespace {

/// Exact distances on a small surface by another way than any of the library's: a shortest path is
/// made of straight lines from vertex to vertex. All straight lines are found by unfolding strips
/// of triangles, as long as a line fits through and is not longer than the longest that may count,
/// and the rest is shortest paths in a graph. Knows of no angles, no saddles, no windows that beat
/// each other. Any number of triangles may share an edge.
class UnfoldedLines {
 public:
  /// Lines longer than `longest` are not looked for.
  UnfoldedLines(const Surface& surface, double longest) : surface_(surface), longest_(longest) {
    for (Index f = 0; f < surface.faces.size(); ++f)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = surface.faces[f][i], b = surface.faces[f][(i + 1) % 3];
        around_[std::minmax(a, b)].push_back({f, surface.faces[f][(i + 2) % 3]});
      }
    const std::size_t n = surface.positions.size();
    line_.assign(n, std::vector<double>(n, infinity));
    for (const Face& face : surface.faces)
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = face[i], b = face[(i + 1) % 3], v = face[(i + 2) % 3];
        for (const auto& [u, w] : {std::pair(a, b), std::pair(b, a)})
          line_[u][w] = std::min(line_[u][w], gap(u, w));
        found_ = &line_[v];
        const Index f = static_cast<Index>(&face - surface.faces.data());
        const Flat p{gap(v, a), 0};
        const Flat q = apex(p, {0, 0}, gap(b, a), gap(v, b));
        follow(f, a, b, p, q, p, q);
      }
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          line_[i][j] = std::min(line_[i][j], line_[i][k] + line_[k][j]);
    for (std::size_t i = 0; i < n; ++i) line_[i][i] = 0;
  }

  [[nodiscard]] const std::vector<double>& from(Index vertex) const { return line_[vertex]; }

  /// From a point of a face.
  [[nodiscard]] std::vector<double> from(Index f, const std::array<double, 3>& b) {
    const Face& face = surface_.faces[f];
    std::array<Flat, 3> corner;
    corner[0] = {0, 0};
    corner[1] = {gap(face[0], face[1]), 0};
    corner[2] = apex(corner[1], corner[0], gap(face[2], face[1]), gap(face[2], face[0]));
    Flat s{0, 0};
    for (std::size_t i = 0; i < 3; ++i) s.x += b[i] * corner[i].x, s.y += b[i] * corner[i].y;
    for (Flat& c : corner) c.x -= s.x, c.y -= s.y;
    std::vector<double> straight(surface_.positions.size(), infinity);
    found_ = &straight;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      straight[face[i]] = std::hypot(corner[i].x, corner[i].y);
      follow(f, face[i], face[j], corner[i], corner[j], corner[i], corner[j]);
    }
    std::vector<double> distance = straight;
    for (std::size_t v = 0; v < distance.size(); ++v)
      for (std::size_t w = 0; w < distance.size(); ++w)
        distance[w] = std::min(distance[w], straight[v] + line_[v][w]);
    return distance;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Flat {
    double x, y;
  };
  static double cross(Flat a, Flat b) { return a.x * b.y - a.y * b.x; }

  [[nodiscard]] double gap(Index v, Index w) const {
    const Position &p = surface_.positions[v], &q = surface_.positions[w];
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  /// The third corner, to the right of the way from `a` to `b`, that far from both.
  static Flat apex(Flat a, Flat b, double to_a, double to_b) {
    const double ex = b.x - a.x, ey = b.y - a.y, length = std::hypot(ex, ey);
    const double along = (to_a * to_a - to_b * to_b + length * length) / (2 * length);
    const double off = std::sqrt(std::max(0., to_a * to_a - along * along));
    const double x = along / length, y = off / length;
    return {a.x + ex * x + ey * y, a.y + ey * x - ex * y};
  }

  /// Over edge a b, seen from the origin at p and q (p to the right), within the rays through `low`
  /// and `high`.
  void follow(Index from, Index a, Index b, Flat p, Flat q, Flat low, Flat high) {
    const double length2 = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
    const double t =
        length2 > 0 ? std::clamp(-(p.x * (q.x - p.x) + p.y * (q.y - p.y)) / length2, 0., 1.) : 0;
    if (std::hypot(p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)) > longest_) return;
    for (const auto& [f, v] : around_.at(std::minmax(a, b))) {
      if (f == from) continue;
      const Flat r = apex(p, q, gap(v, a), gap(v, b));
      const double above = cross(low, r), below = cross(r, high);
      if (above >= 0 && below >= 0) (*found_)[v] = std::min((*found_)[v], std::hypot(r.x, r.y));
      if (above > 0) follow(f, a, v, p, r, low, below > 0 ? r : high);
      if (below > 0) follow(f, v, b, r, q, above > 0 ? r : low, high);
    }
  }

  const Surface& surface_;
  double longest_;
  std::map<std::pair<Index, Index>, std::vector<std::pair<Index, Index>>> around_;
  std::vector<std::vector<double>> line_;
  std::vector<double>* found_ = nullptr;
};

/// In double, in any order: the same bits, and these are right.
void check_exact(const TriangleMesh<double>& mesh, const std::vector<PointSource>& sources,
                 const std::vector<double>& exact, double within = 1e-11) {
  Workspace<double> workspace;
  DistanceField<double> first, field;
  solve_windows(mesh, sources, Accuracy::exact(), {}, workspace, first);
  const Errors e = compare(first.distance, exact);
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.fits);
  CHECK(e.max <= within);
  for (const Schedule schedule : schedules) {
    PropagateOptions options;
    options.schedule = schedule;
    solve_windows(mesh, sources, Accuracy::exact(), options, workspace, field);
    CHECK(field.distance == first.distance);
  }
}

std::vector<double> least(std::vector<double> a, const std::vector<double>& b, double offset) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::min(a[i], b[i] + offset);
  return a;
}

/// No shortest path from any of these vertices, or from inside their triangles, is longer.
double longest_of(const Surface& s, std::initializer_list<Index> from) {
  double longest = 0, edge = 0;
  for (const Index v : from)
    for (const double d : along_edges(s, v))
      if (d < 1e300) longest = std::max(longest, d);
  for (const auto& lengths : lengths_of(s))
    edge = std::max({edge, lengths[0], lengths[1], lengths[2]});
  return longest + edge;
}

/// Small surfaces of every kind, crooked at random.
std::vector<std::pair<const char*, Surface>> small_surfaces(unsigned seed) {
  std::mt19937 random(seed);
  const auto crumple = [&](Surface s, double by) {
    for (Position& p : s.positions)
      for (double& c : p) c += by * (uniform(random) - .5);
    return s;
  };
  return {
      {"sphere", crumple(sphere(1), .3)},
      {"crumpled sphere", crumple(sphere(1), 1.4)},
      {"grid", crumple(grid(4, 3), .25)},
      {"crumpled grid", crumple(grid(4, 3), 1.5)},
      {"polygon", random_polygon(5, 12, 30, seed)},
      {"tetrahedron", crumple(subdivide(tetrahedron()), .5)},
      {"cube", crumple(cube(2), .2)},
      {"moebius", crumple(moebius(7, 1), .3)},
      {"sheets", crumple(sheets(3, 2), .2)},
      {"bow tie", crumple(bow_tie(2), .3)},
      {"soup", soup(7, 9, seed)},
  };
}

}  // namespace

TEST_CASE("exact windows: small surfaces of every kind against all straight lines on them") {
#ifdef PLEXWAY_SANITIZED
  const unsigned seeds = 1;
#else
  const unsigned seeds = 8;
#endif
  for (unsigned seed = 1; seed <= seeds; ++seed)
    for (const auto& [what, s] : small_surfaces(seed)) {
      std::mt19937 random(seed);
      const Index v = s.faces[below(random, s.faces.size())][0], w = s.faces.back()[1];
      const Index f = below(random, s.faces.size());
      UnfoldedLines truth(s, longest_of(s, {v, w, s.faces[f][0]}));
      const auto mesh = s.mesh<double>();
      CAPTURE(what, seed, v, w, f);
      check_exact(mesh, {PointSource::at(v)}, truth.from(v), 1e-9);

      // Two sources, one inside a face, one of them late.
      const double a = .1 + .5 * uniform(random), b = (1 - a) * uniform(random);
      const std::array<double, 3> inside = {a, b, 1 - a - b};
      check_exact(mesh, {PointSource::in(f, inside)}, truth.from(f, inside), 1e-9);
      PointSource late = PointSource::at(w);
      late.offset = .3 * uniform(random);
      check_exact(mesh, {PointSource::in(f, inside), late},
                  least(truth.from(f, inside), truth.from(w), late.offset), 1e-9);

      // On an edge, from the side of either triangle.
      const std::array<double, 3> on_edge = {a, 1 - a, 0};
      check_exact(mesh, {PointSource::in(f, on_edge)}, truth.from(f, on_edge), 1e-9);
    }
}

TEST_CASE("exact windows: many sources inside faces, each in the light of others") {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    std::mt19937 random(seed);
    const Surface s = seed % 2 ? random_polygon(6, 20, 60, seed) : grid(4, 4);
    const auto mesh = s.mesh<double>();
    std::vector<PointSource> sources;
    std::vector<double> exact(s.positions.size(), 1e300);
    for (int n = 0; n < 6; ++n) {
      const Index f = below(random, s.faces.size());
      const double a = .05 + .4 * uniform(random), b = .05 + .4 * uniform(random);
      const std::array<double, 3> inside = {a, b, 1 - a - b};
      sources.push_back(PointSource::in(f, inside));
      sources.back().offset = .2 * uniform(random);
      Position p{};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) p[c] += inside[i] * s.positions[s.faces[f][i]][c];
      exact = least(exact, straight(s, p), sources.back().offset);
    }
    CAPTURE(seed);
    check_exact(mesh, sources, exact);
  }
}

TEST_CASE("exact windows: corners, slits and holes of flat domains") {
  for (const samples::CornerDomain& domain : samples::corner_domains()) {
    const samples::Shape grid = domain.grid(50);
    CAPTURE(domain.name);
    check_exact(TriangleMesh<double>(grid.points, grid.faces), {PointSource::at(0)},
                domain.distances(grid.points), 1e-9);
  }
}

// Real meshes with exact distances.

namespace {

Surface read(const std::filesystem::path& file) {
  io::Triangles t = io::read_triangles(file);
  return {std::move(t.positions), std::move(t.triangles)};
}

}  // namespace

TEST_CASE("windows on real surfaces: exact is exact, accurate is accurate") {
  std::vector<double> means;
  for (const char* const what : {"spot", "fandisk", "rocker-arm", "camelhead", "beetle_car",
                                 "bunny", "armadillo", "wavy_grid200", "t79741", "t908460"}) {
#ifdef PLEXWAY_SANITIZED
    if (means.size() == 2) break;
#endif
    const std::filesystem::path file = exact_file("surfaces", std::string(what) + ".obj");
    if (file.empty()) continue;
    const Surface s = read(file);
    const auto single = s.mesh<float>();
    const auto mesh = s.mesh<double>();
    // Not for merging: needles.
    const bool needles = what[0] == 't';
    double mean = 0;
    const std::vector<ExactAnswer> truths = exact_answers(file);
    REQUIRE_FALSE(truths.empty());
    for (const ExactAnswer& truth : truths) {
      const auto source = PointSource::at(static_cast<Index>(truth.source));
      CAPTURE(what, truth.source);
      const Errors exact =
          compare(solve_windows(mesh, {source}, Accuracy::exact()), truth.distance);
      CAPTURE(exact.mean, exact.max);
      CHECK(exact.fits);
      CHECK(exact.max <= 1e-8);
      const Errors near =
          compare(solve_windows(single, {source}, Accuracy::accurate()), truth.distance);
      CAPTURE(near.mean, near.max);
      CHECK(near.fits);
      CHECK(near.max <= (needles ? 2e-2 : 5e-3));
      mean += near.mean / static_cast<double>(truths.size());
    }
    CAPTURE(what, mean);
    CHECK(mean <= 2e-4);
    means.push_back(mean);
  }
#ifndef PLEXWAY_SANITIZED
  if (means.size() < 10) return;
  std::sort(means.begin(), means.end());
  CHECK((means[4] + means[5]) / 2 <= 7e-5);
#endif
}

}  // namespace plexway::testing::windows_exact_test
