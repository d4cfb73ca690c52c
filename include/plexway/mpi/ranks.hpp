#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/pairs/row_ranks.hpp>

// Ranks of MPI that share the rows of a matrix, or the pieces of one field.
//
//   int main(int argc, char** argv) {
//     plexway::mpi::Ranks ranks(argc, argv);
//     ... every rank makes the same mesh and request ...
//     plexway::share_rows<plexway::DenseRow<float>>(
//         ranks, request, mesh.vertex_count(), sink, [&](const auto& mine, const auto& rows) {
//           return plexway::all_pairs(plexway::Serial{}, mesh, mine, rows);
//         });
//     ... or solve one field of it, which each gets ...
//     auto field = plexway::solve(plexway::OpenMP{.threads = ranks.threads(), .ranks = &ranks},
//                                 mesh, sources);
//   }

/// Ranks of MPI that share the rows of a matrix, or the pieces of one field.
namespace plexway::mpi {

/// All ranks of a run (MPI_COMM_WORLD), one of which is this process. Rank 0 leads, and solves like
/// the others.
///
/// Each rank has a domain of its own: what has many cores is best given one rank a node, whose
/// threads share one. Only one thread at a time calls MPI (MPI_THREAD_SERIALIZED). A rank that dies
/// takes the others along, as MPI has it.
class Ranks final : public RowRanks, public PieceRanks {
 public:
  /// MPI_Init_thread. One in a process. Throws Error where threads are not allowed.
  Ranks(int& argc, char**& argv);
  /// MPI_Finalize, or MPI_Abort where the others wait for what will not come.
  ~Ranks() override;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  /// Rank 0.
  [[nodiscard]] bool leads() const override { return rank() == 0; }
  /// As many as mpirun began.
  [[nodiscard]] std::size_t count() const override;
  /// Which one this is.
  [[nodiscard]] std::size_t rank() const override;
  /// Has any node more than one rank?
  [[nodiscard]] bool share_nodes() const;
  /// For what a node needs once, such as a domain that maps into memory (AnyDomain::keep): one rank
  /// of each node makes a file in its folder of temporary files, or leaves it be; then all of them
  /// take it, or what is not there; then it is removed, also where a signal ends the rank that made
  /// it. All ranks call it. Throws what `make` and `take` do, and Absent on the others then.
  void once_a_node(const std::function<void(const std::filesystem::path&)>& make,
                   const std::function<void(const std::filesystem::path&)>& take);
  /// Threads for each rank of this node, so that its cores are busy: those that the rank is bound
  /// to, else its share.
  [[nodiscard]] int threads() const;

  /// As RowRanks has it. Cost: a message a row, from the others to the leader. Throws Absent if a
  /// rank does not come; UsageError for rows of 2 GB.
  PairsReport share(const PairsRequest& request, std::size_t vertices,
                    const PairsSink<RowRanks::Bytes>& sink, const Solve& solve) override;

  /// As PieceRanks has it: MPI_Iallreduce, while messages go to and fro. Who waits sleeps soon, and
  /// so leaves its core to others.
  void meet(std::span<const PieceRanks::Bytes> to, std::span<std::vector<std::byte>> from,
            std::span<std::uint64_t> sums, double& least) override;
  /// Waits for all ranks, before what only makes sense if all get so far, as PieceRanks::meet does.
  /// Throws Absent if one of them does not come.
  void all_come();

  /// Why ranks do not come to `share`.
  struct Verdict {
    std::size_t rank;  ///< the first that failed, which is the one to say why
    int code;          ///< its exit code; 0 where none failed
  };
  /// This rank will not come to `share`, since it is through, with exit code 0, or failed, with
  /// another. Ranks that wait there go on by Absent. Once, and not after `share`.
  Verdict stay_away(int code);
  /// This rank failed in a field that all solve, as likely all do: what they say, or nothing where
  /// they do not fail within half a second. Only `end_all` makes sense then.
  std::optional<Verdict> fail_together(int code);
  /// Has this rank been in `share`, `meet` or `stay_away`, and not in `all_come` since?
  [[nodiscard]] bool met() const;
  /// Ends all ranks at once.
  [[noreturn]] void end_all(int code);

 private:
  struct State;
  Verdict compare(int code);

  std::unique_ptr<State> state_;
};

/// This rank came to `share`, and others did not.
class Absent : public Error {
 public:
  /// What they said.
  explicit Absent(Ranks::Verdict verdict)
      : Error("rank " + std::to_string(verdict.rank) + " does not come to share the work"),
        verdict_(verdict) {}
  /// What they said.
  [[nodiscard]] Ranks::Verdict verdict() const { return verdict_; }

 private:
  Ranks::Verdict verdict_;
};

}  // namespace plexway::mpi
