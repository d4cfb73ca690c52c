#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace plexway {

/// Memory for plain values of any type, kept from solve to solve: it grows and is never cleared.
class Room {
 public:
  /// Room for `count` values, the first `kept` of which stay what they are.
  template <class T>
  T* reserve(std::size_t count, std::size_t kept = 0) {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= alignment);
    if (const std::size_t wanted = count * sizeof(T); wanted > bytes_) {
      std::unique_ptr<std::byte, Free> grown(
          static_cast<std::byte*>(::operator new (wanted, std::align_val_t{alignment})));
      if (kept > 0) std::memcpy(grown.get(), memory_.get(), kept * sizeof(T));
      memory_ = std::move(grown);
      bytes_ = wanted;
    }
    return reinterpret_cast<T*>(memory_.get());
  }
  /// So many values it has room for.
  template <class T>
  [[nodiscard]] std::size_t capacity() const {
    return bytes_ / sizeof(T);
  }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  static constexpr std::size_t alignment = 64;
  struct Free {
    void operator()(std::byte* memory) const {
      ::operator delete (memory, std::align_val_t{alignment});
    }
  };
  std::unique_ptr<std::byte, Free> memory_;
  std::size_t bytes_ = 0;
};

/// What several threads need beyond what one does. Empty until they have run.
struct TeamRooms {
  Room key;                ///< a simplex: the least distance offered
  Room tie;                ///< a simplex: which of equal offers
  Room near, far, kept;    ///< offers that wait
  std::vector<Room> hand;  ///< offers that a thread has not yet put there

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = key.bytes() + tie.bytes() + near.bytes() + far.bytes() + kept.bytes();
    for (const Room& room : hand) sum += room.bytes();
    return sum + hand.capacity() * sizeof(Room);
  }
};

}  // namespace plexway
