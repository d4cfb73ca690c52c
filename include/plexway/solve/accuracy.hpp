#pragma once

#include <concepts>
#include <string_view>

namespace plexway {

/// How accurate distances on a surface, a cloud or in a solid shall be: an error, or a name.
///
/// A number is the mean relative error to expect at vertices, away from thin triangles: windows are
/// merged as long as that stays so. It is no bound; single vertices may be off by a hundred times
/// as much. Below 1e-5 merging saves nothing any more, and that is `exact`.
///
/// What goes with what is in support.hpp. docs/explanation/accuracy.md has the errors and times to
/// expect.
class Accuracy {
 public:
  /// By which rule: `usual` chooses one, `fast` is labels, the others windows, in solids strings.
  enum class Kind { usual, fast, merged, exact };

  /// For who does not choose: `accurate` where windows or, in solids, strings go (support.hpp),
  /// else `fast`. So it is `fast` on executor GL, under refraction, and with options that are of
  /// labels (Visibility but saddles, a step). Sheets of a mixed domain that join to one surface are
  /// solved by windows, in double exactly. Where windows become too many, labels take over
  /// (PropagateStatistics::windows_gave_up); requested by name, windows end with EndlessError
  /// there.
  static constexpr Accuracy usual() { return Accuracy(Kind::usual, 7e-5); }
  /// One label a simplex: on surfaces mean errors of 3e-4 to 2e-3, single vertices more.
  static constexpr Accuracy fast() { return Accuracy(Kind::fast, 1e-3); }
  /// Merged windows; in solids strings.
  static constexpr Accuracy accurate() { return Accuracy(7e-5); }
  /// All windows, in double: nothing but rounding. For a TriangleMesh<double>: the other one's
  /// lengths are themselves rounded to 6e-8.
  static constexpr Accuracy exact() { return Accuracy(Kind::exact, 0); }

  /// This mean relative error, from 0 (exact) to below 1 (what uses it checks).
  explicit constexpr Accuracy(double error)
      : kind_(error < 1e-5 ? Kind::exact : Kind::merged), error_(error) {}

  /// Does not compile, and says why.
  template <std::convertible_to<std::string_view> Text>
  constexpr Accuracy(const Text&) : Accuracy(0.) {
    static_assert(!std::convertible_to<Text, std::string_view>,
                  "an accuracy is no text: Accuracy::fast(), Accuracy::accurate(), "
                  "Accuracy::exact(), or a mean relative error, Accuracy(1e-4)");
  }

  /// By which rule it is reached.
  [[nodiscard]] constexpr Kind kind() const { return kind_; }
  /// The mean relative error to expect.
  [[nodiscard]] constexpr double error() const { return error_; }
  /// Are both the same?
  friend constexpr bool operator==(const Accuracy&, const Accuracy&) = default;

 private:
  constexpr Accuracy(Kind kind, double error) : kind_(kind), error_(error) {}

  Kind kind_;
  double error_;
};

}  // namespace plexway
