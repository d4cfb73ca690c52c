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

/// Text for XML, in an element or between quotes; control characters become blanks.
inline std::string escape_xml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out;
}

}  // namespace plexway::io
