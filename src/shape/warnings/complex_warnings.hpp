#pragma once

#include <cstddef>
#include <vector>

#include <plexway/shape/warnings.hpp>

namespace plexway {

/// How a cloud was given.
struct GivenCloud {
  std::size_t k = 0;             ///< neighbours that were sought; 0: not known
  bool normals_refused = false;  ///< were some given, and not taken?
};

/// What a complex says of all its fields.
template <class C>
[[nodiscard]] std::vector<Warning> complex_warnings(const C& complex, Reader reader,
                                                    const GivenCloud& given = {});

}  // namespace plexway
