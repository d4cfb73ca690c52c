#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/warnings.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>

#include "complexes/simplicial/simplex_notches.hpp"
#include "shape/warnings/sentences.hpp"

namespace plexway::warnings_test {
using namespace detail;

// What is told of distances, and to whom: the sentences themselves are in field_warnings_test.cpp.

namespace {

constexpr std::array readers = {Reader::people, Reader::tool, Reader::python};

bool tells(const std::vector<Warning>& warnings, const std::string& words) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const Warning& warning) {
    return warning.text.find(words) != std::string::npos;
  });
}

/// Two squares of points in one plane, corner to corner, so far apart in x and in y.
AnyShape squares(double gap) {
  io::Points points;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      points.positions.push_back({double(i), double(j), 0});
      points.positions.push_back({11 + gap + i, 11 + gap + j, 0});
    }
  return AnyShape::cloud(std::move(points));
}

/// A square of two triangles, and another one apart.
AnyShape two_sheets() {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;
  for (Index s = 0; s < 2; ++s) {
    for (const auto& [x, y] : {std::array{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}})
      positions.push_back({x + 5. * s, y, 0});
    faces.push_back({4 * s, 4 * s + 1, 4 * s + 2});
    faces.push_back({4 * s, 4 * s + 2, 4 * s + 3});
  }
  return AnyShape::surface(positions, faces);
}

}  // namespace

TEST_CASE("a wire across a face that is no edge of it is warned of") {
  const auto found = [](std::vector<std::array<Index, 2>> wires) {
    MixedShape shape;
    shape.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    shape.parts.push_back(
        {.vertices = 4, .edges = std::move(wires), .triangles = {{0, 1, 2}, {0, 2, 3}}});
    return domain_warnings(AnyDomain(AnyShape::mixed(shape)));
  };
  CHECK_FALSE(tells(found({{0, 2}, {2, 3}}), "not as an edge"));
  CHECK(tells(found({{0, 2}, {1, 3}}), "1 edge of wires or surfaces leads between vertices that"));
  CHECK(tells(found({{1, 3}}), "what is meant to lie on that part has to be made of its edges"));
}

TEST_CASE("advice is spelled for who reads it") {
  const AnyDomain cloud(squares(2.5));
  for (const Reader reader : readers) {
    const auto told = domain_warnings(cloud, reader);
    REQUIRE(told.size() == 1);
    CHECK(told[0].doubtful);
    CHECK(tells(told, "join parts that have no triangles between them"));
    CHECK(tells(told, "normals in the file (columns nx ny nz)") == (reader == Reader::tool));
    CHECK(tells(told, "normals=") == (reader == Reader::python));
  }
  // The same advice to everybody, options of the tool to nobody else.
  PropagateOptions near;
  near.radius = 2;
  const Source source = PointSource::at(0);
  const AnyField field = cloud.solve(Serial{}, source, near);
  for (const Reader reader : readers) {
    const auto told = warnings(cloud, field, source, near, reader);
    CHECK(told.size() == 2);
    CHECK(tells(told, "not reached (inf)"));
    CHECK(tells(told, "ends the search early"));
    CHECK(tells(told, "--radius or --max-expansions") == (reader == Reader::tool));
    CHECK(tells(told, "radius= ends") == (reader == Reader::python));
    CHECK((reader == Reader::tool || !tells(told, "--")));
  }
  for (int advice = 0; advice <= static_cast<int>(Advice::meant); ++advice)
    for (const Reader reader : {Reader::people, Reader::python})
      CHECK(std::string(spelled(static_cast<Advice>(advice), reader)).find("--") ==
            std::string::npos);
  CHECK(spelled(Advice::accurate, Reader::tool) == std::string("--accuracy accurate"));
  CHECK(spelled(Advice::accurate, Reader::python) == std::string("accuracy='accurate'"));
}

TEST_CASE("what is not reached is told, and is no doubt") {
  const AnyDomain domain(two_sheets());
  const PointSource source = PointSource::at(1);
  const AnyField field = domain.solve(Serial{}, source);
  CHECK(domain_warnings(domain).empty());
  CHECK(field_warnings(domain, field, source).empty());
  const auto told = warnings(domain, field, source);
  REQUIRE(told.size() == 1);
  CHECK(told[0].text == "4 vertices not reached (inf): the surface has 2 components");
  CHECK_FALSE(told[0].doubtful);
  const std::vector<PointSource> both = {source, PointSource::at(4)};
  CHECK(warnings(domain, domain.solve(Serial{}, both), both).empty());
}

TEST_CASE("fields that ended early are told") {
  const AnyDomain domain(two_sheets());
  const PointSource source = PointSource::at(1);
  PropagateOptions options;
  options.max_expansions = 1;
  options.accuracy = Accuracy::fast();
  const auto told =
      field_warnings(domain, domain.solve(Serial{}, source, options), source, Reader::tool);
  REQUIRE(told.size() == 1);
  CHECK(told[0].text == "stopped after 1 expansion: distances may still be too long");
  CHECK(told[0].doubtful);
}

TEST_CASE("work that got much wrong is told of one field and of many rows") {
  const AnyDomain domain(two_sheets());
  PropagateStatistics sum;
  sum.raised_vertices = 3;
  const auto rows = [&](std::size_t count, Accuracy accuracy, Reader reader) {
    return rows_warnings(domain, sum, accuracy, count, reader);
  };
  // 3 of 8 vertices, of 80, and of 800.
  CHECK(tells(rows(1, Accuracy::fast(), Reader::tool),
              "3 vertices came out nearer than the straight line"));
  CHECK(tells(rows(10, Accuracy::fast(), Reader::tool), "3 vertices of 10 rows came out nearer"));
  CHECK(rows(100, Accuracy::fast(), Reader::tool).empty());
  CHECK(tells(rows(1, Accuracy::fast(), Reader::python), "; accuracy='accurate' has none of this"));
  CHECK(tells(rows(1, Accuracy::usual(), Reader::python), "another triangulation= may do better"));
  PropagateStatistics early;
  early.windows_gave_up = 2;
  const auto told = rows_warnings(domain, early, Accuracy::usual(), 5, Reader::python);
  REQUIRE(told.size() == 1);
  CHECK(told[0].text ==
        "windows became too many to wait for from 2 sources: the distances are those of "
        "accuracy='fast'; accuracy='exact' waits longer");
}

TEST_CASE("lengths that no flat simplex has are told, of what a mask leaves") {
  // The first triangle's edges are 4, 3 and 50 long.
  const AnyShape shape =
      AnyShape::surface(4, std::vector<std::array<Index, 3>>{{0, 1, 2}, {0, 2, 3}},
                        std::vector<std::array<double, 3>>{{4, 3, 50}, {50, 40, 30}});
  const AnyDomain domain(shape);
  CHECK(violations_of(domain).count == 1);
  CHECK(violations_of(domain).first == 0);
  const auto told = domain_warnings(domain);
  REQUIRE(told.size() == 1);
  CHECK(told[0].text ==
        "lengths break the triangle inequality in 1 triangle of 2, such as triangle 0: their "
        "lengths were taken as those of the nearest flat ones");
  BuildOptions masked;
  Mask mask(4, 2);
  mask.close_simplex(0);
  masked.mask = std::make_shared<const Mask>(mask);
  const AnyDomain left(shape, masked);
  CHECK(violations_of(left).count == 0);
  CHECK(domain_warnings(left).empty());
}

// Quads of a surface that were handed over as tetrahedra.

namespace {

using Rows = std::vector<std::array<Index, 4>>;

// A strip of n quads along x, bent by `angle` at each edge between two.
std::pair<AnyShape::Points, Rows> strip(Index n, double angle) {
  AnyShape::Points at;
  Rows quads;
  double x = 0, z = 0;
  for (Index i = 0; i <= n; ++i) {
    at.push_back({x, 0, z});
    at.push_back({x + .3 * angle, 1, z});  // no quad is flat
    x += std::cos(i * angle), z += std::sin(i * angle);
    if (i > 0) quads.push_back({2 * i - 2, 2 * i, 2 * i + 1, 2 * i - 1});
  }
  return {at, quads};
}

TEST_CASE("flat tetrahedra alone are refused, with what quads become") {
  const auto [at, quads] = strip(5, 0);
  const AnyShape shape = AnyShape::solid(at, quads);
  CHECK_THROWS_AS(AnyDomain(shape), InputError);
  CHECK_THROWS_WITH(AnyDomain(shape),
                    Catch::Contains("5 tetrahedra") && Catch::Contains("(0, 1, 2) and (0, 2, 3)"));
}

TEST_CASE("tetrahedra that share no face but edges are doubted") {
  auto [at, quads] = strip(6, .2);
  for (std::size_t i = 1; i < at.size(); i += 2) at[i][2] += .1 * (i % 4 == 1);
  const auto doubted = [](const AnyDomain& domain) {
    for (const Warning& warning : domain_warnings(domain))
      if (warning.doubtful && warning.text.find("quads") != std::string::npos) return true;
    return false;
  };
  CHECK(doubted(AnyDomain(AnyShape::solid(at, quads))));
  const AnyShape::Points two = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  CHECK_FALSE(doubted(AnyDomain(AnyShape::solid(two, {{0, 1, 2, 3}, {0, 2, 1, 4}}))));
}

}  // namespace

// Notches of complexes by lengths alone, which the plain step sees through: told with how many
// there are, in every dimension, and nowhere else.

namespace {

// Three cells by two, along further axes two: without the middle one of the first row, or with it.
template <int N>
SimplexShape box(bool notched, bool by_lengths) {
  typename KuhnGrid<N>::Place cells;
  typename KuhnGrid<N>::Point spacing;
  cells.fill(2), spacing.fill(0.5);
  cells[0] = 3;
  const KuhnGrid<N> grid(cells, spacing);
  SimplexShape shape{.dimension = N, .vertices = grid.vertex_count()};
  const auto length = [&](Index v, Index w) {
    double sum = 0;
    for (std::size_t k = 0; k < N; ++k)
      sum += std::pow(grid.position(v)[k] - grid.position(w)[k], 2);
    return std::sqrt(sum);
  };
  for (const auto& simplex :
       grid.simplices([&](const auto& c) { return notched && c[0] == 1 && c[1] == 0; })) {
    shape.corners.insert(shape.corners.end(), simplex.begin(), simplex.end());
    for (std::size_t b = 1; b <= N && by_lengths; ++b)
      for (std::size_t a = 0; a < b; ++a) shape.lengths.push_back(length(simplex[a], simplex[b]));
  }
  if (!by_lengths) shape.axes = N, shape.positions = grid.positions();
  return shape;
}

std::string notch_note(const AnyShape& shape) {
  for (const Warning& warning : domain_warnings(AnyDomain(shape)))
    if (warning.doubtful && warning.text.find("which no rule sees in") != warning.text.npos)
      return warning.text.substr(0, warning.text.find(" of the boundary"));
  return "";
}

template <int N>
void check(const std::string& what) {
  CAPTURE(N);
  CHECK(notch_note(AnyShape::simplices(box<N>(true, true))) == "paths bend around " + what);
  CHECK(notch_note(AnyShape::simplices(box<N>(false, true))).empty());
  CHECK(notch_note(AnyShape::simplices(box<N>(true, false))).empty());  // solved by strings
}

}  // namespace

TEST_CASE("notches by lengths alone are told, in any dimension") {
  check<2>("2 corners");
  check<3>("4 edges");
  check<4>("16 triangles");
  const SimplexShape solid = box<3>(true, true), whole = box<3>(false, true);
  const auto as_solid = [](const SimplexShape& shape) {
    std::vector<std::array<Index, 4>> tets;
    std::vector<std::array<double, 6>> lengths;
    for (std::size_t s = 0; 4 * s < shape.corners.size(); ++s) {
      std::copy_n(&shape.corners[4 * s], 4, tets.emplace_back().begin());
      std::copy_n(&shape.lengths[6 * s], 6, lengths.emplace_back().begin());
    }
    return AnyShape::solid(shape.vertices, tets, lengths);
  };
  CHECK(notch_note(as_solid(solid)) == "paths bend around 4 edges");
  CHECK(notch_note(as_solid(whole)).empty());
}

TEST_CASE("facets of a regular simplex are at the arc cosine of 1 / N") {
  SimplexRecord<double, 4> four{};
  for (double& length2 : four.length2) length2 = 2;
  const auto angles = facet_angles<double, 4>(four);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) CHECK(angles[i][j] == Approx(i == j ? 0 : std::acos(0.25)));
  SimplexRecord<double, 2> right{};
  right.length2[0] = 9, right.length2[1] = 16, right.length2[2] = 25;
  CHECK(facet_angles<double, 2>(right)[1][2] == Approx(std::numbers::pi / 2));
  right.length2[2] = 49;  // in a line
  CHECK(facet_angles<double, 2>(right)[1][2] == 0);
}

// Clouds of points at random, in which nobody can say to a spacing where a slit ends: told where it
// matters, and nowhere else.

namespace {

// Of the unit square, bent to a quarter of a tube, but for a slit of width 0.16 as far as `top`.
std::vector<std::array<double, 3>> sheet(std::size_t count, unsigned seed, double top, bool even) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in(0, 1), off(-0.3, 0.3);
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(count)));
  const double step = 1 / static_cast<double>(side);
  std::vector<std::array<double, 3>> points;
  for (std::size_t n = 0; n < side * side; ++n) {
    const double x = even ? step * (static_cast<double>(n % side) + 0.5 + off(random)) : in(random);
    const double y = even ? step * (static_cast<double>(n / side) + 0.5 + off(random)) : in(random);
    if (std::abs(x - 0.5) < 0.08 && y < top) continue;
    points.push_back({std::sin(x), std::cos(x), y});
  }
  return points;
}

bool warned(std::vector<std::array<double, 3>> at) {
  io::Points points;
  points.positions = std::move(at);
  const AnyDomain domain(AnyShape::cloud(points));
  const auto field = domain.solve(Serial{}, PointSource::at(0));
  for (const Warning& warning : warnings(domain, field, PointSource::at(0)))
    if (warning.text.find("scattered as by chance") != warning.text.npos) return warning.doubtful;
  return false;
}

}  // namespace

TEST_CASE("scattered points: a slit in them is told of, a straight rim and even points are not") {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    CAPTURE(seed);
    CHECK(warned(sheet(2000, seed, 0.6, false)));
    CHECK(!warned(sheet(2000, seed, 0, false)));
    CHECK(!warned(sheet(2000, seed, 0.6, true)));
  }
  // Finer points know it better.
  CHECK(!warned(sheet(20000, 5, 0.6, false)));
}

}  // namespace plexway::warnings_test
