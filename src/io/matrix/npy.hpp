#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/numbers.hpp"
#include "io/output_file.hpp"

namespace plexway::io {

/// The checksum of zip and gzip (CRC-32, reflected 0xEDB88320), of bytes that come in pieces.
class Crc32 {
 public:
  void add(std::string_view bytes);
  [[nodiscard]] std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFFFFFFU;
};

/// A zip archive whose files are stored as they are, of any size (zip64 where that takes it).
///
/// What a file holds is written before: its size and checksum stand in front of it.
class StoredZip {
 public:
  explicit StoredZip(OutputFile& out) : out_(out) {}

  /// After this exactly `bytes` bytes go to `write`.
  void begin_file(std::string_view name, std::uint64_t bytes, std::uint32_t crc);
  void write(std::string_view bytes) { put(bytes); }
  /// The table of contents.
  void finish();

 private:
  struct Entry {
    std::string name;
    std::uint64_t bytes, offset;
    std::uint32_t crc;
  };

  void put(std::string_view bytes) {
    out_.write(bytes);
    at_ += bytes.size();
  }
  template <class... Numbers>
  void put_numbers(Numbers... numbers) {
    (out_.write_binary(numbers), ...);
    at_ += (sizeof(Numbers) + ...);
  }
  /// What both headers of a file have; `zip64` bytes follow for what does not fit in 32 bits.
  void put_header(const Entry& file, std::uint16_t zip64);

  OutputFile& out_;
  std::uint64_t at_ = 0;
  std::vector<Entry> entries_;
};

/// What a NumPy array file, version 1.0, starts with: a magic word, the length of the header, the
/// header (a Python literal, padded so that the data starts at a multiple of 64). `descr` is quoted
/// or a list, `shape` what stands between the brackets: "3," or "3, 4".
inline std::string npy_header(std::string_view descr, std::string_view shape) {
  using namespace std::string_view_literals;
  constexpr auto magic = "\x93NUMPY\x01\x00"sv;
  std::string header = "{'descr': " + std::string(descr) + ", 'fortran_order': False, 'shape': (" +
                       std::string(shape) + "), }";
  while ((magic.size() + sizeof(std::uint16_t) + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  const auto length = little_endian(static_cast<std::uint16_t>(header.size()));
  return std::string(magic) + std::string(length.data(), length.size()) + header;
}

}  // namespace plexway::io
