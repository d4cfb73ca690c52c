#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

#include <plexway/fields/isolines.hpp>
#include <plexway/fields/isosurfaces.hpp>

#include "fields/level_sets.hpp"
#include "paths/cloud_points.hpp"

namespace plexway {
using namespace detail;
namespace {

using Edge = std::pair<Index, Index>;

// A field on triangles: as it is given, linear in each, or with what is known inside of them.
struct Sheet {
  std::span<const std::array<double, 3>> positions;
  std::span<const std::array<Index, 3>> faces;
  std::span<const double> distance;
  /// Or null: what the faces are parts of, and the field inside of them.
  const FineField* fine = nullptr;
  const DistanceInside* inside = nullptr;

  [[nodiscard]] Index parent(Index face) const {
    return fine == nullptr ? face : fine->parent[face];
  }
  /// A point of an edge of a face, by weights of the corners of its parent.
  [[nodiscard]] std::array<double, 4> weights(Index face, const Edge& edge, double t) const {
    std::array<double, 4> all{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = faces[face][i] == edge.first    ? 1 - t
                           : faces[face][i] == edge.second ? t
                                                           : 0;
      if (fine == nullptr)
        all[i] = share;
      else
        for (std::size_t k = 0; k < 3; ++k) all[k] += share * fine->place[face][i][k] / fine->parts;
    }
    return all;
  }
  /// Where along an edge the field has a value that lies between those of its ends.
  [[nodiscard]] double share(Index face, const Edge& edge, double value) const {
    double low = 0, high = 1;
    double below = distance[edge.first] - value, above = distance[edge.second] - value;
    double t = below / (below - above);
    if (inside == nullptr) return t;
    // False position, where an end that stays counts half (Illinois).
    for (int last = 0, step = 0; step < 40 && high - low > 1e-12; ++step) {
      const double off = (*inside)(fine->parent[face], weights(face, edge, t)) - value;
      if (!std::isfinite(off)) break;
      if (std::abs(off) <= 1e-13 * std::abs(value)) break;
      if ((off < 0) == (below < 0)) {
        low = t, below = off;
        if (last == 1) above /= 2;
        last = 1;
      } else {
        high = t, above = off;
        if (last == 2) below /= 2;
        last = 2;
      }
      t = low + (high - low) * (below / (below - above));
    }
    return t;
  }
};

// What one value cuts: in each face at most one straight piece, from edge to edge.
class LineCut {
 public:
  LineCut(const Sheet& sheet, double value) : sheet_(sheet), value_(value) {
    for (Index f = 0; f < sheet.faces.size(); ++f) {
      const auto& face = sheet.faces[f];
      if (!std::all_of(face.begin(), face.end(),
                       [&](Index v) { return std::isfinite(sheet.distance[v]); }))
        continue;
      Edge ends[2];
      int count = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = face[i], b = face[(i + 1) % 3];
        // A vertex with just this value counts as above it: no line ends there.
        if (above(a) != above(b) && count < 2) ends[count++] = std::minmax(a, b);
      }
      if (count < 2) continue;
      for (const Edge& end : ends) {
        at_.emplace(end, pieces_.size());
        if (!share_.contains(end)) share_.emplace(end, sheet.share(f, end, value));
      }
      pieces_.push_back({f, {ends[0], ends[1]}, false});
    }
  }

  void lines(Index number, std::vector<Path>& lines) {
    // Those with an end first; then what is closed.
    for (const bool open : {true, false})
      for (std::size_t p = 0; p < pieces_.size(); ++p)
        for (int end = 0; end < 2; ++end)
          if (!pieces_[p].done && (!open || at_.count(pieces_[p].ends[end]) == 1))
            lines.push_back(follow(p, end, number));
  }

 private:
  struct Piece {
    Index face;
    Edge ends[2];
    bool done;
  };

  [[nodiscard]] bool above(Index v) const { return sheet_.distance[v] >= value_; }

  // The piece's own line, from one of its ends on.
  Path follow(std::size_t p, int end, Index number) {
    Path line;
    line.source = number;
    line.length = 0;
    add(line, pieces_[p].face, pieces_[p].ends[end]);
    for (bool more = true; more;) {
      Piece& piece = pieces_[p];
      piece.done = true;
      const Edge to = piece.ends[1 - end];
      line.points.back() = point(piece.face, piece.ends[end]);
      add(line, piece.face, to);
      more = false;
      const auto [first, last] = at_.equal_range(to);
      for (auto next = first; next != last && !more; ++next) {
        if (pieces_[next->second].done) continue;
        p = next->second;
        end = pieces_[p].ends[0] == to ? 0 : 1;
        more = true;
      }
    }
    return line;
  }

  [[nodiscard]] PathPoint point(Index face, const Edge& edge) const {
    return {sheet_.parent(face), sheet_.weights(face, edge, share_.at(edge))};
  }
  void add(Path& line, Index face, const Edge& edge) const {
    const auto &a = sheet_.positions[edge.first], &b = sheet_.positions[edge.second];
    const double t = share_.at(edge);
    std::array<double, 3> at;
    double step = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = a[k] + t * (b[k] - a[k]);
      if (!line.positions.empty()) step += std::pow(at[k] - line.positions.back()[k], 2);
    }
    line.length += std::sqrt(step);
    line.points.push_back(point(face, edge));
    line.positions.push_back(at);
  }

  const Sheet& sheet_;
  double value_;
  std::vector<Piece> pieces_;
  std::multimap<Edge, std::size_t> at_;
  std::map<Edge, double> share_;
};

std::vector<Path> lines_of(const Sheet& sheet, std::span<const double> values) {
  std::vector<Path> lines;
  for (std::size_t n = 0; n < values.size(); ++n)
    LineCut(sheet, values[n]).lines(static_cast<Index>(n), lines);
  return lines;
}

}  // namespace

std::vector<Path> isolines(const GivenPoints& positions, const GivenSimplices<3>& faces,
                           const Given<double>& distance, const Given<double>& values) {
  check_level_sets(positions.size(), std::span(faces), distance, values, "face", "isoline");
  return lines_of({positions, faces, distance}, values);
}

std::vector<Path> isolines(const GivenPoints& positions, const GivenSimplices<3>& faces,
                           const Given<double>& distance, const Given<double>& values,
                           const DistanceInside& at, double tolerance) {
  if (values.empty()) return {};
  const FineField fine = fine_field(positions, faces, distance, at, {tolerance, values});
  return lines_of({fine.positions, fine.faces, fine.distance, &fine, &at}, values);
}

template <class Real>
std::vector<Path> isolines(const PointCloud<Real>& cloud, const GivenPoints& points,
                           const Given<std::type_identity_t<Real>>& distance,
                           const Given<double>& values) {
  if (points.size() != cloud.point_count() || distance.size() != points.size())
    throw UsageError(std::to_string(points.size()) + " positions and " +
                     std::to_string(distance.size()) + " distances for " +
                     std::to_string(cloud.point_count()) + " points: give one a point");
  const std::vector<Index> outer = vertices_outside(cloud.surface());
  const std::vector<Real> found = sheet_distances<Real>(cloud, distance, outer);
  std::vector<std::array<double, 3>> places(points.begin(), points.end());
  places.insert(places.end(), cloud.more_places().begin(), cloud.more_places().end());
  std::vector<std::array<Index, 3>> faces(cloud.surface().face_count());
  for (Index f = 0; f < faces.size(); ++f) {
    const auto [inside, turned] = cloud.surface().inside_face(f);
    const Index* v = cloud.surface().triangles()[inside].corner;
    faces[f] = {outer[v[0]], outer[v[turned ? 2 : 1]], outer[v[turned ? 1 : 2]]};
  }
  return isolines(places, faces, std::vector<double>(found.begin(), found.end()), values);
}
template std::vector<Path> isolines(const PointCloud<float>&, const GivenPoints&,
                                    const Given<float>&, const Given<double>&);
template std::vector<Path> isolines(const PointCloud<double>&, const GivenPoints&,
                                    const Given<double>&, const Given<double>&);

namespace {

using Position = std::array<double, 3>;

// What one value cuts: in each tetrahedron a triangle or a quadrilateral.
class SurfaceCut {
 public:
  SurfaceCut(std::span<const Position> positions, std::span<const double> distance, double value,
             Index number, Isosurfaces& out)
      : positions_(positions), distance_(distance), value_(value), number_(number), out_(out) {}

  void tet(const std::array<Index, 4>& corner) {
    std::array<Index, 4> below{}, above{};
    std::size_t low = 0, high = 0;
    for (const Index v : corner) {
      if (!std::isfinite(distance_[v])) return;
      // A vertex with just this value counts as above it.
      if (distance_[v] >= value_)
        above[high++] = v;
      else
        below[low++] = v;
    }
    if (low == 0 || high == 0) return;
    if (low == 1) {
      triangle(at(below[0], above[0]), at(below[0], above[1]), at(below[0], above[2]), below[0]);
    } else if (high == 1) {
      triangle(at(below[0], above[0]), at(below[1], above[0]), at(below[2], above[0]), below[0]);
    } else {
      const Index a = at(below[0], above[0]), b = at(below[0], above[1]);
      const Index c = at(below[1], above[1]), d = at(below[1], above[0]);
      triangle(a, b, c, below[0]);
      triangle(a, c, d, below[0]);
    }
  }

 private:
  // The vertex on an edge; at its upper end where that has just the value.
  Index at(Index low, Index high) {
    const double share = (value_ - distance_[low]) / (distance_[high] - distance_[low]);
    const bool at_end = distance_[high] == value_;
    const Index first = at_end ? high : std::min(low, high), second = std::max(low, high);
    const std::uint64_t edge = std::uint64_t{first} << 32 | (at_end ? high : second);
    const auto [known, is_new] = vertex_.emplace(edge, static_cast<Index>(out_.positions.size()));
    if (is_new) {
      Position p;
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = at_end ? positions_[high][k]
                      : positions_[low][k] + share * (positions_[high][k] - positions_[low][k]);
      out_.positions.push_back(p);
      out_.value.push_back(number_);
    }
    return known->second;
  }

  // Clockwise as seen from `below`, which never lies in its plane.
  void triangle(Index a, Index b, Index c, Index below) {
    if (a == b || b == c || c == a) return;
    if (turn(a, b, c, positions_[below]) > 0) std::swap(b, c);
    out_.triangles.push_back({a, b, c});
  }
  [[nodiscard]] double turn(Index a, Index b, Index c, const Position& p) const {
    Position u, v, w;
    for (std::size_t k = 0; k < 3; ++k) {
      u[k] = out_.positions[b][k] - out_.positions[a][k];
      v[k] = out_.positions[c][k] - out_.positions[a][k];
      w[k] = p[k] - out_.positions[a][k];
    }
    return w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) +
           w[2] * (u[0] * v[1] - u[1] * v[0]);
  }

  std::span<const Position> positions_;
  std::span<const double> distance_;
  double value_;
  Index number_;
  Isosurfaces& out_;
  std::unordered_map<std::uint64_t, Index> vertex_;
};

}  // namespace

Isosurfaces isosurfaces(const GivenPoints& positions, const GivenSimplices<4>& tets,
                        const Given<double>& distance, const Given<double>& values) {
  check_level_sets(positions.size(), std::span(tets), distance, values, "tetrahedron",
                   "isosurface");
  Isosurfaces found;
  for (std::size_t n = 0; n < values.size(); ++n) {
    SurfaceCut cut(positions, distance, values[n], static_cast<Index>(n), found);
    for (const auto& tet : tets) cut.tet(tet);
  }
  return found;
}

}  // namespace plexway
