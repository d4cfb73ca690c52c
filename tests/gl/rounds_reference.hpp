#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>
#include <plexway/propagate/saddle_step.hpp>

#include "executors/gl/surface_seeds.hpp"

namespace plexway::testing {

/// What the shaders do with a surface, one entry after another on the processor: the same rounds,
/// the same arithmetic, in plain C++, whatever the size of a front. (Only where nothing is pinched
/// and nothing must be revived.)
class RoundsReference {
 public:
  using Kernel = kernel::SaddleKernel<float>;

  RoundsReference(const TriangleMesh<float>& mesh, std::span<const PointSource> sources, float step)
      : mesh_(mesh),
        triangles_(mesh.triangles()),
        best_(mesh.face_count(), infinity),
        known_(mesh.face_count(), infinity),
        labels_(mesh.face_count()) {
    Workspace<float> workspace;
    gl::SurfaceSeeds seeds;
    seeds.add(mesh, sources, 0, workspace);
    std::vector<Entry> current;
    for (std::size_t n = 0; n < seeds.waiting.size(); ++n) {
      const auto& s = seeds.labels[n];
      Entry e;
      e.triangle = seeds.waiting[n].cell;
      e.edge = s.via & 3;
      e.source = s.via >> 2;
      e.distance = std::bit_cast<float>(seeds.waiting[n].distance);
      e.label.source = Kernel::saddle_point(s.x[0], s.h);
      e.label.limit[0] = Kernel::saddle_point(s.x[0] + s.x[2], s.h + s.limit_h[0]);
      e.label.limit[1] = Kernel::saddle_point(s.x[0] + s.x[3], s.h + s.limit_h[1]);
      e.label.sigma = s.x[1];
      best_[e.triangle] = std::min(best_[e.triangle], e.distance);
      current.push_back(e);
    }
    limit_ = step;
    for (bool was_far = true; !current.empty();) {
      float nearest = infinity;
      const std::vector<Entry> settled = settle(current, nearest);
      for (const Entry& e : settled) expand(e);
      current.clear();
      if (!near_.empty()) {
        std::swap(current, near_);
        was_far = false;
      } else if (!far_.empty()) {
        const bool stuck = was_far && settled.empty() && nearest < infinity;
        limit_ = (stuck ? nearest : limit_) + step;
        std::swap(current, far_);
        was_far = true;
      }
    }
    read_out(seeds);
  }

  /// In the numbers and the unit of the caller.
  [[nodiscard]] std::vector<float> distance() const {
    std::vector<float> all;
    for (const Index v : mesh_.vertices_inside())
      all.push_back(vertex_[v] * static_cast<float>(mesh_.unit()));
    return all;
  }

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  struct Entry {
    Index triangle = 0;
    std::size_t edge = 0;
    float distance = 0;
    Index source = 0;
    Kernel::PosedSaddles label;
  };

  // A label at rest keeps its limits as offsets, which rounds.
  static void rest(Kernel::PosedSaddles& p) {
    for (auto& limit : p.limit) {
      limit.x[0] = p.source.x[0] + (limit.x[0] - p.source.x[0]);
      limit.h = p.source.h + (limit.h - p.source.h);
    }
  }

  // Of the least offers to a triangle that of the first source, then hinge, becomes its label.
  std::vector<Entry> settle(const std::vector<Entry>& waiting, float& nearest) {
    std::map<Index, Entry> won;
    for (const Entry& e : waiting) {
      if (best_[e.triangle] != e.distance) continue;
      if (e.distance >= limit_) {
        nearest = std::min(nearest, e.distance);
        far_.push_back(e);
        continue;
      }
      const auto [place, first] = won.try_emplace(e.triangle, e);
      const Entry& other = place->second;
      if (!first && std::pair(e.source, e.edge) < std::pair(other.source, other.edge))
        place->second = e;
    }
    std::vector<Entry> all;
    for (const auto& [triangle, e] : won) {
      labels_[triangle] = e;
      known_[triangle] = e.distance;
      all.push_back(e);
    }
    return all;
  }

  void expand(const Entry& e) {
    const TriangleRecord<float>& t = triangles_[e.triangle];
    for (const bool left : {true, false}) {
      const std::size_t out = left ? edge_before(e.edge) : edge_after(e.edge);
      const std::size_t corner = left ? e.edge : out;
      const auto here = Kernel::turn_label(e.label, left, t.length[e.edge], t.length[out],
                                           t.cosine[corner], t.sine(corner));
      Index across = t.across[out];
      bool mirrored = (across & Across::flip) != 0;
      for (;;) {
        const Index g = across >> Across::face_shift;
        const std::size_t k = across & Across::edge_mask;
        if (g == mesh_.face_count() || (g == e.triangle && k == out)) break;
        offer(e, here, left ? 0 : 1, mirrored, g, k);
        if ((across & Across::fan) == 0) break;
        across = triangles_[g].across[k];
        mirrored = mirrored == ((across & Across::flip) != 0);
      }
    }
  }

  void offer(const Entry& from, Kernel::PosedSaddles label, int pivot, bool mirrored, Index g,
             std::size_t k) {
    const TriangleRecord<float>& t = triangles_[g];
    if (mirrored) label = Kernel::mirror_label(label, t.length[k]);
    Kernel::SaddleHinge hinge;
    hinge.extent = t.length[k];
    hinge.apex = Kernel::saddle_point(t.apex_x(k), t.apex_h(k));
    hinge.saddle[0] = t.saddle(k);
    hinge.saddle[1] = t.saddle(edge_after(k));
    hinge.pivot = mirrored ? 1 - pivot : pivot;
    const auto crossed = Kernel::cross_hinge(label, hinge, false);
    const float gain = 1 - 16 * std::numeric_limits<float>::epsilon();
    // A gain must be more than rounding; of several offers in one round the least is taken.
    if (!(crossed.distance < known_[g] * gain && crossed.distance <= best_[g])) return;
    best_[g] = crossed.distance;
    Entry e{g, k, crossed.distance, from.source, crossed.label};
    rest(e.label);
    (e.distance < limit_ ? near_ : far_).push_back(e);
  }

  void read_out(const gl::SurfaceSeeds& seeds) {
    vertex_.assign(mesh_.vertex_count(), infinity);
    for (const auto& offer : seeds.offers)
      vertex_[offer.vertex] = std::min(vertex_[offer.vertex], std::bit_cast<float>(offer.distance));
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (best_[f] == infinity) continue;
      const TriangleRecord<float>& t = triangles_[f];
      const std::size_t in = labels_[f].edge;
      const float length = t.length[in];
      const auto at = [&](std::size_t corner, float x, float h) {
        float& d = vertex_[t.corner[corner]];
        d = std::min(d, Kernel::path_length(labels_[f].label, length, Kernel::saddle_point(x, h)));
      };
      at(in, 0, 0);
      at(edge_after(in), length, 0);
      at(edge_before(in), t.apex_x(in), t.apex_h(in));
    }
    for (bool any = true; any;) {
      any = false;
      for (Index f = 0; f < mesh_.face_count(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
          const TriangleRecord<float>& t = triangles_[f];
          float &a = vertex_[t.corner[i]], &b = vertex_[t.corner[edge_after(i)]];
          if (a + t.length[i] < b) b = a + t.length[i], any = true;
          if (b + t.length[i] < a) a = b + t.length[i], any = true;
        }
    }
  }

  const TriangleMesh<float>& mesh_;
  std::span<const TriangleRecord<float>> triangles_;
  std::vector<float> best_, known_, vertex_;
  std::vector<Entry> labels_, near_, far_;
  float limit_ = 0;
};

}  // namespace plexway::testing
