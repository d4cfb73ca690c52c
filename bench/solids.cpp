// Geodesic distance in tetrahedral solids: time beside Dijkstra's on the same edges, errors against
// exact answers, and both as generated solids grow.

#include <cmath>
#include <fstream>

#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <plexway/boost_graph/dijkstra.hpp>
#endif

#include "scenes.hpp"
#include "solver.hpp"

namespace bench::solids {

struct Solid {
  std::string name;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 4>> tets;
  std::vector<Truth> truths;
};

/// TetGen's plain text, 0-based, as the truth folder has it, with its exact answers.
Solid read_solid(const std::filesystem::path& folder, const std::string& name) {
  Solid solid{name, {}, {}, {}};
  std::size_t count = 0;
  std::size_t skip = 0;
  std::ifstream nodes(folder / (name + ".node"));
  nodes >> count >> skip >> skip >> skip;
  const std::size_t count_of_nodes = count;
  solid.positions.resize(count);
  for (auto& p : solid.positions) nodes >> skip >> p[0] >> p[1] >> p[2];
  std::ifstream tets(folder / (name + ".ele"));
  tets >> count >> skip >> skip;
  solid.tets.resize(count);
  for (auto& t : solid.tets) tets >> skip >> t[0] >> t[1] >> t[2] >> t[3];
  if (!nodes || !tets) throw std::runtime_error((folder / name).string() + ": cannot be read");
  solid.truths = read_truths(folder, name, count_of_nodes);
  return solid;
}

/// n^3 cubes of six tetrahedra, inner vertices moved a little; `notched`: without those with
/// x > 1/2 and y > 1/2. The exact answer is known from everywhere in the first half.
Solid generated(Index n, bool notched, bool shuffled) {
  Solid s{(notched ? "l_shape_" : "cube_") + std::to_string(n), {}, {}, {}};
  const auto has = [&](Index i, Index j, Index k) {
    return i < n && j < n && k < n && (!notched || i < n / 2 || j < n / 2);
  };
  samples::Noise noise(1);
  std::vector<Index> number(static_cast<std::size_t>(n + 1) * (n + 1) * (n + 1), plexway::none);
  const auto vertex = [&](Index i, Index j, Index k) -> Index& {
    return number[(static_cast<std::size_t>(k) * (n + 1) + j) * (n + 1) + i];
  };
  for (Index k = 0; k <= n; ++k)
    for (Index j = 0; j <= n; ++j)
      for (Index i = 0; i <= n; ++i) {
        int around = 0;
        for (Index c = 0; c < 8; ++c) around += has(i - (c & 1), j - (c >> 1 & 1), k - (c >> 2));
        if (around == 0) continue;
        std::array<double, 3> p = {double(i), double(j), double(k)};
        for (double& x : p) x = (x + (around == 8 ? 0.15 * noise() : 0)) / n;
        vertex(i, j, k) = static_cast<Index>(s.positions.size());
        s.positions.push_back(p);
      }
  for (Index k = 0; k < n; ++k)
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        if (!has(i, j, k)) continue;
        std::array<Index, 3> axis = {0, 1, 2};
        do {
          std::array<Index, 3> at = {i, j, k};
          std::array<Index, 4> tet = {vertex(i, j, k), 0, 0, 0};
          for (std::size_t e = 0; e < 3; ++e) {
            ++at[axis[e]];
            tet[e + 1] = vertex(at[0], at[1], at[2]);
          }
          s.tets.push_back(tet);
        } while (std::next_permutation(axis.begin(), axis.end()));
      }
  if (shuffled) {
    s.name += ", shuffled";
    const auto place = bench::shuffled(s.positions.size(), noise);
    const auto old = s.positions;
    for (std::size_t v = 0; v < place.size(); ++v) s.positions[place[v]] = old[v];
    for (auto& t : s.tets)
      for (Index& v : t) v = place[v];
    const auto tets = s.tets;
    const auto order = bench::shuffled(tets.size(), noise);
    for (std::size_t t = 0; t < tets.size(); ++t) s.tets[t] = tets[order[t]];
  }
  // From the vertex nearest to the far end of one arm.
  Truth truth;
  double least = 10;
  for (Index v = 0; v < s.positions.size(); ++v) {
    const auto& p = s.positions[v];
    const double d = std::hypot(p[0] - 1, p[1], p[2] - 0.5);
    if (d < least) least = d, truth.source = v;
  }
  const auto& a = s.positions[truth.source];
  for (const auto& p : s.positions) {
    double flat = std::hypot(p[0] - a[0], p[1] - a[1]);
    if (notched && p[1] > .5 && a[0] > .5) {
      const double crossing = a[1] + (p[1] - a[1]) * (.5 - a[0]) / (p[0] - a[0]);
      if (crossing > .5) flat = std::hypot(a[0] - .5, a[1] - .5) + std::hypot(p[0] - .5, p[1] - .5);
    }
    truth.distance.push_back(std::hypot(flat, p[2] - a[2]));
  }
  s.truths.push_back(std::move(truth));
  return s;
}

template <class Real>
Row measure(const Solid& solid, const Effort& effort, int threads) {
  const double vertices = static_cast<double>(solid.positions.size());
  const double tets = static_cast<double>(solid.tets.size());
  Row row;
  std::unique_ptr<plexway::TetMesh<Real>> mesh;
  row["build_ns_per_tet"] =
      1e9 / tets * seconds([&] {
        mesh = std::make_unique<plexway::TetMesh<Real>>(solid.positions, solid.tets);
      });
  Solver solver(*mesh);
  std::vector<Index> sources;
  for (std::size_t i = 0; i < effort.sources; ++i)
    sources.push_back(static_cast<Index>((i * 2654435761u) % solid.positions.size()));
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  std::vector<std::array<Index, 3>> faces;  // three of a tetrahedron have all its edges
  for (const auto& [a, b, c, d] : solid.tets)
    faces.insert(faces.end(), {{a, b, c}, {a, b, d}, {a, c, d}});
  plexway::boost_graph::EdgeDijkstra<Real> dijkstra(solid.positions, faces);
  const auto reference = [&](Index source) { dijkstra.run(source); };
#else
  const auto reference = [](Index) {};
#endif
  const Times times = take_turns(sources, effort, reference, [&](Index source) { solver(source); });
  row["ns_per_vertex"] = 1e9 * times.second / vertices;
  row["ns_per_tet"] = 1e9 * times.second / tets;
#ifdef PLEXWAY_HAS_BOOST_GRAPH
  row["dijkstra_ns_per_vertex"] = 1e9 * times.first / vertices;
  row["ratio"] = times.ratio;
#endif
  if (threads > 0) {
    Effort by_clock = effort;
    by_clock.processor = false;
    Solver team(*mesh, {}, plexway::OpenMP{.threads = threads});
    row["gain"] = 1 / take_turns(
                          sources, by_clock, [&](Index source) { solver(source); },
                          [&](Index source) { team(source); })
                          .ratio;
  }
  Errors errors;
  double updates = 0;
  for (const Truth& truth : solid.truths) {
    solver(truth.source);
    updates += static_cast<double>(solver.statistics().updates) / tets;
    errors.add(truth, solver.distance());
  }
  add_errors(row, errors);
  if (const auto summary = errors.summary()) {
    row["updates_per_tet"] = updates / static_cast<double>(solid.truths.size());
    if (summary->wrong > 0) row["note"] = std::to_string(summary->wrong) + " wrong";
  }
  row["mesh_bytes_per_tet"] = static_cast<double>(mesh->bytes()) / tets;
  row["bytes_per_tet"] = static_cast<double>(mesh->bytes() + solver.workspace().bytes()) / tets;
  return row;
}

void run(Arguments& arguments) {
  std::string truth;
  std::vector<Index> sizes = {12, 26, 44, 70};
  Effort effort{6, 2, 20};
  bool single = false;
  int threads = 0;
  arguments.option("TRUTH", &truth, "Folder of .node, .ele and exact answers");
  arguments.option("--sizes", &sizes, "Cubes along a side of the generated solids");
  effort.add_options(arguments);
  arguments.add_limit();
  arguments.option("--threads", &threads, "Also by so many, by the clock");
  arguments.option("--float", &single, "Float instead of double");
  Table& table = arguments.table(
      "mesh; tets; build_ns_per_tet: build ns/T %.0f; ns_per_vertex: solve ns/V %.0f;"
      "ns_per_tet: ns/T %.0f; dijkstra_ns_per_vertex: Dijkstra ns/V %.0f; ratio %.2f; gain: times "
      "faster by threads %.2f;"
      "mean: error mean %.1e; p99 %.1e; max %.1e; below: most below %.1e;"
      "updates_per_tet: updates/T %.2f; mesh_bytes_per_tet: mesh bytes/T %.0f;"
      "bytes_per_tet: with workspace %.0f; note");
  const auto on = [&](const auto& make) {
    table.measure({}, arguments.limit, [&] {
      const Solid solid = make();
      return Row{{"mesh", solid.name}, {"tets", solid.tets.size()}}.update(
          single ? measure<float>(solid, effort, threads)
                 : measure<double>(solid, effort, threads));
    });
  };
  std::vector<std::string> names;
  if (!truth.empty())
    for (const auto& entry : std::filesystem::directory_iterator(truth))
      if (entry.path().extension() == ".node") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) on([&] { return read_solid(truth, name); });
  for (const bool notched : {false, true})
    for (const Index n : sizes) on([&] { return generated(n, notched, false); });
  if (!sizes.empty()) on([&] { return generated(sizes.back(), true, true); });
}
const Command command("solids", "solids beside Dijkstra on their edges: time, errors, growth", run);

}  // namespace bench::solids
