// Preloaded into a program that runs in an emulator (emulated.sh): its workers, which it starts as
// programs, run in the emulator as well. On the processor itself they would prove nothing.
#include <dlfcn.h>
#include <spawn.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

extern "C" int posix_spawn(pid_t* id, const char* file, const posix_spawn_file_actions_t* actions,
                           const posix_spawnattr_t* attributes, char* const arguments[],
                           char* const environment[]) {
  static const auto spawn =
      reinterpret_cast<decltype(&posix_spawn)>(dlsym(RTLD_NEXT, "posix_spawn"));
  const char* const emulator = std::getenv("EMULATOR");
  if (emulator == nullptr) std::abort();
  std::istringstream text(emulator);
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  words.emplace_back(file);
  for (char* const* word = arguments + 1; *word != nullptr; ++word) words.emplace_back(*word);
  std::vector<char*> command;
  for (std::string& word : words) command.push_back(word.data());
  command.push_back(nullptr);
  return spawn(id, command[0], actions, attributes, command.data(), environment);
}
