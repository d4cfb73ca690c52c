#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <optional>
#include <thread>
#include <utility>

#include <plexway/error.hpp>
#include <plexway/solve/options.hpp>

namespace plexway::python {

namespace py = pybind11;

/// Runs the library's work without the interpreter's lock, and takes that lock now and then to see
/// whether somebody pressed Ctrl-C, and to tell the caller's function how much is done.
class Watch {
 public:
  /// `progress`: None, or called with the share that is done, 0 to 1; returning False ends the work
  /// with Cancelled.
  explicit Watch(py::object progress) : progress_(std::move(progress)) {}

  /// What the work calls, from any thread; false: stop. Other threads than the caller's are let
  /// through: signals are delivered to the main one.
  [[nodiscard]] bool tick(double share) {
    if (std::this_thread::get_id() != caller_) return true;
    const auto now = Clock::now();
    if (now - last_ < std::chrono::milliseconds(20)) return true;
    last_ = now;
    const py::gil_scoped_acquire lock;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      return progress_.is_none() || !progress_(share).is(py::bool_(false));
    } catch (py::error_already_set& error) {
      error_.emplace(std::move(error));
      return false;
    }
  }
  /// For options of a propagation.
  [[nodiscard]] std::function<bool(const Progress&)> of_propagation() {
    return [this](const Progress& progress) {
      return tick(progress.simplices == 0 ? 0
                                          : static_cast<double>(progress.reached) /
                                                static_cast<double>(progress.simplices));
    };
  }
  [[nodiscard]] std::function<bool(double)> of_share() {
    return [this](double share) { return tick(share); };
  }

  /// Does the work; an error of the interpreter that came up meanwhile is raised after it.
  template <class Work>
  auto run(const Work& work) {
    try {
      const py::gil_scoped_release free;
      return work();
    } catch (const Cancelled&) {
      if (error_) throw std::move(*error_);
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;

  py::object progress_;
  std::optional<py::error_already_set> error_;
  std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point last_ = Clock::now();
};

}  // namespace plexway::python
