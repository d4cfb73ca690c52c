#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include <plexway/surface/intrinsic_delaunay.hpp>

#include "paths/path_testing.hpp"
#include "with_accuracy.hpp"

using namespace plexway;
using namespace plexway::testing;

// Paths of fields that were solved on an intrinsic Delaunay triangulation.
namespace {

/// A surface, its triangulation, and a field on that with paths on the surface.
template <class Real>
struct Laid {
  TriangleMesh<Real> input;
  IntrinsicDelaunay delaunay;
  TriangleMesh<Real> mesh;
  PathField<TriangleMesh<Real>> field;

  explicit Laid(const Surface& s, const Refinement& refinement = {})
      : input(s.positions, s.faces),
        delaunay(TriangleMesh<double>(s.positions, s.faces), refinement),
        mesh(delaunay.mesh<Real>()),
        field(mesh, delaunay, input, s.positions) {}
};

/// A hilly grid of narrow, slanting cells, each cut along one of its diagonals, so that flips are
/// due: some with holes, whose corners may touch in a vertex alone.
Surface hills(std::mt19937& random, double height, double left_out) {
  const Index nx = 3 + below(random, 8), ny = 3 + below(random, 8);
  const double narrow = std::exp(-2 * uniform(random)), shear = .5 * uniform(random);
  Surface s;
  for (Index i = 0; i < nx; ++i)
    for (Index k = 0; k < ny; ++k) s.add(narrow * i, k + shear * i, height * uniform(random));
  for (Index i = 0; i + 1 < nx; ++i)
    for (Index k = 0; k + 1 < ny; ++k) {
      const Index a = i * ny + k, b = a + 1, c = a + ny, d = c + 1;
      const bool falls = uniform(random) < .5;
      if (uniform(random) < left_out) continue;
      s.triangle(a, b, falls ? c : d);
      s.triangle(falls ? b : a, d, c);
    }
  if (s.faces.empty()) s.triangle(0, 1, ny);
  return s;
}

/// Vertices, points inside triangles, and whole rows of vertices, as a curve has them.
std::vector<PointSource> some_sources(const Surface& s, std::mt19937& random, int k) {
  std::vector<PointSource> sources = {k % 2 ? anywhere(s.faces, random)
                                            : PointSource::at(below(random, s.positions.size()))};
  if (k % 3 == 1)
    for (Index v = 0; v < s.positions.size() && s.positions[v][0] == 0; ++v)
      sources.push_back(PointSource::at(v));
  if (k % 3 == 2) {
    sources.push_back(anywhere(s.faces, random));
    sources.back().offset = uniform(random);
    sources.push_back(PointSource::at(below(random, s.positions.size())));
    sources.back().offset = .3;
  }
  return sources;
}

struct Difference {
  double longer = 0, shorter = 0;                // of a path than its distance, relative
  std::size_t flips = 0, paths = 0, beyond = 0;  // the estimate
  std::size_t short_steps = 0;
};

/// Paths to vertices and points inside triangles of 500 surfaces.
template <class Real>
Difference compare(Accuracy accuracy, const Refinement& refinement) {
  Difference all;
  for (unsigned k = 0; k < 500; ++k) {
    std::mt19937 random(k);
    const Surface s = hills(random, k % 4 == 0 ? 0 : 1.5 * uniform(random), k % 4 == 3 ? .15 : 0);
    Laid<Real> laid(s, refinement);
    all.flips += laid.delaunay.summary().flips > 0;
    const std::vector<PointSource> sources = some_sources(s, random, static_cast<int>(k));
    const auto& found =
        laid.field.solve(Serial{}, std::span<const PointSource>(sources), at(accuracy));
    for (int t = 0; t < 9; ++t) {
      const PointSource target = t % 3 == 0 ? anywhere(s.faces, random)
                                            : PointSource::at(below(random, s.positions.size()));
      const double distance = laid.field.at(target);
      const Path path = laid.field.trace(target);
      CAPTURE(k, t, distance, path.length);
      REQUIRE((path.source == none) == std::isinf(distance));
      if (path.source == none || path.points.empty()) continue;
      check_path(path, s.positions, s.faces);
      const PointSource& source = sources[path.source];
      const auto position = [&](const PointSource& p) {
        return p.vertex != none ? s.positions[p.vertex]
                                : place(s.positions, s.faces[p.simplex], p.barycentric);
      };
      CHECK(apart(path.positions.front(), position(target)) <= 1e-14);
      CHECK(apart(path.positions.back(), position(source)) <= 1e-14);
      for (std::size_t i = 0; i + 1 < path.positions.size(); ++i)
        all.short_steps += apart(path.positions[i], path.positions[i + 1]) < 1e-10;
      const double length = path.length + source.offset, off = length - distance;
      ++all.paths;
      if (!(distance > 0)) continue;
      all.longer = std::max(all.longer, off / distance);
      all.shorter = std::max(all.shorter, -off / distance);
      if (target.vertex != none && !found.error.empty())
        all.beyond += std::abs(off) > found.error[target.vertex] + 1e-6 * distance;
    }
  }
  CHECK(all.flips > 300);
  CHECK(all.paths > 4000);
  CHECK(all.short_steps == 0);
  return all;
}

/// How many points a straight path over a flat surface has whose vertices have the places `at`: its
/// ends, and where it crosses edges, in whole numbers.
std::size_t points_on_the_way(const Surface& s, std::span<const std::array<std::int64_t, 2>> at,
                              Index from, Index to) {
  const auto turn = [&](Index a, Index b, Index c) {
    return (at[b][0] - at[a][0]) * (at[c][1] - at[a][1]) -
           (at[b][1] - at[a][1]) * (at[c][0] - at[a][0]);
  };
  std::set<std::pair<std::int64_t, std::int64_t>> shares = {{0, 1}, {1, 1}};
  for (const Face& f : s.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index p = f[i], q = f[(i + 1) % 3];
      const std::int64_t left = turn(from, to, p), right = turn(from, to, q);
      if (left == right || (left > 0 && right > 0) || (left < 0 && right < 0)) continue;
      // From `from` to the line of the edge, of the way to `to`.
      std::int64_t share = turn(p, q, from), whole = share - turn(p, q, to);
      if (whole < 0) share = -share, whole = -whole;
      if (share < 0 || share > whole) continue;
      const std::int64_t common = std::gcd(share, whole);
      shares.insert({share / common, whole / common});
    }
  return shares.size();
}

}  // namespace

TEST_CASE("a path over flipped triangles is as long as its distance") {
  // A strip that is folded along its short diagonals.
  Surface s;
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 3; ++k) s.add(.2 * i, k, (2 * i + k) % 3 * .4);
  for (Index i = 0; i < 3; ++i)
    for (Index k = 0; k < 2; ++k) {
      const Index a = 3 * i + k;
      s.triangle(a, a + 3, a + 1);
      s.triangle(a + 1, a + 3, a + 4);
    }
  Laid<double> laid(s);
  REQUIRE(laid.delaunay.summary().flips > 0);
  const TriangleMesh<double> mesh(s.positions, s.faces);
  PathField direct(mesh, s.positions);
  for (Index from = 0; from < s.positions.size(); ++from) {
    const auto& found = laid.field.solve(Serial{}, PointSource::at(from), at(Accuracy::exact()));
    direct.solve(Serial{}, PointSource::at(from), at(Accuracy::exact()));
    for (Index to = 0; to < s.positions.size(); ++to) {
      const Path path = laid.field.trace(to);
      CAPTURE(from, to);
      check_path(path, s.positions, s.faces);
      CHECK(path.length == Approx(found.distance[to]).epsilon(1e-12).margin(1e-15));
      CHECK(path.length == Approx(direct.trace(to).length).epsilon(1e-12).margin(1e-15));
    }
  }
}

TEST_CASE("paths are as long as distances on 500 flipped surfaces, exactly") {
  for (const Refinement& refinement : {Refinement(), Refinement::moderate()}) {
    const Difference all = compare<double>(Accuracy::exact(), refinement);
    CHECK(all.longer <= 1e-12);
    CHECK(all.shorter <= 1e-12);
  }
}

TEST_CASE("paths are as long as distances on 500 flipped surfaces, by the estimate of error") {
  const Difference all = compare<float>(Accuracy::accurate(), {});
  CAPTURE(all.longer, all.shorter, all.beyond, all.paths);
  CHECK(all.longer <= 1e-3);
  CHECK(all.shorter <= 1e-3);
  // It is an estimate: now and then too small.
  CHECK(static_cast<double>(all.beyond) <= .03 * static_cast<double>(all.paths));
}

TEST_CASE("paths after labels on flipped surfaces lie there and are hardly longer than need be") {
  double mean = 0;
  std::size_t paths = 0;
  for (unsigned k = 0; k < 200; ++k) {
    std::mt19937 random(k);
    const Surface s = hills(random, uniform(random), k % 4 == 3 ? .15 : 0);
    const PointSource source = PointSource::at(s.faces[0][0]);
    Laid<float> laid(s);
    Laid<double> exact(s);
    laid.field.solve(Serial{}, source, by_labels());
    exact.field.solve(Serial{}, source, at(Accuracy::exact()));
    for (int t = 0; t < 8; ++t) {
      const PointSource target = anywhere(s.faces, random);
      const double least = exact.field.at(target);
      const Path path = laid.field.trace(target);
      CAPTURE(k, t, least);
      REQUIRE((path.source == none) == std::isinf(least));
      if (path.source == none) continue;
      check_path(path, s.positions, s.faces);
      CHECK(path.length >= least * (1 - 1e-12));
      CHECK(path.length <= least * 1.03);
      mean += path.length / least - 1;
      ++paths;
    }
  }
  CHECK(mean <= 1e-4 * static_cast<double>(paths));
}

TEMPLATE_TEST_CASE("a path over a flat grid crosses each edge once", "", float, double) {
  for (const bool sheared : {false, true}) {
    std::mt19937 random(5);
    Surface s;
    std::vector<std::array<std::int64_t, 2>> places;
    const Index n = 13;
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < n; ++k) {
        s.add(i + (sheared ? k : 0.), k);
        places.push_back({i, k});
      }
    for (Index i = 0; i + 1 < n; ++i)
      for (Index k = 0; k + 1 < n; ++k) {
        const Index a = i * n + k, b = a + 1, c = a + n, d = c + 1;
        const bool falls = sheared && uniform(random) < .5;
        s.triangle(a, b, falls ? c : d);
        s.triangle(falls ? b : a, d, c);
      }
    Laid<TestType> laid(s);
    REQUIRE((laid.delaunay.summary().flips > 0) == sheared);
    PathField direct(laid.input, s.positions);
    if (!sheared) CHECK(points_on_the_way(s, places, 0, n * n - 1) == 13);
    for (int k = 0; k < 300; ++k) {
      const Index from = k == 0 ? 0 : below(random, s.positions.size());
      const Index to = k == 0 ? n * n - 1 : below(random, s.positions.size());
      if (from == to) continue;
      const std::size_t points = points_on_the_way(s, places, from, to);
      for (auto* const field : {&laid.field, &direct}) {
        field->solve(Serial{}, PointSource::at(from), at(Accuracy::accurate()));
        const Path path = field->trace(to);
        CAPTURE(sheared, from, to, field == &direct);
        CHECK(path.points.size() == points);
        CHECK(path.length == Approx(apart(s.positions[from], s.positions[to])).epsilon(1e-14));
      }
    }
  }
}

TEST_CASE("directions, distances inside and nearest sources are those of the input's triangles") {
  for (const Accuracy accuracy : {Accuracy::exact(), Accuracy::fast()}) {
    std::mt19937 random(8);
    const Surface s = hills(random, 0, 0);
    Laid<double> laid(s, Refinement::moderate());
    REQUIRE(laid.delaunay.summary().flips > 0);
    REQUIRE(laid.delaunay.summary().inserted_vertices > 0);
    const std::vector<PointSource> sources = {PointSource::at(0), anywhere(s.faces, random)};
    const Position from[2] = {
        s.positions[0], place(s.positions, s.faces[sources[1].simplex], sources[1].barycentric)};
    laid.field.solve(Serial{}, std::span<const PointSource>(sources), at(accuracy));
    const double within = accuracy == Accuracy::exact() ? 1e-9 : 2e-2;
    const auto directions = laid.field.gradient();
    const auto labels = laid.field.simplex_labels();
    REQUIRE(directions.size() == s.faces.size());
    REQUIRE(labels.size() == s.faces.size());
    for (Index f = 0; f < s.faces.size(); ++f) {
      const PointSource centre = PointSource::in(f, {1. / 3, 1. / 3, 1. / 3});
      const Position p = place(s.positions, s.faces[f], centre.barycentric);
      const double to[2] = {apart(p, from[0]), apart(p, from[1])};
      const std::size_t nearest = to[1] < to[0];
      CAPTURE(f, accuracy.error());
      CHECK(laid.field.at(centre) == Approx(to[nearest]).epsilon(within));
      const double apart_enough = accuracy == Accuracy::exact() ? 1e-9 : .3;
      if (std::abs(to[0] - to[1]) < apart_enough) continue;
      CHECK(labels[f] == nearest);
      if (to[nearest] < .05) continue;
      double along = 0;
      for (std::size_t k = 0; k < 3; ++k)
        along += directions[f][k] * (p[k] - from[nearest][k]) / to[nearest];
      CHECK(along >= 1 - within);
      // Linear in the input's triangles.
      double mean = 0;
      for (const Index v : s.faces[f]) mean += laid.field.distances().distance[v] / 3;
      CHECK(laid.field.at(centre, ReadOut::linear) == Approx(mean));
    }
  }
}

TEST_CASE("paths over flipped triangles with lengths of their own") {
  std::mt19937 random(4);
  const Surface s = hills(random, .5, 0);
  const TriangleMesh<double> input(s.positions.size(), s.faces, lengths_of(s));
  const IntrinsicDelaunay delaunay(input);
  REQUIRE(delaunay.summary().flips > 0);
  const auto mesh = delaunay.mesh<double>();
  PathField<TriangleMesh<double>> field(mesh, delaunay, input);
  const auto& found = field.solve(Serial{}, PointSource::at(1), at(Accuracy::exact()));
  for (Index v = 0; v < s.positions.size(); ++v) {
    const Path path = field.trace(v);
    CHECK(path.positions.empty());
    CHECK(path.length == Approx(found.distance[v]).epsilon(1e-12).margin(1e-15));
  }
  CHECK_THROWS_AS(field.trace(PointSource::in(static_cast<Index>(s.faces.size()), {1, 0, 0})),
                  UsageError);
}
