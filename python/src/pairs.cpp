#include <pybind11/stl.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <plexway/any/complex.hpp>
#include <plexway/apps/all_pairs.hpp>
#include <plexway/error.hpp>

#include "arrays.hpp"
#include "domain.hpp"

namespace plexway::python {
namespace {

template <class Run>
void by(const AnyExecutor& executor, const Run& run) {
  if (const auto* team = std::get_if<OpenMP>(&executor))
    run(*team);
  else if (std::holds_alternative<Serial>(executor))
    run(Serial{});
  else
    throw UsageError("pairs are for the executors serial and openmp");
}

// Rows of few entries, as scipy.sparse.csr_matrix takes them: (data, columns, starts).
py::tuple near(const Domain& domain, std::vector<Source> given, const py::object& columns,
               double radius, const py::object& nearest, const SolveArguments& arguments,
               py::object progress) {
  if (domain.shape().kind() == DomainKind::mixed)  // its complexes have numbers of their own
    throw UsageError("sparse rows are for domains of one kind: ask a mixed one for `distances`");
  const Sources sources(std::move(given));
  const AnyExecutor executor = executor_of(arguments);
  std::vector<Index> wanted;
  if (!columns.is_none()) wanted = indices_of(columns, "columns");
  NearLimits limits;
  limits.radius = radius;
  if (!nearest.is_none()) limits.nearest = nearest.cast<std::size_t>();
  Watch watch(std::move(progress));
  PairsRequest request;
  request.rows.emplace(sources.list());
  request.columns = wanted;
  request.solve = options_of(arguments, watch);
  request.solve.progress = [&](const Progress&) { return watch.tick(0); };
  request.progress = [&](const PairsProgress& at) {
    return watch.tick(static_cast<double>(at.rows_done) / static_cast<double>(at.rows));
  };
  std::vector<std::vector<std::pair<Index, double>>> rows(sources.list().size());
  watch.run([&] {
    by(executor, [&](const auto& by_whom) {
      with_complex(domain.any(), [&](const auto& complex) {
        using Real = RealOf<std::decay_t<decltype(complex)>>;
        (void)near_pairs(by_whom, complex, request, limits,
                         {.row = [&](std::size_t row, SparseRow<Real> content) {
                           for (const NearEntry<Real>& entry : content)
                             rows[row].emplace_back(entry.column,
                                                    static_cast<double>(entry.distance));
                         }});
      });
    });
  });
  std::vector<double> data;
  std::vector<std::int64_t> indices, starts = {0};
  for (const auto& row : rows) {
    for (const auto& [column, distance] : row) {
      indices.push_back(column);
      data.push_back(distance);
    }
    starts.push_back(static_cast<std::int64_t>(indices.size()));
  }
  return py::make_tuple(owned(std::move(data)), owned(std::move(indices)),
                        owned(std::move(starts)));
}

}  // namespace

void bind_pairs(py::module_& module) { module.def("near", &near); }

}  // namespace plexway::python
