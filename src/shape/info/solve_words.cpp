#include "shape/info/solve_words.hpp"

#include <array>
#include <variant>

namespace plexway {

std::string_view executor_name(const AnyExecutor& executor) {
  constexpr std::array<std::string_view, 3> names = {"serial", "openmp", "gl"};
  return names[executor.index()];
}

std::size_t executor_threads(const AnyExecutor& executor) {
  const OpenMP* const team = std::get_if<OpenMP>(&executor);
  return team == nullptr ? 1 : team_size(*team);
}

std::string describe(const AnyExecutor& executor) {
  const std::size_t threads = executor_threads(executor);
  return std::string(executor_name(executor)) +
         (threads > 1 ? " with " + counted(threads, "threads") : "");
}

std::vector<std::string_view> built_executors() {
  std::vector<std::string_view> built = {"serial"};
  if (openmp_built()) built.push_back("openmp");
#ifdef PLEXWAY_HAS_GL
  built.push_back("gl");
#endif
  return built;
}

bool has_accuracies(DomainKind kind) {
  return static_cast<bool>(support_of_accuracy(
      {.executor = ExecutorKind::serial,
       .domain = kind,
       .dimension = 2,
       .single_precision = true,
       .metric = kind == DomainKind::solid ? MetricKind::embedded : MetricKind::intrinsic}));
}

Json json_of(Accuracy accuracy) {
  if (accuracy == Accuracy::accurate()) return "accurate";
  switch (accuracy.kind()) {
    case Accuracy::Kind::fast:
      return "fast";
    case Accuracy::Kind::exact:
      return "exact";
    default:
      return accuracy.error();
  }
}

std::string name_of(Accuracy accuracy) {
  const Json json = json_of(accuracy);
  return json.is_string() ? json.get<std::string>() : short_number(json.get<double>());
}

void add_accuracy(DomainKind kind, Accuracy accuracy, const PropagateStatistics& statistics,
                  Json& json) {
  if (!has_accuracies(kind)) return;
  json["accuracy"] = json_of(accuracy);
  if (statistics.windows_gave_up > 0) json["windows_gave_up"] = statistics.windows_gave_up;
}

}  // namespace plexway
