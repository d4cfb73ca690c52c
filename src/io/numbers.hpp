#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace plexway::io {

/// The numbers that binary files are made of.
enum class NumberType : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

constexpr std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::i8:
    case NumberType::u8:
      return 1;
    case NumberType::i16:
    case NumberType::u16:
      return 2;
    case NumberType::i32:
    case NumberType::u32:
    case NumberType::f32:
      return 4;
    default:
      return 8;
  }
}

constexpr bool is_float(NumberType type) {
  return type == NumberType::f32 || type == NumberType::f64;
}

/// The value whose bytes start at `from`, stored in byte order `stored`.
template <class T>
T load(const char* from, std::endian stored) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if (stored != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// Whether it stays finite in single precision.
inline bool fits_float(double value) {
  return std::abs(value) <= static_cast<double>(std::numeric_limits<float>::max());
}

/// The bytes of `value` in little endian order.
template <class T>
std::array<char, sizeof(T)> little_endian(T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// IEEE 754 half precision: 10 bits of fraction, at most 65504.
inline constexpr double largest_half = 65504;

/// The nearest half, ties to even; beyond the largest, and for infinity, infinity. Not for NaN.
inline std::uint16_t to_half(double value) {
  const std::uint16_t sign = std::signbit(value) ? 0x8000U : 0;
  const double size = std::abs(value);
  if (size >= 65520)
    return static_cast<std::uint16_t>(sign | 0x7C00U);  // rounds beyond the largest
  // In steps of what the last bit is worth there; std::nearbyint rounds ties to even.
  const int exponent = size < 0x1p-14 ? -14 : std::ilogb(size);
  const double steps = std::nearbyint(std::ldexp(size, 10 - exponent));
  // A fraction that rounds up to 2048 carries into the exponent, as it should.
  const auto bits = static_cast<std::uint32_t>(exponent + 14) * 1024U;
  return static_cast<std::uint16_t>(sign | (bits + static_cast<std::uint32_t>(steps)));
}

inline double from_half(std::uint16_t half) {
  const double sign = (half & 0x8000U) != 0 ? -1 : 1;
  const int exponent = (half >> 10) & 31, fraction = half & 1023;
  if (exponent == 31) return fraction == 0 ? sign * HUGE_VAL : std::nan("");
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  return sign * std::ldexp(1024 + fraction, exponent - 25);
}

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
