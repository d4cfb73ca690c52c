#pragma once

#include <catch2/catch.hpp>
#include <cstddef>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "exact_data.hpp"
#include "executors/parity.hpp"

namespace plexway::testing {

/// By pieces so small that there are many even here.
inline OpenMP pieces(int threads, std::size_t size) { return {.threads = threads, .piece = size}; }

/// Surfaces of every kind: open, closed, one-sided, of several sheets, torn.
inline std::vector<Surface> surfaces() {
  std::vector<Surface> all = {grid(24, 24),
                              grid(40, 12, 3, 1),
                              slit_square(12),
                              cube(8),
                              sphere(4),
                              prism(24, 12, 2),
                              moebius(60, 8),
                              sheets(3, 8),
                              bow_tie(10),
                              soup(60, 120, 1),
                              soup(80, 60, 2),
                              tetrahedron(),
                              subdivide(tetrahedron())};
  for (unsigned seed = 1; seed <= 4; ++seed) all.push_back(random_polygon(6, 120, 120, seed));
  return all;
}

/// A square whose left half is slower: lengths jump, paths are refracted.
template <class Real>
TriangleMesh<Real> two_speeds(Index n) {
  const Surface s = grid(n, n);
  auto lengths = lengths_of(s);
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    double x = 0;
    for (const Index v : s.faces[f]) x += s.positions[v][0] / 3;
    for (double& length : lengths[f]) length *= x < 0.5 ? 1.7 : 1;
  }
  SurfaceHints hints;
  hints.refracts = true;
  return {s.positions.size(), s.faces, lengths, hints};
}

/// A scan or a part of a machine whose exact distances from one vertex are known.
struct KnownSurface {
  const Surface& surface;
  const TriangleMesh<float>& mesh;
  PointSource source;
  const ExactAnswer& exact;
  std::string name;
  /// Of raw ones: there the order of work decides at one vertex between 8 % short and 25 % too long
  /// (Serial first in first out: 17 %), so only their means say something of labels.
  [[nodiscard]] bool needles() const { return name == "t79741" || name == "t908460"; }
};
/// Calls visit(known) for each of at most so many triangles, which takes a second or two in all.
template <class Visit>
void each_known_surface(std::size_t most_triangles, const Visit& visit) {
  for (const auto& file : exact_files("surfaces", ".obj")) {
    const io::Triangles soup = io::read_triangles(file);
    if (soup.triangles.size() > most_triangles) continue;
    const Surface s{soup.positions, soup.triangles};
    const auto mesh = s.mesh<float>();
    for (const ExactAnswer& exact : exact_answers(file))
      visit(KnownSurface{s, mesh, PointSource::at(static_cast<Index>(exact.source)), exact,
                         file.stem().string()});
  }
}

/// 200 solves by eight threads, in pieces of about `size`, have one field.
template <class Domain>
void check_200_solves(const Domain& domain, const std::vector<PointSource>& sources,
                      std::size_t size, const PropagateOptions& options) {
  WorkspaceOf<OpenMP, Domain> workspace;
  DistanceField<RealOf<Domain>> first, field;
  solve(pieces(8, size), domain, sources, options, workspace, first);
  std::size_t others = 0;
  for (int i = 0; i < 200; ++i) {
    solve(pieces(8, size), domain, sources, options, workspace, field);
    others += !same_bits(first, field);
  }
  CHECK(others == 0);
}

/// A budget is kept to the last expansion, with the same bits by one thread and by four, and what
/// comes out is no nearer than without one.
template <class Domain>
void check_budget(const Domain& domain, std::size_t size, PropagateOptions options) {
  const auto whole = solve(pieces(4, size), domain, PointSource::at(0), options);
  CHECK(whole.complete);
  for (const std::size_t most : {0u, 1u, 37u, 300u, 3000u}) {
    options.max_expansions = most;
    INFO("at most " << most);
    const auto field = solve(pieces(4, size), domain, PointSource::at(0), options);
    CHECK(!field.complete);
    CHECK(field.statistics.expansions == most);
    CHECK(field.distance[0] == 0);
    std::size_t nearer = 0;
    for (std::size_t v = 0; v < field.distance.size(); ++v)
      nearer += field.distance[v] < whole.distance[v] * RealOf<Domain>(1 - 1e-5);
    CHECK(nearer == 0);
    CHECK(same_bits(field, solve(pieces(1, size), domain, PointSource::at(0), options)));
  }
  options.max_expansions = whole.statistics.expansions;
  CHECK(same_bits(whole, solve(pieces(4, size), domain, PointSource::at(0), options)));
}

/// Progress comes to the calling thread, in order; what it throws or refuses ends the solve, and
/// the workspace, which is returned, serves the next one.
template <class Domain>
WorkspaceOf<OpenMP, Domain> check_reports(const OpenMP& executor, const Domain& domain,
                                          PropagateOptions options) {
  const auto caller = std::this_thread::get_id();
  std::size_t calls = 0, last = 0;
  bool in_order = true;
  options.progress = [&](const Progress& p) {
    ++calls;
    in_order = in_order && std::this_thread::get_id() == caller && p.expansions > last &&
               p.reached <= p.simplices && p.distance > 0;
    last = p.expansions;
    return true;
  };
  const auto whole = solve(executor, domain, PointSource::at(0), options);
  CHECK(calls >= 1);
  CHECK(in_order);

  WorkspaceOf<OpenMP, Domain> workspace;
  DistanceField<RealOf<Domain>> field;
  const PointSource source[] = {PointSource::at(0)};
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(solve(executor, domain, source, options, workspace, field), Cancelled);
  struct Own {};
  options.progress = [](const Progress&) -> bool { throw Own{}; };
  CHECK_THROWS_AS(solve(executor, domain, source, options, workspace, field), Own);
  options.progress = nullptr;
  solve(executor, domain, source, options, workspace, field);
  CHECK(same_bits(whole, field));
  return workspace;
}

/// So many sources that queues grow; then with offsets that no source beats, so that all wait far
/// apart, most in vain.
inline void check_every_vertex_a_source(const PropagateOptions& options, double within) {
  const auto mesh = grid(40, 40).mesh<float>();
  std::vector<PointSource> sources;
  for (Index v = 0; v < mesh.vertex_count(); ++v) sources.push_back(PointSource::at(v));
  const auto all = solve(pieces(3, 100), mesh, sources, options);
  std::size_t wrong = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    wrong += all.distance[v] != 0 || all.label[v] != v;
  CHECK(wrong == 0);
  std::mt19937 random(3);
  for (PointSource& s : sources) s.offset = 100 * uniform(random);
  sources[7].offset = 0;
  const auto field = solve(pieces(3, 100), mesh, sources, options);
  CHECK(parity(solve(Serial{}, mesh, sources, options), field).worst < within);
}

}  // namespace plexway::testing
