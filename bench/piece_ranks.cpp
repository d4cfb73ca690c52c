// One source by pieces that ranks share: counts of supersteps, expansions, letters and bytes, and
// what they come to on more cores. The solve is recorded in one process, which has all pieces, and
// the pieces are then dealt to ranks on paper (Deal): counts and bits are the same whatever the
// ranks. Bytes are those that PiecePost would send; with --check some ranks (threads that meet
// as processes do) really send them, and the table says how many more or fewer bytes that were.
//
// The model: an expansion takes what the recorded solve took for one; a superstep what the slowest
// rank does, log2(n) latencies and one until what was sent is known to have arrived, the most
// messages and the most bytes of a rank.
// `with_whole` adds what each rank does for the whole domain today (seeds, repairs, the last
// field).

#include <algorithm>
#include <atomic>

#include "complexes/test_solids.hpp"
#include "executors/thread_ranks.hpp"
#include "executors/threads/piece_size.hpp"
#include "labels/pieces/triangle_patches.hpp"
#include "labels/workspace_state.hpp"
#include "piece_model.hpp"
#include "solver.hpp"

namespace bench::piece_ranks {

using namespace plexway;

struct Settings {
  std::vector<std::size_t> sizes = {0, 4096}, ranks = {4, 16, 64}, threads = {1};
  std::size_t check = 0;
  std::string accuracy = "fast";
  ThreadCosts threads_cost;
  RankCosts mpi;
};

/// Bytes that so many ranks really send in letters, and in all.
template <class Domain>
std::size_t really_sent(const Domain& domain, std::size_t size, const PropagateOptions& options,
                        std::size_t ranks) {
  std::atomic<std::size_t> sent{0};
  plexway::testing::ThreadRanks(ranks).run([&](PieceRanks& own) {
    OpenMP team{1, 128, size};
    team.ranks = &own;
    sent += solve(team, domain, PointSource::at(0), options).statistics.sent_bytes;
  });
  return sent;
}

/// What the pieces' vertices cost when each rank tells all others at the end, as labels do.
template <class Real>
std::size_t field_bytes(const TriangleMesh<Real>& mesh, std::size_t size,
                        Workspace<Real>& workspace, std::size_t ranks) {
  auto& patches = workspace.state().pieces.of(mesh, size);
  std::size_t sum = 0;
  for (std::size_t p = 0; p < patches.count(); ++p)
    sum += 2 * sizeof(std::uint64_t) + patches[p].vertices.size() * sizeof(Real);
  return sum * (ranks - 1);
}

template <class Domain>
void measure(const std::string& name, const Domain& domain, double domain_bytes,
             const Settings& settings, Table& table) {
  using Real = typename Domain::Number;
  constexpr bool surface = Domain::kind == DomainKind::surface;
  const double simplices = static_cast<double>(domain.simplex_count());
  PropagateOptions options;
  if (surface && settings.accuracy == "fast") options.accuracy = Accuracy::fast();
  const PointSource source = PointSource::at(0);
  double serial = 0, serial_work = 0;
  {
    Workspace<Real> workspace;
    DistanceField<Real> field;
    solve(Serial{}, domain, source, options, workspace, field);
    serial = processor_seconds([&] { solve(Serial{}, domain, source, options, workspace, field); });
    serial_work = static_cast<double>(field.statistics.expansions);
  }
  return_free_memory();
  for (const std::size_t asked : settings.sizes) {
    Workspace<Real> workspace;
    DistanceField<Real> field;
    SuperstepCounts& counts = workspace.state().pieces.counts();
    const OpenMP team{1, 128, asked};
    solve(team, domain, source, options, workspace, field);  // cuts
    counts.keeps_log = true;
    const double seconds =
        processor_seconds([&] { solve(team, domain, source, options, workspace, field); });
    const double expansions = static_cast<double>(field.statistics.expansions);
    const double whole = std::max(seconds - counts.seconds, 0.);
    const double runs = static_cast<double>(counts.runs) * settings.threads_cost.run;
    const double expansion = counts.seconds / (expansions + runs);
    const std::size_t letter = counts.letters > 0 ? counts.bytes / counts.letters : 0;
    const double kept = static_cast<double>(workspace.bytes());
    const double pieces = static_cast<double>(workspace.state().pieces.bytes());
    Index most_piece = 0;
    for (const auto& step : counts.log)
      for (const auto& run : step) most_piece = std::max(most_piece, run.piece);
    for (const std::size_t threads : settings.threads)
      for (const std::size_t ranks : settings.ranks) {
        const AmongRanks all = among_ranks(counts.log, letter, ranks, threads, expansion,
                                           settings.threads_cost, settings.mpi);
        const double n = static_cast<double>(ranks);
        Row row = {{"domain", name},
                   {"simplices", domain.simplex_count()},
                   {"size", asked},
                   {"pieces", most_piece + 1},
                   {"ranks", ranks},
                   {"threads", threads},
                   {"supersteps", counts.supersteps},
                   {"expansions", expansions / simplices},
                   {"times_serial", expansions / serial_work},
                   {"letters", counts.letters},
                   {"letter_bytes", counts.bytes},
                   {"sent_letters", all.letters},
                   {"sent", all.bytes},
                   {"messages", all.messages},
                   {"most", all.most},
                   {"ns", 1e9 * expansion},
                   {"serial_s", serial},
                   {"whole_s", whole},
                   {"speed", serial / all.seconds},
                   {"with_whole", serial / (all.seconds + whole)},
                   {"memory", domain_bytes + kept - pieces + pieces / n}};
        if constexpr (surface)
          if (settings.accuracy == "fast")
            row["sent_field"] = field_bytes(
                domain, piece_size(team, domain.simplex_count(), {4096, 64}), workspace, ranks);
        if (settings.check == ranks) {
          const double sent = static_cast<double>(really_sent(domain, asked, options, ranks));
          row["really"] = sent;
        }
        table.add(std::move(row));
      }
  }
}

void run(Arguments& arguments) {
  Settings settings;
  Meshes meshes;
  std::vector<std::size_t> solids;
  arguments.option("MESH", &meshes.files, "Surfaces");
  arguments.option("--generated", &meshes.sizes, "Bumpy spheres of about so many vertices");
  arguments.option("--solids", &solids,
                   "Cubes with a wall, so many cells along an edge (a multiple of 8), of which 6 "
                   "tetrahedra are made");
  arguments.option("--sizes", &settings.sizes, "Simplices a piece; 0: what OpenMP takes by itself");
  arguments.option("--ranks", &settings.ranks, "Ranks");
  arguments.option("--threads", &settings.threads, "Threads of each");
  arguments.option("--check", &settings.check,
                   "So many of the ranks really send (each has the whole)");
  arguments.option("--accuracy", &settings.accuracy, "What is asked for", {"fast", "accurate"});
  arguments.option("--latency", &settings.mpi.latency, "Seconds of a step of a reduction");
  arguments.option("--message", &settings.mpi.message, "Seconds of a message");
  arguments.option("--bandwidth", &settings.mpi.bandwidth, "Bytes a second of a rank");
  Table& table = arguments.table(
      "domain; simplices; size: a piece; pieces; ranks; threads: threads each; supersteps;"
      "expansions: expansions a simplex %.3f; times_serial: times Serial's %.3f; letters;"
      "letter_bytes: their bytes; sent_letters: letters to other ranks;"
      "sent: bytes sent in supersteps; messages: messages that are not empty;"
      "most: most bytes of a rank in a superstep; sent_field: bytes of the last field;"
      "really: really sent, in all; ns: ns an expansion %.0f; serial_s: Serial, s %.2f;"
      "whole_s: for the whole, s %.2f; speed: model %.1f; with_whole: and with the whole %.1f;"
      "memory: bytes a rank %.3g");
  const auto on = [&](const std::string& name, const auto& make) {
    const auto mesh = make();
    return_free_memory();
    measure(name, mesh, static_cast<double>(mesh.bytes()), settings, table);
  };
  meshes.each([&](const Surface& surface, const auto&) {
    on(surface.name, [&] { return TriangleMesh<float>(surface.positions, surface.faces); });
  });
  for (const std::size_t n : solids)
    on("walled_" + std::to_string(n), [&] {
      const auto made = plexway::testing::walled(static_cast<Index>(n));
      return TetMesh<float>(made.positions, made.tets);
    });
}
const Command command("piece_ranks", "pieces among ranks, on paper: bytes, memory, a model", run);

}  // namespace bench::piece_ranks
