#include <pybind11/stl.h>

#include <atomic>
#include <string>

#include <plexway/error.hpp>

#include "arrays.hpp"
#include "domain.hpp"

namespace plexway::python {

AnyExecutor executor_of(const SolveArguments& arguments) {
  if (arguments.executor == "serial") return Serial{};
  if (arguments.executor == "openmp") return OpenMP{.threads = arguments.threads};
  if (arguments.executor == "gl") return GL{};
  throw py::value_error("executor '" + arguments.executor +
                        "': choose one of 'serial', 'openmp', 'gl'");
}

PropagateOptions options_of(const SolveArguments& arguments, Watch& watch) {
  PropagateOptions options;
  options.radius = arguments.radius;
  options.accuracy = arguments.accuracy;
  if (arguments.visibility == "centroid")
    options.visibility = Visibility::centroid;
  else if (arguments.visibility == "upper_bound")
    options.visibility = Visibility::upper_bound;
  else if (arguments.visibility != "saddles")
    throw py::value_error("visibility '" + arguments.visibility +
                          "': choose one of 'saddles', 'centroid', 'upper_bound'");
  options.progress = watch.of_propagation();
  return options;
}

namespace {

Accuracy accuracy_of(const py::object& accuracy) {
  if (accuracy.is_none()) return Accuracy::usual();
  if (py::isinstance<py::str>(accuracy)) {
    const auto name = accuracy.cast<std::string>();
    if (name == "fast") return Accuracy::fast();
    if (name == "accurate") return Accuracy::accurate();
    if (name == "exact") return Accuracy::exact();
  } else if (py::isinstance<py::float_>(accuracy) || py::isinstance<py::int_>(accuracy)) {
    const auto error = accuracy.cast<double>();
    if (!(error >= 0 && error < 1))
      throw py::value_error("accuracy: a mean relative error is at least 0 and below 1");
    return Accuracy(error);
  }
  throw py::value_error(
      "accuracy: choose one of 'fast', 'accurate', 'exact', or a mean relative error");
}

// The distances as the domain has them, without a copy.
py::array taken(AnyField& field) {
  return std::visit([](auto& f) -> py::array { return owned(std::move(f.distance)); }, field.data);
}

py::tuple solve(const Domain& domain, std::vector<Source> given, const SolveArguments& arguments,
                bool labels, bool errors, py::object progress) {
  const Sources sources(std::move(given));
  const AnyExecutor executor = executor_of(arguments);
  Watch watch(std::move(progress));
  const PropagateOptions options = options_of(arguments, watch);
  std::vector<Warning> told;
  AnyField field = watch.run([&] {
    const SourceList list = sources.list();
    const AnyDomain& any = domain.for_sources(executor, list, options);
    AnyField solved = any.solve(executor, list, options);
    told = field_warnings(any, solved, list, Reader::python);
    return solved;
  });
  py::object label = py::none();
  if (labels) label = owned(field.nearest());
  py::object error = py::none();
  if (errors) error = owned(field.error());
  py::array distance = taken(field);
  return py::make_tuple(std::move(distance), std::move(label), std::move(error), doubts_of(told));
}

// (how many fields have doubts, the first of these, its doubts)
template <class Real>
py::tuple each(const Domain& domain, const Sources& sources, const AnyExecutor& executor,
               const SolveArguments& arguments, py::array_t<Real>& out,
               const std::vector<Index>* columns, py::object progress) {
  auto rows = out.template mutable_unchecked<2>();
  const std::size_t width = columns != nullptr ? columns->size() : domain.any().vertices();
  Watch watch(std::move(progress));
  const SourceList list = sources.list();
  const double count = static_cast<double>(list.size());
  std::atomic<std::size_t> done{0};
  std::size_t doubtful = 0, first = sources.list().size();
  std::vector<Warning> told;  // of the first
  PropagateOptions options = options_of(arguments, watch);
  // The share that counts is that of the rows.
  options.progress = [&](const Progress&) {
    return watch.tick(static_cast<double>(done.load()) / count);
  };
  watch.run([&] {
    const AnyDomain& any = domain.for_sources(executor, list, options);
    any.solve_each(executor, list, options, [&](std::size_t k, const AnyField& field) {
      const auto row = static_cast<py::ssize_t>(k);
      std::visit(
          [&](const auto& f) {
            for (std::size_t c = 0; c < width; ++c)
              rows(row, static_cast<py::ssize_t>(c)) =
                  static_cast<Real>(f.distance[columns != nullptr ? (*columns)[c] : c]);
          },
          field.data);
      std::vector<Warning> own = field_warnings(any, field, list.only(k), Reader::python);
      doubtful += !own.empty();
      if (!own.empty() && k < first) {
        first = k;
        told = std::move(own);
      }
      if (!watch.tick(static_cast<double>(++done) / count))
        throw Cancelled("stopped by the progress function");
    });
  });
  return py::make_tuple(doubtful, first, doubts_of(told));
}

// Row k of `out`, (K, N) of float32 or float64 in any order of memory: the distances from source k
// to all vertices, or to the columns.
py::tuple solve_each(const Domain& domain, std::vector<Source> given,
                     const SolveArguments& arguments, py::array out, const py::object& wanted,
                     py::object progress) {
  std::vector<Index> columns;
  if (!wanted.is_none()) {
    columns = indices_of(wanted, "columns");
    for (const Index v : columns)
      if (v >= domain.any().vertices())
        throw UsageError("columns: vertex " + std::to_string(v) + ": there are " +
                         std::to_string(domain.any().vertices()) + ", counted from 0");
  }
  const std::vector<Index>* const to = wanted.is_none() ? nullptr : &columns;
  const Sources sources(std::move(given));
  const AnyExecutor executor = executor_of(arguments);
  if (py::isinstance<py::array_t<float>>(out)) {
    auto typed = py::reinterpret_borrow<py::array_t<float>>(out);
    return each(domain, sources, executor, arguments, typed, to, std::move(progress));
  }
  auto typed = py::reinterpret_borrow<py::array_t<double>>(out);
  return each(domain, sources, executor, arguments, typed, to, std::move(progress));
}

}  // namespace

void bind_solve(py::module_& module) {
  py::class_<SolveArguments>(module, "SolveArguments")
      .def(py::init([](std::string executor, int threads, double radius, std::string visibility,
                       const py::object& accuracy) {
        return SolveArguments{std::move(executor), threads, radius, std::move(visibility),
                              accuracy_of(accuracy)};
      }));
  module.def("solve", &solve);
  module.def("solve_each", &solve_each);
}

}  // namespace plexway::python
