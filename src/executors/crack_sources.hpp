#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>
#include <plexway/error.hpp>
#include <plexway/propagate/options.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// Sources on the faces of cracks: two faces of the boundary lie on each other there, and
/// coordinates do not say on which of them a source is. Strings would be walked to it through the
/// crack, so the vertex on its other side would be at 0.
template <class Real>
class CrackSources {
 public:
  /// So near to a crack, in mean edges, a source cannot be told from one on it: found by random
  /// plans, of which some are wrong up to 0.01 (docs/EXPERIMENTS.md).
  static constexpr double near = 0.02;

  CrackSources(const TetMesh<Real>& mesh, std::span<const PointSource> sources)
      : mesh_(mesh), tets_(mesh.tets().first(mesh.tet_count())), sources_(sources) {}

  /// Throws UsageError that names the first such source. One whose other side is a source as well
  /// does no harm. Cost: the mesh's edges at which paths bend; with a crack among them linear, plus
  /// sources beside each other.
  void check() {
    const auto edges = mesh_.reflex_edges();
    if (std::none_of(edges.begin(), edges.end(), [](const auto& e) { return is_crack(e); })) return;
    place();
    for (Index t = 0; t < tets_.size(); ++t)
      for (Index face = 0; face < 4; ++face)
        if (is_boundary(t, face)) look_behind(t, face);
  }

 private:
  using Point = Vector3<double>;
  struct Placed {
    Point at;
    std::array<Index, 4> support;  // corners that it lies between, then none
    Index number;
  };

  bool is_boundary(Index t, Index face) const {
    return tets_[t].across[face] >> TetAcross::tet_shift >= tets_.size();
  }
  Point point(Index vertex) const {
    const auto& p = mesh_.points()[vertex];
    return {double(p.x), double(p.y), double(p.z)};
  }
  static double least(double a, double b, double c) { return std::min(a, std::min(b, c)); }
  static double most(double a, double b, double c) { return std::max(a, std::max(b, c)); }

  void place() {
    is_source_.assign(mesh_.points().size(), 0);
    for (Index n = 0; n < sources_.size(); ++n) {
      const PointSource& source = sources_[n];
      Placed placed{{0, 0, 0}, {none, none, none, none}, n};
      if (source.vertex != none) {
        const Index v = mesh_.inside_vertex(source.vertex);
        if (mesh_.corners_at(v).empty()) continue;
        placed.support[0] = v;
        placed.at = point(v);
        is_source_[v] = 1;
      } else {
        std::array<double, 4> b = source.barycentric;
        const auto [t, turned] = mesh_.inside_tet(source.simplex);
        if (turned) std::swap(b[2], b[3]);
        std::size_t corners = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          if (b[i] == 0) continue;
          placed.support[corners++] = tets_[t].corner[i];
          placed.at = placed.at + b[i] * point(tets_[t].corner[i]);
        }
      }
      placed_.push_back(placed);
    }
    std::sort(placed_.begin(), placed_.end(),
              [](const Placed& a, const Placed& b) { return a.at.x < b.at.x; });
    double far = 1;
    for (const auto& p : mesh_.points())
      far =
          std::max(far, most(std::abs(double(p.x)), std::abs(double(p.y)), std::abs(double(p.z))));
    rounding_ = 64 * double(std::numeric_limits<Real>::epsilon()) * far;
  }

  // Sources behind a face of the boundary, or on it without being its own.
  void look_behind(Index t, Index face) const {
    std::array<Index, 3> corner{};
    for (Index i = 0, k = 0; i < 4; ++i)
      if (i != face) corner[k++] = tets_[t].corner[i];
    const Point a = point(corner[0]), b = point(corner[1]), c = point(corner[2]);
    const double begin = least(a.x, b.x, c.x) - near, end = most(a.x, b.x, c.x) + near;
    auto p = std::lower_bound(placed_.begin(), placed_.end(), begin,
                              [](const Placed& placed, double x) { return placed.at.x < x; });
    for (; p != placed_.end() && p->at.x <= end; ++p) {
      const auto is_corner = [&](Index v) {
        return v == none || std::find(corner.begin(), corner.end(), v) != corner.end();
      };
      if (std::all_of(p->support.begin(), p->support.end(), is_corner)) continue;  // lies in it
      Point inward = cross(b - a, c - a);
      double volume = dot(inward, point(tets_[t].corner[face]) - a);
      if (volume < 0) inward = -1. * inward, volume = -volume;
      const double area = norm(inward);
      if (!(volume > rounding_ * area)) continue;  // flat: nothing to see there
      const double height = dot(inward, p->at - a) / area;
      if (height < -near || height > rounding_) continue;
      // Where a perpendicular meets the face.
      const std::array<double, 3> share = {dot(inward, cross(c - b, p->at - b)),
                                           dot(inward, cross(a - c, p->at - c)),
                                           dot(inward, cross(b - a, p->at - a))};
      const double sum = share[0] + share[1] + share[2];
      const double missed = 1e-9 + rounding_;
      if (least(share[0] / sum, share[1] / sum, share[2] / sum) < -missed) continue;
      if (is_shared(*p, corner) || !connected(*p, t)) continue;
      const PointSource& source = sources_[p->number];
      throw UsageError(
          (source.vertex != none ? "source vertex " + std::to_string(source.vertex)
                                 : "a source in tet " + std::to_string(source.simplex)) +
          " lies on the face of a crack in the solid, through which paths would start: take a "
          "point in a tetrahedron beside it, a tenth of the way to its centre, or the vertices on "
          "both sides");
    }
  }

  // Is the place of p, as the face has it, a source as well?
  bool is_shared(const Placed& p, const std::array<Index, 3>& corner) const {
    std::size_t started = 0;
    for (const Index v : corner) {
      if (!is_source_[v]) continue;
      ++started;
      if (norm(point(v) - p.at) <= near) return true;
    }
    return started == corner.size();
  }

  // Does a way through tetrahedra lead from p to t? Rarely asked.
  bool connected(const Placed& p, Index t) const {
    std::vector<char> seen(tets_.size(), 0);
    std::vector<Index> next;
    for (const Index corner : mesh_.corners_at(p.support[0])) {
      if (seen[corner / 4]) continue;
      seen[corner / 4] = 1;
      next.push_back(corner / 4);
    }
    while (!next.empty() && !seen[t]) {
      const Index from = next.back();
      next.pop_back();
      for (Index face = 0; face < 4; ++face) {
        if (is_boundary(from, face)) continue;
        const Index to = tets_[from].across[face] >> TetAcross::tet_shift;
        if (!seen[to]) seen[to] = 1, next.push_back(to);
      }
    }
    return seen[t] != 0;
  }

  const TetMesh<Real>& mesh_;
  std::span<const TetRecord<Real>> tets_;
  std::span<const PointSource> sources_;
  std::vector<Placed> placed_;  // by x
  std::vector<char> is_source_;
  double rounding_ = 0;
};

/// Throws UsageError for a source on a crack where strings are walked to sources.
template <class Real>
void check_cracks(const TetMesh<Real>& mesh, std::span<const PointSource> sources,
                  const PropagateOptions& options) {
  if (mesh.embedded() && options.visibility == Visibility::saddles)
    CrackSources<Real>(mesh, sources).check();
}

}  // namespace plexway
