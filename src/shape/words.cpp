#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/names.hpp"
#include "shape/words.hpp"

namespace plexway::detail {

std::string singular(std::string_view plural) {
  const auto swapped = [&](std::string_view end, std::string_view with) {
    return std::string(plural.substr(0, plural.size() - end.size())).append(with);
  };
  if (plural.ends_with("vertices")) return swapped("vertices", "vertex");
  if (plural.ends_with("simplices")) return swapped("simplices", "simplex");
  if (plural.ends_with("hedra")) return swapped("hedra", "hedron");
  return plural.ends_with("s") ? swapped("s", "") : std::string(plural);
}

std::string counted(std::size_t count, std::string_view plural) {
  return std::to_string(count).append(" ").append(count == 1 ? singular(plural) : plural);
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string short_time(double seconds) {
  char text[32];
  if (seconds >= 1)
    std::snprintf(text, sizeof text, "%.2f s", seconds);
  else
    std::snprintf(text, sizeof text, "%.2f ms", 1e3 * seconds);
  return text;
}

void Table::add(std::string label, std::string text) {
  lines_.emplace_back(std::move(label), std::move(text));
}

void Table::add(const Table& other) {
  lines_.insert(lines_.end(), other.lines_.begin(), other.lines_.end());
}

std::string Table::text() const {
  std::size_t widest = 0;
  for (const auto& line : lines_) widest = std::max(widest, line.first.size());
  std::string text;
  for (const auto& [label, what] : lines_)
    text += label + std::string(widest + 2 - label.size(), ' ') + what + "\n";
  return text;
}

void add_written(Table& table, const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (!file.empty() && !io::on_standard_output(file)) table.add("written", file);
}

std::string json_text(const Json& object) {
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

}  // namespace plexway::detail
