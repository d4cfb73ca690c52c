#include <plexway/solve/workspace.hpp>

#include "labels/workspace_state.hpp"
#include "strings/flat/flat_strings.hpp"
#include "strings/mixed_strings.hpp"
#include "strings/solid_strings.hpp"

namespace plexway {
using namespace detail;

template <class Real>
Workspace<Real>::Workspace() : state_(std::make_unique<WorkspaceState<Real>>()) {}

template <class Real>
Workspace<Real>::~Workspace() = default;

template <class Real>
Workspace<Real>::Workspace(Workspace&&) noexcept = default;

template <class Real>
Workspace<Real>& Workspace<Real>::operator=(Workspace&&) noexcept = default;

template <class Real>
std::size_t Workspace<Real>::bytes() const {
  if (!state_) return 0;
  return state_->bytes() + (state_->strings ? state_->strings->bytes() : 0) +
         (state_->flat_strings ? state_->flat_strings->bytes() : 0) +
         (state_->media ? state_->media->bytes() : 0);
}

template <class Real>
void Workspace<Real>::keep_windows(bool keep) {
  state().windows.keep_windows(keep);
}

template <class Real>
WorkspaceState<Real>& Workspace<Real>::state() {
  if (!state_) state_ = std::make_unique<WorkspaceState<Real>>();
  return *state_;
}

template class Workspace<float>;
template class Workspace<double>;

}  // namespace plexway
