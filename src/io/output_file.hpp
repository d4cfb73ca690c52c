#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include "bytes.hpp"

namespace plexway::io {

/// A file that appears whole or not at all: written beside its place, renamed by `commit`.
///
/// A target that exists and is no regular file (a pipe, a device) is written directly. All members
/// throw Error "cannot write FILE: reason"; without `commit` the destructor leaves nothing behind.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes) {
    if (bytes.size() > buffer_.size() - used_) return write_through(bytes);
    bytes.copy(buffer_.data() + used_, bytes.size());
    used_ += bytes.size();
  }

  /// The shortest decimal text that reads back as `value`; "inf" for infinity.
  template <class Number>
  void write_text(Number value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    write({text.data(), static_cast<std::size_t>(end - text.data())});
  }

  /// The bytes of `value`, little endian.
  template <class Number>
  void write_binary(Number value) {
    const auto bytes = little_endian(value);
    write({bytes.data(), bytes.size()});
  }

  /// The bytes of `value`, big endian.
  template <class Number>
  void write_big_endian(Number value) {
    auto bytes = little_endian(value);
    std::reverse(bytes.begin(), bytes.end());
    write({bytes.data(), bytes.size()});
  }

  /// Flushes, closes, checks, and puts the file in its place.
  void commit();

 private:
  void open(bool directly);
  void write_through(std::string_view bytes);
  void flush();
  void discard();
  [[noreturn]] void refused(int code);

  std::filesystem::path named_;    ///< as the caller names it, for messages
  std::filesystem::path target_;   ///< with symbolic links resolved
  std::filesystem::path written_;  ///< the temporary file, or the target itself
  std::FILE* file_ = nullptr;
  std::string buffer_;
  std::size_t used_ = 0;
};

}  // namespace plexway::io
