#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// Per simplex: reached in this propagation or an earlier one, waiting or not, and by which hinge
/// the path came in. Two bytes, and nothing to clear between propagations: marks of earlier ones
/// carry an older number.
class VisitMarks {
 public:
  using Mark = std::uint16_t;
  static constexpr Mark hinge_mask = 7, waiting = 8;  // simplices have up to 5 facets
  static constexpr int epoch_shift = 4;

  void resize(std::size_t simplices) {
    if (marks_.size() != simplices) marks_.assign(simplices, 0), epoch_ = 0;
  }
  /// All unreached.
  void start() {
    if (++epoch_ == 1 << (16 - epoch_shift)) {
      std::fill(marks_.begin(), marks_.end(), Mark{0});
      epoch_ = 1;
    }
    current_ = static_cast<Mark>(epoch_ << epoch_shift);
  }
  [[nodiscard]] Mark* data() { return marks_.data(); }
  [[nodiscard]] const Mark* data() const { return marks_.data(); }
  [[nodiscard]] Mark current() const { return current_; }
  [[nodiscard]] bool reached(Index s) const { return (marks_[s] ^ current_) < (1 << epoch_shift); }
  [[nodiscard]] std::size_t hinge(Index s) const { return marks_[s] & hinge_mask; }
  [[nodiscard]] std::size_t bytes() const { return marks_.capacity() * sizeof(Mark); }

 private:
  std::vector<Mark> marks_;
  int epoch_ = 0;
  Mark current_ = 0;
};

}  // namespace plexway
