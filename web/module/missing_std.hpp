#pragma once

// What the C++20 library of Debian's Emscripten (libc++ 13) lacks and plexway takes. Included
// before every file of a build for the browser; each part stands aside where the library has it.

#include <atomic>
#include <bit>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <system_error>
#include <type_traits>

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000
// clang-format off
_LIBCPP_BEGIN_NAMESPACE_STD
/// Of what has data() and size() but is no container of its elements.
template <class Rows>
requires(!requires { typename Rows::value_type; }) span(const Rows&)
    -> span<remove_pointer_t<decltype(declval<const Rows&>().data())>>;
_LIBCPP_END_NAMESPACE_STD
// clang-format on
#endif

namespace std {

#ifndef __cpp_lib_smart_ptr_for_overwrite
template <class Array>
requires is_unbounded_array_v<Array> unique_ptr<Array> make_unique_for_overwrite(size_t count) {
  return unique_ptr<Array>(new remove_extent_t<Array>[count]);
}
#endif

#ifndef __cpp_lib_bit_cast
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

#ifndef __cpp_lib_atomic_ref
/// Only what several threads ask for; the module runs one.
template <class T>
class atomic_ref {
 public:
  explicit atomic_ref(T& value) : value_(&value) {}
  T load(memory_order = memory_order_seq_cst) const { return *value_; }
  void store(T value, memory_order = memory_order_seq_cst) const { *value_ = value; }
  template <class... Orders>
  bool compare_exchange_strong(T& expected, T desired, Orders...) const {
    return compare_exchange_weak(expected, desired);
  }
  bool compare_exchange_weak(T& expected, T desired, memory_order = memory_order_seq_cst,
                             memory_order = memory_order_seq_cst) const {
    if (*value_ == expected) {
      *value_ = desired;
      return true;
    }
    expected = *value_;
    return false;
  }
  T fetch_add(T by, memory_order = memory_order_seq_cst) const {
    const T before = *value_;
    *value_ += by;
    return before;
  }

 private:
  T* value_;
};
#endif

#if !defined(__cpp_lib_to_chars)
/// The shortest digits that read back as the same number.
template <class Real>
requires is_floating_point_v<Real> to_chars_result to_chars(char* first, char* last, Real value) {
  char text[40];
  int length = 0;
  for (int digits = sizeof(Real) == 4 ? 6 : 15; digits <= 17; ++digits) {
    length = snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
    if (static_cast<Real>(strtod(text, nullptr)) == value || value != value) break;
  }
  if (last - first < length) return {last, errc::value_too_large};
  memcpy(first, text, static_cast<size_t>(length));
  return {first + length, errc()};
}

/// Decimal numbers as the standard's function reads them: no leading blanks, no plus sign, no
/// hexadecimal digits.
template <class Real>
requires is_floating_point_v<Real> from_chars_result from_chars(const char* first, const char* last,
                                                                Real& value) {
  const auto belongs = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ||
           c == '-' || c == '+';
  };
  const char* end = first;
  while (end != last && belongs(*end)) ++end;
  const char* digits = first != end && *first == '-' ? first + 1 : first;
  if (digits == end || *digits == '+' || *digits == '-' ||
      (end - digits > 1 && *digits == '0' && (digits[1] == 'x' || digits[1] == 'X')))
    return {first, errc::invalid_argument};
  char short_text[64];
  string long_text;
  const char* text = short_text;
  if (end - first < static_cast<ptrdiff_t>(sizeof short_text)) {
    memcpy(short_text, first, static_cast<size_t>(end - first));
    short_text[end - first] = 0;
  } else {
    long_text.assign(first, end);
    text = long_text.c_str();
  }
  char* stop = nullptr;
  Real read;
  if constexpr (sizeof(Real) == 4)
    read = strtof(text, &stop);
  else
    read = strtod(text, &stop);
  if (stop == text) return {first, errc::invalid_argument};
  const char* reached = first + (stop - text);
  if (read != 0 && (read > numeric_limits<Real>::max() || read < -numeric_limits<Real>::max()) &&
      *digits != 'i' && *digits != 'I')
    return {reached, errc::result_out_of_range};
  value = read;
  return {reached, errc()};
}
#endif

}  // namespace std
