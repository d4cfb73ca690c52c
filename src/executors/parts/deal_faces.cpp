#include "executors/parts/deal_faces.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <plexway/error.hpp>

#include "complexes/common/building_blocks.hpp"
#include "complexes/common/simplex_order.hpp"
#include "executors/threads/rank_mail.hpp"

namespace plexway::detail {
namespace {

using Corners = std::array<Index, 3>;

/// The place of a cell on Hilbert's curve, 63 bits: cells beside each other on the curve share a
/// face. Each number has 21 bits. Skilling, Programming the Hilbert curve (AIP 2004).
std::uint64_t hilbert_key(std::array<std::uint32_t, 3> x) {
  constexpr std::uint32_t highest = 1u << 20;
  for (std::uint32_t q = highest; q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (std::uint32_t& one : x) {
      if ((one & q) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t both = (x[0] ^ one) & below;
        x[0] ^= both;
        one ^= both;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t turn = 0;
  for (std::uint32_t q = highest; q > 1; q >>= 1)
    if ((x[2] & q) != 0) turn ^= q - 1;
  for (std::uint32_t& one : x) one ^= turn;
  return every_third_bit(x[2]) | every_third_bit(x[1]) << 1 | every_third_bit(x[0]) << 2;
}

/// A triangle's place along the curve; its number tells those of one cell apart.
struct CurvePlace {
  std::uint64_t key;
  Index face;
};

/// Cuts the curve where it pleases, so that pieces have about as many triangles each, of which each
/// process knows some: by counting those in cells that are made finer where many are. The cut
/// depends on the places alone.
class CurveCells {
 public:
  /// `places`: this process's, of `count` in all. Into `pieces` at most. All processes call it.
  CurveCells(PieceRanks* ranks, std::span<const CurvePlace> places, std::size_t count,
             std::size_t pieces);

  /// So many, none of them empty.
  [[nodiscard]] std::size_t pieces() const { return sizes_.size(); }
  /// Triangles of each.
  [[nodiscard]] std::span<const std::uint64_t> sizes() const { return sizes_; }
  /// `none` in a cell where none of the places is.
  [[nodiscard]] Index piece_of(const CurvePlace& place) const;

 private:
  static constexpr int digit_bits = 4, digits = 24;
  static constexpr std::size_t ways = 1 << digit_bits;
  [[nodiscard]] static std::size_t digit(const CurvePlace& place, int depth);

  struct Node {
    std::uint64_t count;
    Index first;  ///< of its 16 children, or `none`
    Index piece;  ///< where it has none
  };
  std::vector<Node> nodes_;
  std::vector<std::uint64_t> sizes_;
};

std::size_t CurveCells::digit(const CurvePlace& place, int depth) {
  constexpr int in_key = 64 / digit_bits;
  return static_cast<std::size_t>(depth < in_key ? place.key << 1 >> (64 - digit_bits * (depth + 1))
                                                 : std::uint64_t{place.face} >>
                                                       (32 - digit_bits * (depth - in_key + 1))) %
         ways;
}

CurveCells::CurveCells(PieceRanks* ranks, std::span<const CurvePlace> places, std::size_t count,
                       std::size_t pieces)
    : nodes_{{count, none, none}} {
  // Finer than a piece, so that pieces come out even.
  const std::uint64_t most = std::max<std::uint64_t>(count / (16 * pieces), 1);
  std::vector<Index> node(places.size(), 0);  // the finest that holds it
  std::size_t begin = 0;                      // of the last level
  for (int depth = 0; depth < digits; ++depth) {
    const std::size_t end = nodes_.size();
    for (std::size_t n = begin; n < end; ++n)
      if (nodes_[n].count > most && pieces > 1) {
        nodes_[n].first = static_cast<Index>(nodes_.size());
        nodes_.resize(nodes_.size() + ways, {0, none, none});
      }
    if (nodes_.size() == end) break;
    std::vector<std::uint64_t> counts(nodes_.size() - end);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Index first = nodes_[node[i]].first;
      if (first == none) continue;
      node[i] = static_cast<Index>(first + digit(places[i], depth));
      ++counts[node[i] - end];
    }
    add_up(ranks, counts);
    for (std::size_t k = 0; k < counts.size(); ++k) nodes_[end + k].count = counts[k];
    begin = end;
  }
  // Along the curve: what is not divided goes where its middle falls.
  std::uint64_t before = 0;
  Index last = none;
  std::vector<Index> line = {0};
  while (!line.empty()) {
    Node& n = nodes_[line.back()];
    line.pop_back();
    if (n.first != none) {
      for (std::size_t k = ways; k-- > 0;) line.push_back(static_cast<Index>(n.first + k));
      continue;
    }
    if (n.count == 0) continue;
    const auto wanted = static_cast<Index>((2 * before + n.count) * pieces / (2 * count));
    before += n.count;
    if (wanted != last || sizes_.empty()) sizes_.push_back(0);
    last = wanted;
    sizes_.back() += n.count;
    n.piece = static_cast<Index>(sizes_.size() - 1);
  }
}

Index CurveCells::piece_of(const CurvePlace& place) const {
  const Node* n = &nodes_[0];
  for (int depth = 0; n->first != none; ++depth) n = &nodes_[n->first + digit(place, depth)];
  return n->piece;
}

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
    box.high[d] = most_of(ranks, box.high[d]);
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

VertexHomes::VertexHomes(PieceRanks* ranks, const SurfaceRows& rows)
    : ranks_(ranks), deal_(deal_of(ranks)), count_(rows.vertex_count()), positions_(size()) {
  rows.read_vertices(begin(), positions_);
  for (std::size_t v = 0; v < positions_.size(); ++v)
    for (const double x : positions_[v])
      if (!std::isfinite(x))
        throw InputError("vertex " + std::to_string(begin() + v) + ": a coordinate is not finite");
}

std::vector<std::size_t> VertexHomes::ranges_of(std::span<const Index> ascending) const {
  std::vector<std::size_t> ranges(deal_.count + 1, ascending.size());
  for (std::size_t r = 0; r < deal_.count; ++r)
    ranges[r] = static_cast<std::size_t>(
        std::lower_bound(ascending.begin(), ascending.end(), begin_of(r)) - ascending.begin());
  return ranges;
}

std::vector<std::array<double, 3>> VertexHomes::fetch(std::span<const Index> ascending) const {
  const std::vector<std::size_t> ranges = ranges_of(ascending);
  std::vector<std::array<double, 3>> found(ascending.size());
  RankMail asked(ranks_), answers(ranks_);
  for (std::size_t r = 0; r < asked.count(); ++r)
    asked.to(r).add(ascending.subspan(ranges[r], ranges[r + 1] - ranges[r]));
  asked.meet();
  for (std::size_t r = 0; r < asked.count(); ++r)
    for (Unpacked mail = asked.from(r); !mail.empty();)
      answers.to(r).add(position(mail.take<Index>()));
  answers.meet();
  for (std::size_t r = 0; r < answers.count(); ++r) {
    Unpacked mail = answers.from(r);
    mail.take(std::span(found).subspan(ranges[r], ranges[r + 1] - ranges[r]));
  }
  return found;
}

DealtFaces deal_faces(PieceRanks* ranks, const SurfaceRows& rows, const VertexHomes& homes,
                      std::size_t size) {
  const std::size_t count = rows.face_count();
  if (count == 0) throw InputError("the surface has no faces");
  const Deal deal = deal_of(ranks);
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
    RankMail mail(ranks);
    const std::size_t last = std::min((turn + 1) * batch, faces.size());
    for (std::size_t f = turn * batch; f < last; ++f) {
      const Index piece = pieces_of[f];
      mail.to(deal.owner(piece)).add(DealtFace{places[f].key, piece, places[f].face, faces[f]});
    }
    mail.meet();
    mail.each([&](Unpacked& in) { dealt.faces.push_back(in.take<DealtFace>()); });
  }
  std::sort(dealt.faces.begin(), dealt.faces.end(), [](const DealtFace& a, const DealtFace& b) {
    return std::tie(a.piece, a.key, a.face) < std::tie(b.piece, b.key, b.face);
  });
  return dealt;
}

}  // namespace plexway::detail
