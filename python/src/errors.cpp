#include <exception>
#include <string>

#include "base/input_error.hpp"
#include "bindings.hpp"

namespace nb = nanobind;

namespace avoidbench::python {
namespace {

/// Names of files may be no UTF-8: such bytes are shown as `\xff`.
nb::object python_text(const std::string& text) {
  const auto size = static_cast<Py_ssize_t>(text.size());
  return nb::steal(PyUnicode_DecodeUTF8(text.data(), size, "backslashreplace"));
}

void raise_input_error(const std::exception_ptr& thrown, void* type) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    PyErr_SetObject(static_cast<PyObject*>(type), python_text(error.what()).ptr());
  }
}

}  // namespace

void bind_errors(nb::module_& m) {
  const std::string name = nb::cast<std::string>(m.attr("__name__")) + ".InputError";
  PyObject* type = PyErr_NewExceptionWithDoc(
      name.c_str(),
      "What was given is wrong: a file, a field's name, a value. The text has one line for each "
      "problem, as the program prints it: `file:line:column: message`.",
      PyExc_ValueError, nullptr);
  if (type == nullptr) throw nb::python_error();
  m.attr("InputError") = nb::borrow(type);
  // The translator holds on to the type for as long as the process lives.
  nb::register_exception_translator(&raise_input_error, type);
}

}  // namespace avoidbench::python
