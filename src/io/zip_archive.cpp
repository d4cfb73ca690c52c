// PKWARE, .ZIP File Format Specification, sections 4.3.7 (local header), 4.3.12 (central
// directory), 4.3.14 to 4.3.16 (its ends), 4.5.3 (zip64 field).

#include "io/zip_archive.hpp"

#include <plexway/error.hpp>

#include "io/file_bytes.hpp"
#include "io/matrix/npy.hpp"
#include "io/names.hpp"
#include "io/numbers.hpp"

namespace plexway::io {

void ZipArchive::fail(const std::string& cause) const {
  throw InputError(std::string(name_) + ": " + cause);
}

template <class Number>
Number ZipArchive::number(std::uint64_t place) const {
  if (place > bytes_.size() || bytes_.size() - place < sizeof(Number))
    fail("is not a complete zip archive: its directory leads out of it");
  return load<Number>(bytes_.data() + place, std::endian::little);
}

ZipArchive::ZipArchive(std::string_view bytes, std::string_view name)
    : bytes_(bytes), name_(name), room_((std::uint64_t{1} << 24) + 50 * bytes.size()) {
  const std::size_t end = bytes.rfind("PK\x05\x06");
  if (end == bytes.npos) fail("is not a complete zip archive: it has no directory");
  std::uint64_t at = number<std::uint32_t>(end + 16);
  if (end >= 20 && bytes.substr(end - 20).starts_with("PK\x06\x07"))
    at = number<std::uint64_t>(number<std::uint64_t>(end - 12) + 48);
  read_directory(at);
}

void ZipArchive::read_directory(std::uint64_t at) {
  while (number<std::uint32_t>(at) == 0x02014b50) {
    Entry entry{number<std::uint16_t>(at + 8),  number<std::uint16_t>(at + 10),
                number<std::uint32_t>(at + 16), number<std::uint32_t>(at + 20),
                number<std::uint32_t>(at + 24), number<std::uint32_t>(at + 42)};
    const std::uint64_t from = at + 46, extra = from + number<std::uint16_t>(at + 28),
                        end = extra + number<std::uint16_t>(at + 30);
    for (std::uint64_t i = extra; i + 4 <= end; i += 4 + number<std::uint16_t>(i + 2)) {
      if (number<std::uint16_t>(i) != 1) continue;
      std::uint64_t next = i + 4;  // of those numbers that 32 bits do not hold, in this order
      for (std::uint64_t* value : {&entry.size, &entry.packed, &entry.place})
        if (*value == 0xFFFFFFFFU) {
          *value = number<std::uint64_t>(next);
          next += 8;
        }
    }
    const std::uint64_t behind = end + number<std::uint16_t>(at + 32);
    if (behind > bytes_.size())
      fail("is not a complete zip archive: its directory leads out of it");
    const std::string file(bytes_.substr(from, extra - from));
    if (!entries_.emplace(lower_case(file), entry).second) fail("has two files " + quote(file));
    at = behind;
  }
}

std::string ZipArchive::unpack(std::string file) {
  const auto found = entries_.find(lower_case(file));
  if (found == entries_.end()) fail("is a zip archive without " + quote(file));
  const Entry& entry = found->second;
  if ((entry.flags & 1U) != 0) fail("its " + quote(file) + " is encrypted");
  // The local header may have other fields than the directory, so its own lengths count.
  const std::uint64_t from = entry.place + 30 + number<std::uint16_t>(entry.place + 26) +
                             number<std::uint16_t>(entry.place + 28);
  if (from > bytes_.size() || entry.packed > bytes_.size() - from)
    fail("its " + quote(file) + " is cut off");
  if (entry.size > room_) fail("unpacks to more than 16 MiB plus 50 times its size");
  room_ -= entry.size;
  const std::string_view packed = bytes_.substr(from, entry.packed);
  if (entry.method != 0 && entry.method != 8)
    fail("its " + quote(file) + " is packed by method " + std::to_string(entry.method) +
         "; deflate is read");
  std::string out = entry.method == 0 ? std::string(packed)
                                      : inflated(packed, Deflated::alone, entry.size, name_);
  Crc32 crc;
  crc.add(out);
  if (out.size() != entry.size || crc.value() != entry.crc)
    fail("its " + quote(file) + " is damaged (size or checksum)");
  return out;
}

}  // namespace plexway::io
