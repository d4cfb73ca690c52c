#include "io/matrix/npy.hpp"

#include <algorithm>
#include <array>

// PKWARE, .ZIP File Format Specification, sections 4.3.7 (local header), 4.3.12 (central
// directory), 4.3.14 to 4.3.16 (its ends), 4.5.3 (zip64 field).
namespace plexway::io {
namespace {

constexpr std::uint32_t in_zip64 = 0xFFFFFFFFU;
constexpr std::uint16_t version = 45;         // the first with zip64
constexpr std::uint16_t zero = 0, sizes = 1;  // of the fields of a header, zip64
constexpr std::uint16_t day = 33;             // 1980-01-01: the same bytes whenever it is written

constexpr std::array<std::uint32_t, 256> crc_table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit)
      value = (value & 1U) != 0 ? 0xEDB88320U ^ (value >> 1) : value >> 1;
    table[i] = value;
  }
  return table;
}();

}  // namespace

void Crc32::add(std::string_view bytes) {
  for (const char c : bytes)
    state_ = crc_table[(state_ ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (state_ >> 8);
}

// Flags, stored as it is, time, day, checksum, both sizes, of the name, of the zip64 field.
void StoredZip::put_header(const Entry& file, std::uint16_t zip64) {
  put_numbers(version, zero, zero, zero, day, file.crc, in_zip64, in_zip64,
              static_cast<std::uint16_t>(file.name.size()), zip64);
}

void StoredZip::begin_file(std::string_view name, std::uint64_t bytes, std::uint32_t crc) {
  entries_.push_back({std::string(name), bytes, at_, crc});
  put_numbers(std::uint32_t{0x04034b50});
  put_header(entries_.back(), 20);
  put(name);
  put_numbers(sizes, std::uint16_t{16}, bytes, bytes);
}

void StoredZip::finish() {
  const std::uint64_t start = at_;
  for (const Entry& e : entries_) {
    put_numbers(std::uint32_t{0x02014b50}, version);
    put_header(e, 28);
    put_numbers(zero, zero, zero, std::uint32_t{0}, in_zip64);  // comment, disk, attributes, offset
    put(e.name);
    put_numbers(sizes, std::uint16_t{24}, e.bytes, e.bytes, e.offset);
  }
  const std::uint64_t size = at_ - start, end = at_, count = entries_.size();
  // The zip64 end of the central directory, where that is, and the end of the central directory.
  put_numbers(std::uint32_t{0x06064b50}, std::uint64_t{44}, version, version, std::uint32_t{0},
              std::uint32_t{0}, count, count, size, start);
  put_numbers(std::uint32_t{0x07064b50}, std::uint32_t{0}, end, std::uint32_t{1});
  put_numbers(std::uint32_t{0x06054b50}, zero, zero, static_cast<std::uint16_t>(count),
              static_cast<std::uint16_t>(count),
              static_cast<std::uint32_t>(std::min<std::uint64_t>(size, in_zip64)),
              static_cast<std::uint32_t>(std::min<std::uint64_t>(start, in_zip64)), zero);
}

}  // namespace plexway::io
