#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <sstream>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/solve/options.hpp>
#include <plexway/source/point_source.hpp>

namespace plexway {

/// A source on a crack: its place in the list, and how near is too near.
struct OnCrack {
  Index number;
  double near;
};

/// Throws UsageError that names it.
[[noreturn]] inline void refuse(const OnCrack& found, const PointSource& source,
                                const char* simplex) {
  std::ostringstream text;
  if (source.vertex != none)
    text << "source vertex " << source.vertex;
  else
    text << "a source in " << simplex << ' ' << source.simplex;
  text << " lies on a crack in the solid, or nearer to one than " << found.near
       << ", and would be seen through it: take a point farther from it, or the same point on both "
          "sides";
  throw UsageError(text.str());
}

/// Sources on the faces of cracks: two faces of the boundary lie on each other there, and
/// coordinates do not say on which of them a source is. Strings would be walked to it through the
/// crack, so the vertex on its other side would be at 0.
template <class Real>
class CrackSources {
 public:
  /// So near to a crack, in mean edges, a source cannot be told from one on it: found by random
  /// plans, of which some are wrong up to 0.01 (docs/log/experiments.md).
  static constexpr double near = 0.02;

  CrackSources(const TetMesh<Real>& mesh, std::span<const PointSource> sources)
      : mesh_(mesh), tets_(mesh.tets().first(mesh.tet_count())), sources_(sources) {}

  /// One such source. One whose other side is a source as well, with no greater offset, does no
  /// harm. Cost: the mesh's edges at which paths bend; with a crack among them linear, plus
  /// boundary faces and sources that have about the same x.
  std::optional<OnCrack> find() {
    if (!mesh_.has_crack()) return {};
    place();
    std::optional<OnCrack> found;
    over_boundary([&](const Face& face, Placed& p) {
      if (is_in_front(face, p)) p.normals.push_back(face.inward);
    });
    over_boundary([&](const Face& face, const Placed& p) {
      if (!found && is_behind(face, p) && !is_shared(p, face.tet) && connected(p, face.tet))
        found = {p.number, near * mesh_.unit()};
    });
    return found;
  }

 private:
  using Point = Vector3<double>;
  struct Placed {
    Point at;
    std::array<Index, 4> support;  // corners that it lies between, then none
    Index number;
    double offset;
    std::vector<Point> normals;  // into the solid, of faces that it lies in or right in front of
  };
  struct Face {
    Index tet;
    std::array<Index, 3> corner;
    Point a, b, c;
    Point inward;  // unit
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
  template <std::size_t N>
  static bool lies_in(const Placed& p, const std::array<Index, N>& corners) {
    return std::all_of(p.support.begin(), p.support.end(), [&](Index v) {
      return v == none || std::find(corners.begin(), corners.end(), v) != corners.end();
    });
  }

  void place() {
    for (Index n = 0; n < sources_.size(); ++n) {
      const PointSource& source = sources_[n];
      Placed placed{{0, 0, 0}, {none, none, none, none}, n, source.offset, {}};
      if (source.vertex != none) {
        const Index v = mesh_.inside_vertex(source.vertex);
        if (mesh_.corners_at(v).empty()) continue;
        placed.support[0] = v;
        placed.at = point(v);
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

  auto from_x(double x) {
    return std::lower_bound(placed_.begin(), placed_.end(), x,
                            [](const Placed& placed, double least) { return placed.at.x < least; });
  }

  // Calls look(face, source) for faces of the boundary, and sources at most so near along x.
  template <class Look>
  void over_boundary(const Look& look) {
    for (Index t = 0; t < tets_.size(); ++t)
      for (Index i = 0; i < 4; ++i) {
        if (!is_boundary(t, i)) continue;
        Face face{t, {}, {}, {}, {}, {}};
        for (Index k = 0, n = 0; k < 4; ++k)
          if (k != i) face.corner[n++] = tets_[t].corner[k];
        face.a = point(face.corner[0]);
        face.b = point(face.corner[1]);
        face.c = point(face.corner[2]);
        const double end = most(face.a.x, face.b.x, face.c.x) + near;
        auto p = from_x(least(face.a.x, face.b.x, face.c.x) - near);
        if (p == placed_.end() || p->at.x > end) continue;
        face.inward = cross(face.b - face.a, face.c - face.a);
        double volume = dot(face.inward, point(tets_[t].corner[i]) - face.a);
        if (volume < 0) face.inward = -1. * face.inward, volume = -volume;
        const double area = norm(face.inward);
        if (!(volume > rounding_ * area)) continue;  // flat: nothing to see there
        face.inward = 1 / area * face.inward;
        for (; p != placed_.end() && p->at.x <= end; ++p) look(face, *p);
      }
  }

  static double height(const Face& face, const Placed& p) {
    return dot(face.inward, p.at - face.a);
  }
  // Does a perpendicular from the source meet the face?
  bool is_over(const Face& face, const Placed& p) const {
    const auto share = [&](const Point& from, const Point& to) {
      return dot(face.inward, cross(to - from, p.at - from));
    };
    const std::array<double, 3> shares = {share(face.b, face.c), share(face.c, face.a),
                                          share(face.a, face.b)};
    const double sum = shares[0] + shares[1] + shares[2];
    return least(shares[0] / sum, shares[1] / sum, shares[2] / sum) >= -1e-9 - rounding_;
  }
  bool is_in_front(const Face& face, const Placed& p) const {
    if (lies_in(p, face.corner)) return true;
    const double h = height(face, p);
    return h >= -rounding_ && h <= near && is_over(face, p);
  }
  // Is a source right behind a face of the boundary, and in front of one the other way round?
  bool is_behind(const Face& face, const Placed& p) const {
    const auto opposed = [&](const Point& normal) { return dot(normal, face.inward) < -.5; };
    const double h = height(face, p);
    return h >= -near && h <= rounding_ &&
           std::any_of(p.normals.begin(), p.normals.end(), opposed) &&
           !lies_in(p, std::to_array(tets_[face.tet].corner)) && is_over(face, p);
  }

  // Is its place, as tetrahedron t has it, a source as well, and no later?
  bool is_shared(const Placed& p, Index t) {
    for (auto q = from_x(p.at.x - near); q != placed_.end() && q->at.x <= p.at.x + near; ++q)
      if (q->offset <= p.offset && norm(q->at - p.at) <= near &&
          lies_in(*q, std::to_array(tets_[t].corner)))
        return true;
    return false;
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
  double rounding_ = 0;
};

/// One on a crack, where strings are walked to sources.
template <class Real>
std::optional<OnCrack> source_on_crack(const TetMesh<Real>& mesh,
                                       std::span<const PointSource> sources,
                                       const PropagateOptions& options) {
  if (!mesh.embedded() || options.visibility != Visibility::saddles) return {};
  return CrackSources<Real>(mesh, sources).find();
}

}  // namespace plexway
