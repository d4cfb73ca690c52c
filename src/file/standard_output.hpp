#pragma once

#include <string_view>

namespace plexway::detail::file {

/// Thrown where the reader of standard output went away: no error, but no reason to go on.
struct OutputClosed {};

/// "FORMAT:-" is standard output as a file of that format: the format, ascii letters in lower case
/// and digits, or nothing for any other name. A file of such a name is "./FORMAT:-".
inline std::string_view format_on_standard_output(std::string_view name) {
  if (name.size() < 4 || name.size() > 10 || !name.ends_with(":-")) return {};
  name.remove_suffix(2);
  for (const char c : name)
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))) return {};
  return name;
}

}  // namespace plexway::detail::file
