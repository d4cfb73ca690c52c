#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <plexway/common/ids.hpp>
#include <plexway/solve/distance_field.hpp>

#include "complexes/partition/deal.hpp"

namespace plexway::detail {

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
