#include "view_output.hpp"

#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <sstream>

#include "base/input_error.hpp"
#include "base/number_text.hpp"
#include "output.hpp"
#include "process/fed_program.hpp"

namespace avoidbench {
namespace {

std::string ending_of(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  return ending.empty() ? "" : ending.substr(1);
}

/// How ffmpeg makes such a file of raw frames.
std::string coding_of(const std::string& ending) {
  if (ending == "mp4") {
    return "-c:v libx264 -preset veryfast -crf 21 -pix_fmt yuv420p -movflags +faststart";
  }
  if (ending == "webm") {
    return "-c:v libvpx-vp9 -b:v 0 -crf 33 -deadline realtime -cpu-used 6 -row-mt 1 "
           "-pix_fmt yuv420p";
  }
  // A palette of its own: the usual one is far from these colours.
  return "-vf fps=12,scale=800:-1:flags=lanczos,split[a][b];[a]palettegen=stats_mode=diff[p];"
         "[b][p]paletteuse=dither=bayer:bayer_scale=4 -loop 0";
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

/// FILE, or FILE with a number before its extension.
std::filesystem::path picture_file(const std::string& png, std::size_t index, std::size_t count) {
  if (count == 1) return png;
  const std::filesystem::path path = png;
  std::string number = std::to_string(index);
  number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');
  return path.parent_path() / (path.stem().string() + "_" + number +
                               (path.has_extension() ? path.extension().string() : ".png"));
}

}  // namespace

std::string title_line(const TrialListing& listing) {
  return "trial " + std::to_string(listing.id) + " (" + listing.key.substr(0, 8) +
         "): " + trial_text(listing);
}

void write_sheets(const StoredTrial& stored, const World& world, const TrialRecord& record,
                  const std::vector<Moment>& moments, const std::string& title,
                  const std::string& png) {
  if (record.samples.empty()) {
    std::cerr << "nothing was flown: no picture\n";
    return;
  }
  ReplaySheets sheets(stored, world, record, title);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const std::filesystem::path file = picture_file(png, i, moments.size());
    write_png(sheets.sheet(moments[i]), file);
    std::cerr << "wrote " << file.string() << " (t = " << fixed_digits(moments[i].time_s, 3)
              << " s)\n";
  }
}

void check_film(const std::string& file) {
  const std::string ending = ending_of(file);
  if (ending != "mp4" && ending != "webm" && ending != "gif") {
    refuse_file(file, "--video writes .mp4, .webm or .gif");
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
  std::istringstream words("-hide_banner -loglevel error -y -f rawvideo -pix_fmt rgb24 -s " +
                           std::to_string(kFilmWidth_px) + "x" + std::to_string(kFilmHeight_px) +
                           " -r " + shortest(kFilmRate_hz) +
                           " -i - -an -map_metadata -1 -fflags +bitexact " +
                           coding_of(ending_of(file)));
  std::vector<std::string> command{found_program("ffmpeg")};
  for (std::string word; words >> word;) command.push_back(word);
  // As a path, whatever it begins with.
  command.push_back("file:" + file);
  FedProgram ffmpeg(command);
  const std::size_t count = film.frame_count();
  for (std::size_t i = 0; i < count; ++i) {
    if (!ffmpeg.write(film.frame(i).rgb)) break;
    tell(i + 1, count);
  }
  if (ffmpeg.finish() != 0) refuse_file(file, "ffmpeg failed: see above");
  std::cerr << "wrote " << file << '\n';
}

}  // namespace avoidbench
