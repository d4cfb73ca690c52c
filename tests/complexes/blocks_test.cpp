#include <plexway/common/blocks.hpp>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <plexway/error.hpp>

namespace blocks_test {

TEST_CASE("blocks cover every number once on any number of threads") {
  for (const int threads : {0, 1, 2, 5})
    for (const std::size_t count : {0u, 1u, 9u, 10u, 11u, 1000u}) {
      std::vector<std::atomic<int>> seen(count);
      double last = 0;
      plexway::for_blocks(
          count, 10, threads,
          [&](double share) {
            CHECK(share >= last);
            last = share;
            return true;
          },
          [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) ++seen[i];
          });
      for (const auto& s : seen) CHECK(s == 1);
      CHECK(last <= 1);
    }
}

TEST_CASE("blocks hand on what work throws, and stop when progress says so") {
  for (const int threads : {1, 4}) {
    CHECK_THROWS_AS(plexway::for_blocks(1000, 10, threads, {},
                                        [](std::size_t first, std::size_t) {
                                          if (first == 500) throw std::out_of_range("500");
                                        }),
                    std::out_of_range);
    CHECK_THROWS_AS(
        plexway::for_blocks(
            1000000, 10, threads, [](double) { return false; }, [](std::size_t, std::size_t) {}),
        plexway::Cancelled);
  }
}

TEST_CASE("of several blocks that fail the first one counts") {
  for (const int threads : {1, 3, 8})
    for (int turn = 0; turn < 50; ++turn)
      CHECK_THROWS_WITH(
          plexway::for_blocks(1000, 1, threads, {},
                              [](std::size_t first, std::size_t) {
                                if (first < 40) return;
                                if (first == 40)
                                  std::this_thread::sleep_for(std::chrono::microseconds(200));
                                throw std::out_of_range(std::to_string(first));
                              }),
          "40");
}

}  // namespace blocks_test
