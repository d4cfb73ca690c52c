#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <plexway/complex/triangle_mesh.hpp>

#include "propagate/curve_seeds.hpp"
#include "propagate/saddle_rule.hpp"

namespace plexway {

/// The light of curves in triangles that keep another label.
///
/// A triangle has one label, the best for its centre. Where the border of a lit strip leaves a
/// centre dark that is a label from the end of the line, and what light there was is lost: to the
/// lit corner and, where rows of triangles run nearly along the border, to all that the row would
/// have lit further on. So light goes on from the triangles that kept it, in labels of its own,
/// as long as some of it is left and its distance is about what is known.
/// Cost: one look at every triangle, and the propagation over the borders.
template <class Front>
class BorderLight {
 public:
  using Real = double;
  using Label = SaddleLabel<Real>;

  BorderLight(const TriangleMesh<Real>& mesh, const CurveSeeds& curves, const Front& known)
      : triangles_(mesh.triangles()), curves_(curves), known_(known) {
    slot_.assign(triangles_.size(), none);
  }

  /// offer(vertex, distance, source) for the corners of all triangles it got to.
  template <class Offer>
  void offer_corners(const Offer& offer) {
    SaddleRule<Real, BorderLight> rule(triangles_, *this, false);
    const Index faces = static_cast<Index>(triangles_.size() - 1);
    const auto cross = [&](Index f, std::size_t edge) { rule.cross(f, edge, false); };
    for (Index f = 0; f < faces; ++f) {
      for (std::size_t e = 0; e < 3 && known_.keeps_light(f) && !reached(f); ++e) {
        const Index across = triangles_[f].across[e];
        if ((!known_.keeps_light(across >> Across::face_shift) || (across & Across::special)) &&
            e != known_.hinge(f))
          cross(f, e);
      }
    }
    // Where lengths are no metric, refracted light may gain on itself without end.
    const std::size_t most = 64 * triangles_.size();
    for (std::size_t next = 0; next < waiting_.size() && next < most; ++next) {
      Entry& entry = entries_[slot_[waiting_[next]]];
      entry.waits = false;
      rule.expand(waiting_[next], cross);
    }
    for (const Entry& entry : entries_) {
      if (entry.face == faces) continue;
      for (std::size_t i = 0; i < 3; ++i)
        offer(triangles_[entry.face].corner[i], rule.corner_distance(entry.face, i), entry.source);
    }
  }

  // What a rule asks of a front. Until light gets to a triangle it has what is known.

  [[nodiscard]] bool reached(Index f) const { return slot_[f] != none; }
  [[nodiscard]] const Label& label(Index f) const {
    return reached(f) ? entries_[slot_[f]].label : known_.label(f);
  }
  [[nodiscard]] std::size_t hinge(Index f) const {
    return reached(f) ? entries_[slot_[f]].hinge : known_.hinge(f);
  }
  [[nodiscard]] Index source(Index f) const {
    return reached(f) ? entries_[slot_[f]].source : known_.source(f);
  }
  static constexpr bool expands_soon() { return false; }
  void put(Index f, const Label& label) { entry(f).label = label; }
  void narrow(Index f, const Label& label) { put(f, label); }

  void accept(Index f, std::size_t hinge, const Label& label, Real distance, Index source) {
    if (!is_light(label) || !known_.reached(f) || curves_.crosses(source, f)) return;
    const TriangleRecord<Real>& t = triangles_[f];
    const Real size = std::max({t.length[0], t.length[1], t.length[2]});
    const Real slack = known_.keeps_light(f) ? Real(0) : size / 2;
    if (!(distance < known_.label(f).distance() + slack)) return;
    Entry& e = entry(f);
    const bool waits = e.waits;
    e = {label, f, source, static_cast<std::uint8_t>(hinge), true};
    if (!waits) waiting_.push_back(f);
  }

 private:
  struct Entry {
    Label label;
    Index face, source;
    std::uint8_t hinge;
    bool waits;
  };

  // Only light starts at less than 0: bent, it is what the points of its line see as well.
  static bool is_light(const Label& label) { return label.sigma() < 0; }
  Entry& entry(Index f) {
    if (slot_[f] == none) {
      slot_[f] = static_cast<Index>(entries_.size());
      entries_.push_back({{}, f, none, 0, false});
    }
    return entries_[slot_[f]];
  }

  std::span<const TriangleRecord<Real>> triangles_;
  const CurveSeeds& curves_;
  const Front& known_;
  std::vector<Index> slot_;
  std::vector<Entry> entries_;
  std::vector<Index> waiting_;
};

}  // namespace plexway
