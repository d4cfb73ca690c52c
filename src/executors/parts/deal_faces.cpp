#include "executors/parts/deal_faces.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <plexway/error.hpp>

#include "complexes/common/building_blocks.hpp"
#include "executors/parts/curve_cells.hpp"
#include "executors/parts/part_mail.hpp"

namespace plexway {
namespace {

using Corners = std::array<Index, 3>;

std::vector<Corners> read_faces(const SurfaceRows& rows, std::size_t begin, std::size_t end) {
  std::vector<Corners> faces(end - begin);
  rows.read_faces(begin, faces);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto fail = [&](Index v, const std::string& what) {
      throw InputError("face " + std::to_string(begin + f) + ": vertex " + std::to_string(v) +
                       what);
    };
    const auto& [a, b, c] = faces[f];
    for (const Index v : faces[f])
      if (v >= rows.vertex_count())
        fail(v, " is out of range, there are " + std::to_string(rows.vertex_count()));
    if (a == b || c == a) fail(a, " occurs twice");
    if (b == c) fail(b, " occurs twice");
  }
  return faces;
}

/// The vertices of some faces, ascending, where they lie, and of each face which they are.
struct CornerPlaces {
  std::vector<Index> vertices;
  std::vector<std::array<double, 3>> positions;
  std::vector<Corners> faces;  ///< by place in `vertices`

  CornerPlaces(std::span<const Corners> named, const VertexHomes& homes)
      : faces(named.begin(), named.end()) {
    vertices.reserve(3 * faces.size());
    for (const Corners& corners : faces)
      vertices.insert(vertices.end(), corners.begin(), corners.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    vertices.shrink_to_fit();
    positions = homes.fetch(vertices);
    for (Corners& corners : faces)
      for (Index& v : corners)
        v = static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), v) -
                               vertices.begin());
  }
};

std::vector<std::array<double, 3>> middles_of(const CornerPlaces& corners) {
  std::vector<std::array<double, 3>> middles(corners.faces.size());
  for (std::size_t f = 0; f < middles.size(); ++f)
    for (const Index v : corners.faces[f])
      for (std::size_t d = 0; d < 3; ++d) middles[f][d] += corners.positions[v][d] / 3;
  return middles;
}

Box3 box_of_all(PieceRanks* ranks, std::span<const std::array<double, 3>> points) {
  Box3 box;
  for (const auto& point : points) box.take(point);
  for (std::size_t d = 0; d < 3; ++d) {
    box.low[d] = least_of(ranks, box.low[d]);
    box.high[d] = -least_of(ranks, -box.high[d]);
  }
  return box;
}

/// Numbers pieces anew without those that no face of any process went to; how many each has.
std::vector<std::uint64_t> leave_out_empty(PieceRanks* ranks, std::size_t pieces,
                                           std::span<Index> pieces_of) {
  std::vector<std::uint64_t> sizes(pieces, 0);
  for (const Index p : pieces_of) ++sizes[p];
  add_up(ranks, sizes);
  std::vector<Index> name(pieces);
  Index named = 0;
  for (std::size_t p = 0; p < pieces; ++p) name[p] = sizes[p] > 0 ? named++ : none;
  for (Index& p : pieces_of) p = name[p];
  std::erase(sizes, 0u);
  return sizes;
}

}  // namespace

DealtFaces deal_faces(PieceRanks* ranks, const SurfaceRows& rows, const VertexHomes& homes,
                      std::size_t size) {
  const std::size_t count = rows.face_count();
  if (count == 0) throw InputError("the surface has no faces");
  const Deal deal = ranks == nullptr ? Deal{} : Deal{ranks->rank(), ranks->count()};
  const std::size_t begin = count * deal.ours / deal.count;
  const std::vector<Corners> faces = read_faces(rows, begin, count * (deal.ours + 1) / deal.count);

  std::vector<CurvePlace> places(faces.size());
  std::vector<Index> pieces_of(faces.size());
  std::size_t cut_into = 0;
  {
    const CornerPlaces corners(faces, homes);
    const auto middles = middles_of(corners);
    const Box3 box = box_of_all(ranks, middles);
    constexpr double cells = 2097151;  // 21 bits
    double width = 0;                  // halves: no overflow near 1e308
    for (std::size_t d = 0; d < 3; ++d) width = std::max(width, box.high[d] / 2 - box.low[d] / 2);
    // To about 1 first, by a power of two: what divides by a width may overflow.
    int exponent = 0;
    const double share = std::frexp(width, &exponent);
    const double scale = width > 0 ? 0.5 * cells / share : 0;
    const auto key_of = [&](const std::array<double, 3>& point) {
      std::array<std::uint32_t, 3> cell;
      for (std::size_t d = 0; d < 3; ++d)
        cell[d] = static_cast<std::uint32_t>(
            std::clamp(std::ldexp(point[d] - box.low[d], -exponent) * scale, 0., cells));
      return hilbert_key(cell);
    };
    for (std::size_t f = 0; f < faces.size(); ++f)
      places[f] = {key_of(middles[f]), static_cast<Index>(begin + f)};
    const std::size_t wanted = size == 0 || count < size + size / 2 ? 1 : (count + size / 2) / size;
    const CurveCells curve(ranks, places, count, wanted);
    cut_into = curve.pieces();
    // A face is its corners' first piece's, so that cuts run along edges from vertex to vertex and
    // not to and fro between them. Corners where no middles are, as of long faces, do not count.
    std::vector<Index> piece(corners.vertices.size());
    for (std::size_t v = 0; v < piece.size(); ++v)
      piece[v] = curve.piece_of({key_of(corners.positions[v]), corners.vertices[v]});
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto& [a, b, c] = corners.faces[f];
      const Index first = std::min({piece[a], piece[b], piece[c]});
      pieces_of[f] = first != none ? first : curve.piece_of(places[f]);
    }
  }
  const std::vector<std::uint64_t> sizes = leave_out_empty(ranks, cut_into, pieces_of);

  DealtFaces dealt;
  dealt.pieces = sizes.size();
  std::size_t own = 0;
  for (std::size_t p = deal.ours; p < sizes.size(); p += deal.count) own += sizes[p];
  dealt.faces.reserve(own);
  // Some at a time: what is on its way takes room twice. The largest range has the most turns.
  constexpr std::size_t batch = std::size_t{1} << 17;
  const std::size_t turns = (count / deal.count + 1 + batch - 1) / batch;
  for (std::size_t turn = 0; turn < turns; ++turn) {
    PartMail mail(ranks);
    const std::size_t last = std::min((turn + 1) * batch, faces.size());
    for (std::size_t f = turn * batch; f < last; ++f) {
      const Index piece = pieces_of[f];
      mail.to(deal.owner(piece)).add(DealtFace{places[f].key, piece, places[f].face, faces[f]});
    }
    mail.meet();
    for (std::size_t r = 0; r < mail.count(); ++r)
      for (Unpacked in = mail.from(r); !in.empty();) dealt.faces.push_back(in.take<DealtFace>());
  }
  std::sort(dealt.faces.begin(), dealt.faces.end(), [](const DealtFace& a, const DealtFace& b) {
    return std::tie(a.piece, a.key, a.face) < std::tie(b.piece, b.key, b.face);
  });
  return dealt;
}

}  // namespace plexway
