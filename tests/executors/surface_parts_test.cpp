#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>

#include "complexes/jittered.hpp"
#include "exact_data.hpp"
#include "executors/parity.hpp"
#include "executors/parts_testing.hpp"
#include "executors/piece_testing.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::surface_parts_test {

// Surfaces in parts (executors/surface_parts.hpp): what the whole says, with the same bits whatever
// the processes and threads.

namespace {

constexpr Scheduler schedulers[] = {{1, 1, 25}, {2, 1, 25},  {3, 2, 25},
                                    {4, 1, 25}, {1, 3, 120}, {3, 1, 120}};

template <class Real>
double worst_of(const std::vector<Real>& found, const std::vector<Real>& expected) {
  double worst = 0;
  for (std::size_t v = 0; v < expected.size(); ++v) {
    if (std::isfinite(found[v]) != std::isfinite(expected[v])) return 1e300;
    if (!std::isfinite(expected[v])) continue;
    const double miss = std::abs(static_cast<double>(found[v]) - static_cast<double>(expected[v]));
    worst = std::max(worst, miss / std::max(1e-3, static_cast<double>(expected[v])));
  }
  return worst;
}

template <class Exact>
std::vector<double> at_vertices(const Surface& s, const Exact& exact) {
  std::vector<double> all;
  for (const Position& p : s.positions) all.push_back(exact(p));
  return all;
}

/// Exactly and merged, in pieces of a triangle or two (each vertex is at a cut) and larger ones, by
/// several processes: what is known.
void check_known(const Surface& s, const PointSource& source, const std::vector<double>& known,
                 double merged_within) {
  for (const std::size_t piece : {2u, 9u, 60u})
    for (const std::size_t ranks : {1u, 3u}) {
      CAPTURE(piece, ranks);
      const Scheduler scheduler{ranks, 1, piece};
      const auto exact = solve_in_parts<double>(s, scheduler, {source}, at(Accuracy::exact()));
      CHECK(worst_of(exact.distance, known) < 1e-12);
      CHECK(exact.sound());
      CHECK(exact.reached == known.size());
      const auto merged = solve_in_parts<double>(s, scheduler, {source}, at(Accuracy::accurate()));
      CHECK(worst_of(merged.distance, known) < merged_within);
      CHECK(merged.sound());
    }
}

}  // namespace

TEST_CASE("parts: exact windows are those of the whole") {
  unsigned seed = 0;
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<double>();
    for (const std::size_t count : {1u, 5u}) {
      const auto sources = mixed_sources(s, count, ++seed);
      const auto options = at(Accuracy::exact());
      const auto whole = solve(Serial{}, mesh, sources, options);
      std::vector<Joined<double>> found;
      for (const Scheduler& scheduler : schedulers) {
        found.push_back(solve_in_parts<double>(s, scheduler, sources, options));
        INFO("surface " << seed << ", ranks " << scheduler.ranks << ", pieces of "
                        << scheduler.piece);
        const auto& field = found.back();
        CHECK(worst_of(field.distance, whole.distance) < 1e-12);
        CHECK(field.sound());
        CHECK(field.complete);
        CHECK(field.accuracy == Accuracy::exact());
        CHECK(field.summary.mean_edge == Approx(mesh.unit()).epsilon(1e-12));
        CHECK(same_bits(field, found[scheduler.piece == 25 ? 0 : 4]));
      }
      // Whose a vertex is, where two are not all but as near.
      if (count == 1) continue;
      std::vector<DistanceField<double>> alone;
      for (const PointSource& one : sources) alone.push_back(solve(Serial{}, mesh, one, options));
      std::size_t wrong = 0;
      for (std::size_t v = 0; v < whole.distance.size(); ++v) {
        if (!std::isfinite(whole.distance[v])) {
          wrong += found[0].label[v] != none;
          continue;
        }
        const Index label = found[0].label[v];
        REQUIRE(label < sources.size());
        wrong += alone[label].distance[v] > whole.distance[v] * (1 + 1e-9) + 1e-12;
      }
      CHECK(wrong == 0);
    }
  }
}

TEMPLATE_TEST_CASE("parts: merged windows have the same bits whatever the processes and threads",
                   "[threads]", float, double) {
  unsigned seed = 0;
  for (const Surface& s : surfaces()) {
    const auto mesh = s.mesh<double>();
    for (const std::size_t count : {1u, 5u}) {
      const auto sources = mixed_sources(s, count, ++seed);
      const auto in_double = solve(Serial{}, mesh, sources, at(Accuracy::exact()));
      DistanceField<TestType> exact;
      exact.distance.assign(in_double.distance.begin(), in_double.distance.end());
      const auto serial = solve(Serial{}, s.mesh<TestType>(), sources, at(Accuracy::accurate()));
      std::vector<Joined<TestType>> found;
      for (const Scheduler& scheduler : schedulers) {
        found.push_back(solve_in_parts<TestType>(s, scheduler, sources, at(Accuracy::accurate())));
        INFO("surface " << seed << ", ranks " << scheduler.ranks << ", pieces of "
                        << scheduler.piece);
        CHECK((found.back().sound() && found.back().complete));
        CHECK(same_bits(found.back(), found[scheduler.piece == 25 ? 0 : 4]));
      }
      for (const std::size_t i : {0u, 4u}) {
        const Parity p = parity(exact, found[i]), q = parity(exact, serial);
        INFO("surface " << seed << ", worst " << p.worst << ", of Serial " << q.worst);
        CHECK(p.reached_by_one == 0);
        CHECK(p.worst < std::max(2 * q.worst, 1e-3));
      }
    }
  }
}

TEST_CASE("parts: a plane, from vertices and from inside") {
  std::mt19937 random(5);
  for (unsigned seed = 1; seed <= 2; ++seed) {
    const Surface s = jittered(11, seed);
    for (int i = 0; i < 2; ++i) {
      const Index v = below(random, s.positions.size()), f = below(random, s.faces.size());
      const double b = .1 + .8 * uniform(random), c = (1 - b) * (i == 0 ? uniform(random) : 0);
      const Position inside = [&] {
        Position p{};
        const double share[] = {b, c, 1 - b - c};
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t d = 0; d < 2; ++d) p[d] += share[k] * s.positions[s.faces[f][k]][d];
        return p;
      }();
      const auto from = [&](const Position& p) {
        return at_vertices(s,
                           [=](const Position& q) { return std::hypot(q[0] - p[0], q[1] - p[1]); });
      };
      check_known(s, PointSource::at(v), from(s.positions[v]), 1e-4);
      check_known(s, PointSource::in(f, {b, c, 1 - b - c}), from(inside), 1e-4);
    }
  }
}

TEST_CASE("parts: an L, around its corner") {
  Surface s = grid(12, 12);
  std::mt19937 random(8);
  for (Position& p : s.positions)
    for (std::size_t d = 0; d < 2; ++d)
      if (p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1 && p[0] != .5 && p[1] != .5)
        p[d] += (uniform(random) - .5) / 24;
  s = cut(s, [](double x, double y) { return x < .5 || y < .5; });
  // Vertices of no triangle are another test's.
  std::vector<Index> name(s.positions.size(), none);
  Surface all;
  for (Face& f : s.faces)
    for (Index& v : f) {
      if (name[v] == none) name[v] = all.add(s.positions[v][0], s.positions[v][1]);
      v = name[v];
    }
  all.faces = s.faces;
  for (const Position& near : {Position{.9, .1, 0}, Position{.1, .9, 0}, Position{.5, .5, 0}}) {
    const Index v = all.nearest(near[0], near[1]);
    const Position p = all.positions[v];
    const auto known = at_vertices(all, [&](const Position& q) {
      // Where the straight line passes the corner on the wrong side the path goes by way of it.
      const double side = (q[0] - p[0]) * (.5 - p[1]) - (q[1] - p[1]) * (.5 - p[0]);
      const bool apart = (p[0] > .5 && q[1] > .5) || (p[1] > .5 && q[0] > .5);
      const bool hidden = apart && (p[0] > .5 ? side > 0 : side < 0);
      const double straight = std::hypot(q[0] - p[0], q[1] - p[1]);
      return hidden ? std::hypot(p[0] - .5, p[1] - .5) + std::hypot(q[0] - .5, q[1] - .5)
                    : straight;
    });
    check_known(all, PointSource::at(v), known, 1e-4);
  }
}

TEST_CASE("parts: a prism, unrolled") {
  constexpr Index sides = 9, rows = 10;
  constexpr double height = 4;
  const Surface s = prism(sides, rows, height);
  for (const Index v : {0u, 4 * sides + 3, rows * sides + 8}) {
    std::vector<double> known;
    for (Index w = 0; w < s.positions.size(); ++w) {
      double around = std::abs(static_cast<double>(w % sides) - static_cast<double>(v % sides));
      around = std::min(around, sides - around);
      known.push_back(std::hypot(around, s.positions[w][2] - s.positions[v][2]));
    }
    check_known(s, PointSource::at(v), known, 1e-4);
  }
}

TEST_CASE("parts: what is apart is not reached, whoever has it") {
  // Two squares far from each other, the second smaller than a piece; and vertices of no triangle.
  Surface s = jittered(10, 3);
  const Surface far = jittered(2, 4);
  const auto shift = static_cast<Index>(s.positions.size());
  for (const Position& p : far.positions) s.add(p[0] + 100, p[1]);
  for (const Face& f : far.faces) s.triangle(f[0] + shift, f[1] + shift, f[2] + shift);
  const Index alone = s.add(3, 3), last = s.add(200, 0);
  for (const std::size_t ranks : {1u, 2u, 4u}) {
    CAPTURE(ranks);
    const Scheduler scheduler{ranks, 1, 20};
    const auto field = solve_in_parts<double>(s, scheduler, {PointSource::at(5)});
    CHECK(field.sound());
    CHECK(field.reached == shift);
    CHECK(field.beside_source == shift - 1);
    CHECK(field.summary.unreferenced_vertices == 2);
    for (Index v = 0; v < s.positions.size(); ++v)
      CHECK(std::isfinite(field.distance[v]) == (v < shift));
    // From there, and from a vertex of no triangle.
    const auto other = solve_in_parts<double>(
        s, scheduler, {PointSource::at(shift), {.vertex = last, .offset = .25}});
    CHECK(other.reached == far.positions.size() + 1);
    CHECK(other.distance[last] == .25);
    CHECK(other.label[last] == 1);
    CHECK(std::isinf(other.distance[alone]));
    CHECK(other.label[alone] == none);
    CHECK(std::isinf(other.distance[5]));
    const auto nothing = solve_in_parts<double>(s, scheduler, {PointSource::at(last)});
    CHECK(nothing.reached == 1);
    CHECK(nothing.beside_source == 0);
    CHECK(nothing.distance[last] == 0);
  }
}

TEST_CASE("parts: a source in a triangle whose neighbours are all in other pieces") {
  // All that it sends out leaves, so nothing waits in any piece: nothing was reached.
  for (const unsigned seed : {3u, 4u, 5u}) {
    const Surface s = jittered(6, seed);
    for (Index f = 0; f < s.faces.size(); ++f)
      for (const Accuracy& accuracy : {Accuracy::exact(), Accuracy::accurate()}) {
        CAPTURE(seed, f);
        const auto source = PointSource::in(f, {.3, .3, .4});
        const auto field = solve_in_parts<double>(s, {1, 1, 3}, {source}, at(accuracy));
        CHECK(field.reached == s.positions.size());
      }
  }
}

TEST_CASE("parts: more processes than pieces") {
  const Surface s = jittered(6, 9);
  const auto one = solve_in_parts<float>(s, {1, 1, 0}, {PointSource::at(3)});
  CHECK(one.summary.pieces == 1);
  CHECK(one.summary.ghosts == 0);
  for (const std::size_t ranks : {2u, 5u}) {
    const auto many = solve_in_parts<float>(s, {ranks, 1, 0}, {PointSource::at(3)});
    CHECK(same_bits(one, many));
    CHECK(many.sound());
    CHECK(std::count(many.own_faces.begin(), many.own_faces.end(), 0) ==
          static_cast<std::ptrdiff_t>(ranks - 1));
  }
}

TEST_CASE("parts: pieces are even, and each process has its share") {
  const Surface s = sphere(6);
  const auto field = solve_in_parts<float>(s, {4, 1, 500}, {PointSource::at(7)});
  CHECK(field.summary.pieces == Approx(static_cast<double>(s.faces.size()) / 500).epsilon(.05));
  for (const std::size_t own : field.own_faces)
    CHECK(own == Approx(static_cast<double>(s.faces.size()) / 4).epsilon(.15));
  CHECK(field.summary.ghosts < s.faces.size() / 2);
  // A vertex far off leaves all others in one cell of the curve: triangles' numbers tell them
  // apart.
  Surface far = jittered(30, 2);
  const Index v = far.add(1e9, 0);
  far.triangle(0, 1, v);
  const auto apart = solve_in_parts<double>(far, {3, 1, 100}, {PointSource::at(7)});
  CHECK(apart.summary.pieces > 5);
  CHECK(apart.sound());
}

TEST_CASE("parts: the same bits every time") {
  Surface s = jittered(12, 6);
  for (Position& p : s.positions) p[2] = .2 * std::sin(7 * p[0]) * std::cos(5 * p[1]);
  const std::vector<PointSource> sources = {PointSource::at(20), PointSource::at(150)};
  const auto once = solve_in_parts<float>(s, {1, 1, 30}, sources);
  for (const Scheduler& scheduler : {Scheduler{2, 1, 30}, Scheduler{2, 2, 30}}) {
    CHECK(same_bits(once, solve_in_parts<float>(s, scheduler, sources, {}, 100)));
  }
}

TEST_CASE("parts: a radius and a budget are kept") {
  for (const Accuracy accuracy : {Accuracy::exact(), Accuracy::accurate()})
    check_radius_in_parts(at(accuracy), 1e-3);
  check_budget_in_parts({});
}

TEST_CASE("parts: what is wrong is named as in the whole") {
  const Surface good = grid(8, 8);
  const auto refused = [&](const Surface& s, const std::string& text) {
    for (const std::size_t ranks : {1u, 3u}) {
      CAPTURE(ranks, text);
      try {
        solve_in_parts<float>(s, {ranks, 1, 20}, {PointSource::at(0)});
        FAIL("not refused");
      } catch (const Error& error) {
        CHECK(std::string(error.what()).find(text) != std::string::npos);
      }
    }
  };
  Surface s = good;
  s.faces[77][1] = 81;
  refused(s, "face 77: vertex 81 is out of range, there are 81");
  s = good;
  s.faces[101][2] = s.faces[101][0];
  refused(s, "face 101: vertex " + std::to_string(s.faces[101][0]) + " occurs twice");
  s = good;
  s.positions[66][1] = NAN;
  refused(s, "vertex 66: a coordinate is not finite");
  s = good;
  s.faces.clear();
  refused(s, "the surface has no faces");
  s = good;  // a triangle too small beside the mean edge
  const Index a = s.add(5, 5), b = s.add(5 + 1e-12, 5), c = s.add(5, 5 + 1e-12);
  s.triangle(a, b, c);
  refused(s, "face 128: its longest edge");
  CHECK_THROWS_AS(solve_in_parts<float>(good, {2, 1, 20}, {PointSource::at(81)}), UsageError);
  CHECK_THROWS_AS(solve_in_parts<float>(good, {2, 1, 20}, {}), UsageError);
  PropagateOptions other;
  other.schedule = Schedule::fifo;
  CHECK_THROWS_AS(solve_in_parts<float>(good, {2, 1, 20}, {PointSource::at(0)}, other), UsageError);
}

TEST_CASE("parts: merged windows are as accurate as Serial's on curved surfaces") {
  // At which vertex a window too few is kept, and how much that is there, changes with the cut: of
  // several cuts, how many vertices are worse than Serial's worst.
  constexpr std::size_t cuts[] = {1400, 2048, 3000};
  double serial = 0, in_parts = 0, worst_serial = 0, worst = 0;
  std::size_t vertices = 0, worse = 0;
  each_known_surface(60'000, [&](const KnownSurface& known) {
    if (known.name == "t79741") return;  // needles: below
    const auto error = [&](const DistanceField<float>& field, double& most) {
      CHECK(field.accuracy == Accuracy::accurate());
      const ExactError e = error_of(field.distance, known.exact, 2.5e-3);
      most = std::max(most, e.worst);
      return e;
    };
    const ExactError of_serial = error(solve(Serial{}, known.mesh, known.source), worst_serial);
    serial += of_serial.mean;
    CHECK(of_serial.above == 0);
    for (const std::size_t piece : cuts) {
      const ExactError e =
          error(solve_in_parts<float>(known.surface, {2, 1, piece}, {known.source}), worst);
      in_parts += e.mean / std::size(cuts);
      worse += e.above;
    }
    vertices += std::size(cuts) * known.exact.distance.size();
  });
  REQUIRE(serial > 0);
  INFO("mean " << in_parts / serial << " of Serial's, worst " << worst << ", Serial's "
               << worst_serial << ", worse " << worse << " of " << vertices);
  CHECK(in_parts < 1.05 * serial);
  CHECK(static_cast<double>(worse) < 1e-4 * static_cast<double>(vertices));
  CHECK(worst <= 1.5e-2);  // the whole in pieces has 1.3e-2 in one of these cuts
}

// Merged windows give way to exact ones there. In single precision what lengths are rounded to
// moves some vertices by more than 1e-3, of the whole, too.
TEST_CASE("parts: needles, exactly") {
  for (const auto& file : exact_files("surfaces", ".obj")) {
    if (file.stem() != "t79741") continue;
    const io::Triangles soup = io::read_triangles(file);
    const Surface s{soup.positions, soup.triangles};
    const auto options = at(Accuracy::exact());
    const auto whole = solve(Serial{}, s.mesh<double>(), PointSource::at(1928), options);
    const auto parts = solve_in_parts<double>(s, {2, 1, 2048}, {PointSource::at(1928)}, options);
    CHECK(parts.sound());
    CHECK(worst_of(parts.distance, whole.distance) < 1e-12);
  }
}

}  // namespace plexway::testing::surface_parts_test
