// Notches of complexes by lengths alone, which the plain step sees through: told with how many
// there are, in every dimension, and nowhere else.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/warnings.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>

#include "complexes/simplicial/simplex_notches.hpp"

namespace plexway::testing::notches_test {

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

}  // namespace plexway::testing::notches_test
