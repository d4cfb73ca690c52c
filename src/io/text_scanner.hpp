#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#include <plexway/error.hpp>

#include "io/names.hpp"

namespace plexway::io {

inline constexpr std::string_view axis_names[3] = {"coordinate x", "coordinate y", "coordinate z"};

/// A text without the byte order mark (UTF-8) that some editors put in front.
inline std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

/// Walks over the fields of a text, line by line, and knows the number of the line it is on.
///
/// Nothing is copied. A field ends at a blank, at the line's end, or at `#`, which starts a
/// comment. Lines end as the first of them does, at \n or, as on old Macs, at \r alone. Numbers are
/// read by std::from_chars, so the locale plays no part.
class TextScanner {
 public:
  /// What a `\` just before a line's end means.
  enum class Backslash { ordinary, joins_lines };

  TextScanner(std::string_view text, std::string_view name,
              Backslash backslash = Backslash::ordinary, std::size_t first_line = 1)
      : at_(text.data()),
        end_(text.data() + text.size()),
        name_(name),
        line_(first_line),
        joins_lines_(backslash == Backslash::joins_lines) {
    if (first_line == 1) at_ += text.size() - without_mark(text).size();
    const std::size_t end = text.find_first_of("\r\n");
    if (first_line == 0)
      newline_ = '\0';
    else if (end != text.npos && text[end] == '\r' &&
             (end + 1 == text.size() || text[end + 1] != '\n'))
      newline_ = '\r';
  }

  /// Of a value out of a file, which has no lines.
  static TextScanner of_value(std::string_view text, std::string_view name) {
    return {text, name, Backslash::ordinary, 0};
  }

  std::size_t line() const { return line_; }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
  const char* position() const { return at_; }
  bool at_end() const { return at_ == end_; }

  [[noreturn]] void fail(const std::string& cause) const {
    const std::string line = line_ == 0 ? "" : ":" + std::to_string(line_);
    throw InputError(std::string(name_) + line + ": " + cause);
  }

  /// Moves to the next field of this line; false when there is none left.
  bool to_field() {
    while (at_ != end_) {
      if (is_blank(*at_)) {
        ++at_;
      } else if (const char* next = joined(at_); next != nullptr) {
        at_ = next;
        ++line_;
      } else {
        return *at_ != newline_ && *at_ != '#';
      }
    }
    return false;
  }

  /// Moves to the next field of this line or of any later one; false at the end of the text.
  [[gnu::always_inline]] bool to_content() {
    while (!to_field()) {
      if (!next_line()) return false;
    }
    return true;
  }

  /// Skips the rest of this line; false when it was the last.
  bool next_line() {
    const void* newline = at_ == end_ ? nullptr : std::memchr(at_, newline_, bytes_left());
    if (newline == nullptr) {
      at_ = end_;
      return false;
    }
    at_ = static_cast<const char*>(newline) + 1;
    ++line_;
    return true;
  }

  /// Takes the field here, empty when there is none.
  std::string_view field() {
    to_field();
    const char* from = at_;
    while (!ends_field(at_)) ++at_;
    return {from, static_cast<std::size_t>(at_ - from)};
  }

  /// Takes the field here if it is the one-letter statement `letter`.
  bool take_letter(char letter) {
    if (at_ == end_ || *at_ != letter || !ends_field(at_ + 1)) return false;
    ++at_;
    return true;
  }

  /// Whether a number that from_chars calls out of range is one that rounds to zero.
  static bool too_small(std::string_view digits) {
    if (digits.starts_with('-')) digits.remove_prefix(1);
    const auto exponent = digits.find_first_of("eE");
    if (exponent != std::string_view::npos)
      return exponent + 1 < digits.size() && digits[exponent + 1] == '-';
    return digits.starts_with('0') || digits.starts_with('.');
  }

  /// Takes a finite number; `what` names it in messages.
  double number(std::string_view what) {
    if (!to_field()) ends_before(what);
    const char* from = *at_ == '+' ? at_ + 1 : at_;
    double value = 0;
    auto [stop, error] = std::from_chars(from, end_, value);
    if (error == std::errc::result_out_of_range &&
        too_small({from, static_cast<std::size_t>(stop - from)})) {
      value = 0;
      error = std::errc{};
    }
    // A sign of its own may not follow the '+' that from_chars does not know.
    const bool two_signs = from != at_ && from != end_ && *from == '-';
    if (error == std::errc::result_out_of_range || (error == std::errc{} && !std::isfinite(value)))
      fail(std::string(what) + " is not finite: " + quote(field()));
    if (error != std::errc{} || two_signs || !ends_field(stop))
      fail(std::string(what) + " is not a number: " + quote(field()));
    at_ = stop;
    return value;
  }

  /// Takes three numbers, a place in space.
  std::array<double, 3> position3() {
    std::array<double, 3> place{};
    for (std::size_t k = 0; k < 3; ++k) place[k] = number(axis_names[k]);
    return place;
  }

  /// All has been taken, or it is refused.
  void finish() {
    to_field();
    if (!at_end()) fail("there is more: " + quote({at_, bytes_left()}));
  }

  /// Goes back over the last `bytes`, all of them on this line.
  void back(std::size_t bytes) { at_ -= bytes; }

  /// Takes a whole number; `what` names it in messages. `also_ends` is a character that may
  /// follow it besides what ends a field.
  std::int64_t integer(std::string_view what, char also_ends = ' ') {
    if (!to_field()) ends_before(what);
    const char* from = *at_ == '+' ? at_ + 1 : at_;
    std::int64_t value = 0;
    const auto [stop, error] = std::from_chars(from, end_, value);
    const bool two_signs = from != at_ && from != end_ && *from == '-';
    if (error == std::errc::result_out_of_range)
      fail(std::string(what) + " is too large: " + quote(field()));
    if (error != std::errc{} || two_signs || !(ends_field(stop) || *stop == also_ends))
      fail(std::string(what) + " is not a whole number: " + quote(field()));
    at_ = stop;
    return value;
  }

  /// Skips what belongs to the field here after a number was taken from its front.
  std::string_view rest_of_field() {
    const char* from = at_;
    while (!ends_field(at_)) ++at_;
    return {from, static_cast<std::size_t>(at_ - from)};
  }

 private:
  [[noreturn]] void ends_before(std::string_view what) const {
    fail(line_ == 0 ? std::string(what) + " is missing"
                    : "the line ends before " + std::string(what));
  }

  bool is_blank(char c) const {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' ||
           (c != newline_ && (c == '\r' || c == '\n'));
  }

  [[gnu::always_inline]] bool ends_field(const char* at) const {
    return at == end_ || is_blank(*at) || *at == newline_ || *at == '#' || joined(at) != nullptr;
  }

  /// The start of the next line if there is a backslash at `at` that joins it to this one.
  const char* joined(const char* at) const {
    if (*at != '\\' || !joins_lines_) return nullptr;
    const char* next = at + 1;
    if (next != end_ && *next == '\r' && newline_ != '\r') ++next;
    return next != end_ && *next == newline_ ? next + 1 : nullptr;
  }

  const char* at_;
  const char* end_;
  std::string_view name_;
  std::size_t line_;
  bool joins_lines_;
  char newline_ = '\n';
};

}  // namespace plexway::io
