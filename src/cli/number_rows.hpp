#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace plexway::cli {

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

}  // namespace plexway::cli
