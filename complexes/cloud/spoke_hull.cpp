#include "complexes/cloud/umbrella.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "kernel/lanes.hpp"

namespace plexway::detail {

std::span<const std::size_t> SpokeHull::wrap(Index place, std::span<const Spoke> spokes) {
  spokes_ = spokes;
  std::size_t first = 0;
  double largest = 0;
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    const double u = spokes_[i].u, v = spokes_[i].v, size = u * u + v * v;
    if (size > largest) first = i, largest = size;
  }
  if (wrap_without_ties(first, std::sqrt(largest))) return hull_;
  hull_.clear();
  std::size_t at = first;
  do {
    hull_.push_back(at);
    if (hull_.size() > spokes_.size()) {  // rounding: no way around
      hull_.clear();
      break;
    }
    at = next_of_ties(place, at);
  } while (at != first && at != spokes_.size());
  return hull_;
}

// If from each place on the hull one image has all others to its left, by far more than a tie: then
// nothing else is to be asked, and single precision can tell. Who is on the hull already is not
// asked again, except for the first.
bool SpokeHull::wrap_without_ties(std::size_t first, double largest) {
  using Four = kernel::Lanes<float>;
  constexpr std::size_t lanes = 4, most = 64;
  const std::size_t count = spokes_.size();
  if (count < 3 || count > most) return false;
  std::array<float, most> us, vs;
  for (std::size_t i = 0; i < count; ++i) {
    us[i] = static_cast<float>(spokes_[i].u);
    vs[i] = static_cast<float>(spokes_[i].v);
  }
  for (std::size_t i = count; i % lanes != 0; ++i) us[i] = vs[i] = 0;
  // A tie is a turn of at most 2e-4 largest |b|, as no image is farther away than twice the
  // largest; the rest is for what single precision is off.
  const float tie = static_cast<float>(3.5e-4 * largest);
  const float off = static_cast<float>(1.5e-6 * largest * largest);
  const auto bit = [](std::size_t i) { return std::uint64_t{1} << i; };
  std::uint64_t others = (bit(count - 1) << 1) - 1 - bit(first);
  hull_.assign(1, first);
  for (std::size_t from = first;;) {
    const float au = us[from], av = vs[from];
    std::size_t best = 0;
    float bu = 0, bv = 0, least = 0;
    const auto look_at = [&](std::size_t i) {
      best = i, bu = us[i] - au, bv = vs[i] - av;
      least = tie * (std::abs(bu) + std::abs(bv)) + off;
    };
    const auto turn_to = [&](std::size_t i) { return bu * (vs[i] - av) - bv * (us[i] - au); };
    const std::uint64_t rest = others & ~bit(first);
    look_at(rest == 0 ? first : static_cast<std::size_t>(std::countr_zero(rest)));
    std::uint64_t open = others & ~bit(best);
    for (std::size_t at = 0; at < count; at += lanes) {
      Four u, v;
      std::memcpy(&u.v, us.data() + at, sizeof(u.v));
      std::memcpy(&v.v, vs.data() + at, sizeof(v.v));
      u = u - Four(au), v = v - Four(av);
      while (true) {
        const Four turn = Four(bu) * v - Four(bv) * u;
        const auto left = static_cast<unsigned>(kernel::lane_bits(turn > Four(least)));
        const unsigned not_left = ~left & static_cast<unsigned>(open >> at) & 15;
        if (not_left == 0) [[likely]]
          break;
        const std::size_t i = at + static_cast<unsigned>(std::countr_zero(not_left));
        if (!(turn_to(i) < -least)) return false;
        look_at(i);
        open &= ~std::uint64_t{1} << i;
      }
    }
    // All are to the left of what was best when they were asked, and that of this one. So they are
    // unless they are nearly behind; then so is the place before on the hull, and at the end those
    // that were not asked.
    const auto is_left = [&](std::size_t i) { return turn_to(i) > least; };
    const std::size_t size = hull_.size();
    if (best == first) return std::all_of(hull_.begin() + 1, hull_.end() - 1, is_left);
    if (size > 1 && !is_left(hull_[size - 2])) return false;
    for (std::size_t i = 0; i < best && size == 1; ++i)
      if (i != first && !is_left(i)) return false;
    hull_.push_back(best);
    others = (others | bit(first)) & ~bit(best);
    from = best;
  }
}

std::size_t SpokeHull::next_of_ties(Index place, std::size_t at) {
  const Spoke& a = spokes_[at];
  std::size_t best = spokes_.size();
  double bu = 0, bv = 0, bb = 0;
  ties_.clear();
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    if (i == at) continue;
    const double u = spokes_[i].u - a.u, v = spokes_[i].v - a.v;
    const double turn = bu * v - bv * u, square = u * u + v * v;
    constexpr double near_tie = 1e-8, tie = 1e-12;  // squares of sines
    if (best != spokes_.size() && turn * turn <= (at_.empty() ? tie : near_tie) * bb * square &&
        (at_.empty() || on_one_circle({place, a.place, spokes_[best].place, spokes_[i].place}))) {
      if (bu * u + bv * v > 0) {
        ties_.push_back(square > bb ? best : i);
        if (!(square > bb)) continue;
      } else if (a.u * v <= a.v * u) {  // two ways along a line: one has the place to the left
        continue;
      } else {
        ties_.clear();
      }
    } else if (best != spokes_.size() && turn >= 0) {
      continue;
    } else {
      ties_.clear();
    }
    best = i;
    bu = u, bv = v, bb = square;
  }
  if (!ties_.empty()) return break_ties(place, at, best);
  return best;
}

// By Ptolemy: of the products of opposite distances between four places the largest is then the sum
// of the others; else opposite angles lack a sine of pi. The same bits from each of the four.
bool SpokeHull::on_one_circle(std::array<Index, 4> places) const {
  constexpr double tie = 1e-12, rounding = 1e-15;  // squares
  std::sort(places.begin(), places.end());
  const auto apart = [&](std::size_t i, std::size_t j) {
    const Point3 d = minus(at_[places[i]], at_[places[j]]);
    return std::sqrt(dot(d, d));
  };
  std::array<double, 3> product = {apart(0, 1) * apart(2, 3), apart(0, 2) * apart(1, 3),
                                   apart(0, 3) * apart(1, 2)};
  std::sort(product.begin(), product.end());
  const double sum = product[0] + product[1];
  return sum * sum - product[2] * product[2] <=
         tie * product[0] * product[1] + rounding * sum * sum;
}

// Several on one circle with the place. All agree that the lowest of them sees all others.
std::size_t SpokeHull::break_ties(Index place, std::size_t at, std::size_t best) {
  std::size_t lowest = ties_[0];
  for (const std::size_t i : ties_)
    if (spokes_[i].place < spokes_[lowest].place) lowest = i;
  const Index others = std::min({spokes_[at].place, spokes_[best].place, spokes_[lowest].place});
  if (place < others) {
    const Spoke& a = spokes_[at];  // all of them: the nearest image is next
    const auto far = [&](std::size_t i) {
      const double u = spokes_[i].u - a.u, v = spokes_[i].v - a.v;
      return std::sqrt(u * u + v * v);
    };
    std::size_t nearest = best;
    for (const std::size_t i : ties_)
      if (far(i) < far(nearest)) nearest = i;
    return nearest;
  }
  return spokes_[lowest].place == others ? lowest : best;
}

}  // namespace plexway::detail
