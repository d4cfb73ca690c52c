#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "strings/pull.hpp"
#include "strings/solid_space.hpp"
#include "strings/state.hpp"

namespace plexway::detail::strings {

/// Ways around a vertex of the boundary: the solid near a vertex as seen from there: directions,
/// and the faces between them. Strings turn about rows of edges; unfolded, a way from one direction
/// to another is as long as its angles.
class Corner {
 public:
  /// A row of edges at the vertex, the way from there, and the angle up to there.
  struct Row {
    Index place;
    Point along;
    double turned;
  };
  /// The rows that the shortest way through the solid passes, if it turns less than pi: a string
  /// that comes to the vertex and goes on in these directions is shorter beside it, to first order.
  /// False if there is none.
  bool find(const SolidSpace& space, Index vertex, const Point& in, const Point& out);
  /// Another one, that begins at another row.
  bool find_other(const SolidSpace& space);
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  [[nodiscard]] double turned() const { return turned_; }

 private:
  struct Side {
    Point normal, inward[2];  // of a face, and of its edges at the vertex, in its plane
  };
  struct Node {
    Index place;
    Point along;
    double turned;
    std::size_t before;
    bool done, left_out = false;
  };
  void look(const SolidSpace& space, Index vertex);
  [[nodiscard]] bool is_open(const SolidSpace& space, const Node& a, const Node& b) const;

  std::vector<Side> sides_;
  std::vector<Node> nodes_;
  std::vector<Row> rows_;
  double turned_ = 0;
};

/// Takes the strings of a node on to others. A string goes on to a node that shares an edge,
/// through each place of the point as well. It is pulled taut; where it leaves a patch it slides on
/// to the row there, where it wants back in it is let, what it lifts off is dropped, and where a
/// leg leaves its medium the bend that it touches first is put in. The state is only read: each
/// thread has an extender of its own.
class Extender {
 public:
  explicit Extender(const State& state)
      : state_(&state), space_(state.space), plain_(state.plain) {}

  /// The string of a node may be another one now.
  void forget(Index node) {
    if (base_node_ == node) base_node_ = none;
  }
  /// To all nodes that share an edge with it or with others of its point.
  void expand(Index node, const Label& label, Offers& offers);
  /// To one of these.
  void extend(Index node, const Label& label, Index to, Offers& offers);
  /// Along the edge as it is, which is in the domain whatever is around it.
  void go_by_edge(Index node, const Label& label, Index to, Offers& offers);
  /// Its length at a node near by, however long; +inf where it is not found free.
  [[nodiscard]] double moved(Index node, const Label& label, Index to);
  /// Its string, taut.
  [[nodiscard]] const String& string(Index node, const Label& label) {
    prepare(node, label);
    return base_.string;
  }
  [[nodiscard]] std::size_t bytes() const {
    return corners_.size() * (sizeof(Place) + 4 * sizeof(void*));
  }

 private:
  using Kind = MediaSpace::Kind;
  static constexpr double unreached = State::unreached, rounding = State::rounding;
  static constexpr double unmoved = 1e-9;  // an end that moved less did not move
  static constexpr double outside = 1e-6;  // of a patch
  static constexpr double gain = 1e-7;     // slopes that count, of the slowness
  static constexpr double brief = 1e-5;    // legs that may have no length

  /// A string on its way to a new end.
  struct Attempt {
    String string;
    Index root = 0;
    bool touched = false;  ///< something was put in
    int splits = 0;
  };
  enum class Outcome { free, longer, stuck };

  void prepare(Index node, const Label& label);
  Outcome offer(Index from, const Label& label, Index to, Index door, Offers& offers);
  Outcome offer_through(Index node, const Label& label, Index to, Offers& offers);
  void offer_edge(Index node, const Label& label, Index to, Offers& offers);
  void accept(const Attempt& a, Index to, Offers& offers);
  [[nodiscard]] double bound(Index from, const Label& label, Index to, Index door) const;
  void go_by_corner(Index from, const Label& label, Index to);
  Outcome attempt_corner(Index from, const Label& label, Index to);
  Outcome attempt(Index from, const Label& label, Index to, Index door);
  void start(Index to);
  Outcome settle(Attempt& a, Index to, double least);
  Outcome improve(Attempt& a, Index to, Outcome outcome);
  void past_corners(Attempt& a, Index to, Outcome& outcome);
  [[nodiscard]] Index vertex_of(const Attempt& a, std::size_t k) const;
  bool past_corner(Attempt& a, Index to, Outcome& outcome, std::size_t begin, std::size_t end,
                   Index vertex);
  void past_media(Attempt& a, Index to, Outcome& outcome);
  void past_row(Attempt& a, Index to, Outcome& outcome, std::size_t k);
  bool instead(Attempt& a, Index to, Outcome& outcome, std::size_t k, std::span<const Index> doors);

  bool collapse(Attempt& a, std::size_t leg, bool& useless);
  bool rearrange(Attempt& a, Index to, bool& useless);
  bool leave_patch(Attempt& a, std::size_t k);
  bool lift_off_row(Attempt& a, std::size_t k);
  bool lift_off_corner(Attempt& a, std::size_t k);
  [[nodiscard]] bool presses(const Attempt& a, std::size_t k, const Leg& in, const Point& from,
                             Index to) const;
  bool drop_lifted(Attempt& a, std::size_t k, Index to);
  [[nodiscard]] bool gains(const Point& in, const Point& out, std::span<const Index> doors,
                           Index before, const Point& at, Index row);
  void move_apart(Attempt& a, std::size_t begin, const Point& at);
  std::size_t blocked(const Attempt& a, Index to);
  bool insert_touched(Attempt& a, std::size_t leg, Index to);
  void replace(Attempt& a, std::size_t begin, std::size_t end, std::span<const Index> doors,
               const Point& at);
  void append(Attempt& a, Index door, const Point& at);
  [[nodiscard]] Knot knot(Index door, const Point& at);
  const Place* place(Index number);

  [[nodiscard]] double slowness(Index medium) const { return state_->slowness(medium); }
  [[nodiscard]] const Point& at(Index node) const { return state_->at(node); }
  [[nodiscard]] Index place_of(const Knot& knot) const { return space_->place_of(knot.door); }
  [[nodiscard]] Kind kind(const Knot& knot) const { return space_->kind(place_of(knot)); }
  [[nodiscard]] Index source_of(const Attempt& a) const { return state_->roots[a.root].source; }
  [[nodiscard]] double offset(const Attempt& a) const {
    return state_->sources[source_of(a)].offset;
  }
  [[nodiscard]] double length(const Attempt& a) const { return offset(a) + a.string.length; }
  [[nodiscard]] Point end_of_leg(const Attempt& a, std::size_t k, std::size_t other,
                                 Index to) const;
  [[nodiscard]] Point toward(const Attempt& a, std::size_t k, std::size_t other, Index to) const;
  [[nodiscard]] std::uint64_t media_of(const Attempt& a) const;
  [[nodiscard]] bool is_edge(const Attempt& a) const;
  [[nodiscard]] static Point last_leg(const Attempt& a) {
    return a.string.direction(a.string.bends());
  }

  const State* state_;
  const MediaSpace* space_;
  bool plain_;
  std::unordered_map<Index, Place> corners_;
  Puller puller_;
  Corner corner_;
  Attempt base_;  // the string of the node that offers
  Index base_node_ = none, base_chain_ = none, root_chain_ = none;
  Attempt attempt_, other_;
  String single_;              // a problem at one point
  std::vector<Place> copies_;  // of its places
  std::vector<Point> apart_;   // and where they are
  std::vector<Index> doors_, places_;
  Index from_ = none;
  double found_ = 0;   // the shortest that was found of what is offered
  double direct_ = 0;  // on from there along the edge: a string that is offered is no longer
};

}  // namespace plexway::detail::strings
