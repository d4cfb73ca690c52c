#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include <plexway/complex/mixed_complex.hpp>

#include "propagate/bent_ways.hpp"
#include "propagate/mixed_piece.hpp"

namespace plexway {

/// Whole ways as labels in solids tell them: each label is a string, each crossing knows the string
/// that it was made for, and that may begin at the crossing before.
template <class Real>
class WholeWays {
 public:
  using Domain = MixedComplex<Real>;
  using Member = typename Domain::Member;
  using Piece = MixedPiece<Real>;
  using Pieces = std::vector<std::unique_ptr<Piece>>;
  using Point = Vector3<Real>;
  using Taut = TautCrossings<Real>;
  using Step = typename Taut::Step;

  struct Way {
    Point eye;
    Real sigma = infinity;
    Index source;  // a label's, perhaps a crossing's number
    std::vector<Step> steps;
    [[nodiscard]] bool known() const { return sigma < infinity; }
  };

  WholeWays(const Domain& domain, const Pieces& pieces) : domain_(domain), pieces_(pieces) {
    for (const auto& piece : pieces) {
      bends_ |= piece->bend_edges() > 0 || (piece->is_solid() && !piece->sees_all());
      find_torn(*piece, domain.pieces()[torn_.size()].vertices);
    }
  }
  /// Is any more to tell than in solids in which every point sees every other?
  [[nodiscard]] bool any() const { return bends_; }

  /// The crossings are numbered from here on.
  void start(Index first) { first_ = first; }
  /// The next crossing: over a hinge to `start` in the domain's unit, by the label of member m.
  void add(Index hinge, std::uint8_t side, const HingePlace<Real>& place, const Point& start,
           Index m) {
    if (!bends_) return;
    Part& part = parts_.emplace_back(Part{{hinge, side, place}, start, {}, false});
    const auto& h = domain_.hinges()[hinge];
    part.known = pieces_[h.piece[1 - side]]->is_solid() &&
                 pieces_[h.piece[side]]->string_of(domain_.members()[m], part.string);
  }
  /// One that nothing is known of.
  void skip() {
    if (bends_) parts_.emplace_back();
  }

  /// The way that labels around a vertex inside a piece tell.
  void find(Index piece, Index vertex, const BentWays<Real>& bent, Way& way) const {
    way.sigma = infinity;
    way.steps.clear();
    if (String string; pieces_[piece]->string_to(vertex, string)) {
      lead_to(piece, string, bent, way);
      bent.append(piece, string, way.steps);
    }
  }
  /// And that of a crossing, it included.
  void find(Index number, const BentWays<Real>& bent, Way& way) const {
    way.sigma = infinity;
    way.steps.clear();
    const Part* const part = at(number);
    if (part == nullptr || !part->known) return;
    const Index piece = domain_.hinges()[part->step.hinge].piece[part->step.side];
    lead_to(piece, part->string, bent, way);
    bent.append(piece, part->string, way.steps);
    way.steps.push_back(part->step);
  }

 private:
  using String = typename Piece::String;
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  struct Part {
    Step step;
    Point start;
    String string;  // before the crossing
    bool known = false;
  };
  // Places of several vertices, as on the faces of a crack or where holes touch. What comes from
  // one of these is seen on its side alone, but a place does not tell which that is: ways from
  // there went through cracks (up to 73 % too short).
  void find_torn(const Piece& piece, Index vertices) {
    std::vector<Point>& torn = torn_.emplace_back();
    if (!piece.is_solid() || piece.sees_all()) return;
    std::vector<Point> all;
    for (Index v = 0; v < vertices; ++v) all.push_back(piece.unit() * piece.place(v));
    std::sort(all.begin(), all.end(), [](const Point& a, const Point& b) {
      return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
    });
    for (std::size_t i = 1; i < all.size(); ++i)
      if (all[i].x == all[i - 1].x && all[i].y == all[i - 1].y && all[i].z == all[i - 1].z)
        torn.push_back(all[i]);
    for (const Point& p : torn)
      near_ = std::max({near_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  [[nodiscard]] bool is_torn(Index piece, const Point& at) const {
    const Real near = 16 * std::numeric_limits<Real>::epsilon() * near_;
    auto p = std::lower_bound(torn_[piece].begin(), torn_[piece].end(), at.x - near,
                              [](const Point& point, Real x) { return point.x < x; });
    for (; p != torn_[piece].end() && p->x <= at.x + near; ++p)
      if (norm(*p - at) <= near) return true;
    return false;
  }
  [[nodiscard]] const Part* at(Index number) const {
    return number == none || number < first_ ? nullptr : &parts_[number - first_];
  }
  // Where a string begins: at the crossing of its label, or at a point that the label was put to.
  void lead_to(Index piece, const String& string, const BentWays<Real>& bent, Way& way) const {
    const Part* const before = at(string.source);
    const auto same = [](const Point& a, const Point& b) {
      return a.x == b.x && a.y == b.y && a.z == b.z;
    };
    if (before != nullptr && before->known && same(before->start, string.from)) {
      find(string.source, bent, way);
      return;
    }
    if (is_torn(piece, string.from)) return;
    way.eye = string.from;
    way.sigma = string.sigma;
    way.source = string.source;
  }

  const Domain& domain_;
  const Pieces& pieces_;
  bool bends_ = false;
  Real near_ = 0;                         // the largest coordinate of a torn place
  std::vector<std::vector<Point>> torn_;  // of each piece, by x
  Index first_ = 0;
  std::vector<Part> parts_;  // by crossing
};

}  // namespace plexway
