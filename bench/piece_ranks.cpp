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

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include <plexway/solve.hpp>

#include "compare.hpp"
#include "complex/test_solids.hpp"
#include "executors/piece_size.hpp"
#include "executors/thread_ranks.hpp"
#include "piece_model.hpp"
#include "propagate/pieces/triangle_patches.hpp"
#include "propagate/workspace_state.hpp"

namespace {

using namespace plexway;

struct Settings {
  std::vector<std::size_t> generated, solids;  // vertices; cubes along an edge
  std::vector<std::string> meshes;
  std::vector<std::size_t> sizes = {0, 4096}, ranks = {4, 16, 64}, threads = {1};
  std::size_t check = 0;
  std::string accuracy = "fast";
  bench::ThreadCosts threads_cost;
  bench::RankCosts mpi;
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
             const Settings& settings, bench::Table& table) {
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
    serial = bench::processor_seconds(
        [&] { solve(Serial{}, domain, source, options, workspace, field); });
    serial_work = static_cast<double>(field.statistics.expansions);
  }
  bench::return_free_memory();
  for (const std::size_t asked : settings.sizes) {
    Workspace<Real> workspace;
    DistanceField<Real> field;
    SuperstepCounts& counts = workspace.state().pieces.counts();
    const OpenMP team{1, 128, asked};
    solve(team, domain, source, options, workspace, field);  // cuts
    counts.keeps_log = true;
    const double seconds =
        bench::processor_seconds([&] { solve(team, domain, source, options, workspace, field); });
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
        const bench::AmongRanks all = bench::among_ranks(
            counts.log, letter, ranks, threads, expansion, settings.threads_cost, settings.mpi);
        const double n = static_cast<double>(ranks);
        nlohmann::ordered_json row = {{"domain", name},
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

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  bench::Report report;
  CLI::App app("Pieces among ranks: counts, bytes, memory, and a model of more cores");
  app.add_option("MESH", settings.meshes, "Surfaces");
  app.add_option("--generated", settings.generated, "Bumpy spheres of about so many vertices");
  app.add_option("--solids", settings.solids,
                 "Cubes with a wall, so many cells along an edge (a multiple of 8), of which 6 "
                 "tetrahedra are made");
  app.add_option("--sizes", settings.sizes, "Simplices a piece; 0: what OpenMP takes by itself")
      ->capture_default_str();
  app.add_option("--ranks", settings.ranks, "Ranks")->capture_default_str();
  app.add_option("--threads", settings.threads, "Threads of each")->capture_default_str();
  app.add_option("--check", settings.check,
                 "So many of the ranks really send (each has the whole)");
  app.add_option("--accuracy", settings.accuracy, "fast or accurate")
      ->check(CLI::IsMember({"fast", "accurate"}))
      ->capture_default_str();
  app.add_option("--latency", settings.mpi.latency, "Seconds of a step of a reduction")
      ->capture_default_str();
  app.add_option("--message", settings.mpi.message, "Seconds of a message")->capture_default_str();
  app.add_option("--bandwidth", settings.mpi.bandwidth, "Bytes a second of a rank")
      ->capture_default_str();
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  bench::Table table({{"domain", "domain"},
                      {"simplices", "simplices"},
                      {"size", "a piece"},
                      {"pieces", "pieces"},
                      {"ranks", "ranks"},
                      {"threads", "threads each"},
                      {"supersteps", "supersteps"},
                      {"expansions", "expansions a simplex", "%.3f"},
                      {"times_serial", "times Serial's", "%.3f"},
                      {"letters", "letters"},
                      {"letter_bytes", "their bytes"},
                      {"sent_letters", "letters to other ranks"},
                      {"sent", "bytes sent in supersteps"},
                      {"messages", "messages that are not empty"},
                      {"most", "most bytes of a rank in a superstep"},
                      {"sent_field", "bytes of the last field"},
                      {"really", "really sent, in all"},
                      {"ns", "ns an expansion", "%.0f"},
                      {"serial_s", "Serial, s", "%.2f"},
                      {"whole_s", "for the whole, s", "%.2f"},
                      {"speed", "model", "%.1f"},
                      {"with_whole", "and with the whole", "%.1f"},
                      {"memory", "bytes a rank", "%.3g"}});
  return report.write(table, [&] {
    const auto surface = [&](bench::Surface made) {
      const TriangleMesh<float> mesh(made.positions, made.faces);
      const std::string name = made.name;
      made = {};
      bench::return_free_memory();
      measure(name, mesh, static_cast<double>(mesh.bytes()), settings, table);
    };
    for (const std::string& mesh : settings.meshes) surface(bench::read_surface(mesh));
    for (const std::size_t vertices : settings.generated) surface(bench::bumpy_surface(vertices));
    for (const std::size_t n : settings.solids) {
      auto made = plexway::testing::walled(static_cast<Index>(n));
      const TetMesh<float> mesh(made.positions, made.tets);
      made = {};
      bench::return_free_memory();
      measure("walled_" + std::to_string(n), mesh, static_cast<double>(mesh.bytes()), settings,
              table);
    }
  });
}
