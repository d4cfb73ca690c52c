#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/executors/piece_ranks.hpp>

#include "complexes/partition/deal.hpp"
#include "executors/parts/deal_faces.hpp"
#include "executors/threads/rank_mail.hpp"

namespace plexway::detail {

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
