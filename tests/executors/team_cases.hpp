#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "executors/parity.hpp"
#include "with_accuracy.hpp"

/// What every executor that shares a surface among threads must do as one thread does.
namespace plexway::testing {

/// A radius, an offset and a source inside a triangle, by labels.
inline void check_radius_and_offsets(const OpenMP& executor) {
  const auto mesh = grid(30, 30).mesh<double>();
  PropagateOptions options = by_labels();
  options.radius = 0.3;
  const PointSource sources[] = {
      {.vertex = 100, .offset = 0.05}, PointSource::in(700, {.2, .3, .5}), PointSource::at(900)};
  const auto alone = solve(Serial{}, mesh, sources, options);
  const auto field = solve(executor, mesh, sources, options);
  CHECK(field.distance[100] == 0.05);
  const Parity p = parity(alone, field);
  CHECK(p.reached_by_one == 0);
  CHECK(p.worst < 1e-12);
  std::size_t beyond = 0;
  for (const double d : field.distance) beyond += std::isinf(d);
  CHECK(beyond > 100);
  for (std::size_t v = 0; v < field.distance.size(); ++v)
    CHECK((field.label[v] == none) == std::isinf(field.distance[v]));
}

/// So many sources that queues grow; then with offsets that no source beats, so that all wait far
/// apart, most in vain.
inline void check_every_vertex_a_source(const OpenMP& executor) {
  const auto mesh = grid(40, 40).mesh<float>();
  std::vector<PointSource> sources;
  for (Index v = 0; v < mesh.vertex_count(); ++v) sources.push_back(PointSource::at(v));
  const auto all = solve(executor, mesh, sources, by_labels());
  bool own = true;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    own = own && all.distance[v] == 0 && all.label[v] == v;
  CHECK(own);
  std::mt19937 random(3);
  for (PointSource& s : sources) s.offset = 100 * uniform(random);
  sources[7].offset = 0;
  const auto field = solve(executor, mesh, sources, by_labels());
  CHECK(parity(solve(Serial{}, mesh, sources, by_labels()), field).worst < 1.5e-6);
}

/// Progress comes to the calling thread, in order; what it throws or refuses ends the solve, and
/// the workspace, which is returned, serves the next one.
inline Workspace<float> check_reports(const OpenMP& executor, PropagateOptions options) {
  const auto mesh = grid(200, 200).mesh<float>();
  const auto caller = std::this_thread::get_id();
  std::size_t calls = 0, last = 0;
  bool in_order = true;
  options.progress = [&](const Progress& p) {
    ++calls;
    in_order = in_order && std::this_thread::get_id() == caller && p.expansions > last &&
               p.simplices == mesh.face_count() && p.reached <= p.simplices && p.distance > 0;
    last = p.expansions;
    return true;
  };
  const auto whole = solve(executor, mesh, PointSource::at(0), options);
  CHECK(calls >= 1);
  CHECK(in_order);

  Workspace<float> workspace;
  DistanceField<float> field;
  const PointSource source[] = {PointSource::at(0)};
  options.progress = [](const Progress&) { return false; };
  CHECK_THROWS_AS(solve(executor, mesh, source, options, workspace, field), Cancelled);
  struct Own {};
  options.progress = [](const Progress&) -> bool { throw Own{}; };
  CHECK_THROWS_AS(solve(executor, mesh, source, options, workspace, field), Own);
  options.progress = nullptr;
  solve(executor, mesh, source, options, workspace, field);
  CHECK(same_bits(whole, field));
  return workspace;
}

}  // namespace plexway::testing
