#include <plexway/apps/isolines.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/level_sets.hpp"

namespace plexway {
namespace {

using Edge = std::pair<Index, Index>;

// What one value cuts: in each face at most one straight piece, from edge to edge.
class Cut {
 public:
  Cut(std::span<const std::array<double, 3>> positions, std::span<const std::array<Index, 3>> faces,
      std::span<const double> distance, double value)
      : positions_(positions), faces_(faces), distance_(distance), value_(value) {
    for (Index f = 0; f < faces.size(); ++f) {
      if (!std::all_of(faces[f].begin(), faces[f].end(),
                       [&](Index v) { return std::isfinite(distance[v]); }))
        continue;
      Edge ends[2];
      int count = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const Index a = faces[f][i], b = faces[f][(i + 1) % 3];
        // A vertex with just this value counts as above it: no line ends there.
        if (above(a) != above(b) && count < 2) ends[count++] = std::minmax(a, b);
      }
      if (count < 2) continue;
      for (const Edge& end : ends) at_.emplace(end, pieces_.size());
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

  [[nodiscard]] bool above(Index v) const { return distance_[v] >= value_; }

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
      line.points.back().simplex = piece.face;
      set_weights(line.points.back(), piece.face, piece.ends[end]);
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

  [[nodiscard]] double share(const Edge& edge) const {
    const double a = distance_[edge.first], b = distance_[edge.second];
    return (value_ - a) / (b - a);
  }
  void set_weights(PathPoint& point, Index face, const Edge& edge) const {
    const double t = share(edge);
    point.barycentric = {0, 0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      if (faces_[face][i] == edge.first) point.barycentric[i] = 1 - t;
      if (faces_[face][i] == edge.second) point.barycentric[i] = t;
    }
  }
  void add(Path& line, Index face, const Edge& edge) const {
    PathPoint point{face, {}};
    set_weights(point, face, edge);
    const auto &a = positions_[edge.first], &b = positions_[edge.second];
    std::array<double, 3> at;
    double step = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = a[k] + share(edge) * (b[k] - a[k]);
      if (!line.positions.empty()) step += std::pow(at[k] - line.positions.back()[k], 2);
    }
    line.length += std::sqrt(step);
    line.points.push_back(point);
    line.positions.push_back(at);
  }

  std::span<const std::array<double, 3>> positions_;
  std::span<const std::array<Index, 3>> faces_;
  std::span<const double> distance_;
  double value_;
  std::vector<Piece> pieces_;
  std::multimap<Edge, std::size_t> at_;
};

}  // namespace

std::vector<Path> isolines(std::span<const std::array<double, 3>> positions,
                           std::span<const std::array<Index, 3>> faces,
                           std::span<const double> distance, std::span<const double> values) {
  check_level_sets(positions.size(), faces, distance, values, "face", "isoline");
  std::vector<Path> lines;
  for (std::size_t n = 0; n < values.size(); ++n) {
    Cut(positions, faces, distance, values[n]).lines(static_cast<Index>(n), lines);
  }
  return lines;
}

}  // namespace plexway
