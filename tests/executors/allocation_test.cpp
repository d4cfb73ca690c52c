#include <catch2/catch.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

#include <plexway/solve.hpp>

#include "complexes/sampled_clouds.hpp"
#include "complexes/test_wires.hpp"
#include "labels/simplex_testing.hpp"
#include "labels/solid_solving.hpp"
#include "labels/solving.hpp"

namespace {
std::atomic<std::size_t> allocations{0};

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
}  // namespace

// The library's own, in this program, so that allocations can be counted.
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t align) {
  ++allocations;
  const std::size_t unit = static_cast<std::size_t>(align);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size, std::align_val_t align) { return operator new(size, align); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace plexway::testing::allocation_test {

TEMPLATE_TEST_CASE("a second solve allocates nothing", "", float, double) {
  const PointSource first[] = {PointSource::at(3)};
  const PointSource second[] = {PointSource::in(40, {.2, .3, .5})};
  const PointSource several[] = {PointSource::at(3), PointSource::at(60), PointSource::at(9)};
  for (const Surface& s : {grid(60, 60), bow_tie(20), sheets(3, 12), moebius(50, 9)}) {
    const auto mesh = s.mesh<TestType>();
    const auto check = [&](Visibility visibility, Accuracy accuracy) {
      for (const Schedule schedule : schedules) {
        PropagateOptions options;
        options.accuracy = accuracy;
        options.visibility = visibility;
        options.schedule = schedule;
        Workspace<TestType> workspace;
        DistanceField<TestType> field;
        plexway::solve(Serial{}, mesh, first, options, workspace, field);
        std::size_t before = allocations;
        plexway::solve(Serial{}, mesh, first, options, workspace, field);
        std::size_t spent = allocations - before;
        CAPTURE(name(options), accuracy.error());
        CHECK(spent == 0);
        plexway::solve(Serial{}, mesh, several, options, workspace, field);
        if (schedule == Schedule::priority) continue;  // its heap may grow with the source
        before = allocations;
        plexway::solve(Serial{}, mesh, several, options, workspace, field);
        if (accuracy == Accuracy::fast())  // of others the windows that wait may be more
          plexway::solve(Serial{}, mesh, second, options, workspace, field);
        plexway::solve(Serial{}, mesh, several, options, workspace, field);
        spent = allocations - before;
        // The list of labels comes back after a single source had none.
        CHECK(spent == 0);
      }
    };
    for (const Visibility visibility : visibilities) check(visibility, Accuracy::fast());
    check(Visibility::saddles, Accuracy::accurate());
    if (std::is_same_v<TestType, double>) check(Visibility::saddles, Accuracy::exact());
  }
}

TEMPLATE_TEST_CASE("a second solve of a wireframe allocates nothing", "", float, double) {
  const PointSource first[] = {PointSource::at(3)};
  const PointSource second[] = {PointSource::in(40, {.2, .8})};
  const PointSource several[] = {PointSource::at(3), PointSource::at(60), PointSource::at(9)};
  const auto w = random_wires(1, 3000, 5000).wireframe<TestType>();
  for (const Schedule schedule : schedules) {
    PropagateOptions options;
    options.schedule = schedule;
    Workspace<TestType> workspace;
    DistanceField<TestType> field;
    plexway::solve(Serial{}, w, several, options, workspace, field);
    std::size_t before = allocations;
    plexway::solve(Serial{}, w, several, options, workspace, field);
    std::size_t spent = allocations - before;
    CAPTURE(name(options));
    CHECK(spent == 0);
    if (schedule == Schedule::priority) continue;  // its heap may grow with the source
    before = allocations;
    plexway::solve(Serial{}, w, first, options, workspace, field);
    plexway::solve(Serial{}, w, second, options, workspace, field);
    plexway::solve(Serial{}, w, several, options, workspace, field);
    spent = allocations - before;
    CHECK(spent == 0);
  }
}

TEMPLATE_TEST_CASE("a second solve of a simplicial domain allocates nothing", "", float, double) {
  const auto grid = cube_grid<4>(4);
  const auto domain = grid.complex<TestType>([](const auto& c) { return c[0] == 2 && c[1] > 0; });
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  const PointSource one[] = {PointSource::at(0)};
  const PointSource several[] = {PointSource::at(3), PointSource::at(60), PointSource::at(624)};
  for (int round = 0; round < 2; ++round) {
    const std::size_t before = allocations;
    plexway::solve(Serial{}, domain, several, {}, workspace, field);
    plexway::solve(Serial{}, domain, one, {}, workspace, field);
    plexway::solve(Serial{}, domain, several, {}, workspace, field);
    const std::size_t spent = allocations - before;
    if (round == 1) CHECK(spent == 0);
  }
}

TEMPLATE_TEST_CASE("solids: a second solve allocates nothing", "", float, double) {
  const PointSource first[] = {PointSource::at(3)};
  const PointSource second[] = {PointSource::in(40, {.2, .3, .4, .1})};
  for (const Solid& s : {walled(8), edge_touch(6), vertex_touch(6)}) {
    const auto mesh = s.mesh<TestType>();
    for (const Visibility visibility : solid_visibilities) {
      PropagateOptions options;
      options.visibility = visibility;
      Workspace<TestType> workspace;
      DistanceField<TestType> field;
      for (int round = 0; round < 2; ++round) {
        const std::size_t before = allocations;
        plexway::solve(Serial{}, mesh, second, options, workspace, field);
        plexway::solve(Serial{}, mesh, first, options, workspace, field);
        const std::size_t spent = allocations - before;
        if (round == 1) CHECK(spent == 0);
      }
    }
  }
}

}  // namespace plexway::testing::allocation_test
