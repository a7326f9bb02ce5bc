#include <nanobind/stl/filesystem.h>

#include "base/data_folder.hpp"
#include "bindings.hpp"

namespace nb = nanobind;
using namespace avoidbench;

NB_MODULE(_core, m) {
  m.doc() = "The code of avoidbench that Python calls; use it through the package avoidbench.";
  python::bind_errors(m);
  m.def("set_program_file", &set_program_file, nb::arg("file"),
        "Planners and data are looked for as the program `file` would.");
  python::bind_world(m);
}
