#pragma once

// What recorded supersteps come to on more threads, and among ranks.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "complexes/partition/deal.hpp"
#include "executors/threads/piece_post.hpp"
#include "labels/piece_memory.hpp"

namespace bench {

using Log = std::vector<std::vector<plexway::SuperstepCounts::Run>>;

/// In expansions.
struct ThreadCosts {
  double run = 12;      ///< beside what a run of a piece expands
  double barrier = 60;  ///< of threads
};

/// Of MPI, in seconds; bandwidth in bytes a second of one rank.
struct RankCosts {
  double latency = 2e-6;    ///< a step of a reduction, of which there are log2 of the ranks
  double message = 0.5e-6;  ///< one that a rank sends or gets
  double bandwidth = 5e9;
};

/// Runs dealt to so many threads, longest first: until the last is through.
inline double dealt(std::vector<double>& runs, std::size_t threads) {
  std::sort(runs.begin(), runs.end(), std::greater<>());
  std::vector<double> busy(std::max<std::size_t>(threads, 1), 0);
  for (const double run : runs) *std::min_element(busy.begin(), busy.end()) += run;
  return *std::max_element(busy.begin(), busy.end());
}

/// In expansions, on so many threads.
inline double modelled(const Log& log, std::size_t threads, const ThreadCosts& costs) {
  double time = 0;
  std::vector<double> work;
  for (const auto& runs : log) {
    work.clear();
    for (const auto& run : runs) work.push_back(static_cast<double>(run.expansions) + costs.run);
    time += dealt(work, threads);
    if (threads > 1 && runs.size() > 1) time += costs.barrier;
  }
  return time;
}

/// What supersteps come to where pieces are dealt to ranks.
struct AmongRanks {
  std::size_t letters = 0;   ///< from one rank to another
  std::size_t bytes = 0;     ///< of messages
  std::size_t messages = 0;  ///< that are not empty
  std::size_t most = 0;      ///< bytes that one rank sends in one superstep
  double seconds = 0;        ///< modelled
};

/// Bytes are those that PiecePost sends. `expansion` is in seconds.
inline AmongRanks among_ranks(const Log& log, std::size_t letter_bytes, std::size_t ranks,
                              std::size_t threads, double expansion, const ThreadCosts& costs,
                              const RankCosts& mpi) {
  AmongRanks all;
  const plexway::Deal deal{0, ranks};
  std::vector<std::vector<double>> work(ranks);
  std::vector<std::size_t> sends(ranks), gets(ranks), calls(ranks);
  std::vector<std::size_t> letters(ranks), peers(ranks), message(ranks * ranks);
  for (const auto& runs : log) {
    for (auto& own : work) own.clear();
    std::fill(message.begin(), message.end(), 0);
    for (const auto& run : runs) {
      const std::size_t from = deal.owner(run.piece);
      work[from].push_back((static_cast<double>(run.expansions) + costs.run) * expansion);
      std::fill(letters.begin(), letters.end(), 0);
      std::fill(peers.begin(), peers.end(), 0);
      for (const auto& [piece, count] : run.letters) {
        letters[deal.owner(piece)] += count;
        ++peers[deal.owner(piece)];
      }
      for (std::size_t to = 0; to < ranks; ++to) {
        if (to == from || peers[to] == 0) continue;
        all.letters += letters[to];
        message[from * ranks + to] += sizeof(plexway::MailHead) +
                                      peers[to] * sizeof(plexway::MailEntry) +
                                      letters[to] * letter_bytes;
      }
    }
    double slowest = 0;
    for (auto& own : work) {
      double time = dealt(own, threads);
      if (threads > 1 && own.size() > 1) time += costs.barrier * expansion;
      slowest = std::max(slowest, time);
    }
    std::fill(sends.begin(), sends.end(), 0);
    std::fill(gets.begin(), gets.end(), 0);
    std::fill(calls.begin(), calls.end(), 0);
    for (std::size_t from = 0; from < ranks; ++from)
      for (std::size_t to = 0; to < ranks; ++to) {
        const std::size_t bytes = message[from * ranks + to];
        sends[from] += bytes;
        gets[to] += bytes;
        all.messages += bytes > 0;
        calls[from] += bytes > 0;
        calls[to] += bytes > 0;
        all.bytes += bytes;
      }
    const std::size_t most = *std::max_element(sends.begin(), sends.end());
    all.most = std::max(all.most, most);
    all.seconds += slowest;
    if (ranks > 1)
      all.seconds +=
          mpi.latency * static_cast<double>(1 + std::bit_width(ranks - 1)) +
          mpi.message * static_cast<double>(*std::max_element(calls.begin(), calls.end())) +
          static_cast<double>(std::max(most, *std::max_element(gets.begin(), gets.end()))) /
              mpi.bandwidth;
  }
  return all;
}

}  // namespace bench
