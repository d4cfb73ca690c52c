#include "executors/parts/part_pieces.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>

#include <plexway/error.hpp>
#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway::detail {
namespace {

using Point = std::array<double, 3>;
using Corners = std::array<Index, 3>;

/// To who has read a vertex: a piece has it.
struct HadBy {
  Index vertex, piece;
};
/// And back, to that piece: another has it, too.
struct HadToo {
  Index to, vertex, other;
};

}  // namespace

std::vector<Index> ask_homes(PieceRanks* ranks, Deal deal, const VertexHomes& homes,
                             std::span<PartDraft> drafts) {
  std::vector<Index> vertices;  // of all our drafts
  for (const PartDraft& draft : drafts)
    vertices.insert(vertices.end(), draft.vertices.begin(), draft.vertices.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const std::vector<Point> positions = homes.fetch(vertices);
  RankMail asked(ranks), told(ranks);
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    PartDraft& draft = drafts[i];
    const auto ranges = homes.ranges_of(draft.vertices);
    for (std::size_t r = 0; r < deal.count; ++r)
      for (std::size_t v = ranges[r]; v < ranges[r + 1]; ++v)
        asked.to(r).add(HadBy{draft.vertices[v], static_cast<Index>(deal.ours + i * deal.count)});
    draft.positions.reserve(draft.vertices.size());
    for (auto place = vertices.begin(); const Index v : draft.vertices) {
      place = std::lower_bound(place, vertices.end(), v);
      draft.positions.push_back(positions[static_cast<std::size_t>(place - vertices.begin())]);
    }
  }
  asked.meet();
  auto had = asked.all<HadBy>();
  std::sort(had.begin(), had.end(), [](const HadBy& a, const HadBy& b) {
    return std::tie(a.vertex, a.piece) < std::tie(b.vertex, b.piece);
  });
  std::vector<Index> unreferenced;
  auto here = had.begin();
  for (std::size_t v = homes.begin(); v < homes.begin() + homes.size(); ++v) {
    const auto first = here;
    while (here != had.end() && here->vertex == v) ++here;
    if (first == here) unreferenced.push_back(static_cast<Index>(v));
    for (auto a = first; a != here; ++a)
      for (auto b = first; b != here; ++b)
        if (a != b) told.to(deal.owner(a->piece)).add(HadToo{a->piece, a->vertex, b->piece});
  }
  told.meet();
  // By vertices, as processes have ranges of these in order.
  told.each([&](Unpacked& mail) {
    const auto [to, vertex, other] = mail.take<HadToo>();
    PartDraft& draft = drafts[deal.place(to)];
    const Index place = draft.place_of(vertex);
    if (draft.shared.empty() || draft.shared.back() != place) {
      draft.shared.push_back(place);
      draft.pieces.emplace_back();
    }
    draft.pieces.back().push_back(other);
  });
  return unreferenced;
}

std::vector<PartDraft> drafts_of(DealtFaces& dealt, Deal deal) {
  std::vector<PartDraft> drafts;
  auto begin = dealt.faces.begin();
  deal.each(dealt.pieces, [&](std::size_t p) {
    PartDraft& draft = drafts.emplace_back();
    const auto end = std::find_if(begin, dealt.faces.end(),
                                  [&](const DealtFace& face) { return face.piece != p; });
    draft.faces = {dealt.faces.data() + (begin - dealt.faces.begin()),
                   static_cast<std::size_t>(end - begin)};
    begin = end;
    for (const DealtFace& face : draft.faces)
      draft.vertices.insert(draft.vertices.end(), face.corner.begin(), face.corner.end());
    std::sort(draft.vertices.begin(), draft.vertices.end());
    draft.vertices.erase(std::unique(draft.vertices.begin(), draft.vertices.end()),
                         draft.vertices.end());
    draft.vertices.shrink_to_fit();
    for (DealtFace& face : draft.faces)
      for (Index& v : face.corner) v = draft.place_of(v);
  });
  return drafts;
}

std::array<double, 3> lengths_of(const std::array<Point, 3>& corners) {
  std::array<double, 3> lengths;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &p = corners[i], &q = corners[edge_after(i)];
    lengths[i] = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
  return lengths;
}

double mean_edge_of(PieceRanks* ranks, Deal deal, std::span<const PartDraft> drafts,
                    std::size_t pieces, std::size_t faces) {
  double longest = 0;
  for (const PartDraft& draft : drafts)
    for (const DealtFace& face : draft.faces)
      for (const double length : lengths_of(draft.corners_of(face))) {
        if (!std::isfinite(length))
          throw InputError("face " + std::to_string(face.face) + ": an edge length is not finite");
        longest = std::max(longest, length);
      }
  longest = most_of(ranks, longest);
  if (!(longest > 0)) return 1;
  std::vector<std::uint64_t> sums(pieces, 0);  // bits of a number, each from one process
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    double sum = 0;
    for (const DealtFace& face : drafts[i].faces)
      for (const double length : lengths_of(drafts[i].corners_of(face))) sum += length / longest;
    sums[deal.ours + i * deal.count] = std::bit_cast<std::uint64_t>(sum);
  }
  add_up(ranks, sums);
  double sum = 0;
  for (const std::uint64_t bits : sums) sum += std::bit_cast<double>(bits);
  return longest * (sum / (3 * static_cast<double>(faces)));
}

std::size_t sort_by_cut(PartDraft& draft, Deal deal, RankMail& mail) {
  std::vector<Index> to;
  const auto find = [&](const DealtFace& face) {
    to.clear();
    for (const Index v : face.corner) {
      const auto pieces = draft.pieces_at(v);
      to.insert(to.end(), pieces.begin(), pieces.end());
    }
    std::sort(to.begin(), to.end());
    to.erase(std::unique(to.begin(), to.end()), to.end());
    return !to.empty();
  };
  const auto inner = std::stable_partition(draft.faces.begin(), draft.faces.end(), find);
  const auto at_cut = static_cast<std::size_t>(inner - draft.faces.begin());
  for (Index i = 0; i < at_cut; ++i) {
    const DealtFace& face = draft.faces[i];
    find(face);
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = draft.vertices[face.corner[k]];
    for (const Index other : to)
      mail.to(deal.owner(other))
          .add(PartGhost{other, face.piece, i, face.face, corners, draft.corners_of(face)});
  }
  return at_cut;
}

}  // namespace plexway::detail
