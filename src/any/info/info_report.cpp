#include "any/info/info_report.hpp"

#include <algorithm>

namespace plexway {
namespace {

std::string point_text(const std::array<double, 3>& point) {
  std::string text;
  for (const double x : point) text.append(text.empty() ? "(" : ", ").append(short_number(x));
  return text.append(")");
}

}  // namespace

Json to_json(const Bounds& box) { return {{"min", box.low}, {"max", box.high}}; }

Json to_json(const Spread& spread) {
  return {{"min", json_number(spread.min)},
          {"mean", json_number(spread.mean)},
          {"max", json_number(spread.max)}};
}

std::string to_text(const Bounds& box) {
  return point_text(box.low) + " to " + point_text(box.high);
}

std::string to_text(const Spread& spread) {
  return "min " + short_number(spread.min) + ", mean " + short_number(spread.mean) + ", max " +
         short_number(spread.max);
}

Json sizes_json(const std::optional<std::vector<std::size_t>>& sizes) {
  if (!sizes) return nullptr;
  constexpr std::size_t most = 100;
  Json array = Json::array();
  for (std::size_t i = 0; i < std::min(most, sizes->size()); ++i) array.push_back((*sizes)[i]);
  return array;
}

void add_sizes(Table& table, const std::optional<std::vector<std::size_t>>& sizes) {
  if (!sizes || sizes->size() < 2) return;
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sizes->size()); ++i)
    text.append(i == 0 ? "" : ", ").append(std::to_string((*sizes)[i]));
  table.add("components", text + (sizes->size() > most ? ", ... vertices" : " vertices"));
}

}  // namespace plexway
