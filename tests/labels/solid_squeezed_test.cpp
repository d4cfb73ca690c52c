// Prisms over plans where everything is on a lattice: lines of sight that lie in faces of
// tetrahedra, and that two obstacles touch from both sides. Found by fuzzing.

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>

#include "data/corner_domains.hpp"
#include "labels/solving.hpp"

namespace plexway::testing::solid_squeezed_test {

namespace {

/// One layer over a grid of eight cells a side; heights and distances add up by their squares.
/// `closed`: both lips of a slit, which begins at the rim, lie at the same place.
template <class Real>
Errors errors_over(const samples::CornerDomain& plan, double jitter, std::uint64_t seed,
                   double height, bool closed = false) {
  samples::Shape flat = plan.grid(8, jitter, seed);
  auto beside = flat.points;  // lips of slits, where the graph can tell them apart
  for (std::size_t v = 0; v < beside.size(); ++v)
    for (const auto& b : plan.blocks) {
      const double off = beside[v][0] - b.left;
      if (b.left != b.right || off == 0 || std::abs(off) > 1e-12) continue;
      beside[v][0] += off > 0 ? 1e-9 : -1e-9;
      if (closed) flat.points[v][0] = b.left;
    }
  const std::vector<double> truth = plan.distances(beside);
  const auto n = static_cast<Index>(flat.points.size());
  std::vector<std::array<double, 3>> places;
  std::vector<double> exact;
  for (const double z : {0., height})
    for (Index v = 0; v < n; ++v) {
      places.push_back({flat.points[v][0], flat.points[v][1], z});
      exact.push_back(std::hypot(truth[v], z));
    }
  std::vector<std::array<Index, 4>> tets;
  for (std::array<Index, 3> f : flat.faces) {
    std::sort(f.begin(), f.end());
    tets.push_back({f[0], f[1], f[2], f[2] + n});
    tets.push_back({f[0], f[1], f[1] + n, f[2] + n});
    tets.push_back({f[0], f[0] + n, f[1] + n, f[2] + n});
  }
  const TetMesh<Real> solid(places, tets);
  return compare(solve(Serial{}, solid, PointSource::at(0)).distance, exact);
}

}  // namespace

TEST_CASE("a line of sight in the plane of a face of a tetrahedron is free") {
  const samples::CornerDomain plan = {
      "", {{.125, .375, .25, .375}, {.125, .375, .75, .875}, {.625, .875, .25, .375}}, {0, .25}};
  const Errors e = errors_over<double>(plan, 0.16, 0xca, 0.551171875);  // was 0.107
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.fits);
  CHECK(e.max <= 0.02);
  CHECK(e.below >= -1e-12);
}

TEST_CASE("a path that obstacles touch from both sides") {
  const samples::CornerDomain plan = {
      "", {{.25, .375, .75, .875}, {.625, .875, .25, .375}, {.625, .875, .625, .75}}, {.75, .5}};
  const Errors e = errors_over<double>(plan, 0.08, 0xb9, 0.56484375);  // was 0.071
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.fits);
  CHECK(e.mean <= 2e-4);
  CHECK(e.max <= 0.03);
  CHECK(e.below >= -1e-12);
}

TEST_CASE("a path along the floor, over ends of edges that it only touches") {
  const samples::CornerDomain plan = {
      "", {{.25, .375, .25, .375}, {.125, .375, .625, .75}, {.75, .875, .25, .375}}, {.5, .125}};
  const Errors e = errors_over<double>(plan, 0.16, 0x87, 0.4515625);  // was 0.056
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.fits);
  CHECK(e.max <= 1e-9);
  CHECK(e.below >= -1e-12);
}

TEST_CASE("a path that would run along a block's diagonal goes around it") {
  struct Plan {
    samples::CornerDomain plan;
    double jitter;
    std::uint64_t seed;
    double height, was;
  };
  const std::vector<Plan> plans = {
      {{"", {{.125, .375, .25, .375}, {.25, .375, .75, .875}}, {.625, .5}},
       0.24,
       0xc6,
       0.57265625,
       -0.032},
      {{"",
        {{.125, .25, .25, .375},
         {.25, .375, .625, .875},
         {.625, .75, .25, .375},
         {.75, .875, .75, .875}},
        {.875, .25}},
       0.08,
       0x63,
       0.273828125,
       -0.018}};
  for (const auto& [plan, jitter, seed, height, was] : plans) {
    const Errors e = errors_over<double>(plan, jitter, seed, height);
    CAPTURE(seed, was, e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.max <= 1e-6);
    CHECK(e.below >= -1e-12);
  }
}

TEST_CASE("at the end of a crack, open or closed") {
  for (const samples::CornerDomain& plan :
       {samples::CornerDomain{"", {{.5, .5, 0, .5}}, {.25, .125}},
        samples::CornerDomain{"", {{.625, .625, 0, .25}}, {.5, .125}},
        samples::CornerDomain{"", {{.25, .25, 0, .75}, {.625, .625, 0, .375}}, {.125, .25}}})
    for (const bool closed : {false, true}) {
      const Errors e = errors_over<double>(plan, 0.16, 3, 0.3, closed);
      CAPTURE(plan.blocks.size(), plan.source[0], closed, e.mean, e.max, e.below);
      CHECK(e.fits);
      CHECK(e.mean <= 1e-8);
      CHECK(e.max <= 1e-6);  // 0.14 where it was closed
      CHECK(e.below >= -1e-7);
    }
}

TEST_CASE("a path along the floor that touches one obstacle and bends at another") {
  struct Plan {
    samples::CornerDomain plan;
    std::uint64_t seed;
    double height, was;
  };
  const std::vector<Plan> plans = {
      {{"", {{.25, .375, .125, .375}, {.625, .875, .125, .375}, {.75, .875, .75, .875}}, {.25, 0}},
       0x98,
       0.36953125,
       0.080},
      {{"", {{.25, .375, .625, .875}, {.75, .875, .25, .375}, {.625, .75, .625, .875}}, {.75, 1}},
       0x52,
       0.437890625,
       0.061},
      {{"",
        {{.25, .375, .25, .375},
         {.125, .25, .75, .875},
         {.75, .875, .25, .375},
         {.625, .75, .625, .875}},
        {0, .25}},
       0x7e,
       0.43984375,
       0.053},
      {{"", {{.25, .375, .25, .375}, {.25, .375, .75, .875}, {.625, .875, .625, .875}}, {.25, 1}},
       0xa2,
       0.31875,
       0.050}};
  for (const auto& [plan, seed, height, was] : plans) {
    const Errors e = errors_over<double>(plan, 0.24, seed, height);
    CAPTURE(seed, was, e.mean, e.max, e.below);
    CHECK(e.fits);
    CHECK(e.max <= 1e-6);
    CHECK(e.below >= -1e-12);
  }
}

}  // namespace plexway::testing::solid_squeezed_test
