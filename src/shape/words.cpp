#include "shape/words.hpp"

#include <cstdio>

#include "shape/spelling.hpp"

namespace plexway {

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

std::string kept_points(const CloudShape& cloud) {
  const std::size_t kept = cloud.points.positions.size();
  std::string why;
  const auto add = [&](const std::string& what) {
    why.append(why.empty() ? "" : ", ").append(what);
  };
  if (cloud.not_finite > 0) add(std::to_string(cloud.not_finite) + " not finite");
  if (cloud.outliers > 0) add(counted(cloud.outliers, "outliers"));
  if (cloud.thinned) add("thinned to one point a cube");
  if (why.empty()) return why;
  return std::to_string(kept) + " of " + counted(cloud.points_in_file, "points") + ": " + why;
}

std::string why_disconnected(const CloudShape& cloud, std::size_t components, Reader reader) {
  std::string text = "the cloud has " + counted(components, "components");
  const auto k = connecting_k(cloud);
  if (!k)
    text += ", which even 256 neighbours do not connect";
  else if (cloud.k != 0 && *k > cloud.k)
    text += std::string("; ") + spelled(Advice::k, reader) + std::to_string(*k) +
            " is the least that connects its points";
  else
    text += ", though " + std::to_string(*k) +
            " neighbours connect its points: " + spelled(Advice::neighbour_radius, reader) +
            " or " + spelled(Advice::normal_angle, reader) +
            " keeps them apart, or the points are no surface there";
  return text;
}

}  // namespace plexway
