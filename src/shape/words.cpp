#include "shape/words.hpp"

#include <cstdio>

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

}  // namespace plexway::detail
