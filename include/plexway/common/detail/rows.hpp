#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace plexway::detail {

/// An array that is its own, or lies in memory that something else keeps, such as a file that is
/// mapped. It is read as a std::vector is, and may be changed while it is its own.
template <class T, class Own = std::vector<T>>
class Rows {
 public:
  using value_type = T;

  Rows() = default;
  Rows(Own own) : own_(std::move(own)) {}
  /// What `keeper` keeps where it is.
  Rows(std::span<const T> lent, std::shared_ptr<const void> keeper)
      : lent_(lent), keeper_(std::move(keeper)) {}

  /// To change it; of one that is lent a copy, from then on.
  [[nodiscard]] Own& own() {
    if (keeper_) {
      own_.assign(lent_.begin(), lent_.end());
      keeper_.reset();
    }
    return own_;
  }

  [[nodiscard]] const T* data() const { return keeper_ ? lent_.data() : own_.data(); }
  [[nodiscard]] std::size_t size() const { return keeper_ ? lent_.size() : own_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const T* begin() const { return data(); }
  [[nodiscard]] const T* end() const { return data() + size(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return data()[i]; }
  [[nodiscard]] std::size_t capacity() const { return keeper_ ? lent_.size() : own_.capacity(); }

 private:
  Own own_;
  std::span<const T> lent_;
  std::shared_ptr<const void> keeper_;
};

}  // namespace plexway::detail
