#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include <plexway/executors/piece_ranks.hpp>

namespace plexway::testing {

/// Threads that meet as processes do: what each knows of the others came as bytes.
class ThreadRanks {
 public:
  explicit ThreadRanks(std::size_t count) : count_(count) {
    for (auto& round : rounds_) round.resize(count);
  }

  /// Calls work(ranks) on each of so many threads; throws the first exception of one, for which the
  /// others do not wait.
  template <class Work>
  void run(const Work& work) {
    std::vector<std::thread> threads;
    for (std::size_t r = 0; r < count_; ++r)
      threads.emplace_back([&, r] {
        One one(*this, r);
        try {
          work(static_cast<PieceRanks&>(one));
        } catch (...) {
          const std::scoped_lock lock(mutex_);
          if (!failure_) failure_ = std::current_exception();
          come_.notify_all();
        }
      });
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  struct Brought {
    std::vector<std::vector<std::byte>> to;
    std::vector<std::uint64_t> sums;
    double least = 0;
  };

  class One final : public PieceRanks {
   public:
    One(ThreadRanks& all, std::size_t rank) : all_(all), rank_(rank) {}
    [[nodiscard]] std::size_t rank() const override { return rank_; }
    [[nodiscard]] std::size_t count() const override { return all_.count_; }
    void meet(std::span<const Bytes> to, std::span<std::vector<std::byte>> from,
              std::span<std::uint64_t> sums, double& least) override {
      all_.meet(rank_, round_++, to, from, sums, least);
    }

   private:
    ThreadRanks& all_;
    std::size_t rank_, round_ = 0;
  };

  void meet(std::size_t rank, std::size_t round, std::span<const PieceRanks::Bytes> to,
            std::span<std::vector<std::byte>> from, std::span<std::uint64_t> sums, double& least) {
    std::unique_lock lock(mutex_);
    // Who is a round ahead writes the other one: nobody is two ahead.
    std::vector<Brought>& brought = rounds_[round % 2];
    Brought& own = brought[rank];
    own.to.clear();
    for (const auto bytes : to) own.to.emplace_back(bytes.begin(), bytes.end());
    own.sums.assign(sums.begin(), sums.end());
    own.least = least;
    ++arrived_;
    come_.notify_all();
    come_.wait(lock, [&] { return arrived_ >= (round + 1) * count_ || failure_; });
    if (arrived_ < (round + 1) * count_) throw std::runtime_error("another rank failed");
    std::fill(sums.begin(), sums.end(), 0);
    least = std::numeric_limits<double>::infinity();
    for (std::size_t r = 0; r < count_; ++r) {
      if (r != rank) from[r] = brought[r].to[rank];
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += brought[r].sums[i];
      least = std::min(least, brought[r].least);
    }
  }

  std::size_t count_;
  std::mutex mutex_;
  std::condition_variable come_;
  std::size_t arrived_ = 0;
  std::vector<Brought> rounds_[2];
  std::exception_ptr failure_;
};

}  // namespace plexway::testing
