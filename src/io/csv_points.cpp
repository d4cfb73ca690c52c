// Points as a table of text, a point a line. docs/FORMATS.md has the rules.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <plexway/io/points.hpp>

#include "io/text_scanner.hpp"
#include "quote.hpp"
#include "surface_checks.hpp"

namespace plexway::io {
namespace {

constexpr std::size_t absent = SIZE_MAX;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r\"";
  const std::size_t from = text.find_first_not_of(blank);
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(blank) - from + 1);
}

class CsvReader {
 public:
  CsvReader(std::string_view text, std::string_view name)
      : text_(without_mark(text)), name_(name) {}

  Points read() && {
    std::vector<std::string_view> fields;
    while (next_line(fields)) {
      if (columns_ == 0) {
        columns_ = fields.size();
        if (take_header(fields)) continue;
      }
      if (fields.size() != columns_)
        fail("has " + std::to_string(fields.size()) + " columns, those before it have " +
             std::to_string(columns_));
      if (points_.positions.size() == most_vertices) fail("more points than 32 bits count");
      points_.positions.push_back(row(fields, 0));
      if (at_[3] == absent) continue;
      const auto normal = row(fields, 3);
      const double length = std::hypot(normal[0], normal[1], normal[2]);
      if (length != 0 && !(length > 0.5 && length < 2)) fail("has a normal that is no unit vector");
      points_.normals.push_back(normal);
    }
    if (points_.positions.empty())
      throw InputError(std::string(name_) + ": has no points; a cloud needs at least one");
    return std::move(points_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(std::string(name_) + ":" + std::to_string(line_) + ": " + cause);
  }

  // The fields of the next line that has some; what follows a # is a comment.
  bool next_line(std::vector<std::string_view>& fields) {
    while (!text_.empty()) {
      ++line_;
      std::string_view line = text_.substr(0, text_.find('\n'));
      text_.remove_prefix(std::min(line.size() + 1, text_.size()));
      line = trimmed(line.substr(0, line.find('#')));
      if (line.empty()) continue;
      if (separator_ == 0)
        separator_ = line.find(';') != line.npos    ? ';'
                     : line.find(',') != line.npos  ? ','
                     : line.find('\t') != line.npos ? '\t'
                                                    : ' ';
      fields.clear();
      for (std::size_t from = 0; from <= line.size();) {
        const std::size_t end = std::min(line.find(separator_, from), line.size());
        const std::string_view field = trimmed(line.substr(from, end - from));
        if (separator_ != ' ' || !field.empty()) fields.push_back(field);
        from = end + 1;
      }
      return true;
    }
    return false;
  }

  static bool is_number(std::string_view field) {
    double value = 0;
    const auto [rest, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    return error == std::errc{} && rest == field.data() + field.size();
  }

  // Which columns are what; false where the line is a point already.
  bool take_header(const std::vector<std::string_view>& fields) {
    if (std::all_of(fields.begin(), fields.end(), is_number)) {
      if (fields.size() != 3)
        fail("has " + std::to_string(fields.size()) +
             " columns and no header before it that says which of them are x, y and z");
      for (std::size_t k = 0; k < 3; ++k) at_[k] = k;
      return false;
    }
    constexpr std::string_view names[6] = {"x", "y", "z", "nx", "ny", "nz"};
    for (std::size_t c = 0; c < fields.size(); ++c) {
      std::string lower(fields[c]);
      for (char& letter : lower)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter + ('a' - 'A'));
      for (std::size_t k = 0; k < 6; ++k) {
        if (lower != names[k]) continue;
        if (at_[k] != absent) fail("names two columns " + quote(fields[c]));
        at_[k] = c;
      }
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (at_[k] == absent)
        fail("names no column " + std::string(names[k]) + "; the first is " + quote(fields[0]));
    if (at_[3] == absent || at_[4] == absent || at_[5] == absent) at_[3] = absent;
    return true;
  }

  std::array<double, 3> row(const std::vector<std::string_view>& fields, std::size_t first) const {
    std::array<double, 3> found{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::string_view field = fields[at_[first + k]];
      if (field.starts_with('+')) field.remove_prefix(1);
      const auto [rest, error] =
          std::from_chars(field.data(), field.data() + field.size(), found[k]);
      if (error != std::errc{} || rest != field.data() + field.size() || !std::isfinite(found[k]))
        fail("expected a number, found " + quote(fields[at_[first + k]]));
    }
    return found;
  }

  std::string_view text_, name_;
  std::size_t line_ = 0, columns_ = 0;
  char separator_ = 0;
  std::array<std::size_t, 6> at_ = {absent, absent, absent, absent, absent, absent};
  Points points_;
};

}  // namespace

Points parse_csv_points(std::string_view text, std::string_view name) {
  return CsvReader(text, name).read();
}

}  // namespace plexway::io
