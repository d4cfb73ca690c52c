#include "io/number_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

#include <plexway/error.hpp>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/text_scanner.hpp"

namespace plexway::io {

std::vector<NumberRow> read_number_rows(const std::string& file, std::size_t least,
                                        std::size_t most, const std::string& what) {
  const io::FileBytes bytes(file);
  constexpr std::string_view blank = " \t\r,";
  std::vector<NumberRow> rows;
  std::size_t line = 0;
  for (std::string_view text = without_mark(bytes.view()); !text.empty();) {
    std::string_view left = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(left.size() + 1, text.size()));
    ++line;
    const auto fail = [&](const std::string& cause) { fail_at(file, line, cause); };
    NumberRow row{{}, line};
    left = left.substr(0, left.find('#'));
    for (;;) {
      const std::size_t begin = left.find_first_not_of(blank);
      if (begin == left.npos) break;
      left.remove_prefix(begin);
      const std::string_view word = left.substr(0, left.find_first_of(blank));
      const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
      double value = 0;
      const char* const end = digits.data() + digits.size();
      const auto [rest, error] = std::from_chars(digits.data(), end, value);
      if (error != std::errc{} || rest != end || !std::isfinite(value) || word.starts_with("+-"))
        fail("not a number: " + io::quote(word));
      row.numbers.push_back(value);
      left.remove_prefix(word.size());
    }
    if (row.numbers.empty()) continue;
    if (row.numbers.size() < least || row.numbers.size() > most) fail("write " + what);
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError(file + ": nothing in it: write " + what);
  return rows;
}

void fail_at(const std::string& file, std::size_t line, const std::string& cause) {
  throw InputError(file + ":" + std::to_string(line) + ": " + cause);
}
void fail_at(const std::string& file, const NumberRow& row, const std::string& cause) {
  fail_at(file, row.line, cause);
}

std::uint32_t vertex_in(const std::string& file, const NumberRow& row, std::size_t column,
                        std::size_t vertices) {
  const double v = row.numbers[column];
  if (v >= 0 && v == std::floor(v) && v < static_cast<double>(vertices))
    return static_cast<std::uint32_t>(v);
  char name[32];
  std::snprintf(name, sizeof name, "%.15g", v);
  fail_at(file, row,
          "vertex " + std::string(name) + " is out of range: the vertices are 0 to " +
              std::to_string(vertices - 1));
}

}  // namespace plexway::io
