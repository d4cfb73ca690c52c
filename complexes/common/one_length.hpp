#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

namespace plexway {

template <class Row>
double longest_of(const Row& lengths) {
  return *std::max_element(lengths.begin(), lengths.end());
}

/// Two lengths given for one edge of simplices with edges as long as `longest`: by more than
/// numbers of six digits are rounded. Those below 0 are refused by themselves.
inline bool differ_much(double one, double other, double longest) {
  return one >= 0 && other >= 0 && std::abs(one - other) > 1e-5 * longest;
}

[[noreturn]] inline void refuse_two_lengths(Index a, Index b, double one, double other) {
  std::ostringstream text;
  text << "the edge " << std::min(a, b) << " - " << std::max(a, b) << " has the length " << one
       << " in one simplex and " << other << " in another: give it one";
  throw InputError(text.str());
}

}  // namespace plexway
