#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <plexway/executors.hpp>
#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/shape/complex.hpp>
#include <plexway/shape/warnings.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve.hpp>
#include <plexway/surface/triangle_mesh.hpp>
#include <plexway/wireframe/wireframe.hpp>

#include "data/crack_plans.hpp"

namespace plexway::field_warnings_test {

namespace {

/// Two rows of triangles, so many edges long.
struct Strip {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;
  std::vector<std::array<double, 3>> lengths;

  explicit Strip(Index edges) {
    for (Index i = 0; i <= edges; ++i) {
      positions.push_back({static_cast<double>(i), 0, 0});
      positions.push_back({i + .3, 1, 0});
    }
    for (Index i = 0; i < edges; ++i) {
      const Index a = 2 * i;
      faces.push_back({a, a + 2, a + 1});
      faces.push_back({a + 2, a + 3, a + 1});
    }
    const auto apart = [this](Index v, Index w) {
      return std::hypot(positions[v][0] - positions[w][0], positions[v][1] - positions[w][1]);
    };
    for (const auto& [a, b, c] : faces) lengths.push_back({apart(a, b), apart(b, c), apart(c, a)});
  }
};

std::vector<std::string> texts_of(const std::vector<Warning>& warnings) {
  std::vector<std::string> texts;
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

/// What is warned where the kind is known.
std::vector<std::string> of_known_kind(const AnyDomain& domain, const AnyField& field,
                                       const PropagateOptions& options = {}) {
  return with_complex(domain, [&]<class C>(const C& complex) {
    return texts_of(
        plexway::warnings(complex, std::get<DistanceField<RealOf<C>>>(field.data), options));
  });
}

/// That AnyDomain says it, too.
void check_known_kind(const AnyDomain& domain, const AnyField& field,
                      const PropagateOptions& options) {
  const auto all = texts_of(plexway::warnings(domain, field, PointSource::at(0), options));
  for (const std::string& text : of_known_kind(domain, field, options)) {
    INFO(text);
    const bool said = std::any_of(all.begin(), all.end(), [&](const std::string& one) {
      return one.starts_with(text);  // and then more of why vertices are not reached
    });
    CHECK(said);
  }
}

/// Is this among what is warned on a field from vertex 0?
bool warnings(AnyShape shape, const BuildOptions& building, Accuracy accuracy,
              const std::string& words) {
  const AnyDomain domain(std::move(shape), building);
  const Source source = PointSource::at(0);
  PropagateOptions options;
  options.accuracy = accuracy;
  const AnyField field = domain.solve(Serial{}, source, options);
  const CloudShape* const cloud = domain.shape().cloud();
  // Of other triangles and refused normals AnyDomain alone knows.
  if (cloud != nullptr ? cloud->points.normals.empty()
                       : building.triangulation == Triangulation::input)
    check_known_kind(domain, field, options);
  const auto told = plexway::warnings(domain, field, source, options, Reader::tool);
  return std::any_of(told.begin(), told.end(), [&](const Warning& warning) {
    return warning.text.find(words) != std::string::npos;
  });
}

bool warns_of_rounding(AnyShape shape, Precision precision, Accuracy accuracy) {
  BuildOptions building;
  building.precision = precision;
  building.triangulation = Triangulation::input;
  return warnings(std::move(shape), building, accuracy, "use --precision double");
}

/// A roof with so many degrees on either side of its ridge, and a hole there.
io::Points roof(unsigned seed, double degrees) {
  constexpr int side = 30;
  const double slope = degrees * std::acos(-1.) / 180, half = .5 * (side - 1);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-.15, .15);
  io::Points points;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double x = i - half + off(random), y = j + off(random);
      if (std::hypot(x - .3, y - 15) <= 1.6) continue;
      points.positions.push_back({x * std::cos(slope), y, -std::abs(x) * std::sin(slope)});
    }
  return points;
}

/// A block of cubes that are there, each of six tetrahedra, and a skin on the whole of its floor.
template <class There>
MixedShape block(std::array<std::size_t, 3> cubes, const There& there, bool skin) {
  MixedShape shape;
  MixedShape::Part part;
  const auto at = [&](std::size_t x, std::size_t y, std::size_t z) {
    return static_cast<Index>((z * (cubes[1] + 1) + y) * (cubes[0] + 1) + x);
  };
  for (std::size_t z = 0; z <= cubes[2]; ++z)
    for (std::size_t y = 0; y <= cubes[1]; ++y)
      for (std::size_t x = 0; x <= cubes[0]; ++x)
        shape.positions.push_back({double(x), double(y), double(z)});
  for (std::size_t z = 0; z < cubes[2]; ++z)
    for (std::size_t y = 0; y < cubes[1]; ++y)
      for (std::size_t x = 0; x < cubes[0]; ++x) {
        if (!there(x, y, z)) continue;
        std::array<std::size_t, 3> axes = {0, 1, 2};
        do {
          std::array<std::size_t, 3> corner = {x, y, z};
          std::array<Index, 4> tet = {at(x, y, z)};
          for (std::size_t i = 0; i < 3; ++i) {
            ++corner[axes[i]];
            tet[i + 1] = at(corner[0], corner[1], corner[2]);
          }
          part.tets.push_back(tet);
        } while (std::next_permutation(axes.begin(), axes.end()));
        if (!skin || z > 0) continue;
        part.triangles.push_back({at(x, y, 0), at(x + 1, y, 0), at(x + 1, y + 1, 0)});
        part.triangles.push_back({at(x, y, 0), at(x + 1, y + 1, 0), at(x, y + 1, 0)});
      }
  part.vertices = shape.positions.size();
  shape.parts = {part};
  return shape;
}

/// Two layers of points at random, half a spacing apart.
io::Points layers(unsigned seed) {
  constexpr int side = 20;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(0, side);
  io::Points points;
  for (int i = 0; i < 2 * side * side; ++i)
    points.positions.push_back({at(random), at(random), i % 2 == 0 ? 0 : .5});
  return points;
}

}  // namespace

TEST_CASE("strips longer than single precision can hold are told") {
  const Strip s(6000), longer(20000), longest(60000);
  const auto by_lengths = [](const Strip& strip) {
    return AnyShape::surface(strip.positions.size(), strip.faces, strip.lengths);
  };
  const auto in_space = [](const Strip& strip) {
    return AnyShape::surface(strip.positions, strip.faces);
  };
  const Accuracy fast = Accuracy::fast(), accurate = Accuracy::accurate();
  CHECK_FALSE(warns_of_rounding(by_lengths(s), Precision::float32, accurate));
  CHECK(warns_of_rounding(by_lengths(longer), Precision::float32, accurate));
  CHECK_FALSE(warns_of_rounding(by_lengths(longer), Precision::float64, accurate));
  CHECK_FALSE(warns_of_rounding(by_lengths(longer), Precision::float32, fast));
  CHECK_FALSE(warns_of_rounding(in_space(longer), Precision::float32, accurate));
  CHECK(warns_of_rounding(in_space(longest), Precision::float32, accurate));
  CHECK(warns_of_rounding(in_space(longest), Precision::float32, fast));
}

TEST_CASE("fields of a known kind are warned of without AnyDomain") {
  const auto said = [](const AnyDomain& domain, const PropagateOptions& options = {}) {
    const AnyField field = domain.solve(Serial{}, PointSource::at(0), options);
    std::string all;
    for (const std::string& text : of_known_kind(domain, field, options)) all += text + '\n';
    return all;
  };
  const BuildOptions as_given{.triangulation = Triangulation::input};
  const Strip longest(60000);
  CHECK_THAT(said(AnyDomain(AnyShape::surface(longest.positions, longest.faces), as_given)),
             Catch::Contains("use double precision"));
  const Strip s(20);
  CHECK(said(AnyDomain(AnyShape::surface(s.positions, s.faces), as_given)).empty());
  PropagateOptions few;
  few.max_expansions = 5;
  few.accuracy = Accuracy::fast();
  CHECK_THAT(said(AnyDomain(AnyShape::surface(s.positions, s.faces), as_given), few),
             Catch::Contains("stopped after 5 expansions") && Catch::Contains("not reached (inf)"));
  const AnyDomain apart(
      AnyShape::wireframe({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {{0, 1}, {2, 3}}));
  CHECK(said(apart) == "2 vertices not reached (inf): the wireframe has 2 components\n");

  // A notched solid, in space and by its lengths alone.
  const MixedShape cubes = block(
      {3, 1, 2}, [](std::size_t x, std::size_t, std::size_t z) { return x != 1 || z < 1; }, false);
  const auto& tets = cubes.parts[0].tets;
  const AnyDomain solid(AnyShape::solid(cubes.positions, tets));
  CHECK(said(solid).empty());
  const auto lengths = metric::edge_lengths_of<metric::simplex_edges<4>>(cubes.positions, tets);
  CHECK_THAT(said(AnyDomain(AnyShape::solid(cubes.positions.size(), tets, lengths))),
             Catch::Contains("which no rule sees in a solid by lengths"));
}

TEST_CASE("holes of a cloud that points do not tell how to close are told") {
  const auto warns = [](io::Points points,
                        const std::string& words = "around holes that could not be closed") {
    return warnings(AnyShape::cloud(std::move(points)), {}, Accuracy::fast(), words);
  };
  std::size_t warned = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    CHECK_FALSE(warns(roof(seed, 0)));
    if (!warns(layers(seed))) continue;
    ++warned;
    // Normals of no use are not named as the cure.
    io::Points points = layers(seed);
    for (std::size_t i = 0; i < points.positions.size(); ++i)
      points.normals.push_back({0, 0, i % 3 == 0 ? 1. : -1.});
    CHECK(warns(std::move(points), "and are not taken"));
  }
  CHECK(warned > 0);
}

TEST_CASE("noise at a sharp ridge of a cloud is told") {
  const auto warns = [](double degrees, double noise) {
    io::Points points = roof(5, degrees);
    std::mt19937 random(9);
    std::normal_distribution<double> off(0, noise);
    for (auto& p : points.positions)
      for (double& x : p) x += noise > 0 ? off(random) : 0;
    return warnings(AnyShape::cloud(std::move(points)), {}, Accuracy::fast(),
                    "cut through the inside");
  };
  CHECK(warns(75, .06));
  CHECK(warns(60, .06));
  CHECK_FALSE(warns(0, .06));
  CHECK_FALSE(warns(60, 0));
  CHECK_FALSE(warns(0, 0));
}

TEST_CASE("normals of a small cloud with a sharp ridge are told from those of arbitrary signs") {
  for (const double degrees : {0., 30., 60., 75.}) {
    const double slope = degrees * std::acos(-1.) / 180;
    io::Points points = roof(3, degrees), thin;
    // A narrow strip along the ridge: many nearest neighbours are beyond it.
    for (const auto& p : points.positions)
      if (std::abs(p[0]) < 3 * std::cos(slope)) thin.positions.push_back(p);
    for (const auto& p : thin.positions)
      thin.normals.push_back({(p[0] < 0 ? -1 : 1) * std::sin(slope), 0, std::cos(slope)});
    io::Points arbitrary = thin;
    std::mt19937 random(4);
    for (auto& n : arbitrary.normals)
      if (random() % 2 == 0)
        for (double& x : n) x = -x;
    CAPTURE(degrees);
    CHECK(AnyShape::cloud(std::move(thin)).cloud()->normals_agree);
    CHECK_FALSE(AnyShape::cloud(std::move(arbitrary)).cloud()->normals_agree);
  }
}

TEST_CASE("parts of a cloud that no triangles join are told") {
  // Two squares in one plane, corner to corner.
  const auto warns = [](double gap) {
    io::Points points;
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        points.positions.push_back({double(i), double(j), 0});
        points.positions.push_back({11 + gap + i, 11 + gap + j, 0});
      }
    return warnings(AnyShape::cloud(std::move(points)), {}, Accuracy::fast(),
                    "join parts that have no triangles between them");
  };
  CHECK(warns(2.5));
  CHECK_FALSE(warns(1));
  CHECK_FALSE(warns(3));  // two components
}

TEST_CASE("points of a cloud behind a notch in its rim are told") {
  // A flat grid with a notch three spacings deep; a source beside it, and one far away.
  const auto warns = [](std::size_t from, double bent, double offset = 0) {
    io::Points points;
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 20; ++j)
        if (j > 2 || i < 18 || i > 21)
          points.positions.push_back({double(i), double(j), bent * (i - 20.) * (i - 20.)});
    const AnyDomain domain(AnyShape::cloud(std::move(points)));
    PointSource at = PointSource::at(static_cast<Index>(from));
    at.offset = offset;
    const Source source = at;
    const AnyField field = domain.solve(Serial{}, source);
    const auto told = field_warnings(domain, field, source);
    return std::any_of(told.begin(), told.end(), [](const Warning& warning) {
      return warning.text.find("around a notch in its rim") != std::string::npos;
    });
  };
  CHECK(warns(17 * 20, 0));
  CHECK_FALSE(warns(19, 0));
  // What a source has walked before is no detour.
  CHECK(warns(17 * 20, 0, 1));
  CHECK_FALSE(warns(19, 0, 1));
  // Curved so that straight lines are shorter by more: that is no notch.
  CHECK_FALSE(warns(0, .05));
}

TEST_CASE("paths that strings refract and bend around edges of a solid need no warning") {
  const auto told = [](const AnyShape& shape, const std::vector<double>& speed) {
    BuildOptions building{.precision = Precision::float64};
    metric::SimplexSpeeds speeds{.speed = speed, .agreement = {metric::Sides::own}};
    building.lengths = std::make_shared<const MeasuredLengths>(shape.measure(speeds));
    return warnings(shape, building, Accuracy::fast(), "paths go from part to part at vertices");
  };
  const auto whole = [](std::size_t, std::size_t, std::size_t) { return true; };
  const auto pierced = [](std::size_t x, std::size_t y, std::size_t) {
    return !(x == 1 && (y == 1 || y == 2));
  };
  const auto notched = [](std::size_t x, std::size_t, std::size_t z) { return x != 1 || z < 1; };
  // Of a half a speed each, the upper one by `fast`.
  const auto in_halves = [&](const auto& there, double fast) {
    const MixedShape cubes = block({3, 4, 2}, there, false);
    const auto& tets = cubes.parts[0].tets;
    std::vector<double> speed;
    for (const auto& tet : tets) {
      double y = 0;
      for (const Index v : tet) y += cubes.positions[v][1] / 4;
      speed.push_back(y > 2 ? fast : 1);
    }
    return told(AnyShape::solid(cubes.positions, tets), speed);
  };
  CHECK_FALSE(in_halves(pierced, 2));
  CHECK_FALSE(in_halves(notched, .8));
  CHECK_FALSE(in_halves(whole, 2));
  CHECK_FALSE(in_halves(pierced, 1));
  const auto with_skin = [&](const auto& there, double fast, std::size_t wide = 3,
                             double rough = 0) {
    MixedShape cubes = block({wide, 4, 2}, there, true);
    std::mt19937 random(3);
    for (auto& p : cubes.positions)
      for (double& x : p) x += std::uniform_real_distribution<double>(-rough, rough)(random);
    std::vector<double> speed(cubes.parts[0].triangles.size(), fast);
    speed.resize(speed.size() + cubes.parts[0].tets.size(), 1);
    return told(AnyShape::mixed(cubes), speed);
  };
  CHECK_FALSE(with_skin(notched, 2));
  CHECK_FALSE(with_skin(notched, 1));
  CHECK_FALSE(with_skin(whole, 2));
  CHECK(with_skin(notched, 2, 5, .05));  // a skin of many facets: each part by itself
}

TEST_CASE("a wire or a sheet that is not made of a solid's edges is noted") {
  const KuhnGrid<3> grid({2, 2, 2}, {1., 1., 1.});
  std::vector<std::array<double, 3>> positions;
  for (Index v = 0; v < grid.vertex_count(); ++v) positions.push_back(grid.position(v));
  const TetMesh<double> solid(positions, grid.simplices());
  const auto noted = [&](const auto& part, const std::vector<std::array<double, 3>>& places) {
    MixedComplex<double> complex;
    const auto block = complex.add(solid, positions);
    const auto other = complex.add(part, places);
    CHECK(complex.weld(block, other, {.tolerance = 1e-9}) == places.size());
    const auto all = warnings(complex, solve(Serial{}, complex, 0));
    return std::any_of(all.begin(), all.end(), [](const Warning& warning) {
      return warning.text.find("1 edge of wires or surfaces leads") != std::string::npos &&
             !warning.doubtful;
    });
  };
  using Edges = std::vector<std::array<Index, 2>>;
  const std::vector<std::array<double, 3>> row = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  CHECK_FALSE(noted(Wireframe<double>(row, Edges{{0, 1}, {1, 2}}), row));
  const std::vector<std::array<double, 3>> ends = {{0, 0, 0}, {2, 0, 0}};
  CHECK(noted(Wireframe<double>(ends, Edges{{0, 1}}), ends));
  // A square by the grid's own diagonal, and by the other.
  const std::vector<std::array<double, 3>> square = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  using Triangles = std::vector<std::array<Index, 3>>;
  CHECK_FALSE(noted(TriangleMesh<double>(square, Triangles{{0, 1, 2}, {0, 2, 3}}), square));
  CHECK(noted(TriangleMesh<double>(square, Triangles{{0, 1, 3}, {1, 2, 3}}), square));
}

}  // namespace plexway::field_warnings_test
