// Time and memory a vertex as the surface grows: a bumpy sphere at several resolutions, and any
// mesh cut into four again and again.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "compare.hpp"

namespace {

using bench::Index;
using bench::Surface;

/// Every triangle in four, by the middles of its edges. The surface stays the same.
Surface subdivide(const Surface& surface) {
  Surface finer{surface.name, surface.positions, {}};
  using Edge = std::pair<std::pair<Index, Index>, std::size_t>;  // its ends, and which corner
  std::vector<Edge> edges;
  edges.reserve(3 * surface.faces.size());
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto ends = std::minmax(surface.faces[f][i], surface.faces[f][(i + 1) % 3]);
      edges.push_back({{ends.first, ends.second}, 3 * f + i});
    }
  std::sort(edges.begin(), edges.end());
  std::vector<Index> middle(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (e == 0 || edges[e].first != edges[e - 1].first) {
      const auto& a = surface.positions[edges[e].first.first];
      const auto& b = surface.positions[edges[e].first.second];
      finer.positions.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    }
    middle[edges[e].second] = static_cast<Index>(finer.positions.size() - 1);
  }
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto& [a, b, c] = surface.faces[f];
    const Index ab = middle[3 * f];
    const Index bc = middle[3 * f + 1];
    const Index ca = middle[3 * f + 2];
    finer.faces.insert(finer.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return finer;
}

/// Vertices and faces in an order that says nothing about where they are.
void shuffle(Surface& surface) {
  samples::Noise noise(1);
  const auto permutation = [&](std::size_t n) {
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), Index{0});
    for (std::size_t i = n; i > 1; --i) {
      const double place = (noise() + 1) / 2 * static_cast<double>(i);
      std::swap(order[i - 1], order[std::min(i - 1, static_cast<std::size_t>(place))]);
    }
    return order;
  };
  const auto place = permutation(surface.positions.size());
  const auto old_positions = surface.positions;
  for (std::size_t v = 0; v < place.size(); ++v) surface.positions[place[v]] = old_positions[v];
  const auto face_place = permutation(surface.faces.size());
  const auto old_faces = surface.faces;
  for (std::size_t f = 0; f < face_place.size(); ++f) {
    auto face = old_faces[f];
    for (Index& v : face) v = place[v];
    surface.faces[face_place[f]] = face;
  }
  surface.name += ", shuffled";
}

template <class Real>
nlohmann::ordered_json measure(const Surface& surface, const bench::Effort& effort) {
  const double vertices = static_cast<double>(surface.positions.size());
  const auto sources = bench::rotating_sources(surface, effort.sources);
  nlohmann::ordered_json row;

  // Memory first, while nothing but the surface is there.
  bench::return_free_memory();
  const auto before = bench::status_bytes("VmRSS");
  std::unique_ptr<bench::PlexwayPeer<Real>> peer;
  row["build_ns_per_vertex"] =
      1e9 / vertices * bench::seconds([&] {
        peer = std::make_unique<bench::PlexwayPeer<Real>>(surface, bench::one_label());
      });
  const auto build_peak = bench::status_bytes("VmHWM");
  for (const Index source : sources) peer->solve(source);
  row["bytes_per_vertex"] = static_cast<double>(peer->bytes()) / vertices;
  bench::return_free_memory();
  if (const auto now = bench::status_bytes("VmRSS"); before && now)
    row["resident_per_vertex"] = (*now - *before) / vertices;
  if (before && build_peak) row["build_peak_per_vertex"] = (*build_peak - *before) / vertices;

  const auto reference = bench::reference_peer(surface, sizeof(Real) == sizeof(float));
  const auto times = bench::take_turns(
      sources, effort,
      [&](Index source) {
        if (reference) reference->solve(source);
      },
      [&](Index source) { peer->solve(source); });
  row["ns_per_vertex"] = 1e9 * times.second / vertices;
  if (reference) {
    row["dijkstra_ns_per_vertex"] = 1e9 * times.first / vertices;
    row["ratio"] = times.ratio;
  }
  return row;
}

bench::Table scale_table() {
  return bench::Table({{"mesh", "mesh"},
                       {"vertices", "vertices"},
                       {"build_ns_per_vertex", "build ns/V", "%.0f"},
                       {"ns_per_vertex", "solve ns/V", "%.1f"},
                       {"growth", "to the smallest", "%.2f"},
                       {"dijkstra_ns_per_vertex", "Dijkstra ns/V", "%.1f"},
                       {"ratio", "ratio", "%.2f"},
                       {"bytes_per_vertex", "bytes/V", "%.0f"},
                       {"resident_per_vertex", "resident bytes/V", "%.0f"},
                       {"build_peak_per_vertex", "peak of the build bytes/V", "%.0f"},
                       {"note", "note"}});
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::vector<std::size_t> sizes = {50000, 400000, 1000000};
  bench::Effort effort{8, 2, 20};
  double limit = 600;
  bench::Report report;
  bool double_precision = false;
  bool shuffled = false;
  CLI::App app("Time and memory a vertex as a surface grows: one table");
  app.add_option("MESH", meshes, "Surfaces to subdivide up to the largest size");
  app.add_option("--sizes", sizes, "Vertices of the bumpy sphere, about")
      ->delimiter(',')
      ->capture_default_str();
  bench::add_effort_options(app, effort);
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  app.add_flag("--shuffle", shuffled, "Vertices and faces in random order");
  app.add_flag("--double", double_precision, "Double instead of float");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table = scale_table();
  std::map<std::string, double> smallest;  // ns a vertex of the smallest surface of a family
  const auto measure_one = [&](const std::string& family, Surface surface) {
    if (shuffled) shuffle(surface);
    std::cerr << surface.name << ": " << surface.positions.size() << " vertices" << std::endl;
    nlohmann::ordered_json row = {{"mesh", surface.name}, {"vertices", surface.positions.size()}};
    row.update(bench::isolated(limit, [&] {
      return double_precision ? measure<double>(surface, effort) : measure<float>(surface, effort);
    }));
    if (row.contains("ns_per_vertex")) {
      const double ns = row["ns_per_vertex"].get<double>();
      row["growth"] = ns / smallest.try_emplace(family, ns).first->second;
    }
    table.add(std::move(row));
  };
  return report.write(table, [&] {
    std::sort(sizes.begin(), sizes.end());
    for (const std::size_t size : sizes) measure_one("bumpy", bench::bumpy_surface(size));
    for (const std::string& mesh : meshes) {
      Surface surface = bench::read_surface(mesh);
      while (!sizes.empty() && surface.positions.size() <= sizes.back()) {
        measure_one(mesh, surface);
        surface = subdivide(surface);
      }
    }
  });
}
