#pragma once

#include <span>
#include <string>
#include <string_view>

namespace plexway::io {

/// "; did you mean 'known'?" for the known word that a slip of the hand turned into this one, the
/// first of the nearest, or "" where none is near: more than a third of the letters wrong, left
/// out, one too many or swapped with the next. Case does not count.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

}  // namespace plexway::io
