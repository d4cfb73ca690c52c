#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

#include <plexway/error.hpp>
#include <plexway/openvdb/solid.hpp>
#include <plexway/solid/detail/tet_record.hpp>

#include "answer.hpp"
#include "lattice.hpp"

namespace plexway::openvdb {

using namespace detail;
namespace {

// Cuts one tetrahedron of the lattice: corners 0 1 are the ends of one long edge, 2 3 of the
// other.
//
// `side` is -1 inside, 0 on the surface, 1 outside; `doubled` are the corners' coordinates.
// `corner(i)` and `cut(i, j)`, from i inside to j outside, give vertices, `emit(a, b, c, d)` takes
// tetrahedra in any orientation. A quadrilateral on a face is halved by a rule that looks at the
// face alone, so that neighbours agree.
// Source: Labelle, Shewchuk, Isosurface Stuffing, figure 3.
template <class Corner, class Cut, class Nearer, class Emit>
void cut_tet(const std::array<int, 4>& side,
             const std::array<std::array<std::int32_t, 3>, 4>& doubled, Corner corner, Cut cut,
             Nearer nearer, Emit emit) {
  std::array<std::size_t, 4> in{}, on{}, out{};
  std::size_t ins = 0, ons = 0, outs = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (side[i] < 0)
      in[ins++] = i;
    else if (side[i] == 0)
      on[ons++] = i;
    else
      out[outs++] = i;
  }
  if (ins == 0) return;
  if (outs == 0) return emit(corner(0), corner(1), corner(2), corner(3));
  if (ins == 1) {
    std::array<std::uint32_t, 4> v{};
    for (std::size_t i = 0; i < 4; ++i) v[i] = side[i] > 0 ? cut(in[0], i) : corner(i);
    return emit(v[0], v[1], v[2], v[3]);
  }
  // Of the face i j o with o outside: whether the diagonal starts at i, and so ends on the edge j
  // o.
  const auto from_first = [&](std::size_t i, std::size_t j, std::size_t o) {
    if ((o ^ 1) == i) return false;  // it ends on the long edge, if that is cut
    if ((o ^ 1) == j) return true;
    int greater = 0;
    for (std::size_t k = 0; k < 3; ++k) greater += doubled[i][k] > doubled[o][k];
    return greater % 2 == 0;
  };
  if (ins == 2) {
    const auto [a, b] = std::array{in[0], in[1]};
    const std::uint32_t a0 = corner(a), b0 = corner(b);
    const std::size_t r = out[0];
    const std::uint32_t a1 = cut(a, r), b1 = cut(b, r);
    if (outs == 1) {
      const std::uint32_t top = corner(on[0]);
      if (from_first(a, b, r)) {
        emit(a0, b0, b1, top);
        return emit(a0, b1, a1, top);
      }
      emit(a0, b0, a1, top);
      return emit(b0, b1, a1, top);
    }
    const std::size_t s = out[1];
    const std::uint32_t a2 = cut(a, s), b2 = cut(b, s);
    const bool at_r = from_first(a, b, r), at_s = from_first(a, b, s);
    if (at_r && at_s) {
      emit(a0, b0, b1, b2);
      if (nearer(a1, b2, a2, b1)) {
        emit(a0, a1, a2, b2);
        return emit(a0, a1, b1, b2);
      }
      emit(a0, a1, a2, b1);
      return emit(a0, a2, b1, b2);
    }
    if (!at_r && !at_s) {
      emit(b0, a0, a1, a2);
      if (nearer(a1, b2, a2, b1)) {
        emit(b0, b1, b2, a1);
        return emit(b0, a1, a2, b2);
      }
      emit(b0, b1, b2, a2);
      return emit(b0, a1, a2, b1);
    }
    if (at_r) {  // diagonals a0 b1 and b0 a2, so a2 b1
      emit(a0, a1, a2, b1);
      emit(a0, a2, b0, b1);
      return emit(a2, b0, b1, b2);
    }
    emit(a0, a1, a2, b2);  // a0 b2 and b0 a1, so a1 b2
    emit(a0, a1, b0, b2);
    return emit(a1, b0, b1, b2);
  }
  // Three inside: a prism. Diagonals start twice at one corner, once at another.
  const std::size_t o = out[0];
  std::array<int, 3> wins{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j) ++wins[from_first(in[i], in[j], o) ? i : j];
  std::array<std::size_t, 3> order{};  // by wins, most first; they are 2, 1, 0
  for (std::size_t i = 0; i < 3; ++i) order[static_cast<std::size_t>(2 - wins[i])] = in[i];
  const auto [t, m, l] = order;
  const std::uint32_t cm = cut(m, o), cl = cut(l, o);
  emit(corner(t), corner(m), corner(l), cl);
  emit(corner(t), corner(m), cm, cl);
  emit(corner(t), cut(t, o), cm, cl);
}

class Cutter {
 public:
  Cutter(const Bricks& bricks, double spacing)
      : frame_(bricks.frame),
        spacing_(spacing),
        lattice_(bricks, spacing),
        number_(lattice_.points(), Lattice::none) {}

  // All tetrahedra, or with `shell` those alone that have a corner on the surface or outside.
  void run(bool shell) {
    for (std::uint32_t b = 0; b < lattice_.bricks(); ++b) {
      const Lattice::Around around = lattice_.around(b);
      if (shell && lattice_.deep(around)) continue;
      for (std::uint32_t local = 512; local < 1024; ++local) cut_around(around, local, shell);
    }
    if (solid.tets.empty()) nothing_as_wide();
  }

  // Of the last run: whether the vertex is on the surface.
  [[nodiscard]] bool on_surface(Index vertex) const { return on_surface_[vertex] != 0; }

  Solid solid;

 private:
  // The spacing's fault where it is wider than the level set's own.
  [[noreturn]] void nothing_as_wide() const {
    const double side = std::cbrt(std::abs(frame_.determinant()));
    const std::string what =
        "nothing of the level set is as wide as the spacing " + text_of(spacing_ * side);
    if (spacing_ > 1) throw UsageError(what + "; choose a smaller one");
    throw InputError(what);
  }

  // Twelve tetrahedra a cell: its centre, the next one along an axis, and a side of the square
  // between them.
  void cut_around(const Lattice::Around& around, std::uint32_t local, bool shell) {
    const Cell c = Lattice::doubled(local);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<Cell, 4> at;
      std::array<Lattice::Point, 4> p;
      at[0] = at[1] = c;
      at[1][axis] += 2;
      p[0] = Lattice::at(around, c[0], c[1], c[2]);
      p[1] = Lattice::at(around, at[1][0], at[1][1], at[1][2]);
      if (p[1] == Lattice::none) continue;
      for (std::size_t side = 0; side < 4; ++side) {
        const std::size_t along = (axis + 1 + side / 2) % 3, beside = (axis + 2 - side / 2) % 3;
        at[2] = c;
        at[2][axis] += 1;
        at[2][along] -= 1;
        at[2][beside] += side % 2 == 0 ? -1 : 1;
        at[3] = at[2];
        at[3][along] += 2;
        for (std::size_t i = 2; i < 4; ++i)
          p[i] = Lattice::at(around, at[i][0], at[i][1], at[i][2]);
        if (p[2] == Lattice::none || p[3] == Lattice::none) continue;
        cut(p, at, shell);
      }
    }
  }

  void cut(const std::array<Lattice::Point, 4>& p, const std::array<Cell, 4>& at, bool shell) {
    std::array<int, 4> side;
    for (std::size_t i = 0; i < 4; ++i) side[i] = lattice_.side(p[i]);
    if (*std::min_element(side.begin(), side.end()) >= 0) return;
    if (shell && *std::max_element(side.begin(), side.end()) < 0) return;
    cut_tet(
        side, at, [&](std::size_t i) { return corner(p[i]); },
        [&](std::size_t i, std::size_t j) { return crossing(p[i], at[i], at[j]); },
        [&](Index a, Index b, Index c, Index d) { return apart(a, b) <= apart(c, d); },
        [&](Index a, Index b, Index c, Index d) {
          emit({a, b, c, d});
        });
  }

  Index add(const Vector& place, bool surface) {
    solid.positions.push_back(frame_.to_world(place));
    on_surface_.push_back(surface);
    return static_cast<Index>(solid.positions.size() - 1);
  }

  Index corner(Lattice::Point p) {
    if (number_[p] == Lattice::none) number_[p] = add(lattice_.place(p), lattice_.side(p) == 0);
    return number_[p];
  }

  Index crossing(Lattice::Point inside, const Cell& from, const Cell& to) {
    const Cell step = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const auto found = std::find(Lattice::steps.begin(), Lattice::steps.end(), step);
    const auto direction = static_cast<std::size_t>(found - Lattice::steps.begin());
    const auto [at, fresh] =
        crossings_.try_emplace(std::uint64_t{inside} * Lattice::directions + direction, 0);
    if (fresh) at->second = add(lattice_.crossing(inside, direction), true);
    return at->second;
  }

  double apart(Index a, Index b) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = solid.positions[a][k] - solid.positions[b][k];
      sum += d * d;
    }
    return sum;
  }

  void emit(std::array<Index, 4> tet) {
    const Vector& o = solid.positions[tet[0]];
    std::array<Vector, 3> e;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) e[i][k] = solid.positions[tet[i + 1]][k] - o[k];
    const double volume = (e[0][1] * e[1][2] - e[0][2] * e[1][1]) * e[2][0] +
                          (e[0][2] * e[1][0] - e[0][0] * e[1][2]) * e[2][1] +
                          (e[0][0] * e[1][1] - e[0][1] * e[1][0]) * e[2][2];
    if (volume < 0) std::swap(tet[2], tet[3]);
    solid.tets.push_back(tet);
  }

  const Frame& frame_;
  double spacing_;
  Lattice lattice_;
  std::vector<Index> number_;
  std::vector<char> on_surface_;
  std::unordered_map<std::uint64_t, Index> crossings_;
};

double voxels_apart(const LevelSet& level_set, double spacing) {
  if (spacing == 0) return 1;
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw UsageError("the spacing must be 0, for the voxels' own, or a number above 0");
  const double voxels = spacing / level_set.voxel();
  if (!(voxels < 16.0 * BrickNumbers::far))
    throw UsageError("the spacing " + text_of(spacing) +
                     " is wider than any level set of such voxels; choose a smaller one");
  return voxels;
}

}  // namespace

Solid fill(const LevelSet& level_set, double spacing) {
  Cutter cutter(level_set.bricks(), voxels_apart(level_set, spacing));
  cutter.run(false);
  return std::move(cutter.solid);
}

Surface surface_of(const LevelSet& level_set, double spacing) {
  Cutter cutter(level_set.bricks(), voxels_apart(level_set, spacing));
  cutter.run(true);
  // Faces with all corners on the surface; those between two tetrahedra occur twice.
  struct Face {
    std::array<Index, 3> sorted, given;
  };
  std::vector<Face> faces;
  for (const auto& tet : cutter.solid.tets)
    for (const auto& [i, j, k] : tet_faces) {
      const std::array<Index, 3> given = {tet[i], tet[j], tet[k]};
      if (!std::all_of(given.begin(), given.end(), [&](Index v) { return cutter.on_surface(v); }))
        continue;
      std::array<Index, 3> sorted = given;
      std::sort(sorted.begin(), sorted.end());
      faces.push_back({sorted, given});
    }
  std::sort(faces.begin(), faces.end(),
            [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
  Surface surface;
  std::vector<Index> number(cutter.solid.positions.size(), none);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (f + 1 < faces.size() && faces[f].sorted == faces[f + 1].sorted) {
      ++f;
      continue;
    }
    for (Index& v : faces[f].given) {
      if (number[v] == none) {
        number[v] = static_cast<Index>(surface.positions.size());
        surface.positions.push_back(cutter.solid.positions[v]);
      }
      v = number[v];
    }
    surface.triangles.push_back(faces[f].given);
  }
  return surface;
}

}  // namespace plexway::openvdb
