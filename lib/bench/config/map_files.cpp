#include "config/map_files.hpp"

#include "base/digest.hpp"
#include "config/sweep_axes.hpp"
#include "config/sweep_keys.hpp"
#include "wind/wind_field.hpp"
#include "yaml/includes.hpp"

namespace avoidbench {
namespace {

namespace fs = std::filesystem;

/// A field that names a file, as a sweep file has it; an empty name is no file.
struct FileField {
  std::string path;
  std::string* file = nullptr;
  std::string* digest = nullptr;  ///< of `path`_digest; null if there is none
};

/// Also where it is wrong, after its problem was added: messages that follow then name the file.
std::string absolute(const FileField& field, const std::string& file, Reading& reading) {
  if (file.empty()) return file;
  const GivenValue given = reading.at(field.path);
  // Relative to the file that says it, which may be an included one.
  const fs::path found = fs::absolute(folder_of(given.node, ".") / file).lexically_normal();
  std::error_code error;
  if (!fs::exists(found, error)) {
    given.add_problem("no file " + found.string());
  } else if (!fs::is_regular_file(found, error)) {
    given.add_problem("is not a regular file: " + found.string());
  }
  return found.string();
}

/// A digest that the sweep's file gives itself has to be the file's.
void fill_digest(const FileField& field, Reading& reading) {
  try {
    const std::string digest = file_digest(*field.file);
    if (field.digest->empty()) *field.digest = digest;
    if (*field.digest == digest) return;
    reading.at(field.path + "_digest").add_problem("is not that of " + *field.file + ", " + digest);
  } catch (const InputError& error) {
    reading.at(field.path).add_problems(error);
  }
}

/// The file may be an axis: then each of its values is one.
void resolve(const FileField& field, SweepSpec& sweep, Reading& reading) {
  const std::string path = trial_path(field.path);
  const std::size_t before = reading.problems.size();
  for_each_value(sweep, path, *field.file,
                 [&](std::string& file) { file = absolute(field, file, reading); });
  if (reading.problems.size() > before || field.digest == nullptr) return;
  const bool is_axis = axis_of(sweep, path) != nullptr;
  // One file's digest is computed here, once; those of an axis when trials are made.
  if (!is_axis && !field.file->empty()) fill_digest(field, reading);
  if (!is_axis || field.digest->empty()) return;
  reading.at(field.path + "_digest").add_problem("can't be that of several files");
}

/// Reads each wind field once to see that it is one.
void check_wind_fields(const FileField& field, SweepSpec& sweep, Reading& reading) {
  for_each_value(sweep, field.path, *field.file, [&](const std::string& file) {
    try {
      if (!file.empty()) read_wind_field(file, "");
    } catch (const InputError& error) {
      reading.at(field.path).add_problems(error);
    }
  });
}

}  // namespace

void resolve_files(SweepSpec& sweep, Reading& reading) {
  const FileOfMap map = file_of(sweep.base.map);
  if (map.file != nullptr && !map.file->empty()) {
    if (axis_of(sweep, "map_seed") != nullptr) {
      reading.at("maps.seeds")
          .add_problem("a map from a file is the same for every seed; leave one");
    }
    resolve({"maps.file", map.file, map.digest}, sweep, reading);
  }
  WindFieldSpec& wind = sweep.base.wind.field;
  const FileField wind_field{"wind.field.file", &wind.file, &wind.file_digest};
  // Only files that are there are read.
  const std::size_t before = reading.problems.size();
  resolve(wind_field, sweep, reading);
  if (reading.problems.size() == before) check_wind_fields(wind_field, sweep, reading);
  resolve({"latency.database", &sweep.base.latency.database, nullptr}, sweep, reading);
}

}  // namespace avoidbench
