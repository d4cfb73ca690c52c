#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace plexway::io {

inline constexpr std::string_view base64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Bytes as text, with its padding.
inline std::string encode_base64(std::string_view bytes) {
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    const std::size_t some = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < some; ++k)
      three |= std::uint32_t{static_cast<unsigned char>(bytes[i + k])} << (16 - 8 * k);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= some ? base64_digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

/// What a character of base64 stands for, or -1.
constexpr int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// The bytes of a text in base64 that ends with its padding; blanks anywhere. False for anything
/// else.
inline bool decode_base64(std::string_view text, std::string& bytes) {
  std::uint32_t bits = 0;
  int count = 0, padding = 0;
  bytes.clear();
  bytes.reserve(text.size() / 4 * 3);
  for (const char c : text) {
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    const int value = base64_value(c);
    if (c == '=' && count >= 2)
      ++padding;
    else if (value < 0 || padding > 0)
      return false;
    bits = bits << 6 | static_cast<std::uint32_t>(c == '=' ? 0 : value);
    if (++count < 4) continue;
    for (int i = 0; i < 3 - padding; ++i) bytes += static_cast<char>(bits >> (16 - 8 * i) & 0xFF);
    bits = 0;
    count = 0;
  }
  return count == 0;
}

}  // namespace plexway::io
