#pragma once

#include <vector>

#include <plexway/mixed/mixed_complex.hpp>
#include <plexway/shape/warnings.hpp>

namespace plexway {

/// What may be unexpected in a mixed domain: parts that share vertices but not the edges between
/// them, and paths that go from part to part at some points of a face only. Cost: linear.
template <class Real>
[[nodiscard]] std::vector<Warning> mixed_warnings(const MixedComplex<Real>& complex);

}  // namespace plexway
