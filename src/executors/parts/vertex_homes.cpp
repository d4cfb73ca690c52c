#include "executors/parts/vertex_homes.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <plexway/error.hpp>

#include "executors/parts/part_mail.hpp"

namespace plexway {

VertexHomes::VertexHomes(PieceRanks* ranks, const SurfaceRows& rows)
    : ranks_(ranks),
      deal_(ranks == nullptr ? Deal{} : Deal{ranks->rank(), ranks->count()}),
      count_(rows.vertex_count()),
      positions_(size()) {
  rows.read_vertices(begin(), positions_);
  for (std::size_t v = 0; v < positions_.size(); ++v)
    for (const double x : positions_[v])
      if (!std::isfinite(x))
        throw InputError("vertex " + std::to_string(begin() + v) + ": a coordinate is not finite");
}

std::vector<std::size_t> VertexHomes::ranges_of(std::span<const Index> ascending) const {
  std::vector<std::size_t> ranges(deal_.count + 1, ascending.size());
  for (std::size_t r = 0; r < deal_.count; ++r)
    ranges[r] = static_cast<std::size_t>(
        std::lower_bound(ascending.begin(), ascending.end(), begin_of(r)) - ascending.begin());
  return ranges;
}

std::vector<std::array<double, 3>> VertexHomes::fetch(std::span<const Index> ascending) const {
  const std::vector<std::size_t> ranges = ranges_of(ascending);
  std::vector<std::array<double, 3>> found(ascending.size());
  PartMail asked(ranks_), answers(ranks_);
  for (std::size_t r = 0; r < asked.count(); ++r)
    asked.to(r).add(ascending.subspan(ranges[r], ranges[r + 1] - ranges[r]));
  asked.meet();
  for (std::size_t r = 0; r < asked.count(); ++r)
    for (Unpacked mail = asked.from(r); !mail.empty();)
      answers.to(r).add(position(mail.take<Index>()));
  answers.meet();
  for (std::size_t r = 0; r < answers.count(); ++r) {
    Unpacked mail = answers.from(r);
    mail.take(std::span(found).subspan(ranges[r], ranges[r + 1] - ranges[r]));
  }
  return found;
}

}  // namespace plexway
