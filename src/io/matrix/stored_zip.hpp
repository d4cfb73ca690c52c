#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.hpp"
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
/// What a file holds is told before: its size and checksum stand in front of it.
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
  template <class Number>
  void put_number(Number number) {
    const auto bytes = little_endian(number);
    put({bytes.data(), bytes.size()});
  }

  OutputFile& out_;
  std::uint64_t at_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace plexway::io
