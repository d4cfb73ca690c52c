#pragma once

#include <string>

#include <plexway/shape/remarks.hpp>

namespace plexway {

/// For people: paths were to be refracted in a solid, and are not.
[[nodiscard]] std::string smoothed_sentence();
/// For people, where lengths break the triangle inequality; else empty.
[[nodiscard]] std::string violations_sentence(const AnyDomain& domain);

}  // namespace plexway
