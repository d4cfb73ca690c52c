#include "shape/cloud_words.hpp"

#include "shape/spelling.hpp"
#include "shape/words.hpp"

namespace plexway {

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
