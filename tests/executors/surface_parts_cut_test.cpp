#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "complex/jittered.hpp"
#include "executors/parts_testing.hpp"

// Surfaces in parts: into which pieces they are cut.

using namespace plexway;
using namespace plexway::testing;

namespace {

/// What a surface is cut into by some processes, and what each of them has of it.
std::pair<std::size_t, std::vector<std::size_t>> shares(const Surface& s, std::size_t ranks,
                                                        std::size_t piece) {
  std::size_t pieces = 0;
  std::vector<std::size_t> own(ranks);
  ThreadRanks(ranks).run([&](PieceRanks& process) {
    OpenMP executor{.threads = 1, .piece = piece};
    executor.ranks = &process;
    const SurfaceParts<double> parts(executor, RowsOf(s));
    own[process.rank()] = parts.summary().own_faces;
    if (process.rank() == 0) pieces = parts.summary().pieces;
  });
  return {pieces, own};
}

}  // namespace

TEST_CASE("parts: long triangles, whose corners are where no middles are") {
  // Three rings far from each other: middles are a third of the way.
  constexpr Index around = 3000;
  Surface s;
  for (Index ring = 0; ring < 3; ++ring)
    for (Index i = 0; i < around; ++i) {
      const double angle = 2 * 3.141592653589793 * i / around;
      s.add(std::cos(angle), std::sin(angle), .5 * ring);
    }
  for (Index ring = 0; ring < 2; ++ring)
    for (Index i = 0; i < around; ++i) {
      const Index a = around * ring + i, b = around * ring + (i + 1) % around;
      s.quad(a, b, b + around, a + around);
    }
  const auto [pieces, own] = shares(s, 4, 200);
  CHECK(pieces == Approx(static_cast<double>(s.faces.size()) / 200).epsilon(.25));
  for (const std::size_t one : own)
    CHECK(one == Approx(static_cast<double>(s.faces.size()) / 4).epsilon(.25));
}

TEST_CASE("parts: a surface of any size is cut in the same way") {
  Surface s = jittered(20, 7);
  const auto usual = shares(s, 3, 30);
  CHECK(usual.first > 20);
  for (const int power : {-1012, 900}) {
    CAPTURE(power);
    Surface other = s;
    for (Position& p : other.positions)
      for (double& x : p) x = std::ldexp(x, power);
    CHECK(shares(other, 3, 30) == usual);
  }
}
