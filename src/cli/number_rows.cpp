#include "number_rows.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <plexway/error.hpp>

namespace plexway::cli {

std::vector<NumberRow> read_number_rows(const std::string& file, std::size_t least,
                                        std::size_t most, const std::string& what) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(file + ": is a directory, not a file");
  errno = 0;
  std::ifstream in(file);
  if (!in)
    throw InputError(
        file + ": cannot be read: " + std::generic_category().message(errno != 0 ? errno : EIO));
  constexpr std::string_view blank = " \t\r,";
  std::vector<NumberRow> rows;
  std::size_t line = 0;
  for (std::string text; std::getline(in, text);) {
    ++line;
    const auto fail = [&](const std::string& cause) {
      throw InputError(file + ":" + std::to_string(line) + ": " + cause);
    };
    NumberRow row{{}, line};
    std::string_view left = std::string_view(text).substr(0, text.find('#'));
    for (;;) {
      const std::size_t begin = left.find_first_not_of(blank);
      if (begin == left.npos) break;
      left.remove_prefix(begin);
      const std::string_view word = left.substr(0, left.find_first_of(blank));
      const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
      double value = 0;
      const char* const end = digits.data() + digits.size();
      const auto [rest, error] = std::from_chars(digits.data(), end, value);
      if (error != std::errc{} || rest != end || !std::isfinite(value))
        fail("not a number: '" + std::string(word.substr(0, 32)) + "'");
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

}  // namespace plexway::cli
