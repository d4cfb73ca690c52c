#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// One field, solved by several processes.

namespace plexway {

/// Processes that solve one field together, such as the ranks of MPI (mpi/ranks.hpp).
///
/// Each has the whole domain and calls the same solve with an executor that names them
/// (OpenMP::ranks); each runs its own pieces, hears of those of the others by messages, and gets
/// the whole field. All of them must call everything here, in the same order. One that throws must
/// end the others, which wait for it.
class PieceRanks {
 public:
  /// The messages from one to another.
  using Bytes = std::span<const std::byte>;

  virtual ~PieceRanks() = default;
  /// Which one this is, from 0.
  [[nodiscard]] virtual std::size_t rank() const = 0;
  /// How many there are.
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Sends `to[r]` to each rank r and puts into `from[r]` what that one sent here; nothing goes to
  /// this one itself. Meanwhile each of `sums` becomes the sum, and `least` the least, over all
  /// ranks. Both spans have `count()` entries. Cost: a message to each rank that something goes
  /// to, and a reduction.
  virtual void meet(std::span<const Bytes> to, std::span<std::vector<std::byte>> from,
                    std::span<std::uint64_t> sums, double& least) = 0;
};

}  // namespace plexway
