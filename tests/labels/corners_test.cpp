#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <random>
#include <span>
#include <string>

#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>

#include "data/corner_domains.hpp"
#include "exact_data.hpp"
#include "labels/solving.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::corners_test {

// Flat domains with corners, on grids so fine that most lines of sight pass a corner without
// touching a triangle at it; the exact distances are those of a visibility graph.

namespace {

struct Solved {
  Errors errors;
  double updates;  // a triangle
};

template <class Real, class Executor>
Solved solve_grid(const Executor& executor, const samples::CornerDomain& domain, Index n,
                  const PropagateOptions& options = {}) {
  const samples::Shape grid = domain.grid(n);
  const TriangleMesh<Real> mesh(grid.points, grid.faces);
  const auto field = solve(executor, mesh, PointSource::at(0), options);
  return {compare(field.distance, domain.distances(grid.points)),
          static_cast<double>(field.statistics.updates) / static_cast<double>(grid.faces.size())};
}

}  // namespace

TEST_CASE("the visibility graph of a notch is right where it can be said by hand") {
  const samples::CornerDomain notch = samples::corner_domains()[0];
  CHECK(notch.clear({.1, .2, 0}, {.4, .6, 0}));
  CHECK(notch.clear({.4, .1, 0}, {.4, .6, 0}));
  CHECK_FALSE(notch.clear({.1, .2, 0}, {.7, .6, 0}));
  const auto d = notch.distances({{.1, .2, 0}, {.1, 1, 0}, {.8, .1, 0}});
  CHECK(d[1] == Approx(.8).epsilon(1e-14));
  CHECK(d[2] == Approx(std::hypot(.3, .4) + .2 + std::hypot(.2, .5)).epsilon(1e-14));
}

TEMPLATE_TEST_CASE("no light leaks behind corners, however fine the grid", "", float, double) {
  for (const samples::CornerDomain& domain : samples::corner_domains())
    for (const Index n : {50u, 100u, 200u}) {
#ifdef PLEXWAY_SANITIZED
      if (n > 100) continue;
#endif
      for (const bool vectorised : {true, false}) {
        PropagateOptions options = by_labels();
        options.vectorised = vectorised;
        const Solved s = solve_grid<TestType>(Serial{}, domain, n, options);
        CAPTURE(domain.name, n, vectorised, s.errors.mean, s.errors.max, s.errors.below);
        CHECK(s.errors.fits);
        CHECK(s.errors.mean <= 2e-6);
        CHECK(s.errors.max <= 1e-3);
        CHECK(s.errors.below >= -1e-4);
        CHECK(s.updates <= 1.3);
      }
    }
}

TEMPLATE_TEST_CASE("merged light hardly leaks behind corners", "", float, double) {
  // Labels are exact in such domains, but for corners that they mistake; windows have the errors of
  // merging everywhere.
  for (const samples::CornerDomain& domain : samples::corner_domains())
    for (const Index n : {50u, 100u, 200u}) {
#ifdef PLEXWAY_SANITIZED
      if (n > 100) continue;
#endif
      const Solved s = solve_grid<TestType>(Serial{}, domain, n);
      CAPTURE(domain.name, n, s.errors.mean, s.errors.max, s.errors.below);
      CHECK(s.errors.fits);
      CHECK(s.errors.mean <= 1.5e-5);
      CHECK(s.errors.max <= 1e-3);
      CHECK(s.errors.below >= -3e-4);
    }
}

TEST_CASE("teams know of corners as one thread does") {
  for (const samples::CornerDomain& domain : samples::corner_domains()) {
    const Solved s = solve_grid<float>(OpenMP{2}, domain, 100, by_labels());
    CAPTURE(domain.name, s.errors.mean, s.errors.max, s.errors.below);
    CHECK(s.errors.fits);
    CHECK(s.errors.mean <= 2e-6);
    CHECK(s.errors.below >= -1e-4);
  }
}

namespace fs = std::filesystem;

// Real meshes with exact distances.

namespace {

PointSource from(const ExactAnswer& answer) {
  return PointSource::at(static_cast<Index>(answer.source));
}

Surface read(const fs::path& file) {
  io::Triangles t = io::read_triangles(file);
  return {std::move(t.positions), std::move(t.triangles)};
}

double without_nan(double x) { return std::isnan(x) ? 0 : x; }

}  // namespace

TEST_CASE("real surfaces: the default is more accurate than published, upper_bound is one") {
  struct Published {
    const char* name;
    double mean;
  };
  const Published published[] = {
      {"spot", 3.3e-3},       {"fandisk", 1.8e-3}, {"rocker-arm", 1.8e-3}, {"camelhead", 3.2e-3},
      {"beetle_car", 2.5e-3}, {"bunny", 1.9e-3},   {"armadillo", 1.0e-3},  {"wavy_grid200", 6.9e-3},
      {"t79741", 4.4e-2},     {"t908460", 9.0e-3}};
  std::vector<double> ratios;
  for (const auto& [what, bound] : published) {
#ifdef PLEXWAY_SANITIZED
    if (ratios.size() == 3) break;
#endif
    const fs::path file = exact_file("surfaces", std::string(what) + ".obj");
    if (file.empty()) continue;
    const auto mesh = read(file).mesh<float>();
    double mean = 0;
    const std::vector<ExactAnswer> truths = exact_answers(file);
    REQUIRE_FALSE(truths.empty());
    for (const ExactAnswer& truth : truths) {
      const Errors e = compare(solve(mesh, from(truth)), truth.distance);
      CAPTURE(what, truth.source, e.mean, e.max);
      CHECK(e.fits);
      mean += e.mean / static_cast<double>(truths.size());
      PropagateOptions upper;
      upper.visibility = Visibility::upper_bound;
      const Errors u = compare(solve(mesh, from(truth), upper), truth.distance);
      CHECK(u.fits);
      CHECK(u.below >= -1e-4);
    }
    CAPTURE(what, mean, bound);
    CHECK(mean <= bound);
    ratios.push_back(mean / bound);
  }
  REQUIRE_FALSE(ratios.empty());
#ifndef PLEXWAY_SANITIZED
  if (ratios.size() < std::size(published)) {
    WARN("measured on " << ratios.size() << " of " << std::size(published) << " meshes");
    return;
  }
  std::sort(ratios.begin(), ratios.end());
  const double median = (ratios[4] + ratios[5]) / 2;
  CAPTURE(ratios);
  CHECK(median <= .75);
#endif
}

TEMPLATE_TEST_CASE("awkward surfaces: finite where a path leads, close where it is known", "",
                   float, double) {
  const std::vector<fs::path> files = exact_files("awkward", ".obj");
  if (files.empty()) WARN("skipped: no folder of awkward meshes with exact distances");
  for (const fs::path& file : files) {
    const std::string what = file.stem().string();
#ifdef PLEXWAY_SANITIZED
    if (fs::file_size(file) > 500000) continue;
#endif
    const Surface s = read(file);
    const auto mesh = s.mesh<TestType>();
    std::vector<ExactAnswer> truths = exact_answers(file);
    if (truths.empty()) truths.push_back({s.faces[0][0], {}});
    for (const ExactAnswer& truth : truths) {
      CAPTURE(what, truth.source);
      for (const Visibility visibility : visibilities) {
        PropagateOptions options;
        options.visibility = visibility;
        const auto d = solve(mesh, from(truth), options);
        bool valid = d[truth.source] == 0;
        for (const double x : d) valid &= x >= 0;
        CHECK(valid);
        if (truth.distance.empty()) continue;
        std::vector<double> exact = truth.distance;
        std::transform(exact.begin(), exact.end(), exact.begin(), without_nan);
        const Errors e = compare(d, exact);
        CAPTURE(name(options), e.mean, e.max, e.below);
        CHECK(e.fits);
        if (visibility == Visibility::saddles) CHECK(e.mean <= 1.5e-2);
        if (visibility == Visibility::upper_bound) CHECK(e.below >= -1e-4);
      }
    }
  }
}

// What is cheap to see of a field, and always wrong: a distance below the straight line through
// space, and a vertex farther than a neighbour and the edge between.

namespace {

/// A height field of jittered points with one of them far up.
Surface spike(double height, unsigned seed) {
  std::mt19937 random(seed);
  Surface s = grid(8, 8, 8, 8);
  for (Position& p : s.positions)
    for (std::size_t k = 0; k < 3; ++k) p[k] += 0.35 * (2 * uniform(random) - 1);
  s.positions[30][2] = height;
  return s;
}

/// Thin triangles about vertex 0, by chance near and far.
Surface fan(Index count, unsigned seed) {
  std::mt19937 random(seed);
  Surface s;
  s.positions.push_back({0, 0, 0});
  for (Index i = 0; i < count; ++i) {
    const double a = 2 * 3.14159265358979 * i / count, r = 1 + 3 * uniform(random);
    s.positions.push_back({r * std::cos(a), r * std::sin(a), 0.5 * uniform(random)});
    s.faces.push_back({0, i + 1, (i + 1) % count + 1});
  }
  return s;
}

double apart(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

void check_field(const Surface& s, const std::vector<double>& d, const std::vector<Index>& sources,
                 double slack) {
  double below = 0, beyond = 0;
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    double line = std::numeric_limits<double>::infinity();
    for (const Index source : sources)
      line = std::min(line, apart(s.positions[v], s.positions[source]));
    if (std::isfinite(d[v]) && line > 0) below = std::min(below, d[v] / line - 1);
  }
  for (const auto& f : s.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = f[i], w = f[(i + 1) % 3];
      const double gap = std::abs(d[v] - d[w]) - apart(s.positions[v], s.positions[w]);
      beyond = std::max(beyond, gap / std::max(d[v], d[w]));
    }
  CHECK(below >= -slack);
  CHECK(beyond <= slack);
}

/// On all triangulations and both executors.
template <class Real>
void check_surface(const Surface& s, const std::vector<Index>& from) {
  const double slack = sizeof(Real) == 4 ? 1e-6 : 1e-12;
  const TriangleMesh<double> exact(s.positions, s.faces);
  for (const auto kind :
       {Retriangulation::keep, Retriangulation::flips, Retriangulation::refined}) {
    const auto mesh = [&]() -> TriangleMesh<Real> {
      if (kind == Retriangulation::keep) return {s.positions, s.faces};
      return IntrinsicDelaunay(exact, refinement_for(kind)).mesh<Real>();
    }();
    std::vector<PointSource> sources;
    for (const Index v : from) sources.push_back(PointSource::at(v));
    const std::span<const PointSource> all(sources);
    CAPTURE(static_cast<int>(kind), from[0]);
    const auto check = [&](const DistanceField<Real>& field) {
      check_field(s, {field.distance.begin(), field.distance.end()}, from, slack);
    };
    check(plexway::solve(Serial{}, mesh, all));
    check(plexway::solve(Serial{}, mesh, all, by_labels()));
    check(plexway::solve(OpenMP{2}, mesh, all, by_labels()));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("no distance is below the straight line around a spike", "", float, double) {
  std::size_t raised = 0;
  for (const double height : {30., 1000., 1e4})
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Surface s = spike(height, seed);
      CAPTURE(height, seed);
      for (const Index source : {0u, 33u, 63u, 80u}) {
        check_surface<TestType>(s, {source});
        const auto flipped = IntrinsicDelaunay(s.mesh<double>()).mesh<TestType>();
        raised += plexway::solve(Serial{}, flipped, PointSource::at(source), by_labels())
                      .statistics.raised_vertices;
      }
      check_surface<TestType>(s, {7, 33, 78});
    }
  // Else there was nothing to see here.
  CHECK(raised > 0);
}

TEMPLATE_TEST_CASE("in fans of thin triangles no vertex is farther than a neighbour and an edge",
                   "", float, double) {
  std::size_t lowered = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Surface s = fan(150, seed);
    CAPTURE(seed);
    check_surface<TestType>(s, {1});
    check_surface<TestType>(s, {0, 75});
    const auto flipped = IntrinsicDelaunay(s.mesh<double>()).mesh<TestType>();
    CHECK(flipped.has_chords());
    lowered += plexway::solve(Serial{}, flipped, PointSource::at(1), by_labels())
                   .statistics.lowered_vertices;
  }
  CHECK(lowered > 0);
}

TEST_CASE("among triangles thrown together by chance no distance is below the straight line") {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Surface s = soup(60, 4000, seed);
    CAPTURE(seed);
    check_surface<float>(s, {1});
    check_surface<double>(s, {1, 2, 3});
  }
}

TEST_CASE("a source in a triangle is bounded by the straight line as well") {
  const Surface s = spike(1000, 2);
  for (const Index f : {0u, 40u, 70u, 120u}) {
    const PointSource source = PointSource::in(f, {0.2, 0.3, 0.5});
    Position at = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        at[k] += source.barycentric[i] * s.positions[s.faces[f][i]][k];
    const auto d = solve(s.mesh<float>(), source);
    for (std::size_t v = 0; v < d.size(); ++v)
      CHECK(d[v] >= apart(at, s.positions[v]) * (1 - 1e-6));
  }
}

TEST_CASE("lengths alone know no straight line, and good fields need no repair") {
  const Surface s = spike(100, 1);
  const TriangleMesh<float> mesh(s.positions.size(), s.faces, lengths_of(s));
  CHECK(mesh.positions().empty());
  CHECK(plexway::solve(Serial{}, mesh, PointSource::at(0)).statistics.raised_vertices == 0);
  const Surface flat = grid(30, 30);
  const auto field = plexway::solve(Serial{}, flat.mesh<float>(), PointSource::at(7));
  CHECK(field.statistics.raised_vertices == 0);
  CHECK(field.statistics.lowered_vertices == 0);
}

}  // namespace plexway::testing::corners_test
