#pragma once

#include <cstddef>
#include <cstdint>

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

}  // namespace plexway::io
