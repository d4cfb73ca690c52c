// Every cell of the table of what goes together (support.hpp): every yes runs and is right by a
// closed form, every no says its sentence. What the types alone rule out does not compile; that is
// tests/wrong_programs.

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>
#ifdef PLEXWAY_HAS_GL
#include <plexway/executors/gl.hpp>
#endif

#include "executors/check_scene.hpp"

namespace plexway::testing::matrix_test {

namespace {

#define PLEXWAY_IS_A_DOMAIN(...) static_assert(DomainType<__VA_ARGS__>);
PLEXWAY_DOMAINS(PLEXWAY_IS_A_DOMAIN)
#define PLEXWAY_IS_OF_SIMPLICES(...) static_assert(SimplexDomainType<__VA_ARGS__>);
PLEXWAY_SURFACES(PLEXWAY_IS_OF_SIMPLICES)
PLEXWAY_SOLIDS(PLEXWAY_IS_OF_SIMPLICES)
PLEXWAY_WIREFRAMES(PLEXWAY_IS_OF_SIMPLICES)
PLEXWAY_SIMPLICES(PLEXWAY_IS_OF_SIMPLICES)
static_assert(ExecutorType<Serial> && ExecutorType<OpenMP>);

constexpr std::size_t cells = 22 * 7 * ways_count;  // scenes, sources, ways

template <class E>
Count check_table(const E& executor) {
  Count count;
#define PLEXWAY_CHECK(...) \
  visit_scenes<__VA_ARGS__>([&](const auto& scene) { check_scene(executor, scene, count); });
  PLEXWAY_DOMAINS(PLEXWAY_CHECK)
#undef PLEXWAY_CHECK
  CHECK(count.yes > 0);
  return count;
}

}  // namespace

TEST_CASE("the table, by one thread") {
  const Count count = check_table(Serial{});
  CHECK(count.yes + count.no == cells);
  CHECK(count.yes == 2 * 899 + 72 + 2 * 12);
}

TEST_CASE("the table, by a team", "[threads]") {
  if (!openmp_built()) return;
  const Count count = check_table(OpenMP{.threads = 2});
  CHECK(count.yes + count.no == cells);
  CHECK(count.yes == 2 * 622 + 12 + 8);
}

TEST_CASE("many fields on a mixed domain take one thread a source", "[threads]") {
  if (!openmp_built()) return;
  visit_scenes<MixedComplex<double>>([](const auto& scene) {
    const std::vector<PointSource> sources = {PointSource::at(3), PointSource::at(90)};
    const auto rows = solve_each(OpenMP{.threads = 2}, scene.domain, sources);
    const auto alone = solve_each(Serial{}, scene.domain, sources);
    CHECK(std::equal(rows.values().begin(), rows.values().end(), alone.values().begin()));
  });
}

#ifdef PLEXWAY_HAS_GL
TEST_CASE("the table, on a GL device", "[gl]") {
  try {
    (void)gl_device(GL{});
  } catch (const NotBuiltError& error) {
    WARN("skipped, no GL device: " << error.what());
    return;
  }
  const Count count = check_table(GL{});
  CHECK(count.yes + count.no == cells);
  CHECK(count.yes == 2 * 50);
}
#endif

}  // namespace plexway::testing::matrix_test
