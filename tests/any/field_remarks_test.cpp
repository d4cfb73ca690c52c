#include "any/field_remarks.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace plexway;

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

bool warns_of_rounding(AnyShape shape, Precision precision, Accuracy accuracy) {
  BuildOptions building;
  building.precision = precision;
  building.triangulation = Triangulation::input;
  const AnyDomain domain(std::move(shape), building);
  const Source source = PointSource::at(0);
  PropagateOptions options;
  options.accuracy = accuracy;
  const AnyField field = domain.solve(Serial{}, source, options);
  const std::vector<double> distance = field.doubles();
  const auto remarks = field_remarks(domain, field, reach_of(distance, {&source, 1}), false);
  return std::any_of(remarks.begin(), remarks.end(), [](const std::string& r) {
    return r.find("use --precision double") != std::string::npos;
  });
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
  CHECK_FALSE(warns_of_rounding(by_lengths(s), Precision::single, accurate));
  CHECK(warns_of_rounding(by_lengths(longer), Precision::single, accurate));
  CHECK_FALSE(warns_of_rounding(by_lengths(longer), Precision::twice, accurate));
  CHECK_FALSE(warns_of_rounding(by_lengths(longer), Precision::single, fast));
  CHECK_FALSE(warns_of_rounding(in_space(longer), Precision::single, accurate));
  CHECK(warns_of_rounding(in_space(longest), Precision::single, accurate));
  CHECK(warns_of_rounding(in_space(longest), Precision::single, fast));
}
