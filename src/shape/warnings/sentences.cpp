#include <span>
#include <type_traits>
#include <vector>

#include "shape/warnings/sentences.hpp"
#include "shape/words.hpp"

namespace plexway {

namespace detail {

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

}  // namespace detail

metric::Violations violations_of(const AnyDomain& domain) {
  const MeasuredLengths* lengths = domain.lengths();
  if (lengths == nullptr) lengths = domain.shape().lengths();
  if (lengths == nullptr) return {};
  const OpenSimplices* const open = domain.open_simplices();
  if (open == nullptr || lengths->violations.count == 0) return lengths->violations;
  metric::Violations found;
  const auto count = [&](const auto& rows) {
    using Row = typename std::remove_cvref_t<decltype(rows)>::value_type;
    std::vector<Row> left;
    left.reserve(open->size());
    for (std::size_t s = 0; s < open->size(); ++s)
      left.push_back(rows[open->outside(static_cast<Index>(s))]);
    found = metric::find_violations(std::span<const Row>(left));
  };
  if (!lengths->triangles.empty())
    count(lengths->triangles);
  else if (!lengths->tets.empty())
    count(lengths->tets);
  if (found.count > 0) found.first = open->outside(static_cast<Index>(found.first));
  return found;
}

namespace detail {

std::string smoothed_sentence() {
  return "in solids paths are refracted between regions of at most 64 speeds: here each edge takes "
         "the mean of its tetrahedra, which is of first order where they jump";
}

std::string violations_sentence(const AnyDomain& domain) {
  const metric::Violations broken = violations_of(domain);
  if (broken.count == 0) return {};
  const std::string_view what = domain.shape().simplex_name();
  const OpenSimplices* const open = domain.open_simplices();
  const std::size_t all = open == nullptr ? domain.shape().simplices() : open->size();
  return (domain.lengths() != nullptr ? "the metric breaks" : "lengths break") +
         std::string(" the triangle inequality in ") + counted(broken.count, what) + " of " +
         std::to_string(all) + ", such as " + singular(what) + " " + std::to_string(broken.first) +
         ": their lengths were taken as those of the nearest flat ones";
}

}  // namespace detail

}  // namespace plexway
