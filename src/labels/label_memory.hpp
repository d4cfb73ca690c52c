#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/solve/distance_field.hpp>

#include "complexes/partition/deal.hpp"

namespace plexway::detail {

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

/// Room for one label a simplex, allocated without being touched.
template <class Label>
struct LabelStorage {
  std::unique_ptr<Label[]> labels;
  std::size_t count = 0;

  Label* reserve(std::size_t simplices) {
    if (count != simplices) {
      labels = std::make_unique_for_overwrite<Label[]>(simplices);
      count = simplices;
    }
    return labels.get();
  }
  [[nodiscard]] std::size_t bytes() const { return count * sizeof(Label); }
};

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

/// What the last solve by pieces was like, whatever the threads.
struct SuperstepCounts {
  std::size_t supersteps = 0;
  std::size_t messages = 0;  ///< labels sent to other pieces
  std::size_t bytes = 0;     ///< of messages
  std::size_t sent = 0;      ///< bytes from this process to others

  /// Adds what a solve did.
  void tell(PropagateStatistics& statistics) const {
    statistics.supersteps += supersteps;
    statistics.messages += messages;
    statistics.message_bytes += bytes;
    statistics.sent_bytes += sent;
  }
  /// Before a solve.
  void start() { *this = {}; }
};

/// A domain that is cut into pieces, with their own memory.
class KeptPieces {
 public:
  virtual ~KeptPieces() = default;
  [[nodiscard]] virtual std::size_t bytes() const = 0;
};

/// What solves by several threads keep of the last domain. Nothing before the first.
class PieceMemory {
 public:
  /// The number that make() gives of this domain, whose processes compare it.
  template <class Domain, class Make>
  std::uint64_t digest_of(const Domain& domain, const Make& make) {
    if (digested_ != domain.identity()) digest_ = make(), digested_ = domain.identity();
    return digest_;
  }

  /// The pieces of this domain: those of the last call, unless that was for another domain, size or
  /// deal. Made as Pieces(domain, size, deal): about `size` simplices each. Cost of new ones: about
  /// a solve's.
  template <class Pieces, class Domain>
  Pieces& of(const Domain& domain, std::size_t size, Deal deal) {
    auto* pieces = dynamic_cast<Pieces*>(kept_.get());
    if (pieces == nullptr || identity_ != domain.identity() || size_ != size || deal_ != deal) {
      kept_.reset();  // its memory first
      kept_ = std::make_unique<Pieces>(domain, size, deal);
      pieces = static_cast<Pieces*>(kept_.get());
      identity_ = domain.identity();
      size_ = size;
      deal_ = deal;
    }
    return *pieces;
  }

  /// What the last solve was like.
  [[nodiscard]] SuperstepCounts& counts() { return counts_; }

  [[nodiscard]] std::size_t bytes() const { return kept_ ? kept_->bytes() : 0; }

 private:
  std::unique_ptr<KeptPieces> kept_;
  std::uint64_t identity_ = 0, digested_ = 0, digest_ = 0;
  std::size_t size_ = 0;
  Deal deal_;
  SuperstepCounts counts_;
};

}  // namespace plexway::detail
