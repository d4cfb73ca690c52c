#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace plexway::web {

/// A JSON object on one line.
class JsonLine {
 public:
  void add(std::string_view name, std::string_view value) {
    begin(name);
    quoted(value);
  }
  void add(std::string_view name, bool value) {
    begin(name);
    text_ += value ? "true" : "false";
  }
  template <class Number>
  requires std::integral<Number> &&
      (!std::same_as<Number, bool>)void add(std::string_view name, Number value) {
    begin(name);
    text_ += std::to_string(value);
  }
  /// JSON has no infinity: null stands for it.
  void add(std::string_view name, double value) {
    begin(name);
    number(value);
  }
  void add(std::string_view name, const std::array<double, 3>& value) {
    begin(name);
    text_ += '[';
    for (std::size_t i = 0; i < 3; ++i) {
      if (i != 0) text_ += ',';
      number(value[i]);
    }
    text_ += ']';
  }
  void add(std::string_view name, const std::vector<std::string>& values) {
    begin(name);
    text_ += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i != 0) text_ += ',';
      quoted(values[i]);
    }
    text_ += ']';
  }
  [[nodiscard]] std::string text() const { return text_ + "}"; }

 private:
  void begin(std::string_view name) {
    if (text_.size() > 1) text_ += ',';
    text_ += '"';
    text_ += name;
    text_ += "\":";
  }
  void quoted(std::string_view value) {
    text_ += '"';
    for (const char c : value) {
      if (c == '"' || c == '\\') text_ += '\\';
      if (static_cast<unsigned char>(c) >= ' ') text_ += c;
    }
    text_ += '"';
  }
  void number(double value) {
    char digits[32];
    if (std::isfinite(value)) {
      std::snprintf(digits, sizeof digits, "%.17g", value);
      text_ += digits;
    } else {
      text_ += "null";
    }
  }

  std::string text_ = "{";
};

}  // namespace plexway::web
