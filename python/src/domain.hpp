#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/shape/warnings.hpp>

#include "watch.hpp"

namespace plexway::python {

/// What Python's domains stand on: a domain, and what it was built with.
class Domain {
 public:
  Domain(AnyShape shape, BuildOptions options);

  [[nodiscard]] const AnyDomain& any() const { return any_; }
  [[nodiscard]] const AnyShape& shape() const { return any_.shape(); }
  [[nodiscard]] const BuildOptions& options() const { return options_; }
  /// What a mask leaves of the shape; all of it without one. Its simplices have numbers of their
  /// own, `inside`; what Python sees are those of the shape, `outside`.
  [[nodiscard]] const AnyShape& open() const { return open_; }
  [[nodiscard]] PointSource inside(const PointSource& point) const;
  [[nodiscard]] PointSource outside(const PointSource& point) const;
  [[nodiscard]] std::vector<PointSource> outside(std::vector<PointSource> points) const;
  /// The domain that takes these sources and options: where they need double precision, and this
  /// has single, another one, built when it is first needed and then kept.
  [[nodiscard]] const AnyDomain& for_sources(const AnyExecutor& executor, const SourceList& sources,
                                             const PropagateOptions& options) const;
  /// The whole boundary: of a solid its faces, or their vertices alone where a metric measures.
  [[nodiscard]] Source boundary(double offset) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  AnyDomain any_;
  BuildOptions options_;
  AnyShape open_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<const AnyDomain> twice_;
};

/// How to solve, as Python names it.
struct SolveArguments {
  std::string executor = "serial";
  int threads = 0;
  double radius = std::numeric_limits<double>::infinity();
  std::string visibility = "saddles";
  Accuracy accuracy = Accuracy::usual();
};
[[nodiscard]] AnyExecutor executor_of(const SolveArguments& arguments);
[[nodiscard]] PropagateOptions options_of(const SolveArguments& arguments, Watch& watch);

/// The same sources, as points alone where they are.
class Sources {
 public:
  explicit Sources(std::vector<Source> sources);
  [[nodiscard]] SourceList list() const {
    return points_.empty() ? SourceList(sources_) : SourceList(points_);
  }
  /// UsageError unless all are points where the purpose needs them.
  [[nodiscard]] std::span<const PointSource> points(Purpose purpose) const;

 private:
  std::vector<Source> sources_;
  std::vector<PointSource> points_;
};

///@{
/// Texts of warnings, and of those alone that say distances may be wrong: what Python warns of.
[[nodiscard]] pybind11::tuple texts_of(const std::vector<Warning>& warnings);
[[nodiscard]] pybind11::tuple doubts_of(const std::vector<Warning>& warnings);
///@}

void bind_sources(pybind11::module_& module);
void bind_domain(pybind11::module_& module);
void bind_build(pybind11::module_& module);
void bind_solve(pybind11::module_& module);
void bind_paths(pybind11::module_& module);
void bind_sampling(pybind11::module_& module);
void bind_pairs(pybind11::module_& module);
void bind_picture(pybind11::module_& module);

}  // namespace plexway::python
