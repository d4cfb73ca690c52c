// All peers side by side on the same surfaces, in turns with Boost's Dijkstra. bench_cgal has the
// same command with CGAL's peers in it.

#include "peers.hpp"

#include <fstream>
#include <stdexcept>

#include "solver.hpp"
#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <plexway/boost_graph/dijkstra.hpp>
#endif

namespace bench {

namespace peers {

using plexway::Visibility;

template <class Real>
class Plexway final : public Peer {
 public:
  Plexway(const Surface& surface, const plexway::PropagateOptions& options)
      : mesh_(surface.positions, surface.faces), solver_(mesh_, options) {}
  void solve(Index source) override { solver_(source); }
  [[nodiscard]] std::vector<double> distance() const override {
    return {solver_.distance().begin(), solver_.distance().end()};
  }
  [[nodiscard]] std::size_t bytes() const override { return mesh_.bytes() + solver_.bytes(); }

 private:
  plexway::TriangleMesh<Real> mesh_;
  Solver<plexway::TriangleMesh<Real>> solver_;
};

template <class Real>
PeerKind plexway_peer(std::string name, Visibility visibility) {
  return {std::move(name), sizeof(Real) == 4, [visibility](const Surface& surface) {
            plexway::PropagateOptions options = one_label();
            options.visibility = visibility;
            return std::make_unique<Plexway<Real>>(surface, options);
          }};
}

#ifdef PLEXWAY_HAS_BOOST_GRAPH
template <class Real>
class Dijkstra final : public Peer {
 public:
  explicit Dijkstra(const Surface& surface, bool without_colours = false)
      : dijkstra_(surface.positions, surface.faces), without_colours_(without_colours) {}
  void solve(Index source) override {
    without_colours_ ? dijkstra_.run_without_colours(source) : dijkstra_.run(source);
  }
  [[nodiscard]] std::vector<double> distance() const override {
    return {dijkstra_.distance().begin(), dijkstra_.distance().end()};
  }
  [[nodiscard]] std::size_t bytes() const override { return dijkstra_.bytes(); }

 private:
  plexway::boost_graph::EdgeDijkstra<Real> dijkstra_;
  bool without_colours_;
};
#endif

std::vector<PeerKind> common() {
  std::vector<PeerKind> kinds;
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  for (const bool single : {true, false})
    kinds.push_back({single ? "Boost Dijkstra, float" : "Boost Dijkstra, double", single,
                     [single](const Surface& surface) { return reference_peer(surface, single); }});
  kinds.push_back({"Boost Dijkstra, fastest variant", true, [](const Surface& surface) {
                     return std::make_unique<Dijkstra<float>>(surface, true);
                   }});
#endif
  kinds.push_back(plexway_peer<float>("plexway saddles, float", Visibility::saddles));
  kinds.push_back(plexway_peer<double>("plexway saddles, double", Visibility::saddles));
  kinds.push_back(plexway_peer<float>("plexway tuned, float", Visibility::tuned));
  kinds.push_back(plexway_peer<float>("plexway upper_bound, float", Visibility::upper_bound));
  return kinds;
}

/// Built, timed in turns with Dijkstra, compared with the exact answers.
Row measure(const PeerKind& kind, const Surface& surface, const std::vector<Truth>& truths,
            const Effort& effort) {
  const double vertices = static_cast<double>(surface.positions.size());
  Row row;
  std::unique_ptr<Peer> peer;
  row["build_ms"] = 1e3 * seconds([&] { peer = kind.build(surface); });

  const auto reference = reference_peer(surface, kind.single_precision);
  const Times times = take_turns(
      rotating_sources(surface, effort.sources), effort,
      [&](Index source) {
        if (reference) reference->solve(source);
      },
      [&](Index source) { peer->solve(source); });
  row["ns_per_vertex"] = 1e9 * times.second / vertices;
  if (reference) {
    row["dijkstra_ns_per_vertex"] = 1e9 * times.first / vertices;
    row["ratio"] = times.ratio;
  }
  row["turns"] = times.turns;
  if (const std::size_t bytes = peer->bytes())
    row["bytes_per_vertex"] = static_cast<double>(bytes) / vertices;

  std::string note;
  const auto remark = [&](const std::string& text) { note += (note.empty() ? "" : ", ") + text; };
  const auto found = peer->distance();
  const auto reached =
      std::count_if(found.begin(), found.end(), [](double d) { return std::isfinite(d); });
  if (static_cast<std::size_t>(reached) != found.size())
    remark("reaches " + std::to_string(reached) + " vertices");

  Errors errors;
  std::size_t compared = 0;
  double spent = 0;
  for (const Truth& truth : truths) {
    if (compared > 0 && spent > effort.budget) break;
    spent += seconds([&] { peer->solve(truth.source); });
    errors.add(truth, peer->distance());
    ++compared;
  }
  add_errors(row, errors);
  if (const auto summary = errors.summary()) {
    if (summary->wrong > 0) remark(std::to_string(summary->wrong) + " wrong");
    if (compared < truths.size())
      remark(std::to_string(compared) + " of " + std::to_string(truths.size()) + " truths");
  }
  if (!note.empty()) row["note"] = note;
  return row;
}

/// One peer as a program of its own, as bench/peers/run calls them: reads a mesh and a list of
/// vertices, writes a row of distances for each as plain doubles.
void write_rows(const std::string& name, const Meshes& meshes, const std::string& from,
                const std::string& to) {
  const auto& kinds = peer_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const PeerKind& one) { return one.name == name; });
  if (kind == kinds.end()) throw std::runtime_error("no peer is called " + name);
  if (meshes.files.size() != 1) throw std::runtime_error("--rows wants one MESH");
  const Surface surface = read_surface(meshes.files.front());
  const auto peer = kind->build(surface);
  std::ifstream sources(from);
  std::ofstream out(to, std::ios::binary);
  for (std::size_t source = 0; sources >> source;) {
    if (source >= surface.positions.size()) throw std::runtime_error("a source is no vertex");
    peer->solve(static_cast<Index>(source));
    const std::vector<double> row = peer->distance();
    out.write(reinterpret_cast<const char*>(row.data()),
              static_cast<std::streamsize>(row.size() * sizeof(double)));
  }
  out.close();
  if (!sources.eof()) throw std::runtime_error(from + ": no list of vertices");
  if (!out) throw std::runtime_error(to + ": cannot be written");
}

void run(Arguments& arguments) {
  Meshes meshes;
  std::vector<std::string> only;
  Effort effort;
  std::size_t exact_limit = 12000;
  std::string rows_of, rows_from, rows_to;
  meshes.add_options(arguments, "--generate");
  arguments.option("--only", &only, "Only peers whose name holds this (may be repeated)");
  effort.add_options(arguments);
  arguments.option("--exact-limit", &exact_limit,
                   "Exact peers only on meshes with at most this many vertices");
  arguments.add_limit();
  arguments.option("--rows", &rows_of, "No table: the rows of the peer of this name");
  arguments.option("--from", &rows_from, "With --rows: a file of vertices");
  arguments.option("--to", &rows_to, "With --rows: where they go, as plain doubles");
  Table& table = arguments.table(
      "mesh; vertices; peer; build_ms: build ms %.1f; ns_per_vertex: solve ns/V %.1f;"
      "dijkstra_ns_per_vertex: Dijkstra ns/V %.1f; ratio %.2f; mean: error mean %.1e; p99 %.1e;"
      "max %.1e; below: most below %.1e; bytes_per_vertex: bytes/V %.0f; note");
  if (!rows_of.empty()) {
    write_rows(rows_of, meshes, rows_from, rows_to);
    throw Exit(0, "");
  }
  if (meshes.files.empty() && meshes.sizes.empty())
    throw Exit(2, "no MESH and no --generate: nothing to measure");
  meshes.each([&](const Surface& surface, const std::vector<Truth>& truths) {
    for (const PeerKind& kind : peer_kinds()) {
      const auto matches = [&](const std::string& part) {
        return kind.name.find(part) != std::string::npos;
      };
      if (!only.empty() && std::none_of(only.begin(), only.end(), matches)) continue;
      Row head = {
          {"mesh", surface.name}, {"vertices", surface.positions.size()}, {"peer", kind.name}};
      if (kind.exact && surface.positions.size() > exact_limit)
        table.add(head.update(
            {{"note", "skipped: more than " + std::to_string(exact_limit) + " vertices"}}));
      else
        table.measure(head, arguments.limit,
                      [&] { return measure(kind, surface, truths, effort); });
    }
  });
}
const Command command("peers", "every peer that is there, in turns with Boost's Dijkstra", run);

}  // namespace peers

std::vector<PeerKind>& peer_kinds() {
  static std::vector<PeerKind> kinds = peers::common();
  return kinds;
}

std::unique_ptr<Peer> reference_peer([[maybe_unused]] const Surface& surface,
                                     [[maybe_unused]] bool single_precision) {
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  if (single_precision) return std::make_unique<peers::Dijkstra<float>>(surface);
  return std::make_unique<peers::Dijkstra<double>>(surface);
#else
  return nullptr;
#endif
}

}  // namespace bench
