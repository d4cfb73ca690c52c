#include "shape/errors/measures.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <system_error>

#include <plexway/error.hpp>

#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/number_rows.hpp"
#include "io/text_scanner.hpp"

namespace plexway::detail {
namespace {

std::string_view trimmed(std::string_view line) {
  constexpr std::string_view blank = " \t\r";
  const std::size_t first = line.find_first_not_of(blank);
  if (first == line.npos) return {};
  return line.substr(first, line.find_last_not_of(blank) - first + 1);
}

double parse_line(const std::string& file, std::size_t line, std::string_view text) {
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end)
    io::fail_at(file, line, "not a number: " + io::quote(text));
  if (value < 0) io::fail_at(file, line, "a distance below 0: " + io::quote(text));
  return value;
}

}  // namespace

std::vector<double> read_truth(const std::string& file, std::size_t vertices) {
  const io::FileBytes bytes(file);
  std::vector<double> truth;
  std::size_t line = 0;
  std::size_t empty = 0;  // the first empty line, which must have nothing behind it
  for (std::string_view text = io::without_mark(bytes.view()); !text.empty();) {
    const std::string_view whole = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(whole.size() + 1, text.size()));
    ++line;
    const std::string_view value = trimmed(whole);
    if (value.empty()) {
      if (empty == 0) empty = line;
      continue;
    }
    if (empty != 0) io::fail_at(file, empty, "an empty line; write nan where there is no truth");
    if (truth.size() == vertices)
      io::fail_at(file, line, "one value more than the " + std::to_string(vertices) + " vertices");
    truth.push_back(parse_line(file, line, value));
  }
  if (truth.size() < vertices) {
    io::fail_at(file, line,
                "ends after " + std::to_string(truth.size()) + " values, but there are " +
                    std::to_string(vertices) + " vertices");
  }
  return truth;
}

void ErrorGauge::add(std::span<const double> distance, std::span<const double> truth) {
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (std::isnan(truth[v]) || truth[v] == 0) continue;
    const bool reached = std::isfinite(distance[v]);
    if (reached != std::isfinite(truth[v])) ++mismatched_;
    if (reached && std::isfinite(truth[v]))
      relative_.push_back((distance[v] - truth[v]) / truth[v]);
  }
}

double ErrorGauge::mean() const {
  double sum = 0;
  for (const double error : relative_) sum += std::abs(error);
  return sum / static_cast<double>(relative_.size());
}

double ErrorGauge::percentile(double percent) const {
  if (relative_.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted;
  for (const double error : relative_) sorted.push_back(std::abs(error));
  std::sort(sorted.begin(), sorted.end());
  const double rank = percent / 100 * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

double ErrorGauge::max() const { return percentile(100); }

double ErrorGauge::most_below() const {
  if (relative_.empty()) return std::numeric_limits<double>::quiet_NaN();
  return std::min(0.0, *std::min_element(relative_.begin(), relative_.end()));
}

}  // namespace plexway::detail
