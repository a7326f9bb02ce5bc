#include "plots.hpp"

#include "base/data_folder.hpp"
#include "base/input_error.hpp"
#include "process/program.hpp"

namespace avoidbench {

void draw_plots(const std::vector<std::string>& databases, const std::string& sweep,
                const std::filesystem::path& folder) {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::string> command = {python_with({"matplotlib", "pandas"}, "figures need"),
                                      (data_folder() / "scripts/plot/paper_figures.py").string(),
                                      "--program",
                                      program.string(),
                                      "--output",
                                      folder.string()};
  if (!sweep.empty()) command.insert(command.end(), {"--sweep", sweep});
  command.emplace_back("--");
  command.insert(command.end(), databases.begin(), databases.end());
  if (run_program(command, Standard::shown).code != 0) {
    throw InputError("figures could not be drawn: see above");
  }
}

}  // namespace avoidbench
