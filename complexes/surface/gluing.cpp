#include "complexes/surface/gluing.hpp"

#include <algorithm>
#include <string>

#include <plexway/error.hpp>

namespace plexway::detail {
namespace {

Index next_corner(Index corner) { return corner == 2 ? 0 : corner + 1; }

}  // namespace

Gluing glue_by_vertices(std::size_t vertices, Faces faces) {
  Gluing across(faces.size());
  const auto number = [](const EdgeSide& s) {
    return 3 * (s.halfedge >> Across::face_shift) + (s.halfedge & Across::edge_mask);
  };
  struct Glue {
    Gluing& across;
    const decltype(number)& name;
    void set(const EdgeSide& from, Index to) const {
      across[from.halfedge >> Across::face_shift][from.halfedge & Across::edge_mask] = to;
    }
    void single(Index, const EdgeSide& s) const { set(s, none); }
    void pair(const EdgeSide& a, const EdgeSide& b) const {
      set(a, name(b));
      set(b, name(a));
    }
    void cycle(Index, std::span<const EdgeSide> sides) const {
      for (std::size_t k = 0; k < sides.size(); ++k)
        set(sides[k], name(sides[k + 1 == sides.size() ? 0 : k + 1]));
    }
    void take(const Glue&) const {}
  };
  Glue glue{across, number};
  match_edges(
      vertices, faces, {}, 1,
      [&](const EdgeSide& a, const EdgeSide& b) { return number(a) < number(b); }, glue);
  return across;
}

void check_gluing(Faces faces, std::span<const std::array<Index, 3>> across) {
  const std::size_t halfedges = faces.size() * 3;
  std::vector<char> entered(halfedges, 0);
  for (std::size_t h = 0; h < halfedges; ++h) {
    const Index to = across[h / 3][h % 3];
    if (to == none) continue;
    const std::string where = "face " + std::to_string(h / 3) + ", edge " + std::to_string(h % 3);
    if (to >= halfedges) throw InputError(where + ": glued to a halfedge that does not exist");
    if (to == h) throw InputError(where + ": glued to itself");
    if (entered[to]++) throw InputError(where + ": its other side is glued twice");
    const auto& a = faces[h / 3];
    const auto& b = faces[to / 3];
    const auto p = std::minmax(a[h % 3], a[next_corner(static_cast<Index>(h % 3))]);
    const auto q = std::minmax(b[to % 3], b[next_corner(to % 3)]);
    if (p != q) throw InputError(where + ": glued to an edge with other vertices");
  }
  for (std::size_t h = 0; h < halfedges; ++h)
    if ((across[h / 3][h % 3] != none) != (entered[h] != 0))
      throw InputError("face " + std::to_string(h / 3) + ", edge " + std::to_string(h % 3) +
                       ": glued from one side only");
}

}  // namespace plexway::detail
