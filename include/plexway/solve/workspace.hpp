#pragma once

#include <cstddef>
#include <memory>

namespace plexway {

namespace detail {
/// What a Workspace holds, for the library's own use.
template <class Real>
struct WorkspaceState;
}  // namespace detail

/// All that a propagation changes: labels, marks, queues. Belongs to one domain, of any kind, and
/// one thread at a time; grows on first use and is then reused without allocating or clearing.
/// Movable.
template <class Real>
class Workspace {
 public:
  /// Empty.
  Workspace();
  ~Workspace();
  /// The other one is as new.
  Workspace(Workspace&&) noexcept;
  /// Likewise.
  Workspace& operator=(Workspace&&) noexcept;

  /// Bytes held.
  [[nodiscard]] std::size_t bytes() const;
  /// On surfaces solved by windows: whether those stay, for paths, after the next solve.
  void keep_windows(bool keep);

  ///@{
  /// For the library's own use.
  [[nodiscard]] detail::WorkspaceState<Real>& state();
  [[nodiscard]] const detail::WorkspaceState<Real>& state() const { return *state_; }
  ///@}

 private:
  std::unique_ptr<detail::WorkspaceState<Real>> state_;  // null: moved away
};

}  // namespace plexway
