#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/mixed_piece.hpp"
#include "labels/mixed/taut_crossings.hpp"

namespace plexway {

/// Ways over hinges between solids and around edges of these, pulled taut. Where not every point of
/// a solid sees every other, lines are walked: bends that a way lifts off are left out, and what is
/// in its way is gone around.
template <class Real>
class BentWays {
 public:
  using Domain = MixedComplex<Real>;
  using Piece = MixedPiece<Real>;
  using Pieces = std::vector<std::unique_ptr<Piece>>;
  using Taut = TautCrossings<Real>;
  using Step = typename Taut::Step;
  using Point = Vector3<Real>;
  using String = typename Piece::String;

  struct Room {
    typename Taut::Room taut;
    std::vector<Step> given, before, between;
    std::vector<char> stays;  // by step: a bend that is to be kept
  };

  BentWays(const Domain& domain, const Pieces& pieces, const Taut& taut)
      : domain_(domain), pieces_(pieces), taut_(taut) {}

  /// Moves the steps of a way from `eye` to a vertex inside a piece until it is taut and free.
  /// Gives its length; +inf where it is not below `enough`, or no such way is found.
  Real pull(const Point& eye, Real sigma, std::vector<Step>& steps, Index piece, Index vertex,
            Real enough, Room& room) const {
    const Piece& own = *pieces_[piece];
    const Point target = own.unit() * own.place(vertex);
    constexpr int most_changes = 12;
    constexpr Real end = Real(1e-6);
    room.stays.assign(steps.size(), 0);
    room.given.assign(steps.begin(), steps.end());
    std::size_t left_out = none;
    bool at_end = false;
    for (int i = 0; i < most_changes; ++i) {
      const Real length = sigma + taut_.pull(eye, steps, target, room.taut);
      Change change = look(eye, steps, piece, vertex, room.stays);
      if (change.is == Look::free) return length < enough ? length : infinity;
      if (change.is == Look::lifts) {
        room.before.assign(steps.begin(), steps.end());
        left_out = change.step;
        at_end = !(steps[left_out].place[0] > end && steps[left_out].place[0] < 1 - end);
        take_out(steps, room, left_out);
        continue;
      }
      if (left_out != none && (at_end || change.edge == none)) {
        // It does not get past the edge's end, or lifts off by rounding.
        steps.assign(room.before.begin(), room.before.end());
        room.stays.insert(room.stays.begin() + static_cast<std::ptrdiff_t>(left_out), 1);
        left_out = none;
        continue;
      }
      if (!(length < enough)) break;  // what is gone around makes it longer
      if (change.edge == none && !move_on(eye, steps, piece, vertex, room, change)) break;
      if (change.is == Look::free) {
        const Real there = sigma + taut_.length(eye, steps, target);
        return there < enough ? there : infinity;
      }
      left_out = none;
      put_in(steps, room, change.step, taut_.bend(change.piece, change.edge, Real(.5)));
    }
    return infinity;
  }
  /// The bends of a string, behind a way's steps.
  void append(Index piece, const String& string, std::vector<Step>& steps) const {
    for (int i = 0; i < string.bends; ++i)
      steps.push_back(taut_.bend(piece, string.edge[i], string.share[i]));
  }

 private:
  using Look = typename Piece::Look;
  using StringEnd = typename Piece::StringEnd;
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  struct Change {
    decltype(Look::is) is = Look::free;
    std::size_t step = 0;
    Index piece = none, edge = none;
  };

  static void take_out(std::vector<Step>& steps, Room& room, std::size_t at) {
    steps.erase(steps.begin() + static_cast<std::ptrdiff_t>(at));
    room.stays.erase(room.stays.begin() + static_cast<std::ptrdiff_t>(at));
  }
  static void put_in(std::vector<Step>& steps, Room& room, std::size_t at, const Step& bend) {
    steps.insert(steps.begin() + static_cast<std::ptrdiff_t>(at), bend);
    room.stays.insert(room.stays.begin() + static_cast<std::ptrdiff_t>(at), 1);
  }

  // Where nothing is known of what hides a taut way: what hides it first on the way there from the
  // way that was given, or as far as nothing does. All in between is shorter than that, as lengths
  // are convex. False if the given one is hidden too, or is of other steps.
  bool move_on(const Point& eye, std::vector<Step>& steps, Index piece, Index vertex, Room& room,
               Change& change) const {
    constexpr int halvings = 8;
    if (steps.size() != room.given.size()) return false;
    for (std::size_t k = 0; k < steps.size(); ++k)
      if (taut_.is_bend(steps[k]) != taut_.is_bend(room.given[k]) ||
          (taut_.is_bend(steps[k]) && steps[k].hinge != room.given[k].hinge))
        return false;
    const std::vector<char> all(steps.size(), 1);  // what lifts off is a path as well
    const auto hidden = [&](std::span<const Step> way, Change& by) {
      by = look(eye, way, piece, vertex, all);
      return by.is != Look::free;
    };
    if (hidden(room.given, change)) return false;
    Real low = 0, high = 1;
    Change first;
    for (int i = 0; i < halvings; ++i) {
      const Real share = (low + high) / 2;
      room.between.assign(room.given.begin(), room.given.end());
      for (std::size_t k = 0; k < steps.size(); ++k)
        taut_.towards(room.between[k], steps[k], share);
      if (Change by; hidden(room.between, by)) {
        high = share;
        if (by.edge != none) first = by;
      } else {
        low = share;
      }
    }
    if (first.edge != none) {
      change = first;
      return true;
    }
    room.between.assign(room.given.begin(), room.given.end());
    for (std::size_t k = 0; k < steps.size(); ++k) taut_.towards(room.between[k], steps[k], low);
    steps.assign(room.between.begin(), room.between.end());
    change = {};
    return true;
  }

  // The first that is needed, from the end on.
  Change look(const Point& eye, std::span<const Step> steps, Index piece, Index vertex,
              const std::vector<char>& stays) const {
    StringEnd end;
    end.vertex = vertex;
    for (std::size_t behind = steps.size();; --behind) {
      // As far as one piece goes.
      std::size_t first = behind;
      while (first > 0 && taut_.is_bend(steps[first - 1])) --first;
      const Step* const crossing = first > 0 ? &steps[first - 1] : nullptr;
      if (!pieces_[piece]->sees_all()) {
        const Look found = look(eye, crossing, steps.subspan(first, behind - first),
                                stays.data() + first, piece, end);
        if (found.is != Look::free)
          return {found.is, first + static_cast<std::size_t>(found.place), piece, found.edge};
      }
      if (crossing == nullptr) return {};
      behind = first;
      const auto& hinge = domain_.hinges()[crossing->hinge];
      piece = hinge.piece[crossing->side];
      end = at_hinge(*crossing, crossing->side);
    }
  }
  Look look(const Point& eye, const Step* crossing, std::span<const Step> bends, const char* stays,
            Index piece, const StringEnd& end) const {
    String string;
    if (bends.size() > String::most) return {Look::hidden};
    string.bends = static_cast<int>(bends.size());
    for (std::size_t i = 0; i < bends.size(); ++i) {
      string.edge[i] = taut_.edge_of(piece, bends[i]);
      string.share[i] = bends[i].place[0];
      string.stays[i] = stays[i] != 0;
    }
    string.from = crossing == nullptr ? eye : taut_.place(*crossing, 1 - crossing->side);
    const StringEnd begin =
        crossing == nullptr ? StringEnd() : at_hinge(*crossing, 1 - crossing->side);
    return pieces_[piece]->look(string, begin, end);
  }
  [[nodiscard]] StringEnd at_hinge(const Step& step, std::size_t side) const {
    const auto& hinge = domain_.hinges()[step.hinge];
    StringEnd end;
    end.member = &domain_.members()[hinge.begin[side]];
    end.dimension = hinge.dimension;
    end.place = step.place;
    return end;
  }

  const Domain& domain_;
  const Pieces& pieces_;
  const Taut& taut_;
};

}  // namespace plexway
