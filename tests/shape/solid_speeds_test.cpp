// Solids whose tetrahedra have speeds of their own, by the facade.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>

#include "data/mixed_pieces.hpp"

namespace plexway::solid_speeds_test {

TEST_CASE("any domain: paths are refracted where the speeds of a solid jump") {
  const samples::Layers layers = {{.35, .7}, {1, 2, 1.5}};
  constexpr std::size_t n = 8;
  // One solid of all layers' blocks: vertices at one place are one.
  const auto blocks = samples::blocks_of(layers, n, .15, 3);
  std::map<std::array<double, 3>, Index> number;
  AnyShape::Points positions;
  std::vector<std::array<Index, 4>> tets;
  metric::SimplexSpeeds speeds{.speed = {}, .agreement = {metric::Sides::own}};
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for (auto tet : blocks[k].tets) {
      for (Index& v : tet) {
        const auto& p = blocks[k].positions[v];
        const auto [known, is_new] = number.insert({p, static_cast<Index>(positions.size())});
        if (is_new) positions.push_back(p);
        v = known->second;
      }
      tets.push_back(tet);
      speeds.speed.push_back(layers.v[k]);
    }
  const AnyShape shape = AnyShape::solid(positions, tets);
  const auto errors = [&](BuildOptions options, const metric::SimplexSpeeds& by, Index source) {
    options.lengths = std::make_shared<const MeasuredLengths>(shape.measure(by));
    const AnyDomain any(shape, options);
    CHECK(any.shape().kind() == DomainKind::solid);
    CHECK(any.components() == 1);
    const AnyField field = any.solve(Serial{}, PointSource::at(source));
    REQUIRE(field.size() == positions.size());
    std::array<double, 2> e = {0, 0};
    for (Index v = 0; v < positions.size(); ++v) {
      if (v == source) continue;
      const double off = std::abs(field[v] / layers.time(positions[source], positions[v]) - 1);
      e[0] += off / static_cast<double>(positions.size());
      e[1] = std::max(e[1], off);
    }
    return e;
  };
  for (const Index source : {Index(3), Index(100), Index(500)}) {
    const auto twice = errors(BuildOptions{.precision = Precision::float64}, speeds, source);
    CAPTURE(source, twice[0], twice[1]);
    CHECK(twice[0] < 1e-4);
    CHECK(twice[1] < 2e-2);
    const auto single = errors(BuildOptions{.precision = Precision::float32}, speeds, source);
    CAPTURE(single[0], single[1]);
    CHECK(single[0] < 2e-4);
    CHECK(single[1] < 2e-2);
  }
  // One length an edge is of first order, and what a solid of too many speeds has.
  metric::SimplexSpeeds smooth = speeds;
  smooth.agreement.sides = metric::Sides::mean;
  CHECK(errors(BuildOptions{.precision = Precision::float64}, smooth, 100)[0] > 1e-3);
  metric::SimplexSpeeds many = speeds;
  for (std::size_t t = 0; t < 70; ++t) many.speed[t] = 1 + 1e-3 * static_cast<double>(t);
  CHECK_FALSE(shape.measure(many).refracts);
  CHECK(shape.measure(many).smoothed);
  CHECK(shape.measure(many).tets.size() == tets.size());
  many.speed[5] = 0;
  CHECK_THROWS_AS(shape.measure(many), InputError);
  // A single speed is none: exact, as in space.
  metric::SimplexSpeeds one = speeds;
  std::fill(one.speed.begin(), one.speed.end(), 3.);
  BuildOptions options{.precision = Precision::float64};
  options.lengths = std::make_shared<const MeasuredLengths>(shape.measure(one));
  const AnyDomain any(shape, options);
  const AnyField field = any.solve(Serial{}, PointSource::at(100));
  for (Index v = 0; v < positions.size(); ++v)
    CHECK(field[v] == Approx(samples::distance(positions[100], positions[v]) / 3).epsilon(1e-9));
  CHECK(any.solve(OpenMP{2}, PointSource::at(100)).doubles() == field.doubles());
}

}  // namespace plexway::solid_speeds_test
