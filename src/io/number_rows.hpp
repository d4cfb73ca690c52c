#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace plexway::io {

/// A line of numbers.
struct NumberRow {
  std::vector<double> numbers;
  std::size_t line;  ///< from 1
};

/// Reads lines of finite numbers, between blanks or commas, each with at least `least` and at most
/// `most` of them. Empty lines, and what follows a #, are skipped. Throws InputError
/// "FILE:LINE: cause"; `what` says what a line should be.
std::vector<NumberRow> read_number_rows(const std::string& file, std::size_t least,
                                        std::size_t most, const std::string& what);

/// Throws InputError "FILE:LINE: cause".
[[noreturn]] void fail_at(const std::string& file, std::size_t line, const std::string& cause);
[[noreturn]] void fail_at(const std::string& file, const NumberRow& row, const std::string& cause);

/// The number in this column as one of `vertices` vertices. Throws InputError as above if it is
/// none.
std::uint32_t vertex_in(const std::string& file, const NumberRow& row, std::size_t column,
                        std::size_t vertices);

}  // namespace plexway::io
