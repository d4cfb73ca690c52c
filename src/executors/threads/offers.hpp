#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include <plexway/common/ids.hpp>

#include "labels/room.hpp"
#include "labels/visit_marks.hpp"

namespace plexway {

/// What offers are compared by: the bits of a distance, which as numbers are in the order of
/// distances. In float there is room behind them for the tie, so that no two offers are equal and
/// one atomic minimum finds the winner; in double the tie is settled in a pass of its own.
template <class Real>
struct OfferKey {
  using Key = std::uint64_t;
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  static constexpr bool ties_apart = sizeof(Real) == 8;
  static constexpr Key unreached = ~Key{0};

  static Key of(Real distance, Index tie) {
    const Key bits = std::bit_cast<Bits>(distance + Real(0));  // no negative zero
    return ties_apart ? bits : bits << 32 | tie;
  }
  static Real distance(Key key) {
    return std::bit_cast<Real>(static_cast<Bits>(ties_apart ? key : key >> 32));
  }
};

/// Of equal offers the earlier round's wins, then the one from the source with the lowest number,
/// then by hinge.
struct OfferTie {
  static constexpr int source_shift = 3;
  static constexpr Index hinge_mask = 7;
  static constexpr Index limit = Index{1} << (32 - source_shift);  ///< so many sources at most
  static Index of(Index source, std::size_t hinge) {
    return source << source_shift | static_cast<Index>(hinge);
  }
};

/// The round it was made in, where offers may be equal.
template <bool kEqual>
struct OfferRound {
  static constexpr std::uint32_t number = 0;
  OfferRound(std::uint32_t) {}
};
template <>
struct OfferRound<true> {
  std::uint32_t number;
};

/// A label on its way to a simplex.
template <class SimplexLabel, bool kEqual>
struct Offer {
  using Label = SimplexLabel;

  std::uint64_t key;
  Index simplex;
  Index tie;
  [[no_unique_address]] OfferRound<kEqual> round;
  [[no_unique_address]] Label label;

  [[nodiscard]] std::uint64_t rank() const { return std::uint64_t{round.number} << 32 | tie; }
};

/// Offers that one thread makes. They go on to the queue a chunk at a time.
template <class Offer>
class OfferList {
 public:
  explicit OfferList(Room& room) : room_(&room) { grow(); }

  [[gnu::always_inline]] void add(const Offer& offer) {
    if (count_ == capacity_) [[unlikely]]
      grow();
    data_[count_++] = offer;
  }
  [[nodiscard]] const Offer* data() const { return data_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  void clear() { count_ = 0; }

 private:
  [[gnu::noinline]] void grow() {
    data_ = room_->reserve<Offer>(count_ == 0 ? 512 : 2 * count_, count_);
    capacity_ = room_->capacity<Offer>();
  }

  Room* room_;
  Offer* data_;
  std::size_t count_ = 0, capacity_;
};

/// Offers that wait. Threads reserve room for many at a time; where there is none left they keep
/// them until the queue has grown, so that none is lost.
template <class Offer>
class OfferQueue {
 public:
  explicit OfferQueue(Room& room, std::size_t usual) : room_(&room) { grow(usual); }

  /// Moves a list to the queue; leaves it as it is if there is no room.
  void take(OfferList<Offer>& list) {
    const std::size_t count = list.count();
    if (count == 0) return;
    std::size_t at = count_.load(std::memory_order_relaxed);
    do {
      if (at + count > capacity_) return;
    } while (!count_.compare_exchange_weak(at, at + count, std::memory_order_relaxed));
    std::memcpy(static_cast<void*>(data_ + at), list.data(), count * sizeof(Offer));
    list.clear();
  }

  // By one thread while no other is at it.
  void take_alone(OfferList<Offer>& list) {
    const std::size_t count = count_.load(std::memory_order_relaxed) + list.count();
    if (count > capacity_) grow(2 * count);
    take(list);
  }
  void grow(std::size_t capacity) {
    if (capacity <= capacity_) return;
    data_ = room_->reserve<Offer>(capacity, count());
    capacity_ = room_->capacity<Offer>();
  }
  void clear() { count_.store(0, std::memory_order_relaxed); }
  void swap(OfferQueue& other) {
    std::swap(room_, other.room_);
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    const std::size_t count = this->count();
    count_.store(other.count(), std::memory_order_relaxed);
    other.count_.store(count, std::memory_order_relaxed);
  }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] std::size_t count() const { return count_.load(std::memory_order_relaxed); }
  [[nodiscard]] const Offer& operator[](std::size_t i) const { return data_[i]; }

 private:
  Room* room_;
  Offer* data_ = nullptr;
  std::size_t capacity_ = 0;
  alignas(64) std::atomic<std::size_t> count_{0};
};

}  // namespace plexway
