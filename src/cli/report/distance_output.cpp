#include "cli/report/distance_output.hpp"

#include <charconv>
#include <string>

#include "cli/report/console.hpp"

namespace plexway::cli {
namespace {

template <class Number>
void append(std::string& text, Number value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, result.ptr);
}

}  // namespace

void write_distance_csv(std::span<const double> distance, std::span<const std::int32_t> label,
                        std::span<const std::uint32_t> original, std::span<const double> error) {
  std::string text = "vertex,distance";
  if (!label.empty()) text += ",label";
  if (!original.empty()) text += ",original";
  if (!error.empty()) text += ",error";
  text += '\n';
  for (std::size_t v = 0; v < distance.size(); ++v) {
    append(text, v);
    text += ',';
    append(text, distance[v]);
    if (!label.empty()) {
      text += ',';
      append(text, label[v]);
    }
    if (!original.empty()) {
      text += ',';
      append(text, original[v]);
    }
    if (!error.empty()) {
      text += ',';
      append(text, error[v]);
    }
    text += '\n';
    if (text.size() < (std::size_t{1} << 16)) continue;
    write_output(text);
    text.clear();
  }
  write_output(text);
  flush_output();
}

}  // namespace plexway::cli
