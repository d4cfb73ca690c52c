#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>
#include <plexway/executors/surface_parts.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "executors/parts/deal_faces.hpp"
#include "executors/threads/rank_mail.hpp"
#include "executors/threads/team.hpp"
#include "windows/sheet.hpp"
#include "windows/vertex_angles.hpp"
#include "windows/window_patches.hpp"

namespace plexway::detail {

/// One piece of a surface in parts: a small surface of its own triangles, those at the cut first,
/// and behind them the ghosts, all that share a vertex with them. Vertices are numbered as they are
/// named.
template <class Real>
struct PartPiece {
  Index number = 0;                        ///< among the pieces
  std::optional<TriangleMesh<Real>> mesh;  ///< in the whole surface's unit
  std::array<double, 3> origin{};          ///< of the mesh's positions, in the input's unit
  std::size_t own = 0, shared = 0;         ///< triangles; vertices that others may have, the first
  std::vector<Index> vertices;             ///< of own triangles: the surface's numbers
  windows::VertexAngles angles;            ///< of these
  windows::PatchAddresses addresses;
  /// Of each peer the vertices that it has, too, by their numbers here, in the order of the
  /// surface's.
  std::vector<std::vector<Index>> common;

  /// Is it the first of the pieces that have this vertex?
  [[nodiscard]] bool is_first(Index vertex, const CutPiece& cut) const {
    if (vertex >= shared) return true;
    const auto places = addresses.vertices.of(vertex);
    return places.empty() || cut.peers[places[0].piece].piece > number;
  }
  [[nodiscard]] std::size_t bytes() const;
};

/// The pieces of a surface in parts: this process's.
template <class Real>
class PartPieces {
 public:
  /// As SurfaceParts is made. About `size` triangles a piece.
  PartPieces(const Team& team, const SurfaceRows& rows, std::size_t size);

  [[nodiscard]] const SurfacePartsSummary& summary() const { return summary_; }
  [[nodiscard]] double unit() const { return summary_.mean_edge; }
  [[nodiscard]] Deal deal() const { return deal_; }
  /// The pieces of others have nothing but their peers.
  [[nodiscard]] const Cut& cut() const { return cut_; }
  [[nodiscard]] const CutPiece& cut_of(const PartPiece<Real>& part) const {
    return cut_.pieces[part.number];
  }
  /// Ours, in order.
  [[nodiscard]] std::span<const PartPiece<Real>> parts() const { return parts_; }
  [[nodiscard]] windows::Sheet<Real> sheet(const PartPiece<Real>& part) const {
    return {.mesh = &*part.mesh,
            .angles = &part.angles,
            .triangles = part.mesh->triangles(),
            .own = static_cast<Index>(part.own),
            .vertex_count = static_cast<Index>(part.vertices.size()),
            .shared = static_cast<Index>(part.shared),
            .vertices = {}};
  }
  /// Vertices of no triangle that this process has read, ascending.
  [[nodiscard]] std::span<const Index> unreferenced() const { return unreferenced_; }

  /// Pieces tell each of their peers something: write(i, peer, parcel) of our piece i for the peer
  /// at that place, read(i, peer, mail) what that one wrote, all of it. All processes call it.
  /// Returns the bytes sent to other processes.
  template <class Write, class Read>
  std::size_t tell_peers(PieceRanks* ranks, const Write& write, const Read& read) const {
    RankMail mail(ranks);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const CutPiece& cut = cut_of(parts_[i]);
      for (std::size_t peer = 0; peer < cut.peer_count(); ++peer) {
        const Index other = cut.peers[peer].piece;
        Parcel& parcel = mail.to(deal_.owner(other));
        parcel.add(other);
        parcel.add(parts_[i].number);
        write(i, peer, parcel);
      }
    }
    const std::size_t sent = mail.meet();
    mail.each([&](Unpacked& in) {
      const std::size_t i = deal_.place(in.take<Index>());
      const std::size_t peer = cut_of(parts_[i]).place_of(in.take<Index>());
      read(i, peer, in);
    });
    return sent;
  }

  [[nodiscard]] std::size_t bytes() const;

 private:
  SurfacePartsSummary summary_;
  Deal deal_;
  Cut cut_;
  std::vector<PartPiece<Real>> parts_;
  std::vector<Index> unreferenced_;
};

extern template class PartPieces<float>;
extern template class PartPieces<double>;

/// A triangle of one piece for another, which it is a ghost in.
struct PartGhost {
  Index to, from;  ///< pieces
  Index number;    ///< in that it comes from
  Index face;
  std::array<Index, 3> corner;
  std::array<std::array<double, 3>, 3> position;
};

/// What a piece is made from, until it is a surface.
struct PartDraft {
  std::span<DealtFace> faces;   ///< its own; corners by place in:
  std::vector<Index> vertices;  ///< of these, ascending
  std::vector<std::array<double, 3>> positions;
  ///@{
  /// Vertices that other pieces have, too, by place in `vertices`, and of each which they are.
  std::vector<Index> shared;
  std::vector<std::vector<Index>> pieces;
  ///@}
  std::vector<PartGhost> ghosts;

  [[nodiscard]] Index place_of(Index vertex) const {
    return static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), vertex) -
                              vertices.begin());
  }
  [[nodiscard]] bool has(Index vertex) const {
    return std::binary_search(vertices.begin(), vertices.end(), vertex);
  }
  /// The pieces beside it that have the vertex at a place.
  [[nodiscard]] std::span<const Index> pieces_at(Index place) const {
    const auto found = std::lower_bound(shared.begin(), shared.end(), place);
    if (found == shared.end() || *found != place) return {};
    return pieces[static_cast<std::size_t>(found - shared.begin())];
  }
  /// Where the corners of one of its own triangles lie.
  [[nodiscard]] std::array<std::array<double, 3>, 3> corners_of(const DealtFace& face) const {
    const auto& [a, b, c] = face.corner;
    return {positions[a], positions[b], positions[c]};
  }
};

/// Of each of our pieces its triangles and vertices, by the lot.
[[nodiscard]] std::vector<PartDraft> drafts_of(DealtFaces& dealt, Deal deal);

/// Asks the processes that read vertices where they are and who has them. All processes call it.
/// Returns which vertices that we read no piece has.
[[nodiscard]] std::vector<Index> ask_homes(PieceRanks* ranks, Deal deal, const VertexHomes& homes,
                                           std::span<PartDraft> drafts);

/// From each corner of a triangle to the next.
[[nodiscard]] std::array<double, 3> lengths_of(const std::array<std::array<double, 3>, 3>& corners);

/// The mean edge of all pieces, summed up piece by piece, whosever they are. All processes call it.
/// Throws InputError for a length that is not finite.
[[nodiscard]] double mean_edge_of(PieceRanks* ranks, Deal deal, std::span<const PartDraft> drafts,
                                  std::size_t pieces, std::size_t faces);

/// Puts the triangles at the cut first, and mails them to the pieces that they are ghosts in. How
/// many there are.
std::size_t sort_by_cut(PartDraft& draft, Deal deal, RankMail& mail);

}  // namespace plexway::detail
