// Time and memory a vertex as the surface grows: a bumpy sphere at several resolutions, and any
// mesh cut into four again and again.

#include <algorithm>
#include <map>
#include <utility>

#include "peers.hpp"
#include "scenes.hpp"
#include "solver.hpp"

namespace bench::scale {

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
  const auto place = shuffled(surface.positions.size(), noise);
  const auto old_positions = surface.positions;
  for (std::size_t v = 0; v < place.size(); ++v) surface.positions[place[v]] = old_positions[v];
  const auto face_place = shuffled(surface.faces.size(), noise);
  const auto old_faces = surface.faces;
  for (std::size_t f = 0; f < face_place.size(); ++f) {
    auto face = old_faces[f];
    for (Index& v : face) v = place[v];
    surface.faces[face_place[f]] = face;
  }
  surface.name += ", shuffled";
}

template <class Real>
Row measure(const Surface& surface, const Effort& effort) {
  using Mesh = plexway::TriangleMesh<Real>;
  const double vertices = static_cast<double>(surface.positions.size());
  const auto sources = rotating_sources(surface, effort.sources);
  Row row;

  // Memory first, while nothing but the surface is there.
  return_free_memory();
  const auto before = status_bytes("VmRSS");
  std::unique_ptr<Mesh> mesh;
  std::unique_ptr<Solver<Mesh>> solver;
  row["build_ns_per_vertex"] = 1e9 / vertices * seconds([&] {
                                 mesh = std::make_unique<Mesh>(surface.positions, surface.faces);
                                 solver = std::make_unique<Solver<Mesh>>(*mesh, one_label());
                               });
  const auto build_peak = status_bytes("VmHWM");
  for (const Index source : sources) (*solver)(source);
  row["bytes_per_vertex"] = static_cast<double>(mesh->bytes() + solver->bytes()) / vertices;
  return_free_memory();
  if (const auto now = status_bytes("VmRSS"); before && now)
    row["resident_per_vertex"] = (*now - *before) / vertices;
  if (before && build_peak) row["build_peak_per_vertex"] = (*build_peak - *before) / vertices;

  const auto reference = reference_peer(surface, sizeof(Real) == sizeof(float));
  const Times times = take_turns(
      sources, effort,
      [&](Index source) {
        if (reference) reference->solve(source);
      },
      [&](Index source) { (*solver)(source); });
  row["ns_per_vertex"] = 1e9 * times.second / vertices;
  if (reference) {
    row["dijkstra_ns_per_vertex"] = 1e9 * times.first / vertices;
    row["ratio"] = times.ratio;
  }
  return row;
}

void run(Arguments& arguments) {
  std::vector<std::string> meshes;
  std::vector<std::size_t> sizes = {50000, 400000, 1000000};
  Effort effort{8, 2, 20};
  bool twice = false, in_any_order = false;
  arguments.option("MESH", &meshes, "Surfaces to subdivide up to the largest size");
  arguments.option("--sizes", &sizes, "Vertices of the bumpy sphere, about");
  effort.add_options(arguments);
  arguments.add_limit();
  arguments.option("--shuffle", &in_any_order, "Vertices and faces in random order");
  arguments.option("--double", &twice, "Double instead of float");
  Table& table = arguments.table(
      "mesh; vertices; build_ns_per_vertex: build ns/V %.0f; ns_per_vertex: solve ns/V %.1f;"
      "growth: to the smallest %.2f; dijkstra_ns_per_vertex: Dijkstra ns/V %.1f; ratio %.2f;"
      "bytes_per_vertex: bytes/V %.0f; resident_per_vertex: resident bytes/V %.0f;"
      "build_peak_per_vertex: peak of the build bytes/V %.0f; note");
  std::map<std::string, double> smallest;  // ns a vertex of the smallest surface of a family
  const auto on = [&](const std::string& family, Surface surface) {
    if (in_any_order) shuffle(surface);
    Row& row = table.measure(
        {{"mesh", surface.name}, {"vertices", surface.positions.size()}}, arguments.limit,
        [&] { return twice ? measure<double>(surface, effort) : measure<float>(surface, effort); });
    if (const Value* ns = row.find("ns_per_vertex"))
      row["growth"] = ns->number() / smallest.try_emplace(family, ns->number()).first->second;
  };
  std::sort(sizes.begin(), sizes.end());
  for (const std::size_t size : sizes) on("bumpy", bumpy_surface(size));
  for (const std::string& mesh : meshes) {
    Surface surface = read_surface(mesh);
    while (!sizes.empty() && surface.positions.size() <= sizes.back()) {
      on(mesh, surface);
      surface = subdivide(surface);
    }
  }
}
const Command command("scale", "time and memory a vertex as a surface grows", run);

}  // namespace bench::scale
