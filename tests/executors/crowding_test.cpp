#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstddef>
#include <thread>

#include <plexway/solve.hpp>

#include "executors/parity.hpp"
#include "executors/piece_testing.hpp"
#include "executors/threads/crowding.hpp"

namespace plexway::testing::crowding_test {

TEST_CASE("a team that gains nothing leaves the work to one thread, and tries again later") {
  Crowding::report(2, 1);
  CHECK_FALSE(Crowding::crowded());
  Crowding::report(0.6, 1);
  CHECK(Crowding::crowded());
  while (Crowding::crowded()) std::this_thread::yield();
  Crowding::report(1.1, 1);  // neither
  CHECK_FALSE(Crowding::crowded());
  Crowding::report(2, 1);
}

TEST_CASE("clocks of threads go on while they work, and not while they wait") {
  const double now = seconds_on_wall(), begin = seconds_of_thread();
  while (seconds_on_wall() - now < 5e-3) {
  }
  const double worked = seconds_of_thread() - begin;
  CHECK(worked > 0);
  CHECK(worked <= seconds_on_wall() - now);
}

TEST_CASE("the same bits whoever works, and though that changes in between", "[threads]") {
  std::atomic<bool> done{false};
  std::thread other([&] {
    for (unsigned i = 0; !done; ++i) {
      Crowding::report(i % 3 == 0 ? 0.5 : 2, 1);
      std::this_thread::sleep_for(std::chrono::microseconds(50 * (i % 7)));
    }
  });
  const Surface s = sphere(5);
  const auto mesh = s.mesh<float>();
  Workspace<float> workspace;
  DistanceField<float> first, field;
  for (const Accuracy accuracy : {Accuracy::fast(), Accuracy::accurate()}) {
    PropagateOptions options;
    options.accuracy = accuracy;
    for (const Index source : {Index{3}, Index{500}}) {
      solve(pieces(1, 100), mesh, PointSource::at(source), options, workspace, first);
      for (int k = 0; k < 20; ++k) {
        solve(pieces(1 + k % 3, 100), mesh, PointSource::at(source), options, workspace, field);
        CHECK(same_bits(first, field));
      }
    }
  }
  done = true;
  other.join();
  Crowding::report(2, 1);
}

}  // namespace plexway::testing::crowding_test
