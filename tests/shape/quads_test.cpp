#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/remarks.hpp>

// Quads of a surface that were handed over as tetrahedra.
namespace plexway::testing::quads_test {
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
    for (const Remark& remark : domain_remarks(domain))
      if (remark.doubtful && remark.text.find("quads") != std::string::npos) return true;
    return false;
  };
  CHECK(doubted(AnyDomain(AnyShape::solid(at, quads))));
  const AnyShape::Points two = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  CHECK_FALSE(doubted(AnyDomain(AnyShape::solid(two, {{0, 1, 2, 3}, {0, 2, 1, 4}}))));
}

}  // namespace
}  // namespace plexway::testing::quads_test
