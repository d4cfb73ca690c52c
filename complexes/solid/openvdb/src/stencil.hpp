#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plexway::openvdb {

/// Cuts one tetrahedron of the lattice: corners 0 1 are the ends of one long edge, 2 3 of the
/// other.
///
/// `side` is -1 inside, 0 on the surface, 1 outside; `doubled` are the corners' coordinates.
/// `corner(i)` and `cut(i, j)`, from i inside to j outside, give vertices, `emit(a, b, c, d)` takes
/// tetrahedra in any orientation. A quadrilateral on a face is halved by a rule that looks at the
/// face alone, so that neighbours agree.
/// Source: Labelle, Shewchuk, Isosurface Stuffing, figure 3.
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

}  // namespace plexway::openvdb
