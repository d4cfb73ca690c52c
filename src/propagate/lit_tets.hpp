#pragma once

#include <algorithm>
#include <bit>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <plexway/complex/tet_mesh.hpp>

namespace plexway {

/// Tetrahedra that a virtual source is known to see whole, so that lines to it need not be walked
/// beyond them. A tetrahedron is seen whole if those behind all of its faces that the source is in
/// front of are. What is known stays true, whatever labels become; for one thread.
///
/// Memory: a point a tetrahedron, which every solve begins with once.
template <class Real>
class LitTets {
 public:
  using Point = Vector3<Real>;

  /// No tetrahedron is lit.
  void start(std::size_t tets) {
    constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
    known_.assign(tets + 1, Known{Point{nan, nan, nan}, false});
    sentinel_ = static_cast<Index>(tets);
    sources_.reset();
  }

  /// May any be lit by this source? Cheap, so that lines to other points need not ask each.
  [[nodiscard, gnu::always_inline]] bool any_by(const Point& source) const {
    return sources_[name_of(source)];
  }

  [[nodiscard, gnu::always_inline]] bool by(Index t, const Point& source) const {
    return asked(t, source) && known_[t].lit;
  }

  /// Finds out whether the source sees all of t, as far as that follows from tetrahedra of which
  /// `asks(t)` says that they may be asked about.
  template <class Asks>
  bool look(const TetMesh<Real>& mesh, Index t, const Point& source, const Asks& asks,
            int depth = 0) {
    if (t == sentinel_) return false;
    if (asked(t, source)) return known_[t].lit;
    if (depth == deepest || !asks(t)) return false;
    known_[t] = {source, false};  // also while it is found out: rings of tetrahedra end here
    const TetRecord<Real>& record = mesh.tets()[t];
    const Point* points = mesh.points().data();
    bool behind_one = false;
    Real widest = 0;
    for (Index i = 0; i < 4; ++i) {
      const Point& a = points[record.corner[(i + 1) & 3]];
      const Point n =
          cross(points[record.corner[(i + 2) & 3]] - a, points[record.corner[(i + 3) & 3]] - a);
      const Point across = points[record.corner[i]] - a;
      const Real size = norm(n), height = dot(n, across);
      if (!(std::abs(height) > flat * size)) return false;
      // How far in front of the face, outside of t.
      const Real front = height < 0 ? dot(n, source - a) : -dot(n, source - a);
      widest = std::max(widest, dot(across, across));
      if (!(front > on_plane * size)) continue;
      if (!look(mesh, record.across[i] >> TetAcross::tet_shift, source, asks, depth + 1))
        return false;
      behind_one = true;
    }
    const Point off = source - record.centre;
    if (!behind_one && !(dot(off, off) <= widest)) return false;
    sources_.set(name_of(source));
    return known_[t].lit = true;
  }

  [[nodiscard]] std::size_t bytes() const { return known_.capacity() * sizeof(Known); }

 private:
  struct Known {
    Point source;
    bool lit;
  };
  static constexpr int names = 12;  // bits
  [[nodiscard, gnu::always_inline]] static std::size_t name_of(const Point& p) {
    const Real sum = p.x + Real(1.618) * p.y + Real(2.718) * p.z;
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    return static_cast<std::size_t>(std::bit_cast<Bits>(sum) * std::uint64_t{0x9e3779b97f4a7c15} >>
                                    (64 - names));
  }
  [[nodiscard, gnu::always_inline]] bool asked(Index t, const Point& source) const {
    const Point& p = known_[t].source;
    return p.x == source.x && p.y == source.y && p.z == source.z;
  }

  static constexpr int deepest = 64;
  /// In mean edges: flatter tetrahedra are left alone, and a face whose plane is so near to the
  /// source has it in that plane.
  static constexpr Real flat = Real(1e-2);
  static constexpr Real on_plane = sizeof(Real) == sizeof(double) ? Real(1e-6) : Real(1e-5);

  std::vector<Known> known_;
  std::bitset<std::size_t{1} << names> sources_;  // that light any, by names that some share
  Index sentinel_ = 0;
};

}  // namespace plexway
