#include "arrays.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace plexway::python {
namespace {

std::string shape_text(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

py::array as_array(const py::handle& object, const char* name) {
  py::array array = py::array::ensure(object);
  if (!array) {
    PyErr_Clear();
    throw py::type_error(std::string(name) + ": expected an array of numbers");
  }
  return array;
}

// Real numbers, and no truth values or complex ones.
py::array as_numbers(const py::handle& object, const char* name) {
  py::array array = as_array(object, name);
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    throw py::type_error(std::string(name) + ": expected numbers, got dtype " +
                         py::str(array.dtype()).cast<std::string>());
  return array;
}

// Calls use(typed) with the array as float32 where it is of that type, else as float64, converted
// if it must be.
template <class Use>
void with_numbers(const py::array& array, const Use& use) {
  if (py::isinstance<py::array_t<float>>(array))
    use(py::reinterpret_borrow<py::array_t<float>>(array));
  else
    use(py::array_t<double, py::array::forcecast>(array));
}

// Calls use(typed) with an array of integers as it lies where it is of a usual type, else
// converted.
template <class Use>
void with_integers(const py::array& array, const Use& use) {
  if (py::isinstance<py::array_t<std::int64_t>>(array))
    use(py::reinterpret_borrow<py::array_t<std::int64_t>>(array));
  else if (py::isinstance<py::array_t<std::int32_t>>(array))
    use(py::reinterpret_borrow<py::array_t<std::int32_t>>(array));
  else if (py::isinstance<py::array_t<std::uint32_t>>(array))
    use(py::reinterpret_borrow<py::array_t<std::uint32_t>>(array));
  else if (array.dtype().kind() == 'u')
    use(py::array_t<std::uint64_t, py::array::forcecast>(array));
  else
    use(py::array_t<std::int64_t, py::array::forcecast>(array));
}

// Rows of integers, checked by type and shape; `columns` 0: a single row.
py::array as_integers(const py::handle& object, const char* name, std::size_t columns) {
  py::array array = as_array(object, name);
  if (array.size() == 0 && array.ndim() == (columns == 0 ? 1 : 2)) return array;
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u')
    throw py::type_error(std::string(name) + ": expected integers, got dtype " +
                         py::str(array.dtype()).cast<std::string>());
  const auto wanted = static_cast<py::ssize_t>(columns);
  if (columns == 0 ? array.ndim() != 1 : array.ndim() != 2 || array.shape(1) != wanted)
    throw py::value_error(std::string(name) + ": expected a shape " +
                          (columns == 0 ? "(n,)" : "(n, " + std::to_string(columns) + ")") +
                          ", got " + shape_text(array));
  return array;
}

// All of the array, row after row, into `to`.
void take_indices(const py::array& array, py::ssize_t columns, const char* name, Index* to) {
  with_integers(array, [&](const auto& typed) {
    const py::ssize_t count = typed.size();
    const auto take = [&](const auto& at) {
      bool good = true;
      for (py::ssize_t i = 0; i < count; ++i) {
        const auto value = at(i);
        good &= value >= 0 && static_cast<std::uint64_t>(value) < none;
        to[i] = static_cast<Index>(value);
      }
      for (py::ssize_t i = 0; !good && i < count; ++i)
        if (at(i) < 0 || static_cast<std::uint64_t>(at(i)) >= none)
          throw py::value_error(std::string(name) + ": row " + std::to_string(i / columns) +
                                " has " + std::to_string(at(i)) +
                                ", which is no number of a vertex");
    };
    if ((typed.flags() & py::array::c_style) != 0)
      take([data = typed.data()](py::ssize_t i) { return data[i]; });
    else if (typed.ndim() == 1)
      take([&](py::ssize_t i) { return typed.at(i); });
    else
      take([&](py::ssize_t i) { return typed.at(i / columns, i % columns); });
  });
}

}  // namespace

std::vector<std::array<double, 3>> points_of(const py::handle& object, const char* name) {
  const py::array array = as_numbers(object, name);
  if (array.ndim() != 2 || (array.shape(1) != 2 && array.shape(1) != 3))
    throw py::value_error(std::string(name) + ": expected a shape (n, 3) or (n, 2), got " +
                          shape_text(array));
  std::vector<std::array<double, 3>> points(static_cast<std::size_t>(array.shape(0)));
  const bool flat = array.shape(1) == 2;
  with_numbers(array, [&](const auto& typed) {
    const bool rows = (typed.flags() & py::array::c_style) != 0;
    if (rows && !flat && typed.itemsize() == sizeof(double)) {
      std::memcpy(points.data(), typed.data(), points.size() * sizeof points[0]);
      return;
    }
    const auto values = typed.template unchecked<2>();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto row = static_cast<py::ssize_t>(i);
      points[i] = {static_cast<double>(values(row, 0)), static_cast<double>(values(row, 1)),
                   flat ? 0.0 : static_cast<double>(values(row, 2))};
    }
  });
  return points;
}

std::vector<double> numbers_of(const py::handle& object, const char* name) {
  const py::array_t<double, py::array::c_style | py::array::forcecast> array(
      as_numbers(object, name));
  return {array.data(), array.data() + array.size()};
}

std::vector<Index> indices_of(const py::handle& object, const char* name, std::size_t columns) {
  const py::array array = as_integers(object, name, columns);
  std::vector<Index> indices(static_cast<std::size_t>(array.size()));
  if (!indices.empty())
    take_indices(array, static_cast<py::ssize_t>(std::max<std::size_t>(columns, 1)), name,
                 indices.data());
  return indices;
}

template <std::size_t N>
std::vector<std::array<Index, N>> index_rows_of(const py::handle& object, const char* name) {
  const py::array array = as_integers(object, name, N);
  std::vector<std::array<Index, N>> rows(static_cast<std::size_t>(array.size()) / N);
  if (!rows.empty()) take_indices(array, static_cast<py::ssize_t>(N), name, rows.front().data());
  return rows;
}

template <std::size_t N>
std::vector<std::array<double, N>> number_rows_of(const py::handle& object, const char* name) {
  const py::array array = as_numbers(object, name);
  if (array.ndim() != 2 || array.shape(1) != static_cast<py::ssize_t>(N))
    throw py::value_error(std::string(name) + ": expected a shape (n, " + std::to_string(N) +
                          "), got " + shape_text(array));
  const std::vector<double> numbers = numbers_of(array, name);
  std::vector<std::array<double, N>> rows(numbers.size() / N);
  if (!rows.empty()) std::memcpy(rows.data(), numbers.data(), numbers.size() * sizeof(double));
  return rows;
}

template std::vector<std::array<Index, 2>> index_rows_of<2>(const py::handle&, const char*);
template std::vector<std::array<Index, 3>> index_rows_of<3>(const py::handle&, const char*);
template std::vector<std::array<Index, 4>> index_rows_of<4>(const py::handle&, const char*);
template std::vector<std::array<double, 3>> number_rows_of<3>(const py::handle&, const char*);
template std::vector<std::array<double, 6>> number_rows_of<6>(const py::handle&, const char*);

}  // namespace plexway::python
