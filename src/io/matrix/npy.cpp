#include "io/matrix/npy.hpp"

#include <algorithm>
#include <array>

// PKWARE, .ZIP File Format Specification, sections 4.3.7 (local header), 4.3.12 (central
// directory), 4.3.14 to 4.3.16 (its ends), 4.5.3 (zip64 field).
namespace plexway::io {
namespace {

constexpr std::uint32_t in_zip64 = 0xFFFFFFFFU;
constexpr std::uint16_t version = 45;  // the first with zip64
constexpr std::uint16_t day = 33;      // 1980-01-01: the same bytes whenever it is written

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

void StoredZip::begin_file(std::string_view name, std::uint64_t bytes, std::uint32_t crc) {
  entries_.push_back({std::string(name), bytes, at_, crc});
  put_number(std::uint32_t{0x04034b50});
  put_number(version);
  put_number(std::uint16_t{0});  // flags
  put_number(std::uint16_t{0});  // stored
  put_number(std::uint16_t{0});  // time
  put_number(day);
  put_number(crc);
  put_number(in_zip64);
  put_number(in_zip64);
  put_number(static_cast<std::uint16_t>(name.size()));
  put_number(std::uint16_t{20});
  put(name);
  put_number(std::uint16_t{1});  // zip64: both sizes
  put_number(std::uint16_t{16});
  put_number(bytes);
  put_number(bytes);
}

void StoredZip::finish() {
  const std::uint64_t start = at_;
  for (const Entry& e : entries_) {
    put_number(std::uint32_t{0x02014b50});
    put_number(version);
    put_number(version);
    put_number(std::uint16_t{0});
    put_number(std::uint16_t{0});
    put_number(std::uint16_t{0});
    put_number(day);
    put_number(e.crc);
    put_number(in_zip64);
    put_number(in_zip64);
    put_number(static_cast<std::uint16_t>(e.name.size()));
    put_number(std::uint16_t{28});
    put_number(std::uint16_t{0});  // comment
    put_number(std::uint16_t{0});  // disk
    put_number(std::uint16_t{0});  // attributes
    put_number(std::uint32_t{0});
    put_number(in_zip64);  // offset
    put(e.name);
    put_number(std::uint16_t{1});
    put_number(std::uint16_t{24});
    put_number(e.bytes);
    put_number(e.bytes);
    put_number(e.offset);
  }
  const std::uint64_t size = at_ - start, end = at_, count = entries_.size();
  put_number(std::uint32_t{0x06064b50});  // zip64 end of the central directory
  put_number(std::uint64_t{44});
  put_number(version);
  put_number(version);
  put_number(std::uint32_t{0});
  put_number(std::uint32_t{0});
  put_number(count);
  put_number(count);
  put_number(size);
  put_number(start);
  put_number(std::uint32_t{0x07064b50});  // where that is
  put_number(std::uint32_t{0});
  put_number(end);
  put_number(std::uint32_t{1});
  put_number(std::uint32_t{0x06054b50});  // end of the central directory
  put_number(std::uint16_t{0});
  put_number(std::uint16_t{0});
  put_number(static_cast<std::uint16_t>(count));
  put_number(static_cast<std::uint16_t>(count));
  put_number(static_cast<std::uint32_t>(std::min<std::uint64_t>(size, in_zip64)));
  put_number(static_cast<std::uint32_t>(std::min<std::uint64_t>(start, in_zip64)));
  put_number(std::uint16_t{0});
}

}  // namespace plexway::io
