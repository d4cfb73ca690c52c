#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace plexway::io {

/// The files in a zip archive (zip64 too), packed by deflate or not at all.
class ZipArchive {
 public:
  /// Both are referred to. Throws InputError "NAME: cause" where the bytes are no archive.
  ZipArchive(std::string_view bytes, std::string_view name);

  /// Unpacks a file; upper and lower case are the same. Throws InputError where it is missing,
  /// encrypted or broken, and where all files unpacked so far come to more than 16 MiB and 50 times
  /// the archive; NotBuiltError without zlib for what is packed.
  [[nodiscard]] std::string unpack(std::string file);

 private:
  struct Entry {
    std::uint16_t flags, method;
    std::uint32_t crc;
    std::uint64_t packed, size, place;
  };

  [[noreturn]] void fail(const std::string& cause) const;
  template <class Number>
  [[nodiscard]] Number number(std::uint64_t place) const;
  void read_directory(std::uint64_t at);

  std::string_view bytes_, name_;
  std::map<std::string, Entry> entries_;  ///< by their names in lower case
  std::uint64_t room_;
};

}  // namespace plexway::io
