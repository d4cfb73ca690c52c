#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <plexway/common/ids.hpp>

/// NumPy arrays in and out. What is wrong with an array is told by the name of the argument that it
/// came as: TypeError for a type, ValueError for a shape and for numbers.
namespace plexway::python {

namespace py = pybind11;

/// n rows of 2 or 3 coordinates of any number type, in any order of memory; a third that is missing
/// is 0. float64 and float32 are read where they lie.
[[nodiscard]] std::vector<std::array<double, 3>> points_of(const py::handle& array,
                                                           const char* name);
/// Numbers in one row, or in rows one after the other: all that an array has.
[[nodiscard]] std::vector<double> numbers_of(const py::handle& array, const char* name);
/// Rows of `columns` vertices of any integer type, each from 0 to below `none`, one row after the
/// other; `columns` 0: a single row.
[[nodiscard]] std::vector<Index> indices_of(const py::handle& array, const char* name,
                                            std::size_t columns = 0);

/// The same as rows.
template <std::size_t N>
[[nodiscard]] std::vector<std::array<Index, N>> index_rows_of(const py::handle& array,
                                                              const char* name);
template <std::size_t N>
[[nodiscard]] std::vector<std::array<double, N>> number_rows_of(const py::handle& array,
                                                                const char* name);

/// An array that owns the vector: nothing is copied.
template <class T>
[[nodiscard]] py::array_t<T> owned(std::vector<T> values) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const auto size = static_cast<py::ssize_t>(kept->size());
  T* const data = kept->data();
  const py::capsule owner(kept.release(),
                          [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return py::array_t<T>(size, data, owner);
}
template <class T, std::size_t N>
[[nodiscard]] py::array_t<T> owned(std::vector<std::array<T, N>> values) {
  auto kept = std::make_unique<std::vector<std::array<T, N>>>(std::move(values));
  const auto size = static_cast<py::ssize_t>(kept->size());
  T* const data = reinterpret_cast<T*>(kept->data());
  const py::capsule owner(kept.release(), [](void* vector) {
    delete static_cast<std::vector<std::array<T, N>>*>(vector);
  });
  return py::array_t<T>({size, static_cast<py::ssize_t>(N)}, data, owner);
}

/// An array that looks at rows which `owner` keeps alive; nobody may write to it.
template <class T, std::size_t N>
[[nodiscard]] py::array_t<T> view(const std::array<T, N>* rows, std::size_t count,
                                  const py::object& owner) {
  py::array_t<T> array({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(N)},
                       reinterpret_cast<const T*>(rows), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}
template <class T>
[[nodiscard]] py::array_t<T> view(const T* values, std::size_t rows, std::size_t columns,
                                  const py::object& owner) {
  py::array_t<T> array({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)}, values,
                       owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace plexway::python
