#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <memory>
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

/// Rows as a caller gives them: of std::array<double, 3>, say, or of numbers alone. What is such an
/// array and stays is referred to, and must outlive this; what would be gone after the line, and
/// what stands in braces, is kept; anything else (RowsOfNumbers) is copied. Spans of what is
/// kept end with the last copy.
template <class T>
class Given {
 public:
  /// None.
  Given() = default;
  /// What stands in braces, kept.
  Given(std::initializer_list<T> rows) { keep(std::vector<T>(rows)); }
  /// An array of any kind. Throws as rows_of.
  template <detail::AnyRows R>
  requires(!std::same_as<std::remove_cvref_t<R>, Given>) Given(R&& given) {
    using Kind = std::remove_cvref_t<R>;
    if constexpr (std::convertible_to<const Kind&, std::span<const T>>) {
      if constexpr (std::is_lvalue_reference_v<R> || std::ranges::borrowed_range<R>)
        rows_ = given;
      else
        keep(Kind(std::forward<R>(given)));
    } else if constexpr (std::is_arithmetic_v<T>) {
      static_assert(RangeOfNumbers<Kind>, "numbers are expected in a row: a std::vector<double>");
      if constexpr (RangeOfNumbers<Kind>)
        keep(std::vector<T>(std::ranges::begin(given), std::ranges::end(given)));
    } else {
      keep(rows_of<typename T::value_type, std::tuple_size_v<T>>(given));
    }
  }
  ///@{
  /// Copies share what is kept; a move leaves none.
  ~Given() = default;
  Given(const Given&) = default;
  Given(Given&& other) noexcept
      : rows_(std::exchange(other.rows_, {})), keeper_(std::move(other.keeper_)) {}
  Given& operator=(Given other) noexcept {
    std::swap(rows_, other.rows_);
    std::swap(keeper_, other.keeper_);
    return *this;
  }
  ///@}

  ///@{
  /// As those of a std::span.
  [[nodiscard]] const T* data() const { return rows_.data(); }
  [[nodiscard]] const T* begin() const { return rows_.data(); }
  [[nodiscard]] const T* end() const { return rows_.data() + rows_.size(); }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return rows_[i]; }
  ///@}

 private:
  template <class Rows>
  void keep(Rows rows) {
    const auto kept = std::make_shared<const Rows>(std::move(rows));
    rows_ = *kept;
    keeper_ = kept;
  }

  std::span<const T> rows_;
  std::shared_ptr<const void> keeper_;
};

/// Points in space.
using GivenPoints = Given<std::array<double, 3>>;
/// Simplices of N vertices each.
template <std::size_t N>
using GivenSimplices = Given<std::array<Index, N>>;

}  // namespace plexway
