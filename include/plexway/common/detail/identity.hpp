#pragma once

#include <cstdint>

namespace plexway::detail {

/// Tells contents apart, at once and exactly: what is kept elsewhere about an object (a copy on a
/// graphics processor) is still right while its identity is the same.
///
/// A member of what it identifies. Whatever is built, emptied by a move or `renewed` gets a number
/// that nothing else in the process has had; a copy has the same content, and so the same number.
/// Any thread may draw.
class Identity {
 public:
  Identity() : value_(draw()) {}
  Identity(const Identity&) = default;
  Identity& operator=(const Identity&) = default;
  Identity(Identity&& other) noexcept : value_(other.value_) { other.renew(); }
  Identity& operator=(Identity&& other) noexcept {
    value_ = other.value_;
    other.renew();
    return *this;
  }
  ~Identity() = default;

  /// For whoever changes the content. Never throws.
  void renew() noexcept { value_ = draw(); }
  /// Never 0.
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  static std::uint64_t draw() noexcept;

  std::uint64_t value_;
};

}  // namespace plexway::detail
