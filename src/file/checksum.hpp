#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace plexway::detail::file {

/// Tells damage: 64 bits of blocks of 64 bytes, at the speed of memory. Each change of one word is
/// found, others but for one in 2^64. Against those who want to deceive it is nothing.
class Checksum {
 public:
  static constexpr std::size_t block = 64;

  /// `size` is a multiple of `block`.
  void add(const std::byte* bytes, std::size_t size);
  [[nodiscard]] std::uint64_t value() const;

 private:
  static constexpr std::size_t lanes = block / sizeof(std::uint64_t);
  // Digits of pi, so that no lane starts as another.
  std::array<std::uint64_t, lanes> lane_ = {
      0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89,
      0x452821e638d01377, 0xbe5466cf34e90c6c, 0xc0ac29b7c97c50dd, 0x3f84d5b5b5470917};
};

}  // namespace plexway::detail::file
