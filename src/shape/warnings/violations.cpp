#include "shape/warnings/violations.hpp"

#include <span>
#include <type_traits>
#include <vector>

#include "shape/words.hpp"

namespace plexway {

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

}  // namespace plexway
