#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "file/new_file.hpp"
#include "io/numbers.hpp"

namespace plexway::io {

/// A file that appears whole or not at all (`file/new_file.hpp`), by way of a buffer. All members
/// throw Error "cannot write FILE: reason".
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& file)
      : file_(file), buffer_(std::size_t{1} << 16, '\0') {}

  void write(std::string_view bytes) {
    if (bytes.size() > buffer_.size() - used_) return write_through(bytes);
    bytes.copy(buffer_.data() + used_, bytes.size());
    used_ += bytes.size();
  }

  /// The shortest decimal text that reads back as `value`; "inf" for infinity.
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void write(Number value) {
    std::array<char, 32> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    write(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
  }

  /// Texts and numbers, one after the other.
  template <class First, class Second, class... Rest>
  void write(const First& first, const Second& second, const Rest&... rest) {
    write(first);
    write(second);
    (write(rest), ...);
  }

  /// As text, with `between` between two.
  template <class Numbers>
  void write_row(const Numbers& numbers, std::string_view between) {
    bool first = true;
    for (const auto number : numbers) write(std::exchange(first, false) ? "" : between, number);
  }

  /// The bytes of `value`, little endian.
  template <class Number>
  void write_binary(Number value) {
    const auto bytes = little_endian(value);
    write(std::string_view(bytes.data(), bytes.size()));
  }

  /// The bytes of `value`, big endian.
  template <class Number>
  void write_big_endian(Number value) {
    auto bytes = little_endian(value);
    std::reverse(bytes.begin(), bytes.end());
    write(std::string_view(bytes.data(), bytes.size()));
  }

  /// Hands all to the system: what is left to do can hardly fail.
  void flush() {
    const std::size_t bytes = used_;
    used_ = 0;
    if (const int failed = file_.write(buffer_.data(), bytes); failed != 0) file_.refuse(failed);
  }

  /// Flushes, closes, checks, and puts the file in its place.
  void commit() {
    flush();
    file_.commit();
  }

 private:
  void write_through(std::string_view bytes) {
    flush();
    if (bytes.size() < buffer_.size()) return write(bytes);
    if (const int failed = file_.write(bytes.data(), bytes.size()); failed != 0)
      file_.refuse(failed);
  }

  plexway::detail::file::NewFile file_;
  std::string buffer_;
  std::size_t used_ = 0;
};

}  // namespace plexway::io
