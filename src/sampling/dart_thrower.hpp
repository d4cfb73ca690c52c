#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/sampling/poisson_disk.hpp>

#include "executors/solid_growth.hpp"
#include "executors/surface_growth.hpp"
#include "fields/cut_domain.hpp"
#include "sampling/random.hpp"

namespace plexway::detail {

/// One maximal Poisson-disk sample of a domain whose simplices are small against the radius.
///
/// A dart with radius rho starts with the offset limit - rho, limit being the largest radius: then
/// a point is covered if its field is below the limit, whichever dart is nearest.
template <class Complex>
class DartThrower {
  using Field = Growth<Complex>;
  using Real = typename Field::Number;
  static constexpr std::size_t corners = Field::corners;

 public:
  struct Dart {
    Index vertex;   ///< or none
    Index simplex;  ///< numbers inside
    Weights weights;
  };
  /// Where darts go. Numbers and unit inside.
  struct Target {
    std::span<const double> radii;    ///< one a vertex
    std::span<const Index> vertices;  ///< that darts may hit if the options want them there
    /// Into which simplices they go; empty: all.
    std::vector<bool> open;
    std::vector<Dart> earlier;  ///< that are there already
  };

  /// `report(share)` hears how much is covered.
  template <class Report>
  DartThrower(Field& field, Target target, const PoissonOptions& options, Random& random,
              Report report)
      : field_(field),
        radii_(target.radii),
        open_(std::move(target.open)),
        limit_(static_cast<Real>(*std::max_element(radii_.begin(), radii_.end()))),
        random_(random),
        darts_(std::move(target.earlier)),
        earlier_(darts_.size()) {
    field_.clear();
    for (Index n = 0; n < darts_.size(); ++n) add(darts_[n], n);
    if (options.at_vertices)
      throw_at_vertices(target.vertices, report);
    else
      throw_everywhere(options.order, report);
  }

  /// Those that were thrown.
  [[nodiscard]] std::span<const Dart> darts() const { return std::span(darts_).subspan(earlier_); }
  [[nodiscard]] std::size_t thrown() const { return thrown_; }
  [[nodiscard]] std::size_t taken_back() const { return taken_back_; }

 private:
  using Corners = std::array<Weights, corners>;
  static constexpr unsigned kinds = 1u << (corners - 1);  ///< parts that a piece is cut into

  /// A part of a simplex that was cut `level` times, each time into `kinds` parts; `way` has the
  /// number of the part that was taken each time, the last one lowest. There are many pieces, so
  /// their corners are worked out when one is drawn.
  struct Piece {
    std::uint64_t way = 0;
    Index simplex;
    int level = 0;
  };
  static constexpr Real least_share = 1 - Real(5e-4);  ///< of a radius, between two darts
  static constexpr int most_levels = 64 / static_cast<int>(corners - 1);

  [[nodiscard]] bool open(Index s) const { return open_.empty() || open_[s]; }

  template <class Report>
  void throw_at_vertices(std::span<const Index> vertices, Report& report) {
    std::vector<Index> order(vertices.begin(), vertices.end());
    random_.shuffle(std::span(order));
    for (std::size_t n = 0; n < order.size(); ++n) {
      const Index v = order[n];
      if (n % 4096 == 0) report(static_cast<double>(n) / static_cast<double>(order.size()));
      ++thrown_;
      const Real nearest = field_.vertex_distance(v);
      if (nearest < limit_) continue;
      Real size = 0;
      field_.each_corner_at(v, [&](Index c) { size = std::max(size, field_.size(c / corners)); });
      (void)take({v, none, {}}, nearest, size);
    }
  }

  template <class Report>
  void throw_everywhere(DartOrder order, Report& report) {
    const Index simplices = static_cast<Index>(field_.simplices());
    std::vector<double> sum(simplices);
    double total = 0;
    for (Index s = 0; s < simplices; ++s) {
      sum[s] = total += open(s) ? static_cast<double>(field_.measure(s)) : 0;
      largest_ = std::max(largest_, field_.size(s));
    }
    if (!(total > 0)) return;
    if (order == DartOrder::simplices)
      throw_into_each(report);
    else
      throw_until_crowded(sum, report);
    throw_into_gaps(total, report);
  }

  template <class Report>
  void throw_into_each(Report& report) {
    std::vector<Index> order(field_.simplices());
    std::iota(order.begin(), order.end(), Index{0});
    random_.shuffle(std::span(order));
    for (std::size_t n = 0; n < order.size(); ++n) {
      if (n % 4096 == 0) report(static_cast<double>(n) / static_cast<double>(order.size()));
      if (open(order[n])) throw_into(order[n], whole());
    }
  }

  /// While most of the domain is free: anywhere.
  template <class Report>
  void throw_until_crowded(const std::vector<double>& sum, Report& report) {
    // Where to look in `sum` for each part of the whole.
    const std::size_t marks = sum.size() / 8 + 1;
    const double scale = static_cast<double>(marks) / sum.back();
    std::vector<Index> mark(marks + 1, static_cast<Index>(sum.size() - 1));
    for (std::size_t s = sum.size(); s-- > 0;)
      mark[std::min(marks, static_cast<std::size_t>(sum[s] * scale))] = static_cast<Index>(s);
    for (std::size_t m = marks; m-- > 0;) mark[m] = std::min(mark[m], mark[m + 1]);
    constexpr std::size_t round = 256, enough = 5;
    for (std::size_t hits = round; hits >= enough;) {
      hits = 0;
      for (std::size_t n = 0; n < round; ++n) {
        const double at = random_.uniform() * sum.back();
        Index s = mark[static_cast<std::size_t>(at * scale)];
        while (s + 1 < sum.size() && !(at < sum[s])) ++s;
        hits += throw_into(s, whole());
      }
      report(1 - static_cast<double>(hits) / static_cast<double>(round));
    }
  }

  /// Then among the parts of simplices that no single dart covers, cut ever smaller.
  template <class Report>
  void throw_into_gaps(double total, Report& report) {
    WeightedPieces<Piece> pieces;
    const auto add = [&](const Piece& piece) {
      pieces.add(piece, static_cast<double>(field_.measure(piece.simplex)) *
                            std::ldexp(1., -static_cast<int>(corners - 1) * piece.level));
    };
    for (Index s = 0; s < field_.simplices(); ++s) {
      if (field_.reached(s) && (field_.distance(s) + largest_ <= limit_ ||
                                field_.distance(s) + field_.size(s) <= limit_))
        continue;
      if (open(s) && !covered(s, whole())) add(Piece{.simplex = s});
    }
    for (std::size_t n = 0; !pieces.empty(); ++n) {
      if (n % 4096 == 0) report(std::max(0., 1 - pieces.bound() / total));
      const Piece piece = pieces.draw(random_);
      const Corners corner = corners_of(piece);
      const std::size_t taken_back = taken_back_;
      throw_into(piece.simplex, corner);
      // Below this no one would find a gap. A dart that was taken back found that the piece is
      // covered after all, though no label here says so.
      const Real size = std::ldexp(field_.size(piece.simplex), -piece.level) / limit_;
      if (size < (taken_back_ > taken_back ? Real(5e-3) : Real(1e-4)) || piece.level == most_levels)
        continue;
      add_open_parts(piece, corner, add);
    }
  }

  static Corners whole() {
    Corners corner{};
    for (std::size_t i = 0; i < corners; ++i) corner[i][i] = 1;
    return corner;
  }
  static Corners corners_of(const Piece& piece) {
    Corners corner = whole();
    constexpr int bits = corners - 1;
    for (int level = piece.level; level-- > 0;)
      corner = part_of(corner, static_cast<unsigned>(piece.way >> bits * level) % kinds);
    return corner;
  }

  /// Is there one dart that covers all of it? The points that a label covers are convex within a
  /// simplex, so its corners tell.
  bool covered(Index s, const Corners& corner) {
    bool any = false;
    field_.each_label(s, [&](Index, const auto& distance) {
      any = true;
      for (const Weights& w : corner) any = any && distance(w) <= limit_;
      return any;
    });
    return any;
  }

  /// Cut into 2^N parts of equal size; those that no single dart covers.
  template <class Add>
  void add_open_parts(const Piece& piece, const Corners& corner, Add add) {
    std::array<Corners, kinds> part;
    for (unsigned n = 0; n < kinds; ++n) part[n] = part_of(corner, n);
    unsigned open = (1u << kinds) - 1;
    field_.each_label(piece.simplex, [&](Index, const auto& distance) {
      for (unsigned n = 0; n < kinds; ++n) {
        if (!(open >> n & 1)) continue;
        bool all = true;
        for (const Weights& w : part[n]) all = all && distance(w) <= limit_;
        if (all) open &= ~(1u << n);
      }
      return open == 0;
    });
    for (unsigned n = 0; n < kinds; ++n)
      if (open >> n & 1) add(Piece{piece.way * kinds + n, piece.simplex, piece.level + 1});
  }

  /// Part n of these: those at the corners first, then what is left in the middle.
  static Corners part_of(const Corners& corner, unsigned n) {
    const auto middle = [&](std::size_t i, std::size_t j) {
      Weights w{};
      for (std::size_t k = 0; k < corners; ++k) w[k] = (corner[i][k] + corner[j][k]) / 2;
      return w;
    };
    Corners part;
    if (n < corners) {
      for (std::size_t j = 0; j < corners; ++j) part[j] = n == j ? corner[n] : middle(n, j);
    } else if constexpr (corners == 3) {
      part = {middle(0, 1), middle(1, 2), middle(2, 0)};
    } else {  // an octahedron, around one of its diagonals
      constexpr std::size_t ring[4][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
      const auto &a = ring[n - 4], &b = ring[(n - 3) % 4];
      part = {middle(0, 2), middle(1, 3), middle(a[0], a[1]), middle(b[0], b[1])};
    }
    return part;
  }

  /// A dart at a random point of a part of a simplex; false if that is covered.
  bool throw_into(Index s, const Corners& corner) {
    std::array<double, corners + 1> cut{};  // spacings of sorted numbers are uniform weights
    for (std::size_t i = 1; i < corners; ++i) cut[i] = random_.uniform();
    cut[corners] = 1;
    std::sort(cut.begin(), cut.end());
    Weights w{};
    for (std::size_t i = 0; i < corners; ++i)
      for (std::size_t k = 0; k < corners; ++k) w[k] += (cut[i + 1] - cut[i]) * corner[i][k];

    ++thrown_;
    Real nearest = std::numeric_limits<Real>::infinity();
    field_.each_label(s, [&](Index, const auto& distance) {
      nearest = std::min(nearest, distance(w));
      return nearest < limit_;
    });
    return !(nearest < limit_) && take({none, s, w}, nearest, field_.size(s));
  }

  void add(const Dart& dart, Index number) {
    const Real sigma = limit_ - radius_of(dart);
    if (dart.vertex != none)
      field_.add_vertex(dart.vertex, sigma, number, limit_);
    else
      field_.add(dart.simplex, dart.weights, sigma, number, limit_);
  }

  /// Labels keep one or two darts, the nearest, so another may be overlooked. `nearest` is how far
  /// those are.
  bool take(const Dart& dart, Real nearest, Real size) {
    const bool far = nearest > limit_ + 4 * size;
    const auto number = static_cast<Index>(darts_.size());
    const Real own = radius_of(dart);
    bool fits = true;
    if constexpr (Field::exact) {
      const auto reach = [&](Index n) { return radius_of(darts_[n]) * least_share; };
      fits = far || !field_.is_near_another(dart.vertex, dart.simplex, dart.weights, own, reach);
      if (fits) add(dart, number);
    } else {
      add(dart, number);
      fits = far || keeps_off(number, own);
      if (!fits) field_.remove_last(number, limit_);
    }
    if (fits)
      darts_.push_back(dart);
    else
      ++taken_back_;
    return fits;
  }

  /// A triangle keeps one label, that of the dart nearest to its centre. Another shows where the
  /// fronts meet: halfway to it, where nobody else is near.
  bool keeps_off(Index number, Real own) {
    bool fits = true;
    for (const Index s : field_.touched()) {
      if (!fits) break;
      // Fronts meet where both have walked as far, less their offsets: at most half the radius.
      if (field_.source(s) != number ||
          field_.distance(s) - (limit_ - own) - 2 * field_.size(s) > own / 2)
        continue;
      field_.each_meeting(s, [&](Real length, Index other) {
        const Real radius = radius_of(darts_[other]);
        fits = fits && length - (limit_ - own) - (limit_ - radius) >= radius * least_share;
      });
    }
    return fits;
  }

  [[nodiscard]] Real radius_of(const Dart& d) const {
    if (d.vertex != none) return static_cast<Real>(radii_[d.vertex]);
    double radius = 0;
    for (std::size_t k = 0; k < corners; ++k)
      radius += d.weights[k] * radii_[field_.corners_of(d.simplex)[k]];
    return static_cast<Real>(radius);
  }

  Field& field_;
  std::span<const double> radii_;
  std::vector<bool> open_;
  Real limit_, largest_ = 0;
  Random& random_;
  std::vector<Dart> darts_;
  std::size_t earlier_;  // darts that were there
  std::size_t thrown_ = 0, taken_back_ = 0;
};

}  // namespace plexway::detail
