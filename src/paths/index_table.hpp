#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway {

/// Values by number, for a few of very many numbers: open addressing.
template <class Value>
class IndexTable {
 public:
  /// The value of a key, and whether it is new. A reference lasts until the next call.
  std::pair<Value&, bool> get(Index key) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = find(key);
    const bool fresh = slot.key != key;
    if (fresh) slot.key = key, slot.value = Value{}, ++count_;
    return {slot.value, fresh};
  }

 private:
  struct Slot {
    Index key = none;
    Value value{};
  };
  Slot& find(Index key) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at =
        static_cast<std::size_t>((key * std::uint64_t{0x9E3779B97F4A7C15}) >> 20) & mask;
    while (slots_[at].key != none && slots_[at].key != key) at = (at + 1) & mask;
    return slots_[at];
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 256 : 2 * slots_.size());
    old.swap(slots_);
    for (Slot& slot : old)
      if (slot.key != none) find(slot.key) = std::move(slot);
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace plexway
