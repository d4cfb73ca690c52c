#include "executors/parts/part_label_rooms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "complexes/surface/gluing.hpp"
#include "complexes/surface/shape_blocks.hpp"

namespace plexway::detail {
namespace {

/// What there is around a vertex.
struct Around {
  double excess = 0;  ///< as mark_saddles takes it
  bool on_boundary = false;
};

/// Of each vertex of a piece's own triangles; others have nothing yet.
template <class Real>
std::vector<Around> pieces_around(const PartPiece<Real>& part) {
  const TriangleMesh<Real>& mesh = *part.mesh;
  const auto triangles = mesh.triangles();
  const std::size_t faces = mesh.face_count();
  std::vector<Around> around(mesh.vertex_count());
  std::vector<std::array<Index, 3>> corners(faces);
  for (std::size_t f = 0; f < faces; ++f) std::copy_n(triangles[f].corner, 3, corners[f].begin());
  const ShapesInSpace shapes(mesh.positions(), corners);
  std::vector<Index> some;
  ShapeBlock block{};
  std::array<ShapeBlock::Row, 3> angle;
  for (std::size_t first = 0; first < faces; first += ShapeBlock::size) {
    some.resize(std::min(ShapeBlock::size, faces - first));
    std::iota(some.begin(), some.end(), static_cast<Index>(first));
    shapes.look_up(some, block);
    angles_of(block, angle);
    for (std::size_t k = 0; k < some.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::array<Index, 3>& corner = corners[first + k];
        around[corner[i]].excess += angle[i][k];
        if (triangles[first + k].across[i] >> Across::face_shift != faces) continue;
        around[corner[i]].on_boundary = around[corner[edge_after(i)]].on_boundary = true;
      }
  }
  around.resize(part.vertices.size());
  for (Around& one : around) one.excess -= (one.on_boundary ? 1 : 2) * std::numbers::pi;
  around.resize(mesh.vertex_count());
  return around;
}

/// Pieces tell their peers something of each triangle that those have as a ghost: write(i,
/// triangle, parcel) of our piece i, read(i, ghost, peer, mail).
template <class Real, class Write, class Read>
void tell_of_ghosts(PieceRanks* ranks, const PartPieces<Real>& pieces, const Write& write,
                    const Read& read) {
  pieces.tell_peers(
      ranks,
      [&](std::size_t i, std::size_t peer, Parcel& parcel) {
        const PartPiece<Real>& part = pieces.parts()[i];
        for (Index f = 0; f < pieces.cut_of(part).at_cut; ++f)
          for (const auto& place : part.addresses.triangles.of(f))
            if (place.piece == peer) write(i, f, parcel);
      },
      [&](std::size_t i, std::size_t peer, Unpacked& mail) {
        const PartPiece<Real>& part = pieces.parts()[i];
        const auto& home = part.addresses.at_home;  // by peers, in each as the peer has them
        for (std::size_t g = 0; g < home.size(); ++g)
          if (home[g].piece == peer) read(i, static_cast<Index>(part.own + g), peer, mail);
      });
}

}  // namespace

template <class Real>
PartLabelRooms<Real>::PartLabelRooms(const Team& team, const PartPieces<Real>& pieces)
    : pieces_(pieces), all_(pieces.parts().size()) {
  team.each(all_.size(), [&](std::size_t i) {
    const PartPiece<Real>& part = pieces.parts()[i];
    const auto triangles = part.mesh->triangles();
    Piece& piece = all_[i];
    piece.triangles.assign(triangles.begin(), triangles.end());
    piece.leads_in = leads_in(triangles, part.own);
    for (const Index v : part.mesh->pinched())
      if (v < part.vertices.size()) piece.pinched.push_back(v);
  });
  mark_saddles(team);
  // Where none of its own lies over it, not all need be here: such edges of ghosts are boundaries.
  for (std::size_t i = 0; i < all_.size(); ++i)
    for (std::size_t g = 0; g < all_[i].leads_in.size(); ++g)
      for (std::size_t e = 0; e < 3; ++e)
        if ((all_[i].leads_in[g] >> e & 1) == 0)
          all_[i].triangles[pieces.parts()[i].own + g].across[e] =
              all_[i].triangles.back().across[e];
}

template <class Real>
void PartLabelRooms<Real>::mark_saddles(const Team& team) {
  const auto parts = pieces_.parts();
  std::vector<std::vector<Around>> around(all_.size());
  // Of vertices that only ghosts have, whose word it is: the first peer's.
  std::vector<std::vector<std::size_t>> known_by(all_.size());
  team.each(all_.size(), [&](std::size_t i) {
    around[i] = pieces_around(parts[i]);
    known_by[i].assign(around[i].size() - parts[i].vertices.size(), ~std::size_t{0});
  });
  tell_of_ghosts(
      team.ranks(), pieces_,
      [&](std::size_t i, Index f, Parcel& parcel) {
        for (const Index v : all_[i].triangles[f].corner) parcel.add(around[i][v]);
      },
      [&](std::size_t i, Index ghost, std::size_t peer, Unpacked& mail) {
        for (const Index v : all_[i].triangles[ghost].corner) {
          const auto told = mail.take<Around>();
          if (v < parts[i].vertices.size()) continue;
          std::size_t& by = known_by[i][v - parts[i].vertices.size()];
          if (by <= peer) continue;
          by = peer;
          around[i][v] = told;
        }
      });
  team.each(all_.size(), [&](std::size_t i) {
    const PartPiece<Real>& part = parts[i];
    VertexFans fans;
    std::vector<double> excess;
    for (const Around& one : around[i]) {
      excess.push_back(one.excess);
      fans.on_boundary.push_back(one.on_boundary);
    }
    std::vector<Index> corners;
    for (Index v = 0; v < part.vertices.size(); ++v) {
      if (part.angles.kind[v] != windows::VertexAngles::irregular) continue;
      part.mesh->corners_at(v, corners);
      fans.irregular.push_back(v);
      fans.irregular_begin.push_back(static_cast<Index>(fans.irregular_corners.size()));
      fans.irregular_corners.insert(fans.irregular_corners.end(), corners.begin(), corners.end());
    }
    fans.irregular_begin.push_back(static_cast<Index>(fans.irregular_corners.size()));
    for (TriangleRecord<Real>& t : all_[i].triangles)
      for (Real& sine : t.signed_sine) sine = std::abs(sine);
    std::vector<Index> first_use(around[i].size());
    std::iota(first_use.begin(), first_use.end(), Index{0});
    detail::mark_saddles<Real>(all_[i].triangles, fans, first_use, std::move(excess),
                               {.threads = 1}, pieces_.summary().vertices);
  });
  tell_of_ghosts(
      team.ranks(), pieces_,
      [&](std::size_t i, Index f, Parcel& parcel) {
        for (std::size_t k = 0; k < 3; ++k) parcel.add(all_[i].triangles[f].saddle(k));
      },
      [&](std::size_t i, Index ghost, std::size_t, Unpacked& mail) {
        for (Real& sine : all_[i].triangles[ghost].signed_sine)
          sine = std::copysign(sine, mail.take<bool>() ? Real(-1) : Real(1));
      });
}

template <class Real>
std::size_t PartLabelRooms<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t sum = of(all_);
  for (const Piece& one : all_)
    sum += one.room.bytes() + of(one.triangles) + of(one.leads_in) + of(one.pinched);
  return sum;
}

template class PartLabelRooms<float>;
template class PartLabelRooms<double>;

}  // namespace plexway::detail
