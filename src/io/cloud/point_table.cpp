// Points as text, one a line. docs/reference/formats.md has the rules.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/names.hpp"
#include "io/readers.hpp"
#include "io/surface/polygons.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {
namespace {

constexpr std::size_t absent = SIZE_MAX;
using Fields = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\v\f\"";
  const std::size_t from = text.find_first_not_of(blank);
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(blank) - from + 1);
}

std::optional<double> number_in(std::string_view field) {
  if (field.starts_with('+') && !field.starts_with("+-")) field.remove_prefix(1);
  double value = 0;
  const char* const end = field.data() + field.size();
  const auto [rest, error] = std::from_chars(field.data(), end, value);
  const bool tiny = error == std::errc::result_out_of_range && field.find("e-") != field.npos;
  if (rest != end || (error != std::errc{} && !tiny)) return std::nullopt;
  return tiny ? 0 : value;
}

class PointTable {
 public:
  PointTable(std::string_view text, std::string_view name)
      : text_(without_mark(text)), name_(name) {
    const std::size_t end = text_.find_first_of("\r\n");
    if (end != text_.npos && text_.substr(end, 2) != "\r\n") newline_ = text_[end];
  }

  Points read() && {
    for (Fields fields; next_line(fields);)
      if (columns_ != 0 || !begin(fields)) add(fields);
    const std::size_t count = points_.positions.size();
    if (promised_ && count < *promised_)
      fail("the file ends after " + std::to_string(count) + " of " + std::to_string(*promised_) +
           " points");
    if (count == 0)
      throw InputError(std::string(name_) + ": has no points; a cloud needs at least one");
    if (at_[3] != absent) check_normals();
    return std::move(points_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ":" + std::to_string(line_) + ": " + cause);
  }
  [[nodiscard]] std::string point() const {
    return "point " + std::to_string(points_.positions.size());
  }

  // The fields of the next line that has some.
  bool next_line(Fields& fields) {
    while (!text_.empty()) {
      ++line_;
      std::string_view line = text_.substr(0, text_.find(newline_));
      text_.remove_prefix(std::min(line.size() + 1, text_.size()));
      line = trimmed(line);
      // A comment may name the columns.
      const std::size_t mark = line.starts_with("//") ? 2 : line.find_first_of("#%") == 0 ? 1 : 0;
      line = trimmed(mark != 0 ? line.substr(mark) : line.substr(0, line.find('#')));
      if (mark != 0 && columns_ == 0) named_ = split(line, separator_of(line));
      if (mark != 0 || line.empty()) continue;
      if (columns_ == 0) separator_ = separator_of(line);
      fields = split(line, separator_);
      return true;
    }
    return false;
  }

  static char separator_of(std::string_view line) {
    for (const char one : {';', ',', '\t'})
      if (line.find(one) != line.npos) return one;
    return ' ';
  }
  static Fields split(std::string_view line, char separator) {
    Fields fields;
    for (std::size_t from = 0; from <= line.size() && !line.empty();) {
      const std::size_t end = separator == ' '
                                  ? std::min(line.find_first_of(" \t", from), line.size())
                                  : std::min(line.find(separator, from), line.size());
      const std::string_view field = trimmed(line.substr(from, end - from));
      if (separator != ' ' || !field.empty()) fields.push_back(field);
      from = end + 1;
    }
    return fields;
  }

  // The first line: true where it is no point.
  bool begin(const Fields& fields) {
    if (!std::all_of(fields.begin(), fields.end(), [](auto f) { return number_in(f); })) {
      take_header(fields);
      for (std::size_t k = 0; k < 3; ++k)
        if (at_[k] == absent)
          fail("names no column " + std::string(names[k]) + "; the first is " + quote(fields[0]));
      columns_ = fields.size();
      return true;
    }
    if (fields.size() == 1 && !promised_) return promise(*number_in(fields[0]));
    columns_ = fields.size();
    if (named_.size() == columns_) take_header(named_);
    if (at_[0] != absent && at_[1] != absent && at_[2] != absent) return false;
    // Leica's .pts has a count before, and a brightness and colours behind.
    const bool scan = promised_ && (columns_ == 4 || columns_ == 7);
    if (columns_ != 3 && columns_ != 6 && !scan)
      fail("has " + std::to_string(columns_) + (columns_ == 1 ? " column" : " columns") +
           " and no header before it that says which of them are x, y and z");
    for (std::size_t k = 0; k < (columns_ == 6 ? 6 : 3); ++k) at_[k] = k;
    guessed_ = true;
    if (scan)
      passed_over("columns 4 to " + std::to_string(columns_) + " are brightness and colour");
    return false;
  }

  bool promise(double count) {
    if (count < 0 || count != std::floor(count) || count >= static_cast<double>(most_vertices))
      fail("a first line with one number must say how many points follow");
    const auto points = static_cast<std::uint64_t>(count);
    if (points > (text_.size() + 1) / 6)  // three digits, two blanks, a line's end
      fail("the first line says " + std::to_string(points) + " points, but only " +
           std::to_string(text_.size()) + " bytes follow");
    promised_ = points;
    points_.positions.reserve(points);
    return true;
  }

  void take_header(const Fields& fields) {
    at_.fill(absent);
    for (std::size_t c = 0; c < fields.size(); ++c) {
      const std::string lower = lower_case(fields[c]);
      for (std::size_t k = 0; k < 6; ++k) {
        if (lower != names[k]) continue;
        if (at_[k] != absent) fail("names two columns " + quote(fields[c]));
        at_[k] = c;
      }
    }
    if (at_[3] == absent || at_[4] == absent || at_[5] == absent) at_[3] = absent;
  }

  void add(const Fields& fields) {
    if (promised_ && points_.positions.size() == *promised_)
      fail("the file goes on after its " + std::to_string(*promised_) + " points with " +
           quote(fields[0]));
    if (fields.size() != columns_)
      fail(point() + " has " + std::to_string(fields.size()) +
           (fields.size() == 1 ? " column" : " columns") + ", those before it have " +
           std::to_string(columns_));
    if (points_.positions.size() == most_vertices) fail("more points than 32 bits count");
    const auto row = [&](std::size_t first) {
      std::array<double, 3> found{};
      for (std::size_t k = 0; k < 3; ++k) {
        const std::string_view field = fields[at_[first + k]];
        const auto value = number_in(field);
        if (!value || !std::isfinite(*value))
          fail(std::string(names[first + k]) + " of " + point() +
               " is no finite number: " + quote(field));
        found[k] = *value;
      }
      return found;
    };
    const auto position = row(0);
    if (at_[3] != absent) points_.normals.push_back(row(3));
    points_.positions.push_back(position);
  }

  void passed_over(const std::string& what) {
    points_.report.notes.push_back(what + ", and passed over");
  }

  // Without a header the columns 4 to 6 may be colours.
  void check_normals() {
    constexpr double near = 0.05;
    double most = 0, least = 0;
    std::size_t unit = 0, wrong = absent;
    for (std::size_t i = 0; i < points_.normals.size(); ++i) {
      const auto& n = points_.normals[i];
      const double length = std::hypot(n[0], n[1], n[2]);
      if (length == 0 || std::abs(length - 1) < near) ++unit;
      if (length != 0 && !(length > 0.5 && length < 2) && wrong == absent) wrong = i;
      for (const double c : n) most = std::max(most, c), least = std::min(least, c);
    }
    if (unit == points_.normals.size()) return;
    if (guessed_ && least >= 0 && most <= 255 && (most > 1 || 2 * unit < points_.normals.size())) {
      passed_over("columns 4 to 6 are colours by their range, 0 to " +
                  std::string(most > 1 ? "255" : "1") + ", not normals");
      points_.normals.clear();
    } else if (wrong != absent) {
      throw InputError(std::string(name_) + ": point " + std::to_string(wrong) +
                       " has a normal that is no unit vector; if these columns are something "
                       "else, leave them out");
    }
  }

  static constexpr std::string_view names[6] = {"x", "y", "z", "nx", "ny", "nz"};
  std::string_view text_, name_;
  Points points_;
  Fields named_;  ///< by a comment before the first point
  std::optional<std::uint64_t> promised_;
  std::size_t line_ = 0, columns_ = 0;
  bool guessed_ = false;  ///< what the columns are
  char separator_ = ' ', newline_ = '\n';
  std::array<std::size_t, 6> at_ = {absent, absent, absent, absent, absent, absent};
};

}  // namespace

Points parse_point_table(std::string_view text, std::string_view name) {
  return PointTable(text, name).read();
}

}  // namespace plexway::io
