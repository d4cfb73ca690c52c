#pragma once

#include <cstddef>

#include <plexway/common/ids.hpp>

#include "labels/front.hpp"

namespace plexway {

/// Vertices whose neighbours must be looked at again, in the room of a front that has run empty. If
/// that should not be enough, some are lost, and it says so.
class ChangedVertices {
 public:
  explicit ChangedVertices(FrontStorage& storage)
      : list_(storage.near.get()), capacity_(storage.capacity) {}

  void clear() { count_ = 0, some_ = lost_ = false; }
  void push(Index vertex) {
    some_ = true;
    if (count_ < capacity_)
      list_[count_++] = vertex;
    else
      lost_ = true;
  }
  bool pop(Index& vertex) {
    if (count_ == 0) return false;
    vertex = list_[--count_];
    return true;
  }
  [[nodiscard]] bool some() const { return some_; }
  [[nodiscard]] bool lost() const { return lost_; }

 private:
  Index* list_;
  std::size_t capacity_, count_ = 0;
  bool some_ = false, lost_ = false;
};

}  // namespace plexway
