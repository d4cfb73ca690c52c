// Vertices that are one on request: a soup, in which each simplex has vertices of its own, against
// the domain that it is cut from.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/shape/pairs.hpp>
#include <plexway/simplicial/kuhn_grid.hpp>

#include "complexes/test_meshes.hpp"
#include "folder.hpp"

namespace plexway::testing::merge_test {

namespace {

using Catch::Matchers::Contains;

struct Soup {
  AnyShape whole, apart;
  std::vector<Index> of;  // which vertex of the whole each is
};

// Each corner on its own, in random order, moved by at most `noise`.
template <std::size_t N>
auto cut(const std::vector<Position>& at, const std::vector<std::array<Index, N>>& simplices,
         double noise, std::vector<Position>& places, std::vector<Index>& of) {
  std::mt19937 random(5);
  std::vector<Index> order(simplices.size() * N);
  for (Index i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  places.resize(order.size());
  of.resize(order.size());
  std::vector<std::array<Index, N>> apart(simplices.size());
  for (std::size_t c = 0; c < order.size(); ++c) {
    const Index v = simplices[c / N][c % N];
    apart[c / N][c % N] = order[c];
    of[order[c]] = v;
    places[order[c]] = at[v];
    for (double& x : places[order[c]]) x += noise * (uniform(random) - 0.5);
  }
  return apart;
}

Soup surface_soup(double noise) {
  std::mt19937 random(3);
  Surface s = grid(9, 7);
  for (Position& p : s.positions) p[2] = 0.2 * uniform(random);
  std::vector<Position> places;
  std::vector<Index> of;
  auto apart = cut(s.positions, s.faces, noise, places, of);
  return {AnyShape::surface(s.positions, s.faces), AnyShape::surface(places, apart), of};
}

Soup solid_soup() {
  const KuhnGrid<3> kuhn({4, 3, 2}, {0.25, 0.3, 0.5}, {0, 0, 0});
  std::vector<Position> at, places;
  for (Index v = 0; v < kuhn.vertex_count(); ++v) at.push_back(kuhn.position(v));
  std::vector<Index> of;
  const auto tets = kuhn.simplices([](const auto& c) { return c[0] == 1 && c[1] < 2; });
  auto apart = cut(at, tets, 0, places, of);
  return {AnyShape::solid(at, tets), AnyShape::solid(places, apart), of};
}

Soup wire_soup() {
  std::vector<Position> at;
  std::vector<std::array<Index, 2>> edges;
  for (Index i = 0; i < 40; ++i) {
    at.push_back({std::cos(0.4 * i), std::sin(0.4 * i), 0.1 * i});
    if (i > 0) edges.push_back({i - 1, i});
    if (i > 8) edges.push_back({i - 8, i});
  }
  std::vector<Position> places;
  std::vector<Index> of;
  auto apart = cut(at, edges, 0, places, of);
  return {AnyShape::wireframe(at, edges), AnyShape::wireframe(places, apart), of};
}

AnyDomain built(const AnyShape& shape, std::shared_ptr<const Mask> mask = nullptr) {
  return AnyDomain(shape, {.precision = Precision::float64, .mask = std::move(mask)});
}

PropagateOptions best(const AnyShape& shape) {
  PropagateOptions options;
  if (shape.kind() == DomainKind::surface) options.accuracy = Accuracy::exact();
  return options;
}

void check_same(const Soup& soup, const AnyField& whole, const AnyField& merged, double epsilon) {
  REQUIRE(merged.size() == soup.apart.vertices());
  for (std::size_t v = 0; v < merged.size(); ++v) {
    CAPTURE(v);
    CHECK(merged[v] == Approx(whole[soup.of[v]]).epsilon(epsilon).margin(epsilon));
  }
}

}  // namespace

TEST_CASE("merged vertices: a soup has the distances of the whole") {
  const std::pair<Soup, double> soups[] = {
      {surface_soup(0), 0}, {surface_soup(1e-9), 1e-8}, {solid_soup(), 0}, {wire_soup(), 0}};
  for (const auto& [one, tolerance] : soups) {
    const Soup& soup = one;
    const AnyShape joined = soup.apart.merged(tolerance);
    const double epsilon = tolerance > 0 ? 1e-7 : 1e-11;
    const auto first = joined.merged_vertices();
    REQUIRE(first.size() == soup.apart.vertices());
    REQUIRE(joined.merged_count() == soup.apart.vertices() - soup.whole.vertices());
    const AnyDomain merged = built(joined), whole = built(soup.whole);
    CHECK(merged.components() == whole.components());
    const PropagateOptions options = best(joined);
    // One source, at what is the first of its place and at what is not; and several.
    const Index far = static_cast<Index>(joined.vertices()) - 1;
    for (const std::vector<Index>& at :
         {std::vector<Index>{0}, std::vector<Index>{far}, std::vector<Index>{1, far, 1}}) {
      std::vector<PointSource> sources, of_whole;
      for (const Index v : at) {
        sources.push_back(PointSource::at(v));
        of_whole.push_back(PointSource::at(soup.of[v]));
      }
      const AnyField field = merged.solve(Serial{}, sources, options);
      check_same(soup, whole.solve(Serial{}, of_whole, options), field, epsilon);
      CHECK(field.label().size() == (at.size() > 1 ? joined.vertices() : 0));
      const auto label = field.label();
      for (std::size_t v = 0; v < label.size(); ++v) CHECK(label[v] == label[first[v]]);
    }
    VertexSource set{.vertices = {far, 2}};
    check_same(soup,
               whole.solve(Serial{}, Source(VertexSource{.vertices = {soup.of[far], soup.of[2]}}),
                           options),
               merged.solve(Serial{}, Source(set), options), epsilon);
    // Rows, whole and sparse.
    const AnyField from = whole.solve(Serial{}, PointSource::at(soup.of[far]), options);
    const std::vector<PointSource> rows = {PointSource::at(far)};
    std::vector<double> row(joined.vertices());
    merged.solve_each(Serial{}, rows, options, std::span<double>(row));
    PairsRequest request{.rows = SourceList(rows), .solve = options};
    std::vector<double> dense;
    all_pairs(Serial{}, merged, request,
              {[&](std::size_t, DenseRow<double> r) { dense.assign(r.begin(), r.end()); }});
    CHECK(dense == row);
    for (std::size_t v = 0; v < row.size(); ++v)
      CHECK(row[v] == Approx(from[soup.of[v]]).epsilon(epsilon).margin(epsilon));
    std::size_t near = 0;
    near_pairs(Serial{}, merged, request, {.radius = 0.4}, {[&](std::size_t, SparseRow<double> r) {
                 near = r.size();
                 for (const auto& [column, distance] : r)
                   CHECK(distance == Approx(from[soup.of[column]]).epsilon(1e-6).margin(1e-6));
               }});
    CHECK(near == static_cast<std::size_t>(
                      std::count_if(row.begin(), row.end(), [](double d) { return d <= 0.4; })));
    // Paths start and end at any of them.
    const AnyPathField paths = merged.path_field(Serial{}, rows, options);
    for (Index v = 0; v < joined.vertices(); v += 7) {
      CHECK(paths.trace(PointSource::at(v)).length ==
            Approx(from[soup.of[v]]).epsilon(1e-9).margin(1e-9 + tolerance));
      CHECK(paths.at(PointSource::at(v)) == Approx(row[v]).margin(1e-12));
    }
  }
}

TEST_CASE("merged vertices: prepared, masked, written, and what loses a corner") {
  const ::testing::Folder folder;
  const Soup soup = surface_soup(0);
  const AnyShape joined = soup.apart.merged(0);
  const AnyDomain merged = built(joined);
  const PointSource source = PointSource::at(static_cast<Index>(joined.vertices()) - 1);
  const std::vector<double> truth = merged.solve(Serial{}, source).doubles();

  const auto kept = folder.at("soup.plexway");
  merged.keep(kept);
  const AnyShape again = AnyShape::read(kept);
  CHECK(again.merged_count() == joined.merged_count());
  CHECK(built(again).solve(Serial{}, source).doubles() == truth);

  const auto written = folder.at("field.ply");
  joined.write_field(written, truth);
  CHECK(AnyShape::read(written).vertices() == joined.vertices());

  // Whoever closes one of those at a place closes it.
  const auto first = joined.merged_vertices();
  Index twin = 0;
  while (first[twin] == twin) ++twin;
  auto closed = std::make_shared<Mask>(joined.vertices(), joined.simplices());
  closed->close_vertex(twin);
  const AnyField around = built(joined, closed).solve(Serial{}, source);
  for (Index v = 0; v < joined.vertices(); ++v)
    CHECK(std::isfinite(around[v]) == (first[v] != first[twin]));

  // An edge shorter than the tolerance takes its triangles along.
  std::vector<Position> at = {{0, 0, 0}, {1, 0, 0}, {1, 1e-6, 0}, {0, 1, 0}};
  const AnyShape needle = AnyShape::surface(at, {{0, 1, 2}, {0, 2, 3}}).merged(1e-5);
  CHECK(std::vector<Index>(needle.collapsed().begin(), needle.collapsed().end()) ==
        std::vector<Index>{0});
  CHECK(built(needle).solve(Serial{}, PointSource::at(2))[1] == 0);
  CHECK(built(needle).solve(Serial{}, PointSource::at(3))[1] == Approx(std::sqrt(2.)));

  // Files, and what is refused.
  folder.write("soup.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n");
  const auto file = folder.at("soup.obj");
  CHECK(AnyDomain::read(file).components() == 2);
  const AnyDomain read = AnyDomain::read(file, {.merge = 0});
  CHECK(read.components() == 1);
  CHECK(read.solve(Serial{}, PointSource::at(0))[4] == Approx(std::sqrt(2.)));
  CHECK(AnyShape::read(file, {.as = DomainKind::wireframe, .merge = 0}).merged_count() == 2);
  CHECK_THROWS_WITH(AnyShape::read(file, {.merge = -1}), Contains("merge must be a number >= 0"));
  CHECK_THROWS_WITH(AnyShape::read(file, {.as = DomainKind::cloud, .merge = 0}),
                    Contains("vertices are merged of"));
  CHECK_THROWS_WITH(AnyShape::surface(3, {{0, 1, 2}}, {{1, 1, 1}}).merged(0),
                    Contains("vertices are merged of"));
}

}  // namespace plexway::testing::merge_test
