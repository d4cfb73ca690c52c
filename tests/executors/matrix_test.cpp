// Every executor with every domain and every operation: solved, the same as by Serial up to the
// order of updates, or refused in words that say what to do; what GL does not take does not
// compile.

#include <catch2/catch.hpp>
#include <span>
#include <string>
#include <vector>

#include <plexway/complex/kuhn_grid.hpp>
#include <plexway/error.hpp>
#include <plexway/executors/field.hpp>
#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

#include "complex/test_clouds.hpp"
#include "complex/test_solids.hpp"
#include "complex/test_wires.hpp"
#include "executors/parity.hpp"
#include "propagate/simplex_testing.hpp"

using namespace plexway;
using namespace plexway::testing;

namespace {

using Sources = std::span<const PointSource>;

template <class Executor, class Domain>
concept Propagates = requires(Executor executor, const Domain& domain, Sources sources) {
  propagate(executor, domain, sources);
  propagate(executor, domain, sources[0]);
  field(executor, domain, sources);
};
template <class Executor, class Domain>
concept Batches = requires(Executor executor, const Domain& domain, Sources sources) {
  fields(executor, domain, sources);
};

// All domains, flat or of a dimension where the step is exact, so that order decides nothing.
template <class Real, class Visit>
void visit_domains(const Visit& visit) {
  visit("surface", grid(12, 9).mesh<Real>());
  visit("solid", solid_cube(4).template mesh<Real>());
  visit("wireframe", random_wires(4, 200, 600).wireframe<Real>());
  std::vector<std::array<Index, 2>> edges;  // a ring with chords
  std::vector<std::array<double, 1>> lengths;
  for (Index v = 0; v < 60; ++v)
    for (const Index step : {1u, 7u}) {
      edges.push_back({v, (v + step) % 60});
      lengths.push_back({0.8 * step + 0.01 * v});
    }
  visit("simplices, dimension 1", SimplicialComplex<Real, 1>(60, edges, lengths));
  visit("simplices, dimension 2", cube_grid<2>(9, 2).template complex<Real>());
  visit("simplices, dimension 3", cube_grid<3>(4, 2).template complex<Real>());
  visit("simplices, dimension 4", cube_grid<4>(2, 2).template complex<Real>());
  auto cloud = samples::plane_cloud(400);
  cloud.points.push_back(cloud.points[7]);  // a twin
  const auto near = test_clouds::near_pairs(cloud.points);
  visit("cloud", PointCloud<Real>(cloud.points, near));
  MixedComplex<Real> mixed;
  const auto a = mixed.add(grid(6, 6).mesh<Real>());
  const auto b = mixed.add(grid(4, 4).mesh<Real>());
  const std::array<Index, 2> pairs[] = {{6, 0}, {13, 5}, {20, 10}};
  mixed.weld(a, b, std::span<const std::array<Index, 2>>(pairs));
  visit("mixed", mixed);
}

template <class Domain>
constexpr bool is_mixed = std::is_same_v<Domain, MixedComplex<RealOf<Domain>>>;

template <class Executor, class Domain>
void check_all(const Executor& executor, const Domain& domain, double tolerance) {
  const std::vector<PointSource> list = {PointSource::at(3), PointSource::at(11),
                                         PointSource::at(0)};
  const Sources sources(list);
  const auto close = [&](auto found, auto expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t v = 0; v < found.size(); ++v) {
      const double x = static_cast<double>(found[v]), y = static_cast<double>(expected[v]);
      if (std::isinf(x) || std::isinf(y))
        CHECK(x == y);
      else
        CHECK(std::abs(x - y) <= tolerance * std::max(y, 1e-3));
    }
  };
  const auto span_of = [](const auto& values) { return std::span(values.data(), values.size()); };
  const auto nearest = propagate(Serial{}, domain, sources);
  close(span_of(propagate(executor, domain, sources).distance), span_of(nearest.distance));
  close(span_of(field(executor, domain, sources).distance), span_of(nearest.distance));
  const auto rows = fields(executor, domain, sources);
  REQUIRE(rows.rows() == sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const auto alone = propagate(Serial{}, domain, sources[k]);
    close(span_of(propagate(executor, domain, sources[k]).distance), span_of(alone.distance));
    close(rows.row(k), span_of(alone.distance));
  }
}

}  // namespace

TEMPLATE_TEST_CASE("every domain by one thread and by a team: solved or refused", "[threads]",
                   float, double) {
  const double tolerance = sizeof(TestType) == 4 ? 2e-5 : 1e-12;
  visit_domains<TestType>([&](const char* name, const auto& domain) {
    using Domain = std::decay_t<decltype(domain)>;
    INFO(name);
    static_assert(Propagates<Serial, Domain> && Batches<Serial, Domain>);
    static_assert(Propagates<OpenMP, Domain> && Batches<OpenMP, Domain>);
    check_all(Serial{}, domain, 0);
    if (!openmp_built()) return;
    if constexpr (is_mixed<Domain>) {
      const std::vector<PointSource> sources = {PointSource::at(3), PointSource::at(5)};
      CHECK_THROWS_AS(propagate(team(2), domain, Sources(sources)), UsageError);
      CHECK_THROWS_WITH(field(team(2), domain, Sources(sources)),
                        Catch::Contains("use the executor Serial, or fields"));
      const auto rows = fields(team(2), domain, Sources(sources));
      const auto alone = fields(Serial{}, domain, Sources(sources));
      CHECK(std::equal(rows.values().begin(), rows.values().end(), alone.values().begin()));
    } else {
      // A cloud's sheet is no grid: what a triangle hears of first matters.
      const bool flat = !std::is_same_v<Domain, PointCloud<TestType>>;
      check_all(team(2), domain, flat ? tolerance : 2e-2);
    }
  });
}

#ifdef PLEXWAY_HAS_GL

template <class Domain>
constexpr bool on_device = Propagates<GL, Domain>&& Batches<GL, Domain>;
static_assert(on_device<TriangleMesh<float>> && on_device<TetMesh<float>>);
static_assert(on_device<Wireframe<float>> && on_device<PointCloud<float>>);
template <class Domain>
constexpr bool refused = !Propagates<GL, Domain> && !Batches<GL, Domain>;
static_assert(refused<TriangleMesh<double>> && refused<TetMesh<double>>);
static_assert(refused<Wireframe<double>> && refused<PointCloud<double>>);
static_assert(refused<MixedComplex<float>>);
static_assert(refused<SimplicialComplex<float, 1>> && refused<SimplicialComplex<float, 2>>);
static_assert(refused<SimplicialComplex<float, 3>> && refused<SimplicialComplex<float, 4>>);

TEST_CASE("every domain on a GL device: solved, or it does not compile", "[gl]") {
  try {
    (void)gl_device(GL{});
  } catch (const NotBuiltError& error) {
    WARN("skipped, no GL device: " << error.what());
    return;
  }
  visit_domains<float>([&](const char* name, const auto& domain) {
    using Domain = std::decay_t<decltype(domain)>;
    INFO(name);
    if constexpr (GLDomain<Domain>)
      check_all(GL{}, domain, std::is_same_v<Domain, PointCloud<float>> ? 2e-2 : 2e-5);
  });
}

#endif
