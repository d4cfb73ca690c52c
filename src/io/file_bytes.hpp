#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "io/names.hpp"

namespace plexway::io {

/// All bytes of a file, in memory. The name may be as `InputName` has it.
class FileBytes {
 public:
  /// Throws InputError "FILE: cause" when it is missing, a directory, empty or not readable.
  /// `most`: of a regular file no more than its first bytes.
  explicit FileBytes(const std::filesystem::path& file, std::size_t most = SIZE_MAX);

  /// From now on what comes through a pipe is kept, and another look at that name finds it again:
  /// for a program that looks at each input as often as it likes, and ends.
  static void keep_streams();

  std::string_view view() const { return {bytes_.get(), size_}; }

 private:
  std::shared_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// How bytes are packed: with gzip's header, with zlib's, or alone as in zip archives.
enum class Deflated { gzip = 15 + 16, zlib = 15, alone = -15 };

/// Unpacks what comes to `room` bytes at most. Throws InputError "NAME: cause", and NotBuiltError
/// without zlib.
std::string inflated(std::string_view packed, Deflated how, std::size_t room,
                     std::string_view name);

/// A file to be read: its bytes, when they are requested, and unpacked where they are gzip's.
class OpenedFile {
 public:
  explicit OpenedFile(const std::filesystem::path& file);
  /// What has been read already, `bytes`, which are referred to.
  OpenedFile(const std::filesystem::path& file, std::string_view bytes);

  /// As given, for messages.
  [[nodiscard]] const std::string& name() const { return name_; }
  /// With its dot, in lower case, without .gz behind it.
  [[nodiscard]] const std::string& extension() const { return input_.extension; }
  [[nodiscard]] bool is_standard_input() const { return input_.standard_input; }
  /// Bytes that were given, so that no file lies beside it.
  [[nodiscard]] bool is_in_memory() const { return bytes_ && !file_; }
  /// Throws InputError as FileBytes, and NotBuiltError without zlib for what is packed.
  [[nodiscard]] std::string_view bytes() const;

 private:
  std::string name_;
  InputName input_;
  mutable std::optional<FileBytes> file_;
  mutable std::optional<std::string_view> bytes_;
  mutable std::string unpacked_;
};

}  // namespace plexway::io
