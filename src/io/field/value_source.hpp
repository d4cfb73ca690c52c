#pragma once

// Two sources of numbers that look the same to a reader: text, where numbers are words and lines
// make no difference, and bytes. Formats that come as both are read by one template.

#include <bit>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include <plexway/error.hpp>

#include "io/numbers.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {

class TextValues {
 public:
  static constexpr bool is_text = true;

  explicit TextValues(const TextScanner& scanner) : scanner_(scanner) {}

  [[noreturn]] void fail(const std::string& cause) const { scanner_.fail(cause); }
  std::uint64_t bytes_left() const { return scanner_.bytes_left(); }

  /// The most values that can follow: each takes a character and a separator, but for the last.
  std::uint64_t most(NumberType) const { return (bytes_left() + 1) / 2; }

  /// The next word on this line or a later one; empty at the end of the file.
  std::string_view word() { return scanner_.to_content() ? scanner_.field() : std::string_view(); }

  double real(NumberType, std::string_view what) {
    to_content(what);
    return scanner_.number(what);
  }

  std::int64_t whole(NumberType, std::string_view what) {
    to_content(what);
    return scanner_.integer(what);
  }

  /// A whole number that is text in binary files too.
  std::int64_t text_whole(std::string_view what) { return whole(NumberType::i64, what); }

  void skip(NumberType, std::uint64_t values, std::string_view what) {
    for (std::uint64_t i = 0; i < values; ++i) {
      to_content(what);
      const std::string_view field = scanner_.field();
      if (is_word(field)) fail("expected " + std::string(what) + ", found " + quote(field));
    }
  }

  /// Whether a field is a name and no number, not even an infinite one.
  static bool is_word(std::string_view field) {
    const auto lower = [&](std::size_t i) { return i < field.size() ? field[i] | 0x20 : 0; };
    if (lower(0) < 'a' || lower(0) > 'z') return false;
    return !(lower(0) == 'n' && lower(1) == 'a' && lower(2) == 'n') &&
           !(lower(0) == 'i' && lower(1) == 'n' && lower(2) == 'f');
  }

  /// Goes to the next line, whatever is left of this one; false at the end of the file.
  bool end_line() { return scanner_.next_line(); }

  /// Where numbers begin: in text on this line or the next, in bytes behind the line's end.
  void start_values() {}

  /// Like end_line, but nothing may be left: for what is written one item a line.
  void end_item() {
    if (scanner_.to_field()) fail("the line goes on with " + quote(scanner_.field()));
    scanner_.next_line();
  }

  /// Goes behind the next line that is blank.
  void skip_to_blank_line() {
    while (scanner_.next_line() && scanner_.to_field()) continue;
  }

  /// Goes behind the next line that starts with the word `end`.
  void skip_past(std::string_view end) {
    while (scanner_.next_line()) {
      if (scanner_.to_field() && scanner_.field() == end) return;
    }
    fail("the file ends before " + quote(end));
  }

  void finish(std::string_view what) {
    if (scanner_.to_content())
      fail(std::string(what) + " goes on after its last value with " + quote(scanner_.field()));
  }

 private:
  void to_content(std::string_view what) {
    if (!scanner_.to_content()) fail("the file ends before " + std::string(what));
  }

  TextScanner scanner_;
};

class ByteValues : public BinaryNumbers<ByteValues> {
 public:
  static constexpr bool is_text = false;

  /// Starts at byte `at` of `bytes`; messages start with `name`.
  ByteValues(std::string_view bytes, std::string_view name, std::endian order, std::size_t at = 0)
      : BinaryNumbers(bytes, order, at), name_(name) {}

  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ": byte " + std::to_string(at_) + ": " + cause);
  }
  std::uint64_t most(NumberType type) const { return bytes_left() / size_of(type); }

  std::string_view word() {
    while (at_ != bytes_.size() && is_space(bytes_[at_])) ++at_;
    const std::size_t from = at_;
    while (at_ != bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return bytes_.substr(from, at_ - from);
  }

  std::int64_t text_whole(std::string_view what) {
    const std::string_view digits = word();
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (digits.empty()) fail("the file ends before " + std::string(what));
    if (error != std::errc{} || stop != digits.data() + digits.size())
      fail(std::string(what) + " is not a whole number: " + quote(digits));
    return value;
  }

  bool end_line() {
    const auto newline = bytes_.find('\n', at_);
    at_ = newline == std::string_view::npos ? bytes_.size() : newline + 1;
    return newline != std::string_view::npos;
  }

  void start_values() { end_line(); }

  void end_item() {}

  void skip_to_blank_line() {
    while (end_line()) {
      std::size_t next = at_;
      while (next != bytes_.size() && bytes_[next] != '\n' && is_space(bytes_[next])) ++next;
      if (next == bytes_.size() || bytes_[next] == '\n') return;
    }
  }

  void skip_past(std::string_view end) {
    const auto found = bytes_.find(end, at_);
    if (found == std::string_view::npos) fail("the file ends before " + quote(end));
    at_ = found + end.size();
  }

  void finish(std::string_view what) {
    if (bytes_left() != 0)
      fail(std::string(what) + " goes on for " + std::to_string(bytes_left()) +
           " bytes after its last value");
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::string_view name_;
};

/// A count that the file states of things made of `values` numbers of `type` each, as far as the
/// bytes that are left can hold so many.
template <class Source>
std::uint64_t checked_count(const Source& in, std::int64_t stated, std::string_view what,
                            NumberType type, std::uint64_t values) {
  if (stated < 0)
    in.fail("the number of " + std::string(what) + " is negative: " + std::to_string(stated));
  const auto count = static_cast<std::uint64_t>(stated);
  if (count > in.most(type) / values)
    in.fail("there should be " + std::to_string(count) + " " + std::string(what) + ", but only " +
            std::to_string(in.bytes_left()) + " bytes follow");
  return count;
}

}  // namespace plexway::io
