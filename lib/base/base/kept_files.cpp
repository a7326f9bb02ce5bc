#include "base/kept_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "base/digest.hpp"
#include "base/input_error.hpp"
#include "base/input_file.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlanners = ".planners";
constexpr const char* kMaps = ".maps";
constexpr const char* kLibrary = ".so";
constexpr const char* kScript = ".py";
constexpr const char* kProgram = ".run";  // whatever it was called: to be executed

/// results/quick.db and .planners: results/quick.planners.
fs::path folder_beside(const fs::path& database, const char* ending) {
  fs::path folder = database;
  if (folder.extension() == ".db") folder.replace_extension();
  folder += ending;
  return folder;
}

/// False also where the file can't be read.
bool has_digest(const fs::path& file, const std::string& digest) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  try {
    return file_digest(file) == digest;
  } catch (const InputError&) {
    return false;
  }
}

/// Copies the file of this digest to `kept`; returns why it could not, or "".
std::string keep(const fs::path& file, const std::string& digest, const fs::path& kept) {
  constexpr std::uint64_t kMostBytes = 256U << 20U;
  // There already, and whole.
  if (has_digest(kept, digest)) return "";
  std::string bytes;
  try {
    bytes = read_input_file(file, kMostBytes);
  } catch (const InputError& error) {
    return error.what();
  }
  std::error_code error;
  fs::create_directories(kept.parent_path(), error);
  // Under a name of its own first: whoever looks sees all of the file or none, and two runs that
  // keep the same one do not meet.
  const fs::path written = kept.string() + "." + std::to_string(::getpid());
  std::ofstream stream(written, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  // What was read and written has to be the file that the sweep was read with.
  const bool is_whole = stream.good() && has_digest(written, digest);
  if (is_whole) fs::rename(written, kept, error);
  if (is_whole && !error) return "";
  fs::remove(written, error);
  return stream.good() ? file.string() + ": changed since the sweep was read"
                       : "can't write " + written.string();
}

/// DIGEST.ending in the folder beside the database, or in another database's; the former first.
std::optional<fs::path> find_kept(const fs::path& database, const char* kind,
                                  const std::string& digest, const std::string& ending) {
  if (database.empty() || digest.empty()) return std::nullopt;
  const fs::path own = folder_beside(database, kind);
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path parent = own.has_parent_path() ? own.parent_path() : fs::path(".");
  // Databases are renamed and merged: another one's folder may hold the file. The digest decides in
  // any case.
  for (const auto& entry : fs::directory_iterator(parent, error)) {
    if (entry.path().extension() == kind) folders.push_back(entry.path());
  }
  // Folders are listed in no particular order.
  std::sort(folders.begin(), folders.end());
  folders.insert(folders.begin(), own);
  for (const fs::path& folder : folders) {
    const fs::path file = folder / (digest + ending);
    if (has_digest(file, digest)) return file;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> keep_files(const std::vector<FlownFile>& files, const fs::path& database) {
  std::vector<std::string> problems;
  for (const FlownFile& flown : files) {
    const char* kind = flown.is_planner ? kPlanners : kMaps;
    const std::string own = fs::path(flown.file).extension().string();
    const std::string ending = !flown.is_planner   ? own
                               : !flown.is_program ? kLibrary
                               : own == kScript    ? kScript
                                                   : kProgram;
    const fs::path kept = folder_beside(database, kind) / (flown.digest + ending);
    const std::string problem = keep(flown.file, flown.digest, kept);
    std::error_code error;
    if (ending == kProgram) {
      // A new file has no right to be run, whatever the copied one had.
      fs::permissions(kept, fs::perms::owner_exec, fs::perm_options::add, error);
    }
    if (!problem.empty()) problems.push_back(problem);
  }
  return problems;
}

std::optional<fs::path> kept_planner(const fs::path& database, const std::string& digest) {
  for (const char* ending : {kLibrary, kScript, kProgram}) {
    if (auto file = find_kept(database, kPlanners, digest, ending)) return file;
  }
  return std::nullopt;
}

std::optional<fs::path> kept_map(const fs::path& database, const std::string& digest,
                                 const std::string& name) {
  return find_kept(database, kMaps, digest, fs::path(name).extension().string());
}

std::vector<std::string> merge_kept_files(const fs::path& into, const fs::path& from) {
  std::vector<std::string> problems;
  for (const char* kind : {kPlanners, kMaps}) {
    std::error_code error;
    const fs::path target = folder_beside(into, kind);
    for (const auto& entry : fs::directory_iterator(folder_beside(from, kind), error)) {
      const std::string digest = entry.path().stem().string();
      // Names are not trusted: only files whose digest is their name are copied.
      if (!has_digest(entry.path(), digest)) continue;
      const std::string problem = keep(entry.path(), digest, target / entry.path().filename());
      if (!problem.empty()) problems.push_back(problem);
    }
  }
  return problems;
}

}  // namespace avoidbench
