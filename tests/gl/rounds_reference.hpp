#pragma once

#include <algorithm>
#include <bit>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "executors/gl/seeds.hpp"
#include "labels/surface/saddle_step.hpp"

namespace plexway::testing {
using namespace detail;

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
    WorkspaceState<float> workspace;
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
      e.label.sigma = s.x[1];
      for (std::size_t i = 0; i < 2; ++i)
        e.limit(i, Kernel::saddle_point(s.x[2 + i], s.limit_h[i]));
      best_[e.triangle] = std::min(best_[e.triangle], e.distance);
      current.push_back(e);
    }
    limit_ = step;
    for (bool was_far = true; !current.empty();) {
      float nearest = infinity;
      std::vector<Entry> settled = settle(current, nearest);
      narrow(settled);
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
    Kernel::HingePoint offset[2];  // of the limits

    // A label at rest keeps its limits as offsets, which rounds.
    void limit(std::size_t i, Kernel::HingePoint by) {
      offset[i] = by;
      label.limit[i] = Kernel::saddle_point(label.source.x[0] + by.x[0], label.source.h + by.h);
    }
    void limit_at(std::size_t i, Kernel::HingePoint p) {
      limit(i, Kernel::saddle_point(p.x[0] - label.source.x[0], p.h - label.source.h));
    }
  };

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

  // Limits heard from neighbours: all hear, and then all change.
  void narrow(std::vector<Entry>& settled) {
    for (Entry& e : settled) hear(e);
    for (const Entry& e : settled) labels_[e.triangle] = e;
  }
  void hear(Entry& e) const {
    const TriangleRecord<float>& t = triangles_[e.triangle];
    const std::size_t before = edge_before(e.edge), after = edge_after(e.edge);
    const float x = e.label.source.x[0], h = e.label.source.h, width = t.length[e.edge];
    const float to_left = x * t.sine(e.edge) + h * t.cosine[e.edge];
    const float to_right = (width - x) * t.sine(after) + h * t.cosine[after];
    const float noise =
        64 * std::numeric_limits<float>::epsilon() * (std::abs(x) + std::abs(h) + width);
    // Only where the source lies beyond an edge that the label did not come by.
    if (h < 0 || std::min(to_left, to_right) >= -noise) return;
    const bool left = to_left < to_right;
    const std::size_t over = left ? before : after, corner = left ? e.edge : over;
    const Index g = t.across[over] >> Across::face_shift;
    const std::size_t k = t.across[over] & Across::edge_mask;
    if ((t.across[over] & Across::special) != 0 || g == mesh_.face_count()) return;
    const Entry& other = labels_[g];
    if (known_[g] == infinity || other.edge == k || other.source != e.source) return;
    const float close = e.distance / 128;
    if (std::abs(other.label.sigma - e.label.sigma) > close) return;
    bool another = false;  // is one of its limits at another distance?
    for (std::size_t i = 0; i < 2; ++i) {
      const auto length2 = [&](const Entry& of) {
        return of.offset[i].x[0] * of.offset[i].x[0] + of.offset[i].h * of.offset[i].h;
      };
      another |= std::abs(length2(other) - length2(e)) > 0.01F * length2(other);
    }
    if (!another) return;
    const TriangleRecord<float>& u = triangles_[g];
    const bool turns_left = k == edge_before(other.edge);
    const std::size_t around = turns_left ? other.edge : k;
    const auto there = Kernel::turn_label(other.label, turns_left, u.length[other.edge],
                                          u.length[k], u.cosine[around], u.sine(around));
    const auto found = Kernel::narrow_limits(
        e.label, there, left, width, t.length[over], t.cosine[corner], t.sine(corner),
        Kernel::saddle_point(t.apex_x(e.edge), t.apex_h(e.edge)), close);
    for (std::size_t i = 0; i < 2; ++i)
      if (found.narrower[i]) e.limit_at(i, found.limit[i]);
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
    Entry e{g, k, crossed.distance, from.source, crossed.label, {}};
    for (std::size_t i = 0; i < 2; ++i) e.limit_at(i, crossed.label.limit[i]);
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
