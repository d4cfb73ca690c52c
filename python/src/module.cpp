#include <pybind11/pybind11.h>

#include <plexway/error.hpp>
#include <plexway/executors.hpp>
#include <plexway/version.hpp>

#include "domain.hpp"

namespace plexway::python {
namespace {

// The exceptions of the package, one for each of the library's. They live as long as the process.
struct Exceptions {
  PyObject *error, *input, *precision, *usage, *not_built, *endless, *cancelled;
};
Exceptions exceptions;

PyObject* make(py::module_& module, const char* name, const char* text, const py::tuple& bases) {
  const std::string full = std::string("plexway.") + name;
  PyObject* const made = PyErr_NewExceptionWithDoc(full.c_str(), text, bases.ptr(), nullptr);
  if (made == nullptr) throw py::error_already_set();
  module.attr(name) = py::reinterpret_borrow<py::object>(made);
  return made;
}

void bind_exceptions(py::module_& module) {
  const auto of = [](PyObject* first, PyObject* second = nullptr) {
    const auto one = py::reinterpret_borrow<py::object>(first);
    return second == nullptr ? py::make_tuple(one)
                             : py::make_tuple(one, py::reinterpret_borrow<py::object>(second));
  };
  Exceptions& e = exceptions;
  e.error = make(module, "Error", "Base of everything that plexway raises on purpose.",
                 of(PyExc_Exception));
  e.input = make(module, "InputError", "A file or an array is not what it must be.",
                 of(e.error, PyExc_ValueError));
  e.precision = make(module, "PrecisionError",
                     "Sizes that single precision cannot hold beside each other: build the domain "
                     "with precision='double'.",
                     of(e.input));
  e.usage = make(module, "UsageError", "A call asks for something that makes no sense.",
                 of(e.error, PyExc_ValueError));
  e.not_built = make(module, "NotBuilt", "The feature exists, but not in this build or here.",
                     of(e.error, PyExc_RuntimeError));
  e.endless = make(module, "EndlessError",
                   "A solve that does not end, because lengths are no metric, was stopped.",
                   of(e.error, PyExc_ArithmeticError));
  e.cancelled = make(module, "Cancelled", "A progress function returned False.", of(e.error));

  py::register_exception_translator([](std::exception_ptr thrown) {
    const auto raise = [](PyObject* type, const std::exception& error) {
      PyErr_SetString(type, error.what());
    };
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const PrecisionError& error) {
      raise(exceptions.precision, error);
    } catch (const InputError& error) {
      raise(exceptions.input, error);
    } catch (const UsageError& error) {
      raise(exceptions.usage, error);
    } catch (const NotBuiltError& error) {
      raise(exceptions.not_built, error);
    } catch (const EndlessError& error) {
      raise(exceptions.endless, error);
    } catch (const Cancelled& error) {
      raise(exceptions.cancelled, error);
    } catch (const Error& error) {
      raise(exceptions.error, error);
    }
  });
}

}  // namespace
}  // namespace plexway::python

PYBIND11_MODULE(_plexway, module) {
  using namespace plexway::python;
  module.doc() = "What the package plexway stands on; use that.";
  module.attr("__version__") = plexway::version_string;
  module.def("openmp_built", &plexway::openmp_built);
  bind_exceptions(module);
  bind_sources(module);
  bind_domain(module);
  bind_build(module);
  bind_solve(module);
  bind_paths(module);
  bind_sampling(module);
  bind_pairs(module);
  bind_picture(module);
}
