#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>

#include <plexway/common/ids.hpp>
#include <plexway/solve/options.hpp>

#include "executors/gl/buffer.hpp"

namespace plexway::detail::gl {

/// shaders/front_control.glsl says what these mean.
struct FrontControl {
  enum State : GLuint { running, done, overflowed, out_of_budget };
  std::array<GLuint, 4> dispatch{0, 1, 1, 0}, settle_dispatch{0, 1, 1, 0},
      twin_dispatch{0, 1, 1, 0};
  GLuint state = running;
  GLuint current = 0, near = 1, far = 2;
  GLuint begin = 0, count = 0, total = 0, capacity = 0;
  std::array<GLuint, 3> waiting_in{};
  GLuint near_before = 0, far_before = 0, live = 0, was_far = 1;
  float limit = 0, step = 0;
  GLuint nearest_far = unreached, reached = 0, accepted = 0;
  std::array<GLuint, 2> expansions{}, updates{}, budget{};
  GLuint rounds = 0, spare = 0;

  static constexpr GLuint unreached = 0x7f800000u;  // the bits of +inf
  [[nodiscard]] static std::size_t wide(const std::array<GLuint, 2>& words) {
    return words[0] | static_cast<std::size_t>(words[1]) << 32;
  }
};

/// A waiting label: the same.
struct Waiting {
  GLuint cell, distance, round = 0;
};

/// shaders/front.glsl says what is in it.
struct Cell {
  GLuint least, rank, age, known;
};

/// The labels of a propagation and the queues in which they wait, on the device: who may write
/// where, and round after round until none waits. In a round first the least
/// offer to each simplex becomes its label, then those that got one make theirs: the result is a
/// matter of what is offered, not of who was faster. The rule is a shader of the owner's.
class Front {
 public:
  Front();
  void release(const Session& session);
  [[nodiscard]] std::size_t bytes() const;

  /// All `cells` unreached, nothing waits. `label_bytes`: of one label; `room`: for so many waiting
  /// ones at first.
  void start(const Session& session, std::size_t cells, std::size_t label_bytes, std::size_t room,
             double step, std::size_t max_expansions);

  /// Puts labels into the first queue; of those for one cell the best is accepted.
  template <class Label>
  void seed(const Session& session, std::span<const Waiting> entries,
            std::span<const Label> labels) {
    make_room(session, entries.size());
    waiting_.write(session, entries);
    waiting_labels_.write(session, labels);
    begin_with(session, entries.size());
  }

  /// Calls `add`, a dispatch that puts labels into the far queue, again with more room if it found
  /// too little; then accepts them. How many.
  std::size_t add(const Session& session, const std::function<void()>& add);

  /// Rounds of the program `rule`, a work group of which expands `share` labels, until nothing
  /// waits. `label_defines` says to front_label.glsl what labels are. `report` gets the state every
  /// few rounds. By `narrow`, if any, the labels that a round settled hear from those of neighbours
  /// before `rule` offers them and keeps what they heard. False if the budget is spent: then the
  /// labels that still wait have been settled.
  bool spread(const Session& session, GLuint rule, std::size_t share,
              const std::string& label_defines,
              const std::function<void(const FrontControl&)>& report, GLuint narrow = 0);

  /// Makes the labels of all cells zeros: for rules that look at those of neighbours.
  void clear_labels(const Session& session, std::size_t cells) {
    labels_.fill(session, 0, cells * (label_bytes_ / sizeof(GLuint)));
  }

  /// Bindings 0 to 4: control, cells, labels, waiting, waiting labels.
  void bind(const Session& session) const;
  [[nodiscard]] const Buffer& cells() const { return cells_; }
  [[nodiscard]] const Buffer& labels() const { return labels_; }
  [[nodiscard]] const FrontControl& state() const { return state_; }  ///< when it was last read
  [[nodiscard]] std::size_t growths() const { return growths_; }

 private:
  [[nodiscard]] std::size_t most_entries(const Session& session) const;
  void make_room(const Session& session, std::size_t entries);
  void begin_with(const Session& session, std::size_t entries);
  void accept(const Session& session, std::size_t first, std::size_t count);
  void launch(const Session& session, GLuint program, std::size_t indirect) const;
  void settle_all(const Session& session, const std::string& label_defines);
  void grow(const Session& session);
  void write_state(const Session& session);
  void read_state(const Session& session);
  void advance(const Session& session, std::size_t share);

  Buffer control_, cells_, labels_, waiting_, waiting_labels_;
  FrontControl state_;
  std::size_t label_bytes_ = 0, growths_ = 0;
};

/// Dispatches enough work groups for so many invocations and makes what they write visible.
void dispatch(const Session& session, std::size_t invocations);

}  // namespace plexway::detail::gl
