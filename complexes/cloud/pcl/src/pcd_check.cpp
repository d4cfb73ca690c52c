#include "pcd_check.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

namespace plexway::pcl {
namespace {

// PCL keeps field offsets in 32 bits; no point type comes near this.
constexpr std::uint64_t most_point_bytes = 1u << 20;

std::string quote(std::string_view piece) {
  std::string out = "'";
  for (const char c : piece.substr(0, 32)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (piece.size() > 32 ? "...'" : "'");
}

struct Field {
  std::string_view name;
  std::uint64_t size = 0, count = 1;
  char type = 0;
};

class PcdChecker {
 public:
  PcdChecker(std::string_view bytes, std::string_view name) : bytes_(bytes), name_(name) {}

  PcdPromise check() && {
    while (data_.empty()) {
      if (!next_line()) fail("the file ends before 'DATA'");
      if (!words_.empty() && words_[0].front() != '#') header_line();
    }
    check_header();
    if (data_ == "ascii")
      check_text();
    else
      check_binary();
    return {points_.value(), point_bytes_};
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ":" + std::to_string(line_) + ": " + cause);
  }

  /// Cuts the next line into words; false at the end of the file.
  bool next_line() {
    if (at_ == bytes_.size()) return false;
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    const std::string_view line = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    ++line_;
    words_.clear();
    for (std::size_t i = 0; i < line.size();) {
      const std::size_t from = line.find_first_not_of(" \t\r", i);
      if (from == line.npos) break;
      i = std::min(line.find_first_of(" \t\r", from), line.size());
      words_.push_back(line.substr(from, i - from));
    }
    return true;
  }

  void header_line() {
    const std::string_view key = words_[0] == "COLUMNS" ? "FIELDS" : words_[0];
    constexpr std::array<std::string_view, 10> known = {"VERSION", "FIELDS", "SIZE",   "TYPE",
                                                        "COUNT",   "WIDTH",  "HEIGHT", "VIEWPOINT",
                                                        "POINTS",  "DATA"};
    const auto found = std::find(known.begin(), known.end(), key);
    if (found == known.end())
      fail("unknown word " + quote(key) + " in the header" +
           (line_ == 1 ? "; a .pcd starts with VERSION or a comment" : ""));
    const auto bit = 1u << (found - known.begin());
    if ((seen_ & bit) != 0) fail("a second " + quote(key));
    seen_ |= bit;
    if (key == "FIELDS") {
      for (std::size_t i = 1; i < words_.size(); ++i) fields_.push_back({.name = words_[i]});
    } else if (key == "SIZE") {
      for_each_field(
          [&](Field& field, std::string_view word) { field.size = whole(word, "size"); });
    } else if (key == "TYPE") {
      for_each_field([&](Field& field, std::string_view word) {
        if (word.size() != 1) fail("unknown type " + quote(word));
        field.type = word[0];
      });
    } else if (key == "COUNT") {
      for_each_field(
          [&](Field& field, std::string_view word) { field.count = whole(word, "count"); });
    } else if (key == "WIDTH") {
      width_ = only("width");
    } else if (key == "HEIGHT") {
      height_ = only("height");
    } else if (key == "POINTS") {
      points_ = only("number of points");
    } else if (key == "DATA") {
      if (words_.size() != 2 ||
          (words_[1] != "ascii" && words_[1] != "binary" && words_[1] != "binary_compressed"))
        fail("DATA must be ascii, binary or binary_compressed");
      data_ = words_[1];
    }
  }

  template <class Take>
  void for_each_field(Take take) {
    if (fields_.empty()) fail(quote(words_[0]) + " before the names of FIELDS");
    if (words_.size() != fields_.size() + 1)
      fail(std::string(words_[0]) + " has " + std::to_string(words_.size() - 1) + " values for " +
           std::to_string(fields_.size()) + " fields");
    for (std::size_t i = 0; i < fields_.size(); ++i) take(fields_[i], words_[i + 1]);
  }

  std::uint64_t whole(std::string_view word, const char* what) const {
    std::uint64_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc{} || stop != end || value == 0 || value >= none)
      fail("the " + std::string(what) + " must be a whole number above 0, not " + quote(word));
    return value;
  }

  std::uint64_t only(const char* what) const {
    if (words_.size() != 2) fail("the " + std::string(what) + " must be one number");
    return whole(words_[1], what);
  }

  void check_header() {
    const auto require = [&](bool there, const char* what) {
      if (!there) fail("the header has no " + std::string(what));
    };
    require(!fields_.empty(), "FIELDS");
    require(fields_[0].size != 0, "SIZE");
    require(fields_[0].type != 0, "TYPE");
    require(width_.has_value(), "WIDTH");
    require(points_.has_value(), "POINTS");
    const std::uint64_t height = height_.value_or(1);
    if (*width_ * height != *points_)  // both are below 2^32
      fail("WIDTH " + std::to_string(*width_) + " times HEIGHT " + std::to_string(height) +
           " is not POINTS " + std::to_string(*points_));
    for (const Field& field : fields_) {
      const bool sound = field.type == 'F' ? field.size == 4 || field.size == 8
                                           : (field.type == 'I' || field.type == 'U') &&
                                                 (field.size == 1 || field.size == 2 ||
                                                  field.size == 4 || field.size == 8);
      if (!sound)
        fail("field " + quote(field.name) + " has type " + quote({&field.type, 1}) + " of " +
             std::to_string(field.size) + " bytes; there are I, U of 1, 2, 4, 8 and F of 4, 8");
      columns_ += field.count;
      point_bytes_ += field.size * field.count;
      if (point_bytes_ > most_point_bytes) fail("a point has more bytes than any point type");
    }
    for (const std::string_view axis : {"x", "y", "z"}) {
      const auto is_axis = [&](const Field& field) { return field.name == axis; };
      const auto count = std::count_if(fields_.begin(), fields_.end(), is_axis);
      if (count != 1 || std::find_if(fields_.begin(), fields_.end(), is_axis)->count != 1)
        fail("there must be one field " + quote(axis) + " with one number");
    }
  }

  void check_text() {
    const std::uint64_t most = (bytes_.size() - at_ + 1) / (2 * columns_);
    if (*points_ > most) fail_too_few(bytes_.size() - at_);
    std::vector<char> types;
    for (const Field& field : fields_) types.insert(types.end(), field.count, field.type);
    for (std::uint64_t point = 0; point < *points_;) {
      if (!next_line())
        fail("the file ends after " + std::to_string(point) + " of " + std::to_string(*points_) +
             " points");
      if (words_.empty()) continue;
      if (words_.size() != columns_)
        fail("point " + std::to_string(point) + " has " + std::to_string(words_.size()) +
             " numbers, but the fields take " + std::to_string(columns_));
      for (std::size_t c = 0; c < columns_; ++c) check_number(words_[c], types[c]);
      ++point;
    }
    while (next_line())
      if (!words_.empty()) fail("the file goes on after its last point with " + quote(words_[0]));
  }

  /// NaN is a number here: it says that the scanner saw nothing.
  void check_number(std::string_view word, char type) const {
    const char* from = word.data();
    const char* const end = from + word.size();
    std::errc error{};
    const char* stop = nullptr;
    if (type == 'F') {
      if (*from == '+') ++from;
      double value = 0;
      const auto result = std::from_chars(from, end, value);
      stop = result.ptr;
      error = result.ec;
      // Too small for a double is 0 to PCL, as it should be.
      if (error == std::errc::result_out_of_range && word.find("e-") != word.npos)
        error = std::errc{};
    } else {
      std::int64_t value = 0;
      const auto result = std::from_chars(from, end, value);
      stop = result.ptr;
      error = result.ec;
    }
    if (error == std::errc::result_out_of_range) fail("a number is too large: " + quote(word));
    if (error != std::errc{} || stop != end) fail("not a number: " + quote(word));
  }

  void check_binary() {
    const std::uint64_t all = *points_ * point_bytes_;  // below 2^32 times 2^20
    std::uint64_t room = bytes_.size() - at_, taken = all;
    if (data_ == "binary_compressed") {
      std::array<std::uint32_t, 2> lengths{};  // compressed, then as it was
      if (room < sizeof lengths) fail_too_few(room);
      std::memcpy(lengths.data(), bytes_.data() + at_, sizeof lengths);
      if (lengths[1] != all)
        fail("the compressed data says that it holds " + std::to_string(lengths[1]) +
             " bytes, but the points take " + std::to_string(all));
      // LZF makes three bytes out of 264 at best.
      if (all > std::uint64_t{88} * lengths[0])
        fail("the compressed data is too short for " + std::to_string(*points_) + " points");
      taken = sizeof lengths + lengths[0];
    }
    if (taken > room) fail_too_few(room);
    const std::string_view rest = bytes_.substr(at_ + taken);
    if (rest.find_first_not_of(std::string_view("\0\r\n ", 4)) != rest.npos)
      fail("the file goes on for " + std::to_string(rest.size()) + " bytes after its last point");
  }

  [[noreturn]] void fail_too_few(std::uint64_t room) const {
    fail("the header says " + std::to_string(*points_) + " points, but only " +
         std::to_string(room) + " bytes follow");
  }

  std::string_view bytes_, name_;
  std::size_t at_ = 0, line_ = 0;
  std::vector<std::string_view> words_;
  unsigned seen_ = 0;
  std::vector<Field> fields_;
  std::optional<std::uint64_t> width_, height_, points_;
  std::string_view data_;
  std::size_t columns_ = 0, point_bytes_ = 0;
};

}  // namespace

PcdPromise check_pcd(std::string_view bytes, std::string_view name) {
  return PcdChecker(bytes, name).check();
}

}  // namespace plexway::pcl
