#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/jittered.hpp"
#include "executors/parts_testing.hpp"
#include "executors/same_work.hpp"
#include "message_of.hpp"

namespace plexway::testing::surface_parts_cut_test {
using namespace detail;

// Surfaces in parts: into which pieces they are cut, what is told of the whole, where points are,
// and that all processes have the same.

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

TEST_CASE("parts: sums over sources in no triangle, whoever has read them") {
  Surface s = jittered(8, 3);
  std::mt19937 random(4);
  std::vector<PointSource> sources = {PointSource::at(7)};
  for (int i = 0; i < 500; ++i)
    sources.push_back({.vertex = s.add(100 + i, 0), .offset = std::sqrt(uniform(random))});
  sources.push_back({.vertex = sources[9].vertex, .offset = 2});  // there is a nearer one
  const auto one = solve_in_parts<double>(s, {1, 1, 20}, sources);
  CHECK(one.reached == s.positions.size());
  double sum = 0;
  for (const double d : one.distance) sum += d;
  CHECK(one.mean_distance == Approx(sum / static_cast<double>(one.reached)).epsilon(1e-12));
  for (const std::size_t ranks : {2u, 3u, 5u})
    CHECK(same_bits(one, solve_in_parts<double>(s, {ranks, 1, 20}, sources)));
}

TEST_CASE("parts: processes with other rows are told so") {
  const Surface s = jittered(12, 5);
  const auto known_by = [&](std::size_t ranks, const auto& rows_of) {
    std::vector<std::string> told(ranks);
    ThreadRanks(ranks).run([&](PieceRanks& own) {
      told[own.rank()] = message_of([&] { check_same_rows(own, RowsOf(rows_of(own.rank()))); });
    });
    return told;
  };
  for (const std::size_t ranks : {1u, 2u, 4u, 5u}) {
    CAPTURE(ranks);
    for (const std::string& text :
         known_by(ranks, [&](std::size_t) -> const Surface& { return s; }))
      CHECK(text.empty());
    if (ranks == 1) continue;
    const auto refused = [&](const auto& rows_of) {
      for (const std::string& text : known_by(ranks, rows_of))
        CHECK(text.find("the ranks of one solve need the same domain") == 0);
    };
    const auto refused_of = [&](const Surface& other, std::size_t odd) {
      refused([&](std::size_t r) -> const Surface& { return r == odd ? other : s; });
    };
    // All vertices have other numbers, or all faces, or there are more of them.
    Surface reversed = s, turned = s, longer = s;
    const auto last = static_cast<Index>(s.positions.size() - 1);
    std::reverse(reversed.positions.begin(), reversed.positions.end());
    for (Face& f : reversed.faces)
      for (Index& v : f) v = last - v;
    std::reverse(turned.faces.begin(), turned.faces.end());
    longer.add(0, 0);
    for (const Surface* other : {&reversed, &turned, &longer}) {
      for (std::size_t odd = 0; odd < ranks; ++odd) refused_of(*other, odd);
      // Half of them, side by side.
      refused([&](std::size_t r) -> const Surface& { return 2 * r < ranks ? s : *other; });
    }
    // One row differs of those that one reads for itself: by a bit, or by which corner is first.
    for (std::size_t odd = 0; odd < ranks; ++odd) {
      const auto in_range = [&](std::size_t count, std::size_t k) {
        const std::size_t begin = count * odd / ranks, end = count * (odd + 1) / ranks;
        return begin + (end - 1 - begin) * k / 3;
      };
      for (std::size_t k = 0; k <= 3; ++k) {
        Surface other = s;
        double& x = other.positions[in_range(s.positions.size(), k)][0];
        x = std::nextafter(x, 2);
        refused_of(other, odd);
        other = s;
        Face& f = other.faces[in_range(s.faces.size(), k)];
        f = {f[1], f[2], f[0]};
        refused_of(other, odd);
      }
    }
  }
}

TEST_CASE("parts: the nearest point, whoever has it") {
  const Surface s = jittered(9, 2);
  std::vector<Position> points = {{.31, .77, .5}, {-1, .4, 0}, {.5, .5, 0}};
  // Vertices are found as such, and of several triangles as near the first.
  const std::size_t others = points.size();
  points.insert(points.end(), s.positions.begin(), s.positions.end());
  std::map<std::pair<Index, Index>, Index> first;  // of each edge
  for (Index f = 0; f < s.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i)
      first.insert({std::minmax(s.faces[f][i], s.faces[f][(i + 1) % 3]), f});
  for (const auto& [edge, face] : first) {
    Position& p = points.emplace_back();
    for (std::size_t d = 0; d < 3; ++d)
      p[d] = .5 * s.positions[edge.first][d] + .5 * s.positions[edge.second][d];
  }
  for (const std::size_t ranks : {1u, 3u}) {
    std::vector<std::vector<PartPoint>> found(ranks);
    std::vector<char> refused(ranks, 0);
    ThreadRanks(ranks).run([&](PieceRanks& own) {
      OpenMP executor{.threads = 1, .piece = 20};
      executor.ranks = &own;
      const SurfaceParts<double> parts(executor, RowsOf(s));
      for (const Position& p : points) found[own.rank()].push_back(parts.nearest(p));
      try {
        static_cast<void>(parts.nearest({0, NAN, 0}));
      } catch (const UsageError&) {
        refused[own.rank()] = 1;
      }
    });
    for (std::size_t r = 0; r < ranks; ++r) {
      CHECK(refused[r] != 0);
      for (std::size_t i = 0; i < others; ++i) {
        const PointSource& one = found[r][i].source;
        REQUIRE(one.simplex < s.faces.size());
        CHECK(one.simplex == found[0][i].source.simplex);
        CHECK(one.barycentric == found[0][i].source.barycentric);
        Position at{};
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t d = 0; d < 3; ++d)
            at[d] += one.barycentric[k] * s.positions[s.faces[one.simplex][k]][d];
        CHECK(at[0] == Approx(std::clamp(points[i][0], 0., 1.)).margin(1e-12));
        CHECK(at[1] == Approx(std::clamp(points[i][1], 0., 1.)).margin(1e-12));
        CHECK(found[r][i].distance ==
              Approx(std::hypot(at[0] - points[i][0], at[1] - points[i][1], at[2] - points[i][2]))
                  .margin(1e-12));
      }
      std::size_t i = others;
      for (Index v = 0; v < s.positions.size(); ++v, ++i) {
        CHECK(found[r][i].source.vertex == v);
        CHECK(found[r][i].distance < 1e-12);
      }
      for (const auto& [edge, face] : first) CHECK(found[r][i++].source.simplex == face);
    }
  }
}

}  // namespace plexway::testing::surface_parts_cut_test
