#include "shape/info/report.hpp"

#include <algorithm>
#include <cmath>

#include "io/names.hpp"

namespace plexway::detail {

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
