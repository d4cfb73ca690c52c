#include "did_you_mean.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace plexway::io {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c; }

// Letters to change, add, drop or swap with the next: the restricted Damerau-Levenshtein distance.
std::size_t slips_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      next[j] = std::min({row[j - 1] + (same ? 0 : 1), row[j] + 1, next[j - 1] + 1});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1]))
        next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before.swap(row);
    row.swap(next);
  }
  return row[b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string_view> known) {
  constexpr std::size_t longest = 64;
  if (word.size() > longest) return "";
  const auto letters = [](std::string_view of) {
    return static_cast<std::size_t>(
        std::count_if(of.begin(), of.end(), [](char c) { return c != '-' && c != '.'; }));
  };
  std::string_view best;
  std::size_t least = std::max<std::size_t>(letters(word) / 3, 1) + 1;
  for (const std::string_view one : known) {
    if (one.size() > longest || letters(one) < 2) continue;
    const std::size_t slips = slips_between(word, one);
    if (slips >= least || slips >= letters(one)) continue;
    least = slips;
    best = one;
  }
  if (best.empty() || letters(word) == 0) return "";
  return std::string("; did you mean '").append(best).append("'?");
}

}  // namespace plexway::io
