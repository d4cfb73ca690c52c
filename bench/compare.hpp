#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../data/shapes.hpp"
#include "harness.hpp"
#include "isolate.hpp"
#include "peer.hpp"
#include "table.hpp"

namespace bench {

struct CompareOptions {
  std::vector<std::string> meshes;
  std::vector<std::size_t> generated;
  std::filesystem::path truth;
  std::vector<std::string> only;
  Effort effort;
  std::size_t exact_limit = 12000;
  double limit = 600;
  std::string rows_of;
  std::filesystem::path rows_from, rows_to;
  Report report;
};

/// The bumpy sphere with about as many vertices as asked for.
inline Surface bumpy_surface(std::size_t vertices) {
  const double n = std::max(1.0, std::round(std::sqrt(static_cast<double>(vertices) / 10)));
  samples::Shape shape = samples::bumpy(static_cast<Index>(n));
  return {"bumpy_" + std::to_string(shape.points.size()), std::move(shape.points),
          std::move(shape.faces)};
}

/// One row: built, timed in turns with Dijkstra, compared with the exact answers.
inline nlohmann::ordered_json measure_peer(const PeerKind& kind, const Surface& surface,
                                           const std::vector<Truth>& truths, const Effort& effort) {
  const double vertices = static_cast<double>(surface.positions.size());
  nlohmann::ordered_json row;
  std::unique_ptr<Peer> peer;
  row["build_ms"] = 1e3 * seconds([&] { peer = kind.build(surface); });

  const auto sources = rotating_sources(surface, effort.sources);
  const auto solve = [&](Index source) { peer->solve(source); };
  const auto reference = reference_peer(surface, kind.single_precision);
  const auto dijkstra = [&](Index source) {
    if (reference) reference->solve(source);
  };
  const Times times = take_turns(sources, effort, dijkstra, solve);
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
  if (const auto summary = errors.summary()) {
    row["mean"] = summary->mean;
    row["p99"] = summary->p99;
    row["max"] = summary->max;
    row["most_below"] = summary->most_below;
    if (summary->wrong > 0) remark(std::to_string(summary->wrong) + " wrong");
    if (compared < truths.size())
      remark(std::to_string(compared) + " of " + std::to_string(truths.size()) + " truths");
  }
  if (!note.empty()) row["note"] = note;
  return row;
}

inline Table comparison_table() {
  return Table({{"mesh", "mesh"},
                {"vertices", "vertices"},
                {"peer", "peer"},
                {"build_ms", "build ms", "%.1f"},
                {"ns_per_vertex", "solve ns/V", "%.1f"},
                {"dijkstra_ns_per_vertex", "Dijkstra ns/V", "%.1f"},
                {"ratio", "ratio", "%.2f"},
                {"mean", "error mean", "%.1e"},
                {"p99", "p99", "%.1e"},
                {"max", "max", "%.1e"},
                {"most_below", "most below", "%.1e"},
                {"bytes_per_vertex", "bytes/V", "%.0f"},
                {"note", "note"}});
}

/// What all these programs take to say how long to measure.
inline void add_effort_options(CLI::App& app, Effort& effort) {
  app.add_option("--sources", effort.sources, "Sources to rotate")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--repeats", effort.repeats, "Solves from each source")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--warm", effort.warm, "An untimed solve before each timed one");
  app.add_flag("--processor", effort.processor, "The processor's time instead of the clock's");
  app.add_option("--budget", effort.budget, "Seconds after which a row ends early")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

inline void compare_on(const Surface& surface, const std::filesystem::path& truth_folder,
                       const std::vector<PeerKind>& kinds, const CompareOptions& options,
                       Table& table) {
  const auto truths = read_truths(truth_folder, surface);
  for (const PeerKind& kind : kinds) {
    const auto matches = [&](const std::string& part) {
      return kind.name.find(part) != std::string::npos;
    };
    if (!options.only.empty() && std::none_of(options.only.begin(), options.only.end(), matches))
      continue;
    std::cerr << surface.name << ": " << kind.name << std::endl;
    nlohmann::ordered_json row = {
        {"mesh", surface.name}, {"vertices", surface.positions.size()}, {"peer", kind.name}};
    if (kind.exact && surface.positions.size() > options.exact_limit)
      row["note"] = "skipped: more than " + std::to_string(options.exact_limit) + " vertices";
    else
      row.update(isolated(options.limit,
                          [&] { return measure_peer(kind, surface, truths, options.effort); }));
    table.add(std::move(row));
  }
}

/// One peer as a program of its own, as bench/peers/run calls them: reads a mesh and a list of
/// vertices, writes a row of distances for each as plain doubles.
inline int write_rows(const CompareOptions& options, const std::vector<PeerKind>& kinds) try {
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const PeerKind& candidate) {
    return candidate.name == options.rows_of;
  });
  if (kind == kinds.end()) throw std::runtime_error("no peer is called " + options.rows_of);
  if (options.meshes.size() != 1) throw std::runtime_error("--rows wants one MESH");
  const Surface surface = read_surface(options.meshes.front());
  const auto peer = kind->build(surface);
  std::ifstream sources(options.rows_from);
  std::ofstream out(options.rows_to, std::ios::binary);
  for (std::size_t source = 0; sources >> source;) {
    if (source >= surface.positions.size()) throw std::runtime_error("a source is no vertex");
    peer->solve(static_cast<Index>(source));
    const std::vector<double> row = peer->distance();
    out.write(reinterpret_cast<const char*>(row.data()),
              static_cast<std::streamsize>(row.size() * sizeof(double)));
  }
  out.close();
  if (!sources.eof())
    throw std::runtime_error(options.rows_from.string() + ": no list of vertices");
  if (!out) throw std::runtime_error(options.rows_to.string() + ": cannot be written");
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}

/// The whole program: every peer on every mesh, one table on stdout, progress on stderr.
inline int compare_peers(int argc, char** argv, const std::vector<PeerKind>& kinds) {
  CompareOptions options;
  CLI::App app("All peers side by side on the same surfaces: one table");
  app.add_option("MESH", options.meshes, "Surfaces (.obj .off .ply .stl)");
  app.add_option("--generate", options.generated,
                 "Also the bumpy sphere with about this many vertices (may be repeated)");
  app.add_option("--truth-dir", options.truth,
                 "Folder of the exact answers NAME.vID.txt (default: beside each mesh)");
  app.add_option("--only", options.only, "Only peers whose name holds this (may be repeated)");
  add_effort_options(app, options.effort);
  app.add_option("--exact-limit", options.exact_limit,
                 "Exact peers only on meshes with at most this many vertices")
      ->capture_default_str();
  app.add_option("--limit", options.limit, "Seconds after which a row is given up")
      ->capture_default_str();
  auto* rows =
      app.add_option("--rows", options.rows_of, "No table: the rows of the peer of this name");
  app.add_option("--from", options.rows_from, "With --rows: a file of vertices")->needs(rows);
  app.add_option("--to", options.rows_to, "With --rows: where they go, as plain doubles")
      ->needs(rows);
  options.report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  if (!options.rows_of.empty()) return write_rows(options, kinds);
  if (options.meshes.empty() && options.generated.empty()) {
    std::cerr << "no MESH and no --generate: nothing to measure\n";
    return 2;
  }

  Table table = comparison_table();
  return options.report.write(table, [&] {
    for (const std::filesystem::path mesh : options.meshes)
      compare_on(read_surface(mesh), options.truth.empty() ? mesh.parent_path() : options.truth,
                 kinds, options, table);
    for (const std::size_t vertices : options.generated)
      compare_on(bumpy_surface(vertices), options.truth, kinds, options, table);
  });
}

/// The peers that need nothing but this project (and Boost, where its provider is built).
inline std::vector<PeerKind> common_peers() {
  using plexway::Visibility;
  std::vector<PeerKind> kinds;
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  for (const bool single : {true, false})
    kinds.push_back({single ? "Boost Dijkstra, float" : "Boost Dijkstra, double", single,
                     [single](const Surface& surface) { return reference_peer(surface, single); },
                     false});
  kinds.push_back(
      {"Boost Dijkstra, fastest variant", true,
       [](const Surface& surface) { return std::make_unique<DijkstraPeer<float>>(surface, true); },
       false});
#endif
  kinds.push_back(plexway_peer<float>("plexway saddles, float", Visibility::saddles));
  kinds.push_back(plexway_peer<double>("plexway saddles, double", Visibility::saddles));
  kinds.push_back(plexway_peer<float>("plexway tuned, float", Visibility::tuned));
  kinds.push_back(plexway_peer<float>("plexway upper_bound, float", Visibility::upper_bound));
  return kinds;
}

}  // namespace bench
