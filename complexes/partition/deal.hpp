#pragma once

#include <cstddef>
#include <deque>
#include <utility>

namespace plexway::detail {

/// Which pieces are whose: they are dealt to processes in turn. One in the order of a cut lies
/// beside the one before, so each process has some of every region, and each has work wherever the
/// front is.
struct Deal {
  std::size_t ours = 0;   ///< this process
  std::size_t count = 1;  ///< of so many

  [[nodiscard]] std::size_t owner(std::size_t piece) const { return piece % count; }
  [[nodiscard]] bool is_ours(std::size_t piece) const { return owner(piece) == ours; }
  /// Of a piece that is ours: its number among these.
  [[nodiscard]] std::size_t place(std::size_t piece) const { return piece / count; }
  /// Calls visit(piece) for each that is ours of so many, in order.
  template <class Visit>
  void each(std::size_t pieces, const Visit& visit) const {
    for (std::size_t p = ours; p < pieces; p += count) visit(p);
  }
  bool operator==(const Deal&) const = default;
};

/// The pieces that are ours, at work in a solve; they stay where they are made.
template <class Piece>
class OurPieces {
 public:
  explicit OurPieces(Deal deal) : deal_(deal) {}

  [[nodiscard]] const Deal& deal() const { return deal_; }
  /// Makes the next of them, in the order of their numbers.
  template <class... Arguments>
  void add(Arguments&&... arguments) {
    pieces_.emplace_back(std::forward<Arguments>(arguments)...);
  }
  /// By its number among all; null where it is another process's.
  [[nodiscard]] Piece* find(std::size_t piece) {
    return deal_.is_ours(piece) ? &pieces_[deal_.place(piece)] : nullptr;
  }
  ///@{
  /// By its number among ours.
  [[nodiscard]] std::size_t size() const { return pieces_.size(); }
  [[nodiscard]] Piece& operator[](std::size_t i) { return pieces_[i]; }
  [[nodiscard]] const Piece& operator[](std::size_t i) const { return pieces_[i]; }
  [[nodiscard]] auto begin() { return pieces_.begin(); }
  [[nodiscard]] auto end() { return pieces_.end(); }
  [[nodiscard]] auto begin() const { return pieces_.begin(); }
  [[nodiscard]] auto end() const { return pieces_.end(); }
  ///@}

 private:
  Deal deal_;
  std::deque<Piece> pieces_;
};

}  // namespace plexway::detail
