// The tool among ranks of MPI: mpirun -n 4 plexway-mpi distance INPUT ..., or pairs.

#include <exception>
#include <optional>
#include <string>

#include <plexway/mpi/ranks.hpp>

#include "tool/app.hpp"
#include "tool/report/console.hpp"

namespace {

using plexway::mpi::Ranks;

// One line for all ranks, from the one that failed first.
int ended(Ranks& ranks, int code, const char* message) {
  std::optional<Ranks::Verdict> verdict;
  if (ranks.met()) {
    if (code == 0) return code;
    try {
      throw;
    } catch (const plexway::mpi::Absent& absent) {
      const Ranks::Verdict& absence = absent.verdict();
      if (absence.code != 0) return absence.code;
      // It was through with other work, and this one's is not done.
      plexway::detail::cli::say_error("another rank took no part: all ranks need the same command");
      return 2;
    } catch (...) {
      verdict = ranks.fail_together(code);
      if (!verdict) {
        plexway::detail::cli::say_error(message);
        ranks.end_all(code);
      }
    }
  } else {
    verdict = ranks.stay_away(code);
  }
  if (code != 0 && verdict->rank == ranks.rank())
    plexway::detail::cli::say_error(ranks.leads()
                                        ? std::string(message)
                                        : "rank " + std::to_string(ranks.rank()) + ": " + message);
  return verdict->code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Ranks ranks(argc, argv);
    using Among = plexway::detail::cli::Among;
    Among among{ranks,
                ranks,
                ranks.threads(),
                [&] { ranks.all_come(); },
                {},
                [&](int code, const char* message) { return ended(ranks, code, message); }};
    if (ranks.share_nodes())
      among.once_a_node = [&](const Among::WithFile& make, const Among::WithFile& take) {
        ranks.once_a_node(make, take);
      };
    return plexway::detail::cli::run(argc, argv, &among);
  } catch (const std::exception& error) {
    plexway::detail::cli::say_error(error.what());
    return 1;
  }
}
