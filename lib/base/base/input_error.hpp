#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace avoidbench {

/// One thing wrong with what the user gave. `line` and `column` count from 1; 0 where the place is
/// not known.
struct InputProblem {
  std::string file;
  int line = 0;
  int column = 0;
  std::string message;
};

/// `file:line:column: message`, without the parts that are not known.
std::string text(const InputProblem& problem);

/// Bad input, with all the problems found at once. Caught once, in main, which prints each and
/// exits 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(InputProblem problem);
  explicit InputError(std::string message);
  explicit InputError(std::vector<InputProblem> problems);
  const std::vector<InputProblem>& problems() const { return problems_; }

 private:
  std::vector<InputProblem> problems_;
};

/// Throws InputError about a file as a whole.
[[noreturn]] void refuse_file(const std::filesystem::path& file, std::string message);

/// The candidate that `word` is most likely a misspelling of (edit distance, at most a third of its
/// length), or "".
std::string_view nearest_word(std::string_view word, std::span<const std::string> candidates);

/// ` (did you mean X?)` for the nearest candidate, or "" where none is near.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

}  // namespace avoidbench
