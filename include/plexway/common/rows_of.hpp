#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <ranges>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>
#include <plexway/error.hpp>

namespace plexway {

/// A number, or a reference to one.
template <class T>
concept NumberLike = std::is_arithmetic_v<std::remove_cvref_t<T>>;

/// Has rows and columns, and m(i, j) is a number: a matrix of Eigen, in either order.
template <class M>
concept MatrixLike = requires(const M& m) {
  { m.rows() } -> std::convertible_to<std::size_t>;
  { m.cols() } -> std::convertible_to<std::size_t>;
  requires NumberLike<decltype(m(0, 0))>;
};

/// A range of numbers.
template <class R>
concept RangeOfNumbers =
    std::ranges::forward_range<const R> && NumberLike<std::ranges::range_reference_t<const R>>;

/// A range of ranges of numbers.
template <class R>
concept RangeOfRows = std::ranges::forward_range<const R> &&
    RangeOfNumbers<std::remove_cvref_t<std::ranges::range_reference_t<const R>>>;

/// What points and simplices may be given as: a matrix with a row each; a range of ranges, such as
/// std::vector<std::array<float, 3>>; or the numbers of all rows one after the other.
template <class R>
concept RowsOfNumbers = MatrixLike<R> || RangeOfRows<R> || RangeOfNumbers<R>;

namespace detail {

// Something with elements, whatever these are.
template <class R>
concept AnyRows = MatrixLike<R> || std::ranges::forward_range<const R>;

// The numbers that rows are made of: float where they are that, else double.
template <class R>
consteval auto number_of() {
  const auto of = []<class T>(std::type_identity<T>) {
    return std::conditional_t<std::same_as<std::remove_cvref_t<T>, float>, float, double>();
  };
  if constexpr (MatrixLike<R>)
    return of(std::type_identity<decltype(std::declval<const R&>()(0, 0))>());
  else if constexpr (RangeOfRows<R>)
    return of(std::type_identity<std::ranges::range_value_t<
                  const std::remove_cvref_t<std::ranges::range_reference_t<const R>>>>());
  else
    return of(std::type_identity<std::ranges::range_value_t<const R>>());
}
template <class R>
using NumberOf = decltype(number_of<R>());

// Do rows say by their type that they have not N numbers?
template <class R, std::size_t N>
inline constexpr bool is_of_other_width = false;
template <RangeOfRows R, std::size_t N>
requires requires { std::tuple_size<std::ranges::range_value_t<const R>>::value; }
inline constexpr bool is_of_other_width<R, N> =
    std::tuple_size_v<std::ranges::range_value_t<const R>> != N;

template <class T, class Number>
T as_number(Number number, std::size_t row) {
  if constexpr (std::same_as<T, Index>) {
    static_assert(std::integral<Number>, "vertices are integers");
    if constexpr (std::integral<Number>)  // else one error would become three
      if (!std::in_range<Index>(number))
        throw InputError("row " + std::to_string(row) + ": " + std::to_string(number) +
                         " is no number of a vertex");
  }
  return static_cast<T>(number);
}

}  // namespace detail

/// Rows of N numbers, of whatever they are given as, copied. Throws InputError for rows of another
/// length, and for an integer that is no number of a vertex. Cost: linear.
template <class T, std::size_t N, detail::AnyRows R>
[[nodiscard]] std::vector<std::array<T, N>> rows_of(const R& given) {
  static_assert(RowsOfNumbers<R>,
                "points and simplices are numbers: a std::vector<std::array<float, 3>>, a matrix "
                "with a row each, or all numbers in a row");
  static_assert(!detail::is_of_other_width<R, N>,
                "rows have another length: a point has 3 coordinates, a triangle 3 vertices, a "
                "tetrahedron 4, an edge 2");
  std::vector<std::array<T, N>> rows;
  const auto expect = [&](bool right) {
    if (!right)
      throw InputError("row " + std::to_string(rows.size()) + ": expected " + std::to_string(N) +
                       " numbers");
  };
  if constexpr (MatrixLike<R>) {
    expect(static_cast<std::size_t>(given.cols()) == N || given.rows() == 0);
    for (decltype(given.rows()) i = 0; i < given.rows(); ++i) {
      std::array<T, N> row;
      for (std::size_t k = 0; k < N; ++k)
        row[k] =
            detail::as_number<T>(given(i, static_cast<decltype(given.cols())>(k)), rows.size());
      rows.push_back(row);
    }
  } else if constexpr (RowsOfNumbers<R>) {
    using Element = std::remove_cvref_t<std::ranges::range_reference_t<const R>>;
    const auto take = [&](auto& at, auto end) {
      std::array<T, N> row;
      for (T& number : row) {
        expect(at != end);
        number = detail::as_number<T>(*at++, rows.size());
      }
      return row;
    };
    if constexpr (std::is_arithmetic_v<Element>) {
      auto at = std::ranges::begin(given);
      while (at != std::ranges::end(given)) rows.push_back(take(at, std::ranges::end(given)));
    } else {
      for (const auto& one : given) {
        auto at = std::ranges::begin(one);
        const auto row = take(at, std::ranges::end(one));
        expect(at == std::ranges::end(one));
        rows.push_back(row);
      }
    }
  }
  return rows;
}

/// Numbers in rows that are all as long as the first.
struct EqualRows {
  /// Row by row.
  std::vector<double> numbers;
  /// Of each row.
  std::size_t width = 0;
};

/// Rows that tell themselves how long they are.
template <class R>
concept RowsOfAnyWidth = MatrixLike<R> || RangeOfRows<R>;

/// Copied. Throws InputError for a row that is longer or shorter than the first. Cost: linear.
template <RowsOfAnyWidth R>
[[nodiscard]] EqualRows equal_rows_of(const R& given) {
  EqualRows rows;
  if constexpr (MatrixLike<R>) {
    rows.width = static_cast<std::size_t>(given.cols());
    for (decltype(given.rows()) i = 0; i < given.rows(); ++i)
      for (decltype(given.cols()) k = 0; k < given.cols(); ++k)
        rows.numbers.push_back(static_cast<double>(given(i, k)));
  } else {
    std::size_t count = 0;
    for (const auto& one : given) {
      for (const auto number : one) rows.numbers.push_back(static_cast<double>(number));
      if (count == 0) rows.width = rows.numbers.size();
      if (rows.numbers.size() != ++count * rows.width)
        throw InputError("row " + std::to_string(count - 1) + ": expected " +
                         std::to_string(rows.width) + " numbers");
    }
  }
  return rows;
}

/// Is it what a constructor takes without a copy?
template <class R, class T, std::size_t N>
concept PlainRows = std::convertible_to<const R&, std::span<const std::array<T, N>>>;

/// Points and simplices of N corners of which at least one is to be copied.
template <class Points, class Simplices, std::size_t N>
concept OtherRows = detail::AnyRows<Points> && detail::AnyRows<Simplices> &&
    !(PlainRows<Points, double, 3> && PlainRows<Simplices, Index, N>);

}  // namespace plexway
