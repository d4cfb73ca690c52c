#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace plexway::io {

/// A file that is made in pieces, in any order, perhaps by several runs: OUT.part, which gets its
/// own name when it is whole. Any thread may write and read.
///
/// All members throw Error "cannot write FILE: reason"; what was written before stays.
class PartFile {
 public:
  /// Goes on with the part of an earlier run, or begins one. `end` is how far that is worth
  /// keeping.
  PartFile(const std::filesystem::path& out, bool resume, std::uint64_t end = UINT64_MAX);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Bytes from a place on.
  void write(std::uint64_t offset, std::string_view bytes);
  /// All of them, or Error.
  void read(std::uint64_t offset, std::span<char> bytes) const;
  /// To the disk.
  void sync();
  /// To the disk, and in its place.
  void commit();
  /// The part is not needed any more.
  void remove();

  /// The name of a part of a file.
  [[nodiscard]] static std::filesystem::path path_of(const std::filesystem::path& out);

 private:
  [[noreturn]] void refused(int code) const;

  std::filesystem::path out_, path_;
  int file_ = -1;
};

/// Throws Error unless the disk of `out` has room for `bytes`, beyond what OUT.part has there.
void check_room(const std::filesystem::path& out, double bytes);

/// For people: "1.2 GB".
[[nodiscard]] std::string short_bytes(double bytes);

}  // namespace plexway::io
