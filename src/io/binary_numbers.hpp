#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "bytes.hpp"
#include "number_type.hpp"

namespace plexway::io {

/// Numbers of any type out of bytes, one after the other. What is wrong with them is told to
/// `Source::fail(cause)` of the class that derives from this one: it knows where they stand.
template <class Source>
class BinaryNumbers {
 public:
  std::uint64_t bytes_left() const { return bytes_.size() - at_; }

  double real(NumberType type, std::string_view what) {
    if (!is_float(type)) return static_cast<double>(whole(type, what));
    const std::size_t from = at_;
    const double value =
        type == NumberType::f32 ? static_cast<double>(take<float>(what)) : take<double>(what);
    if (!std::isfinite(value)) {
      at_ = from;
      fail(std::string(what) + " is not finite");
    }
    return value;
  }

  std::int64_t whole(NumberType type, std::string_view what) {
    switch (type) {
      case NumberType::i8:
        return take<std::int8_t>(what);
      case NumberType::u8:
        return take<std::uint8_t>(what);
      case NumberType::i16:
        return take<std::int16_t>(what);
      case NumberType::u16:
        return take<std::uint16_t>(what);
      case NumberType::i32:
        return take<std::int32_t>(what);
      case NumberType::u32:
        return take<std::uint32_t>(what);
      case NumberType::i64:
        return take<std::int64_t>(what);
      case NumberType::u64: {
        const auto value = take<std::uint64_t>(what);
        if (value > most_whole) fail(std::string(what) + " is too large");
        return static_cast<std::int64_t>(value);
      }
      case NumberType::f32:
      case NumberType::f64:
        break;
    }
    const double value = real(type, what);
    if (value != std::floor(value) || std::abs(value) > 9e15)
      fail(std::string(what) + " is not a whole number");
    return static_cast<std::int64_t>(value);
  }

  /// Leaves out so many values.
  void skip(NumberType type, std::uint64_t values, std::string_view what) {
    if (values > bytes_left() / size_of(type)) fail("the file ends before " + std::string(what));
    at_ += values * size_of(type);
  }

 protected:
  BinaryNumbers(std::string_view bytes, std::endian order, std::size_t at)
      : bytes_(bytes), order_(order), at_(at) {}

  std::string_view bytes_;
  std::endian order_;
  std::size_t at_;

 private:
  static constexpr std::uint64_t most_whole = 0x7FFFFFFFFFFFFFFFU;

  [[noreturn]] void fail(const std::string& cause) const {
    static_cast<const Source*>(this)->fail(cause);
  }

  template <class T>
  T take(std::string_view what) {
    if (bytes_left() < sizeof(T)) fail("the file ends before " + std::string(what));
    const T value = load<T>(bytes_.data() + at_, order_);
    at_ += sizeof(T);
    return value;
  }
};

}  // namespace plexway::io
