#include "executors/parts/part_drafts.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include <plexway/error.hpp>
#include <plexway/surface/detail/triangle_record.hpp>

namespace plexway {
namespace {

using Point = std::array<double, 3>;
using Corners = std::array<Index, 3>;

/// What the processes that read vertices know of them: where they are, and who has them.
class Directory {
 public:
  Directory(PieceRanks* ranks, Deal deal, const VertexHomes& homes, std::span<PartDraft> drafts)
      : ranks_(ranks), deal_(deal), homes_(homes), drafts_(drafts), asked_(ranks) {}

  /// All processes. Returns which vertices of our range no piece has.
  [[nodiscard]] std::vector<Index> ask() {
    for (std::size_t i = 0; i < drafts_.size(); ++i) {
      const std::span<const Index> vertices = drafts_[i].vertices;
      const auto ranges = homes_.ranges_of(vertices);
      for (std::size_t r = 0; r < deal_.count; ++r) {
        asked_.to(r).add(static_cast<Index>(deal_.ours + i * deal_.count));
        asked_.to(r).add(static_cast<Index>(ranges[r + 1] - ranges[r]));
        asked_.to(r).add(vertices.subspan(ranges[r], ranges[r + 1] - ranges[r]));
      }
    }
    asked_.meet();
    note_pieces();
    RankMail answers(ranks_);
    each_list([&](std::size_t r, Index piece, std::span<const Index> vertices) {
      answer(piece, vertices, answers.to(r));
    });
    answers.meet();
    for (std::size_t r = 0; r < deal_.count; ++r) {
      Unpacked mail = answers.from(r);
      for (PartDraft& draft : drafts_) hear(draft, mail);
    }
    std::vector<Index> unreferenced;
    for (std::size_t v = 0; v < homes_.size(); ++v)
      if (begin_[v] == begin_[v + 1])
        unreferenced.push_back(static_cast<Index>(homes_.begin() + v));
    return unreferenced;
  }

 private:
  // visit(rank, piece, its vertices that are ours)
  template <class Visit>
  void each_list(const Visit& visit) const {
    std::vector<Index> vertices;
    for (std::size_t r = 0; r < deal_.count; ++r)
      for (Unpacked mail = asked_.from(r); !mail.empty();) {
        const auto piece = mail.take<Index>();
        vertices.resize(mail.take<Index>());
        mail.take(std::span(vertices));
        visit(r, piece, std::span<const Index>(vertices));
      }
  }

  void note_pieces() {
    begin_.assign(homes_.size() + 1, 0);
    each_list([&](std::size_t, Index, std::span<const Index> vertices) {
      for (const Index v : vertices) ++begin_[v - homes_.begin() + 1];
    });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    pieces_.resize(begin_.back());
    std::vector<std::size_t> at(begin_.begin(), begin_.end() - 1);
    each_list([&](std::size_t, Index piece, std::span<const Index> vertices) {
      for (const Index v : vertices) pieces_[at[v - homes_.begin()]++] = piece;
    });
    for (std::size_t v = 0; v < homes_.size(); ++v)
      std::sort(pieces_.begin() + static_cast<std::ptrdiff_t>(begin_[v]),
                pieces_.begin() + static_cast<std::ptrdiff_t>(begin_[v + 1]));
  }
  [[nodiscard]] std::span<const Index> pieces_of(Index vertex) const {
    const std::size_t v = vertex - homes_.begin();
    return std::span(pieces_).subspan(begin_[v], begin_[v + 1] - begin_[v]);
  }

  void answer(Index piece, std::span<const Index> vertices, Parcel& parcel) const {
    parcel.add(static_cast<Index>(vertices.size()));
    for (const Index v : vertices) parcel.add(homes_.position(v));
    const auto is_shared = [&](Index v) { return pieces_of(v).size() > 1; };
    parcel.add(static_cast<Index>(std::count_if(vertices.begin(), vertices.end(), is_shared)));
    for (Index i = 0; i < vertices.size(); ++i) {
      if (!is_shared(vertices[i])) continue;
      const auto pieces = pieces_of(vertices[i]);
      parcel.add(i);
      parcel.add(static_cast<Index>(pieces.size() - 1));
      for (const Index other : pieces)
        if (other != piece) parcel.add(other);
    }
  }
  static void hear(PartDraft& draft, Unpacked& mail) {
    const auto before = static_cast<Index>(draft.positions.size());
    draft.positions.resize(before + mail.take<Index>());
    mail.take(std::span(draft.positions).subspan(before));
    for (auto count = mail.take<Index>(); count > 0; --count) {
      draft.shared.push_back(before + mail.take<Index>());
      draft.pieces.emplace_back(mail.take<Index>());
      mail.take(std::span(draft.pieces.back()));
    }
  }

  PieceRanks* ranks_;
  Deal deal_;
  const VertexHomes& homes_;
  std::span<PartDraft> drafts_;
  RankMail asked_;
  std::vector<std::size_t> begin_;
  std::vector<Index> pieces_;
};

}  // namespace

std::vector<Index> ask_homes(PieceRanks* ranks, Deal deal, const VertexHomes& homes,
                             std::span<PartDraft> drafts) {
  return Directory(ranks, deal, homes, drafts).ask();
}

std::vector<PartDraft> drafts_of(DealtFaces& dealt, Deal deal) {
  std::vector<PartDraft> drafts;
  auto begin = dealt.faces.begin();
  for (std::size_t p = deal.ours; p < dealt.pieces; p += deal.count) {
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
  }
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
  longest = -least_of(ranks, -longest);
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

}  // namespace plexway
