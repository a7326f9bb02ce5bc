#include "film_output.hpp"

#include <unistd.h>

#include <filesystem>
#include <iostream>

#include "base/input_error.hpp"
#include "output.hpp"
#include "process/fed_program.hpp"
#include "text/number_text.hpp"

namespace avoidbench {
namespace {

std::string ending_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  return ending.empty() ? "" : ending.substr(1);
}

/// How ffmpeg makes such a file of raw frames.
std::vector<std::string> coding_of(const std::string& ending) {
  if (ending == "mp4") {
    return {"-c:v", "libx264",  "-preset", "veryfast",  "-crf",
            "21",   "-pix_fmt", "yuv420p", "-movflags", "+faststart"};
  }
  if (ending == "webm") {
    return {"-c:v",     "libvpx-vp9", "-b:v", "0",       "-crf", "33",       "-deadline",
            "realtime", "-cpu-used",  "6",    "-row-mt", "1",    "-pix_fmt", "yuv420p"};
  }
  // A palette of its own: the usual one is far from these colours.
  return {"-vf",
          "fps=12,scale=800:-1:flags=lanczos,split[a][b];[a]palettegen=stats_mode=diff[p];"
          "[b][p]paletteuse=dither=bayer:bayer_scale=4",
          "-loop", "0"};
}

/// On a terminal one line that counts; elsewhere a line every tenth.
void tell(std::size_t done, std::size_t count) {
  static const bool is_terminal = ::isatty(STDERR_FILENO) != 0;
  if (is_terminal) {
    std::cerr << "\rframe " << done << " of " << count << (done == count ? "\n" : "") << std::flush;
  } else if (done * 10 / count != (done - 1) * 10 / count) {
    std::cerr << "frame " << done << " of " << count << '\n';
  }
}

}  // namespace

void check_film(const std::string& file) {
  const std::string ending = ending_of(file);
  if (ending != "mp4" && ending != "webm" && ending != "gif") {
    throw InputError({.file = file, .message = "--video writes .mp4, .webm or .gif"});
  }
  check_output(file, ending);
  if (found_program("ffmpeg").empty()) {
    throw InputError(
        "--video needs the program ffmpeg, which is not on the PATH (Debian: apt install ffmpeg)");
  }
}

void write_film(const StoredTrial& stored, const World& world, const TrialRecord& record,
                const std::vector<Moment>& moments, const std::string& file) {
  if (record.samples.empty()) {
    std::cerr << "nothing was flown: no video\n";
    return;
  }
  Film film(stored, world, record, moments);
  std::vector<std::string> command = {
      found_program("ffmpeg"),
      "-hide_banner",
      "-loglevel",
      "error",
      "-y",
      "-f",
      "rawvideo",
      "-pix_fmt",
      "rgb24",
      "-s",
      std::to_string(kFilmWidth_px) + "x" + std::to_string(kFilmHeight_px),
      "-r",
      shortest(kFilmRate_hz),
      "-i",
      "-",
      "-an",
      "-map_metadata",
      "-1",
      "-fflags",
      "+bitexact"};
  for (const std::string& word : coding_of(ending_of(file))) command.push_back(word);
  // As a path, whatever it begins with.
  command.push_back("file:" + file);
  FedProgram ffmpeg(command);
  const std::size_t count = film.frame_count();
  for (std::size_t i = 0; i < count; ++i) {
    if (!ffmpeg.write(film.frame(i).rgb)) break;
    tell(i + 1, count);
  }
  if (ffmpeg.finish() != 0)
    throw InputError({.file = file, .message = "ffmpeg has failed: see above"});
  std::cerr << "wrote " << file << '\n';
}

}  // namespace avoidbench
