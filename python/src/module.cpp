#include <nanobind/stl/string.h>

#include <string>

#include "base/data_folder.hpp"
#include "bindings.hpp"
#include "version.hpp"

namespace nb = nanobind;
using namespace avoidbench;

NB_MODULE(_core, m) {
  m.doc() = "The code of avoidbench that Python calls; use it through the package avoidbench.";
  m.attr("version") = kVersion;
  python::bind_errors(m);
  m.def(
      "set_program_file", [](const std::string& file) { set_program_file(file); }, nb::arg("file"),
      "Planners and data are looked for as the program `file` would.");
  python::bind_world(m);
  python::bind_env(m);
  python::bind_interpreter();
}
