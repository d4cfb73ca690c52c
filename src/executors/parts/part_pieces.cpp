#include "executors/parts/part_pieces.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/geometry.hpp"
#include "complexes/common/number_range.hpp"
#include "complexes/surface/face_layout.hpp"
#include "complexes/surface/shape_blocks.hpp"
#include "executors/parts/deal_faces.hpp"
#include "labels/pieces/triangle_patches.hpp"

namespace plexway::detail {
namespace {

using Corners = std::array<Index, 3>;

/// Shapes in space, measured in a unit that is given.
class ShapesOfPart final : public TriangleShapes {
 public:
  ShapesOfPart(std::span<const Point3> positions, Faces faces, double unit)
      : shapes_(positions, faces), unit_(unit) {}
  void look_up(std::span<const Index> faces, ShapeBlock& block) const override {
    shapes_.look_up(faces, block);
  }
  [[nodiscard]] std::span<const Point3> positions() const override { return shapes_.positions(); }
  [[nodiscard]] double unit() const override { return unit_; }

 private:
  ShapesInSpace shapes_;
  double unit_;
};

template <class Real>
void check_size(Index face, const std::array<Point3, 3>& corners, double unit) {
  const auto lengths = lengths_of(corners);
  NumberRange<Real>::check_simplex("face", face,
                                   *std::max_element(lengths.begin(), lengths.end()) / unit);
}

/// A piece's own vertices and those of its ghosts, named by their first use.
class Naming {
 public:
  explicit Naming(const PartDraft& draft) : draft_(draft), name_(draft.vertices.size(), none) {
    for (const PartGhost& ghost : draft.ghosts)
      for (const Index v : ghost.corner)
        if (!draft.has(v)) others_.push_back({v, none});
    std::sort(others_.begin(), others_.end());
    others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
  }

  void take(const DealtFace& own) {
    Corners& face = faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i)
      face[i] = named(name_[own.corner[i]], draft_.vertices[own.corner[i]],
                      draft_.positions[own.corner[i]]);
  }
  void take(const PartGhost& ghost) {
    Corners& face = faces.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Index v = ghost.corner[i];
      face[i] =
          named(draft_.has(v) ? name_[draft_.place_of(v)] : others_name(v), v, ghost.position[i]);
    }
  }
  /// Of an own vertex, by its place in the draft.
  [[nodiscard]] Index name_of(std::size_t place) const { return name_[place]; }

  std::vector<Index> vertices;  ///< the surface's, in the order of their names
  std::vector<Point3> positions;
  std::vector<Corners> faces;

 private:
  Index named(Index& name, Index vertex, const Point3& position) {
    if (name == none) {
      name = static_cast<Index>(vertices.size());
      vertices.push_back(vertex);
      positions.push_back(position);
    }
    return name;
  }
  [[nodiscard]] Index& others_name(Index vertex) {
    return std::lower_bound(
               others_.begin(), others_.end(), vertex,
               [](const std::pair<Index, Index>& a, Index number) { return a.first < number; })
        ->second;
  }

  const PartDraft& draft_;
  std::vector<Index> name_;
  std::vector<std::pair<Index, Index>> others_;  ///< vertices of ghosts alone
};

/// Makes a piece of its triangles and its ghosts, and lists its peers.
template <class Real>
void make_piece(PartDraft& draft, double unit, CutPiece& cut, PartPiece<Real>& part) {
  std::sort(draft.ghosts.begin(), draft.ghosts.end(), [](const PartGhost& a, const PartGhost& b) {
    return std::tie(a.from, a.number) < std::tie(b.from, b.number);
  });
  for (const PartGhost& ghost : draft.ghosts) check_size<Real>(ghost.face, ghost.position, unit);
  Naming named(draft);
  cut.own = part.own = draft.faces.size();
  for (const DealtFace& face : draft.faces) {
    if (cut.simplices.size() == cut.at_cut) part.shared = named.vertices.size();
    cut.simplices.push_back(face.face);
    named.take(face);
  }
  if (cut.at_cut == cut.own) part.shared = named.vertices.size();
  part.vertices = named.vertices;
  for (const PartGhost& ghost : draft.ghosts) {
    cut.simplices.push_back(ghost.face);
    named.take(ghost);
    if (cut.peers.empty() || cut.peers.back().piece != ghost.from)
      cut.peers.push_back({ghost.from, none, 0});
    part.addresses.at_home.push_back({static_cast<Index>(cut.peers.size() - 1), ghost.number});
  }
  cut.peers.push_back({none, none, 0});

  part.common.resize(cut.peer_count());
  for (std::size_t s = 0; s < draft.shared.size(); ++s)
    for (const Index other : draft.pieces[s])
      part.common[cut.place_of(other)].push_back(named.name_of(draft.shared[s]));
  const std::size_t faces = named.faces.size();
  std::vector<Index> order(faces);
  std::iota(order.begin(), order.end(), Index{0});
  part.origin = named.positions[0];
  // As the file has them: a triangle must be the same to all pieces that it is in.
  part.mesh.emplace(FaceLayout(named.vertices.size(), named.faces, std::move(order), 1, false),
                    ShapesOfPart(named.positions, named.faces, unit), SurfaceHints{.threads = 1});
  part.angles = windows::vertex_angles(*part.mesh);
  part.angles.excess.resize(part.vertices.size());
  part.angles.excess.shrink_to_fit();
  part.angles.kind.resize(part.vertices.size());
  part.angles.kind.shrink_to_fit();
}

/// Pieces tell each other by which numbers they know what both have.
template <class Real>
void tell_addresses(PieceRanks* ranks, const PartPieces<Real>& pieces,
                    std::span<PartPiece<Real>> parts, std::vector<CutPiece>& cuts) {
  std::vector<std::vector<std::vector<windows::PatchPlace>>> vertices(parts.size()),
      triangles(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    vertices[i].resize(parts[i].shared);
    triangles[i].resize(cuts[parts[i].number].at_cut);
  }
  pieces.tell_peers(
      ranks,
      [&](std::size_t i, std::size_t peer, Parcel& parcel) {
        parcel.add(static_cast<Index>(peer));
        // Its triangles that are ghosts here.
        const auto& home = parts[i].addresses.at_home;
        const auto of_peer = [&](const windows::PatchPlace& place) { return place.piece == peer; };
        const auto first = std::find_if(home.begin(), home.end(), of_peer);
        const auto last = std::find_if_not(first, home.end(), of_peer);
        parcel.add(static_cast<Index>(parts[i].own) + static_cast<Index>(first - home.begin()));
        parcel.add(static_cast<Index>(last - first));
        for (auto ghost = first; ghost != last; ++ghost) parcel.add(ghost->number);
        parcel.add(std::span<const Index>(parts[i].common[peer]));
      },
      [&](std::size_t i, std::size_t peer, Unpacked& mail) {
        cuts[parts[i].number].peers[peer].place = mail.take<Index>();
        const auto place = static_cast<Index>(peer);
        auto number = mail.take<Index>();
        for (auto count = mail.take<Index>(); count > 0; --count)
          triangles[i][mail.take<Index>()].push_back({place, number++});
        for (const Index v : parts[i].common[peer])
          vertices[i][v].push_back({place, mail.take<Index>()});
      });
  const auto by_peer = [](const windows::PatchPlace& a, const windows::PatchPlace& b) {
    return a.piece < b.piece;
  };
  const auto join = [&](std::vector<std::vector<windows::PatchPlace>>& lists,
                        windows::Elsewhere& joined) {
    joined.end();
    for (auto& list : lists) {  // heard in the order of processes
      std::sort(list.begin(), list.end(), by_peer);
      joined.places.insert(joined.places.end(), list.begin(), list.end());
      joined.end();
    }
    lists = {};
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    join(vertices[i], parts[i].addresses.vertices);
    join(triangles[i], parts[i].addresses.triangles);
  }
}

/// What messages of labels are addressed by: of own triangles that share an edge with one of a peer
/// the numbers that they have there as ghosts.
template <class Real>
void list_slots(const PartPiece<Real>& part, CutPiece& cut) {
  const auto& elsewhere = part.addresses.triangles;
  std::vector<std::vector<CutPiece::Slot>> slots(cut.peer_count());
  std::vector<Index> beside;  // peers over the edges of one
  for (Index f = 0; f < cut.at_cut; ++f) {
    beside.clear();
    for (std::size_t e = 0; e < 3; ++e)
      any_over_edge(part.mesh->triangles(), f, e, [&](Index g) {
        if (g >= part.own) beside.push_back(part.addresses.at_home[g - part.own].piece);
        return false;
      });
    for (const auto& [peer, number] : elsewhere.of(f))
      if (std::find(beside.begin(), beside.end(), peer) != beside.end())
        slots[peer].push_back({f, number});
  }
  for (std::size_t peer = 0; peer < slots.size(); ++peer) {
    cut.peers[peer].slot_begin = static_cast<Index>(cut.slots.size());
    cut.slots.insert(cut.slots.end(), slots[peer].begin(), slots[peer].end());
  }
  cut.peers.back().slot_begin = static_cast<Index>(cut.slots.size());
}

/// The peers of all pieces, for who carries messages between them.
void share_peers(PieceRanks* ranks, std::vector<CutPiece>& cuts) {
  share_pieces(
      ranks, cuts.size(),
      [&](std::size_t p, Parcel& parcel) {
        for (std::size_t peer = 0; peer < cuts[p].peer_count(); ++peer)
          parcel.add(cuts[p].peers[peer]);
      },
      [&](std::size_t p, Unpacked mail) {
        while (!mail.empty()) cuts[p].peers.push_back(mail.take<CutPiece::Peer>());
        cuts[p].peers.push_back({none, none, 0});
      });
}

}  // namespace

template <class Real>
PartPieces<Real>::PartPieces(const Team& team, const SurfaceRows& rows, std::size_t size)
    : deal_(team.deal()) {
  PieceRanks* const ranks = team.ranks();
  const auto check_count = [](const char* what, std::size_t count) {
    if (count >= none) throw InputError("more than 4294967294 " + std::string(what));
  };
  check_count("vertices", rows.vertex_count());
  check_count("faces", rows.face_count());
  summary_.vertices = rows.vertex_count();
  summary_.faces = rows.face_count();

  DealtFaces dealt;
  std::vector<PartDraft> drafts;
  {
    const VertexHomes homes(ranks, rows);
    dealt = deal_faces(ranks, rows, homes, size);
    drafts = drafts_of(dealt, deal_);
    unreferenced_ = ask_homes(ranks, deal_, homes, drafts);
  }
  summary_.pieces = dealt.pieces;
  summary_.own_pieces = drafts.size();
  summary_.own_faces = dealt.faces.size();
  summary_.mean_edge = mean_edge_of(ranks, deal_, drafts, dealt.pieces, summary_.faces);
  cut_.pieces.resize(dealt.pieces);
  {
    RankMail mail(ranks);
    for (std::size_t i = 0; i < drafts.size(); ++i) {
      for (const DealtFace& face : drafts[i].faces)
        check_size<Real>(face.face, drafts[i].corners_of(face), unit());
      cut_.pieces[deal_.ours + i * deal_.count].at_cut = sort_by_cut(drafts[i], deal_, mail);
    }
    mail.meet();
    mail.each([&](Unpacked& in) {
      const auto ghost = in.take<PartGhost>();
      drafts[deal_.place(ghost.to)].ghosts.push_back(ghost);
    });
  }
  parts_.resize(drafts.size());
  team.each(drafts.size(), [&](std::size_t i) {
    parts_[i].number = static_cast<Index>(deal_.ours + i * deal_.count);
    make_piece(drafts[i], unit(), cut_.pieces[parts_[i].number], parts_[i]);
    drafts[i] = {};
  });
  tell_addresses<Real>(ranks, *this, parts_, cut_.pieces);
  for (const PartPiece<Real>& part : parts_) list_slots(part, cut_.pieces[part.number]);
  share_peers(ranks, cut_.pieces);
  summary_.unreferenced_vertices = sum_of(ranks, unreferenced_.size());
  for (const PartPiece<Real>& part : parts_) summary_.ghosts += part.addresses.at_home.size();
  summary_.ghosts = sum_of(ranks, summary_.ghosts);
}

template <class Real>
std::size_t PartPiece<Real>::bytes() const {
  std::size_t sum = sizeof(*this) + (mesh ? mesh->bytes() : 0) +
                    vertices.capacity() * sizeof(Index) + angles.bytes() + addresses.bytes();
  for (const auto& list : common) sum += sizeof(list) + list.capacity() * sizeof(Index);
  return sum;
}

template <class Real>
std::size_t PartPieces<Real>::bytes() const {
  std::size_t sum = cut_.bytes() + unreferenced_.capacity() * sizeof(Index);
  for (const PartPiece<Real>& part : parts_) sum += part.bytes();
  return sum;
}

template struct PartPiece<float>;
template struct PartPiece<double>;
template class PartPieces<float>;
template class PartPieces<double>;

}  // namespace plexway::detail
