#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

/// Every file that a user names to be written goes through these, except databases themselves.
namespace avoidbench {

/// A file's name made of a text that a database or a sweep gives: the text itself where it is a
/// plain name of A-Z a-z 0-9 _ . -, at most 100 letters long, that begins with neither . nor -.
/// Else other letters become _, and the text's digest follows, so that two texts do not share a
/// file. Never a path, hidden, or an option. scripts/plot/paper_figures.py does the same.
std::string safe_file_name(std::string_view text);

/// Throws InputError where the file can't be written: it is a folder, its folder is not there or
/// can't be written, or it is a database, which holds results and is never written over. For before
/// a flight or other work that takes its time. Makes no file.
void check_output_file(const std::filesystem::path& file);

/// Opens the file to be written from its beginning on. Throws InputError as check_output_file().
std::ofstream open_output(const std::filesystem::path& file);

/// Throws InputError where not all that was written has reached the file: only closing writes what
/// is still in the buffer.
void close_output(std::ofstream& stream, const std::filesystem::path& file);

/// A large file that is there only once it is whole: it is written beside its place, as FILE.part,
/// and moved there at the end. Whoever looks sees the former file, or all of the new one.
class WholeFile {
 public:
  /// Throws InputError as check_output_file().
  explicit WholeFile(std::filesystem::path file);
  /// Removes what is not finished.
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// Forgets what was written.
  void restart();
  std::ofstream& stream() { return stream_; }
  /// Throws InputError where not all could be written so far.
  void check() const;
  /// Puts it in its place. Throws InputError as close_output().
  void finish();

 private:
  std::filesystem::path file_, part_;
  std::ofstream stream_;
};

}  // namespace avoidbench
