#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_solids.hpp"
#include "labels/cracked_solid.hpp"
#include "labels/solving.hpp"
#include "message_of.hpp"

namespace plexway::testing::solid_crack_test {

// Sources on the faces of cracks and beside them. On a crack two faces of the boundary lie on each
// other, and coordinates do not tell one from the other: its vertices do.

namespace {

template <class Domain, class Sources>
std::string refusal(const Domain& domain, const Sources& sources) {
  return message_of<UsageError>([&] { static_cast<void>(solve(Serial{}, domain, sources)); });
}

}  // namespace

TEMPLATE_TEST_CASE("sources on a crack and all others are right", "", float, double) {
  constexpr bool single = std::is_same_v<TestType, float>;
  for (const auto& plan : {one_slit, two_slits}) {
    const Cracked cracked(plan, 0.16, 3, 0.3);
    const TetMesh<TestType> solid(cracked.places, cracked.tets);
    std::size_t on = 0;
    for (Index v = 0; v < cracked.floor(); ++v) {
      if (cracked.on_lip[v] == 0 && v % 5 != 0) continue;
      on += cracked.on_lip[v] != 0;
      const auto field = solve(Serial{}, solid, PointSource::at(v));
      const Errors e = compare(field.distance, cracked.exact(cracked.beside[v]));
      CAPTURE(v, e.mean, e.max, e.below);
      CHECK(e.fits);
      CHECK(e.max <= (single ? 1e-4 : 1e-6));
      CHECK(e.below >= (single ? -1e-4 : -1e-7));
      CHECK(solve(OpenMP{2}, solid, PointSource::at(v)).distance == field.distance);
    }
    CHECK(on > 6);
  }
}

TEST_CASE("at the end of a crack a source sees both sides") {
  const Cracked cracked(one_slit, 0.16, 3, 0.3);
  const TetMesh<double> solid(cracked.places, cracked.tets);
  const auto end = std::find_if(cracked.places.begin(), cracked.places.end(), [](const auto& p) {
    return p[0] == .5 && p[1] == .5 && p[2] == 0;
  });
  REQUIRE(end != cracked.places.end());
  const auto v = static_cast<Index>(end - cracked.places.begin());
  const Errors e =
      compare(solve(Serial{}, solid, PointSource::at(v)).distance, cracked.exact({.5, .5, 0}));
  CHECK(e.fits);
  CHECK(e.max <= 1e-6);
}

TEST_CASE("points in tetrahedra at a crack are right as near as they are") {
  const Cracked cracked(two_slits, 0.16, 3, 0.3);
  const TetMesh<double> solid(cracked.places, cracked.tets);
  std::size_t near = 0;
  for (Index t = 0; t < cracked.tets.size(); t += 2) {
    const auto& tet = cracked.tets[t];
    const auto corner = std::find_if(tet.begin(), tet.end(), [&](Index v) {
      return v < cracked.floor() && cracked.on_lip[v] != 0;
    });
    if (corner == tet.end()) continue;
    const auto at = static_cast<std::size_t>(corner - tet.begin());
    for (const double share : {.004, .1}) {
      std::array<double, 4> b;
      b.fill(share / 4);
      b[at] += 1 - share;
      samples::Point from = {0, 0, 0};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 3; ++k) from[k] += b[i] * cracked.places[tet[i]][k];
      // Some have all corners along the crack: the truth does not know on which side.
      if (std::abs(from[0] - cracked.places[*corner][0]) < 1e-6) continue;
      ++near;
      const Errors e =
          compare(solve(Serial{}, solid, PointSource::in(t, b)).distance, cracked.exact(from));
      CAPTURE(t, share, e.mean, e.max, e.below);
      CHECK(e.max <= (share < .01 ? 5e-6 : 1e-6));  // the truth has its sides 2e-9 apart
      CHECK(e.below >= -1e-7);
    }
  }
  CHECK(near > 20);
}

TEST_CASE("sources on both sides of a crack do no harm") {
  const Cracked cracked(one_slit, 0.16, 3, 0.3);
  const TetMesh<double> solid(cracked.places, cracked.tets);
  std::vector<PointSource> all;
  std::vector<double> exact(cracked.places.size(), 1e300);
  for (Index v = 0; v < cracked.floor(); ++v) {
    if (cracked.on_lip[v] == 0) continue;
    all.push_back(PointSource::at(v));
    const auto from = cracked.exact(cracked.beside[v]);
    for (std::size_t w = 0; w < exact.size(); ++w) exact[w] = std::min(exact[w], from[w]);
  }
  const auto field = solve(Serial{}, solid, all);
  const Errors e = compare(field.distance, exact);
  CAPTURE(e.mean, e.max, e.below);
  CHECK(e.below >= -1e-7);
  CHECK(e.max <= 1e-6);
  for (const PointSource& source : all) CHECK(field.distance[source.vertex] == 0);
}

TEST_CASE("solids without cracks take sources anywhere, also where they touch another") {
  const samples::CornerDomain plan = {"", {{.25, .375, .25, .75}, {.625, .75, -1, .5}}, {.5, .5}};
  const Cracked notched(plan, 0.16, 5, 0.3);
  const TetMesh<double> solid(notched.places, notched.tets);
  for (Index v = 0; v < notched.floor(); ++v) {
    if (solid.corners_at(solid.inside_vertex(v)).empty()) continue;
    CHECK(refusal(solid, PointSource::at(v)).empty());
  }

  // A cracked solid, and another block right beside it that shares no vertex with it.
  Cracked pair(one_slit, 0.16, 3, 0.3);
  const auto first = static_cast<Index>(pair.places.size());
  const std::size_t tets = pair.tets.size();
  for (Index v = 0; v < first; ++v) {
    auto p = pair.places[v];
    p[0] = -p[0];
    pair.places.push_back(p);
  }
  for (std::size_t t = 0; t < tets; ++t) {
    auto tet = pair.tets[t];
    for (Index& v : tet) v += first;
    pair.tets.push_back(tet);
  }
  const TetMesh<double> both(pair.places, pair.tets);
  for (Index v = 0; v < pair.floor(); ++v)
    if (pair.places[v][0] == 0) CHECK(refusal(both, PointSource::at(v)).empty());
}

TEST_CASE("a source on a crack of a piece is right, as good as fast where it lies nowhere") {
  const Cracked cracked(one_slit, 0.16, 3, 0.3);
  Cracked block(one_slit, 0.16, 3, 0.3);
  for (auto& p : block.places) p[0] -= 1;        // beside it: the walls meet
  enum class Pieces { nowhere, apart, welded };  // without positions labels solve them
  for (const Pieces pieces : {Pieces::nowhere, Pieces::apart, Pieces::welded}) {
    MixedComplex<double> domain;
    const bool lies = pieces != Pieces::nowhere;
    using Places = std::span<const std::array<double, 3>>;
    const auto first = domain.add(TetMesh<double>(block.places, block.tets),
                                  lies ? Places(block.places) : Places());
    const auto second = domain.add(TetMesh<double>(cracked.places, cracked.tets),
                                   lies ? Places(cracked.places) : Places());
    if (pieces == Pieces::welded) CHECK(domain.weld(first, second) > 9);
    for (Index v = 0; v < cracked.floor(); ++v) {
      if (cracked.on_lip[v] == 0) continue;
      const Index number = second.first_vertex + v;
      const auto field = solve(Serial{}, domain, PointSource::at(number));
      const auto begin = field.distance.begin() + second.first_vertex;
      const std::vector<double> own(begin,
                                    begin + static_cast<std::ptrdiff_t>(cracked.places.size()));
      const Errors e = compare(own, cracked.exact(cracked.beside[v]));
      CAPTURE(v, e.mean, e.max, e.below);
      CHECK(e.fits);
      if (lies) {
        CHECK(e.max <= 1e-6);
        continue;
      }
      PropagateOptions options;
      options.accuracy = Accuracy::fast();
      const TetMesh<double> alone(cracked.places, cracked.tets);
      const Errors fast = compare(solve(Serial{}, alone, PointSource::at(v), options).distance,
                                  cracked.exact(cracked.beside[v]));
      CAPTURE(fast.mean, fast.max, fast.below);
      CHECK(e.mean <= 1.1 * fast.mean);
      CHECK(e.max <= fast.max + 1e-9);
      CHECK(e.below >= -1e-2);
    }
  }
}

TEST_CASE("away from its crack a cracked solid takes sources at walls and notches") {
  const samples::CornerDomain plan = {
      "", {{.625, .625, -1, .375}, {.25, .375, .25, .75}}, {.125, .125}};
  const Cracked cracked(plan, 0.16, 5, 0.3);
  const TetMesh<double> solid(cracked.places, cracked.tets);
  const auto is_far = [&](Index v) { return std::abs(cracked.places[v][0] - .625) > .2; };
  for (Index t = 0; t < cracked.tets.size(); ++t) {
    const auto& tet = cracked.tets[t];
    if (!std::all_of(tet.begin(), tet.end(), is_far)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(refusal(solid, PointSource::at(tet[i])).empty());
      for (const double share : {1e-9, 1e-3}) {  // beside the corner, and beside the face opposite
        std::array<double, 4> at, off;
        at.fill(share);
        at[i] = 1 - 3 * share;
        off.fill((1 - share) / 3);
        off[i] = share;
        CHECK(refusal(solid, PointSource::in(t, at)).empty());
        CHECK(refusal(solid, PointSource::in(t, off)).empty());
      }
    }
  }
}

}  // namespace plexway::testing::solid_crack_test
