#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <random>
#include <span>
#include <vector>

#include <plexway/executors/surface_parts.hpp>
#include <plexway/solve.hpp>

#include "complexes/test_meshes.hpp"
#include "executors/thread_ranks.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing {

/// A surface as it would be read from a file; counts what is read.
class RowsOf final : public SurfaceRows {
 public:
  explicit RowsOf(const Surface& surface) : surface_(surface) {}
  [[nodiscard]] std::size_t vertex_count() const override { return surface_.positions.size(); }
  [[nodiscard]] std::size_t face_count() const override { return surface_.faces.size(); }
  void read_vertices(std::size_t first, std::span<Position> positions) const override {
    std::copy_n(surface_.positions.begin() + static_cast<std::ptrdiff_t>(first), positions.size(),
                positions.begin());
    vertices_read += positions.size();
  }
  void read_faces(std::size_t first, std::span<Face> corners) const override {
    std::copy_n(surface_.faces.begin() + static_cast<std::ptrdiff_t>(first), corners.size(),
                corners.begin());
    faces_read += corners.size();
  }

  mutable std::size_t vertices_read = 0, faces_read = 0;

 private:
  const Surface& surface_;
};

/// What several processes found, put together.
template <class Real>
struct Joined : PartField<Real> {
  SurfacePartsSummary summary;
  std::vector<std::size_t> own_faces;  ///< of each process
  bool agree = true;                   ///< where several have a vertex
  bool geometry = true;                ///< is what parts have what was read, each triangle once?
  bool reads_little = true;            ///< does each process read its share alone?

  [[nodiscard]] bool sound() const { return agree && geometry && reads_little; }
};

struct Scheduler {
  std::size_t ranks = 1;
  int threads = 1;
  std::size_t piece = 0;
};

/// Solves in parts by threads that meet as processes do; one alone has no ranks.
template <class Real>
Joined<Real> solve_in_parts(const Surface& surface, const Scheduler& scheduler,
                            const std::vector<PointSource>& sources,
                            const PropagateOptions& options = {}, int times = 1) {
  Joined<Real> all;
  std::mutex mutex;
  std::vector<char> known(surface.positions.size(), 0);
  std::vector<Face> faces;
  const auto take = [&](const SurfacePart& part, const PartField<Real>& field,
                        const SurfacePartsSummary& summary) {
    const std::scoped_lock lock(mutex);
    if (all.distance.empty()) {
      static_cast<PartField<Real>&>(all) = field;
      all.distance.assign(known.size(), 0);
      all.error.assign(known.size(), 0);
      all.label.assign(sources.size() > 1 ? known.size() : 0, none);
      all.summary = summary;
    }
    all.own_faces.push_back(summary.own_faces);
    all.agree &= field.reached == all.reached && field.mean_distance == all.mean_distance &&
                 field.max_distance == all.max_distance && field.farthest == all.farthest &&
                 field.statistics.expansions == all.statistics.expansions &&
                 summary.ghosts == all.summary.ghosts;
    all.geometry &= part.vertex.size() == field.distance.size() &&
                    std::is_sorted(part.vertex.begin(), part.vertex.end());
    const auto error = [&](std::size_t i) { return field.error.empty() ? 0 : field.error[i]; };
    for (std::size_t i = 0; i < part.vertex.size(); ++i) {
      const Index v = part.vertex[i];
      all.geometry &= part.position[i] == surface.positions[v];
      if (known[v] != 0)
        all.agree &= all.distance[v] == field.distance[i] && all.error[v] == error(i) &&
                     (all.label.empty() || all.label[v] == field.label[i]);
      known[v] = 1;
      all.distance[v] = field.distance[i];
      all.error[v] = error(i);
      if (!all.label.empty()) all.label[v] = field.label[i];
    }
    for (const Face& f : part.triangle)
      faces.push_back({part.vertex[f[0]], part.vertex[f[1]], part.vertex[f[2]]});
  };
  const auto work = [&](PieceRanks* ranks) {
    OpenMP executor{.threads = scheduler.threads, .piece = scheduler.piece};
    executor.ranks = ranks;
    const RowsOf rows(surface);
    SurfaceParts<Real> parts(executor, rows);
    const std::size_t n = ranks == nullptr ? 1 : ranks->count();
    {
      const std::scoped_lock lock(mutex);
      all.reads_little &= rows.faces_read <= surface.faces.size() / n + 1 &&
                          rows.vertices_read <= surface.positions.size() / n + 1;
    }
    PartField<Real> field;
    for (int i = 0; i < times; ++i) field = parts.solve(sources, options);
    take(parts.part(rows), field, parts.summary());
  };
  if (scheduler.ranks == 1)
    work(nullptr);
  else
    ThreadRanks(scheduler.ranks).run([&](PieceRanks& own) { work(&own); });
  auto expected = surface.faces;
  std::sort(expected.begin(), expected.end());
  std::sort(faces.begin(), faces.end());
  all.geometry &=
      faces == expected && std::find(known.begin(), known.end(), char{0}) == known.end();
  return all;
}

template <class Real>
bool same_bits(const Joined<Real>& a, const Joined<Real>& b) {
  return a.distance == b.distance && a.error == b.error && a.label == b.label &&
         a.reached == b.reached && a.mean_distance == b.mean_distance &&
         a.max_distance == b.max_distance && a.farthest == b.farthest &&
         a.statistics.expansions == b.statistics.expansions &&
         a.statistics.lowered_vertices == b.statistics.lowered_vertices;
}

/// Of triangles' vertices, since others are reached from nowhere; where there are several, from
/// inside a triangle and on an edge, too, and the last with an offset.
inline std::vector<PointSource> mixed_sources(const Surface& s, std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<PointSource> sources;
  for (std::size_t i = 0; i < count; ++i) {
    const Face& f = s.faces[below(random, s.faces.size())];
    sources.push_back(PointSource::at(f[below(random, 3)]));
  }
  if (count == 1) return sources;
  sources[1] = PointSource::in(below(random, s.faces.size()), {.2, .3, .5});
  sources[2] = PointSource::in(below(random, s.faces.size()), {.4, .6, 0});
  sources.back().offset = 0.01;
  return sources;
}

/// A sphere within a radius: what is nearer is within a share of the exact distance, what is
/// farther is not reached; the same bits by one process and by three.
inline void check_radius_in_parts(PropagateOptions options, double within) {
  const Surface s = sphere(4);
  const auto whole = solve(Serial{}, s.mesh<double>(), PointSource::at(5), at(Accuracy::exact()));
  options.radius = 1;
  std::vector<Joined<double>> found;
  for (const std::size_t ranks : {1u, 3u}) {
    found.push_back(solve_in_parts<double>(s, {ranks, 1, 40}, {PointSource::at(5)}, options));
    CHECK(found.back().sound());
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < s.positions.size(); ++v) {
      const double d = whole.distance[v];
      if (std::abs(d - 1) < within) continue;
      wrong += std::isfinite(found.back().distance[v]) != (d < 1) ||
               (d < 1 && std::abs(found.back().distance[v] - d) > within * d);
    }
    CHECK(wrong == 0);
  }
  CHECK(same_bits(found[0], found[1]));
}
/// No more is expanded than may be, whatever the processes.
inline void check_budget_in_parts(PropagateOptions options) {
  const Surface s = sphere(4);
  for (const std::size_t most : {0u, 1u, 100u, 1500u}) {
    options.max_expansions = most;
    const auto one = solve_in_parts<float>(s, {1, 1, 40}, {PointSource::at(5)}, options);
    CHECK(!one.complete);
    CHECK(one.statistics.expansions == most);
    CHECK(one.distance[5] == 0);
    CHECK(same_bits(one, solve_in_parts<float>(s, {3, 1, 40}, {PointSource::at(5)}, options)));
  }
}

}  // namespace plexway::testing
