#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/solve/distance_field.hpp>

#include <plexway/shape/complex.hpp>
#include "tool/options/input.hpp"
#include "tool/options/picture_options.hpp"
#include "tool/options/solve_options.hpp"
#include "tool/report/summary.hpp"

namespace plexway::detail::cli {
/// What the commands that choose points have in common, as typed.
struct SamplingCommand : InputCommand {
  std::string out;
  std::string precision = "float";
  bool precision_given = false;
  PictureArguments picture;
};

/// What a command did with its time: all of it, part after part.
class Phases {
 public:
  /// A part ends, which began where the one before ended.
  void end(std::string name) {
    const double now = watch_.seconds();
    parts_.emplace_back(std::move(name), now - before_);
    before_ = now;
  }
  void tell(Summary& summary) const {
    for (const auto& [name, seconds] : parts_) summary.took(name, seconds);
  }

 private:
  Stopwatch watch_;
  double before_ = 0;
  std::vector<std::pair<std::string, double>> parts_;
};

inline constexpr const char* output_help = "; - for CSV on standard output";

/// Adds INPUT, --out (which it describes), --as and so on.
void add_sampling_options(CLI::App& app, SamplingCommand& command, const char* out_help);

/// Throws UsageError where the precision does not exist.
Precision precision_of(const SamplingCommand& command);

/// Before any work: throws as check_output_name, check_picture and check_outputs_differ.
void check_outputs(const SamplingCommand& command, const std::string& other = "",
                   const std::string& third = "");

/// Draws the points and this, if a picture is wanted.
void draw_points(const SamplingCommand& command, const Domain& domain,
                 std::span<const PointSource> points, SceneContent content);

/// Points of a shape as its complex has them, where simplices have a corner twice or vertices are
/// merged, and back.
class SampledNumbers {
 public:
  explicit SampledNumbers(const OpenSimplices* open) : open_(open) {}

  [[nodiscard]] std::vector<PointSource> inside(std::vector<PointSource> points) const {
    if (open_ != nullptr)
      for (PointSource& point : points) point = open_->inside(point);
    return points;
  }
  void outside(std::vector<PointSource>& points) const {
    if (open_ != nullptr)
      for (PointSource& point : points) point = open_->outside(point);
  }
  template <class Value>
  void spread(std::vector<Value>& of_vertices) const {
    if (open_ != nullptr) open_->spread(of_vertices);
  }

 private:
  const OpenSimplices* open_;
};

/// Calls `use(complex, numbers)` on the domain's own triangles, as plexway::with_sampled. Returns
/// what is to be told of it.
template <class Use>
Notes with_sampled(const Domain& domain, Precision precision, const Use& use) {
  support(Purpose::samples, domain.kind()).require();
  const AnyDomain built(domain, {.precision = precision, .triangulation = Triangulation::input});
  const SampledNumbers numbers(built.open_simplices());
  plexway::with_sampled(built, [&](const auto& complex) { use(complex, numbers); });
  Notes notes;
  notes.add(domain_warnings(built, Reader::tool));
  return notes;
}

/// A note about the parts of the domain in which none of the points lies, if there are any.
void add_parts_without(Notes& notes, const Domain& domain, std::span<const PointSource> points,
                       std::string_view plural);

/// The summary of so many points, by this name.
[[nodiscard]] Summary points_summary(const SamplingCommand& command, const Domain& domain,
                                     const std::string& name, std::size_t points,
                                     const std::string& more = "");

/// Adds the work and the time, prints it, and says the notes.
void finish(Summary& summary, const SamplingCommand& command, const PropagateStatistics& work,
            const Phases& phases, const Notes& notes);

}  // namespace plexway::detail::cli
