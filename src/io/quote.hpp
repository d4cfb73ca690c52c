#pragma once

#include <string>
#include <string_view>

namespace plexway::io {

/// A piece of a file, fit for a one-line message: short, printable, in quotes.
inline std::string quote(std::string_view piece) {
  constexpr std::size_t longest = 32;
  std::string out = "'";
  for (char c : piece.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
  if (piece.size() > longest) out += "...";
  return out + "'";
}

}  // namespace plexway::io
