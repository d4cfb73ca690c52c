#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace plexway::detail::file {

/// The bytes of a file where the system keeps them: nothing is copied, and processes that map the
/// same file share them. They may only be read. A file that is replaced by another (NewFile) stays
/// as it was here; one that is cut short while it is mapped ends the process by a signal, as the
/// system has it.
class MappedFile {
 public:
  /// Throws InputError "FILE: cause" if it is missing, no regular file, empty or not readable.
  explicit MappedFile(const std::filesystem::path& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  /// All of them, from the start of a page.
  [[nodiscard]] std::span<const std::byte> bytes() const { return {start_, size_}; }

 private:
  const std::byte* start_ = nullptr;
  std::size_t size_ = 0;
};

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
