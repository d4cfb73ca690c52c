// What is told of distances, and to whom: the sentences themselves are in field_warnings_test.cpp.

#include <plexway/shape/warnings.hpp>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <vector>

#include "shape/warnings/sentences.hpp"

namespace plexway::warnings_test {

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

}  // namespace plexway::warnings_test
