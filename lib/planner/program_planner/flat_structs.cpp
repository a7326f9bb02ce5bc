#include "program_planner/flat_structs.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace avoidbench {
namespace {

static_assert(sizeof(void*) == sizeof(std::uint64_t), "pointers and offsets have one size");

constexpr std::uint32_t kMostTexts = 1000;  ///< of parameters, profiles, files

/// Puts an offset into a pointer's place.
template <class Pointer>
void set_offset(Pointer& pointer, std::uint64_t offset) {
  static_assert(std::is_pointer_v<Pointer>);
  std::memcpy(&pointer, &offset, sizeof offset);
}

std::uint64_t offset_in(const void* pointer) {
  return static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(pointer));
}

template <class Struct>
std::uint64_t write_struct(Segment& segment, const Struct& value) {
  return segment.add(&value, sizeof value);
}

/// What a struct points to is written before it, since it holds the offsets.
std::uint64_t write_picture(Segment& segment, const ab_picture& picture) {
  ab_picture copy = picture;
  const auto pixels = static_cast<std::size_t>(copy.width_px) *
                      static_cast<std::size_t>(copy.height_px) * copy.channels;
  set_offset(copy.pixels, segment.add(picture.pixels, pixels));
  return write_struct(segment, copy);
}

std::uint64_t write_depth(Segment& segment, const ab_depth_image& image) {
  ab_depth_image copy = image;
  const auto pixels =
      static_cast<std::size_t>(copy.width_px) * static_cast<std::size_t>(copy.height_px);
  set_offset(copy.depth_m, segment.add(image.depth_m, pixels * sizeof(float)));
  return write_struct(segment, copy);
}

std::uint64_t write_cloud(Segment& segment, const ab_cloud& cloud) {
  ab_cloud copy = cloud;
  const std::size_t points = cloud.point_count * sizeof(ab_lidar_point);
  const std::size_t misses = std::size_t{3} * cloud.miss_count * sizeof(float);
  set_offset(copy.points, points == 0 ? 0 : segment.add(cloud.points, points));
  set_offset(copy.misses_lidar, misses == 0 ? 0 : segment.add(cloud.misses_lidar, misses));
  return write_struct(segment, copy);
}

std::uint64_t write_stereo(Segment& segment, const ab_stereo_pair& pair) {
  ab_stereo_pair copy = pair;
  set_offset(copy.left, write_picture(segment, *pair.left));
  set_offset(copy.right, write_picture(segment, *pair.right));
  return write_struct(segment, copy);
}

std::uint64_t write_command(Segment& segment, const ab_command& command) {
  ab_command copy = command;
  const std::size_t point_bytes = command.point_count * sizeof(ab_point);
  set_offset(copy.points, point_bytes == 0 ? 0 : segment.add(command.points, point_bytes));
  return write_struct(segment, copy);
}

/// The offsets of what `write` makes of each element, as an array.
template <class Element, class Write>
std::uint64_t write_pointers(Segment& segment, const Element* const* elements, std::uint32_t count,
                             Write&& write) {
  std::vector<std::uint64_t> offsets;
  for (std::uint32_t i = 0; i < count; ++i) offsets.push_back(write(segment, *elements[i]));
  return segment.add(offsets);
}

}  // namespace

std::uint64_t write_flat(Segment& segment, const ab_setup& setup) {
  ab_setup copy = setup;
  const auto write_value = [](Segment& to, const ab_value& value) {
    ab_value written = value;
    const bool has_text = value.text != nullptr;
    set_offset(written.text, has_text ? to.add(value.text, std::strlen(value.text) + 1) : 0);
    return write_struct(to, written);
  };
  set_offset(copy.values, write_pointers(segment, setup.values, setup.value_count, write_value));
  // depth_camera is cameras[0] in ab_setup, and so in the segment.
  std::uint64_t first = 0;
  const auto write_camera = [&first](Segment& to, const ab_camera& camera) {
    const std::uint64_t offset = write_struct(to, camera);
    if (first == 0) first = offset;
    return offset;
  };
  set_offset(copy.cameras,
             write_pointers(segment, setup.cameras, setup.camera_count, write_camera));
  set_offset(copy.depth_camera, first);
  set_offset(copy.lidars, write_pointers(segment, setup.lidars, setup.lidar_count,
                                         [](Segment& to, const ab_lidar& lidar) {
                                           return write_struct(to, lidar);
                                         }));
  return write_struct(segment, copy);
}

std::uint64_t write_flat(Segment& segment, const ab_mission& mission) {
  ab_mission copy = mission;
  const std::size_t goal_bytes = 3 * mission.goal_count * sizeof(double);
  set_offset(copy.goals_world_m,
             goal_bytes == 0 ? 0 : segment.add(mission.goals_world_m, goal_bytes));
  return write_struct(segment, copy);
}

std::uint64_t write_flat(Segment& segment, const ab_observation& observation) {
  ab_observation copy = observation;
  set_offset(copy.state, write_struct(segment, *observation.state));
  set_offset(copy.depth,
             write_pointers(segment, observation.depth, observation.depth_count, write_depth));
  set_offset(copy.stereo,
             write_pointers(segment, observation.stereo, observation.stereo_count, write_stereo));
  set_offset(copy.color,
             write_pointers(segment, observation.color, observation.color_count, write_picture));
  const std::size_t imu_bytes = observation.imu_count * sizeof(ab_imu_sample);
  // 0 is null: an empty array lies nowhere.
  set_offset(copy.imu, imu_bytes == 0 ? 0 : segment.add(observation.imu, imu_bytes));
  set_offset(copy.states, write_pointers(segment, observation.states, observation.state_count,
                                         [](Segment& to, const ab_state& state) {
                                           return write_struct(to, state);
                                         }));
  const bool has_reference = observation.reference != nullptr;
  set_offset(copy.reference,
             has_reference ? segment.add(observation.reference, sizeof(ab_point)) : 0);
  set_offset(copy.clouds,
             write_pointers(segment, observation.clouds, observation.cloud_count, write_cloud));
  const std::size_t track_bytes = observation.track_count * sizeof(ab_track);
  set_offset(copy.tracks, track_bytes == 0 ? 0 : segment.add(observation.tracks, track_bytes));
  const bool has_wanted = observation.wanted != nullptr;
  set_offset(copy.wanted, has_wanted ? write_command(segment, *observation.wanted) : 0);
  return write_struct(segment, copy);
}

FlatAnswer::FlatAnswer(const std::vector<std::byte>& bytes) : bytes_(bytes) {
  // copy_answer() takes no answer that is shorter.
  std::memcpy(&head_, bytes_.data(), sizeof head_);
}

void FlatAnswer::copy(std::uint64_t offset, void* to, std::size_t count, const char* what) const {
  // In this order, so that no sum can overflow: offsets and counts are the program's.
  const std::uint64_t at = offset - Segment::kAnswerOffset;
  if (offset < Segment::kAnswerOffset || at > bytes_.size() || count > bytes_.size() - at) {
    throw BadAnswer(std::string(what) + " lies outside of the answer");
  }
  std::memcpy(to, bytes_.data() + at, count);
}

std::size_t FlatAnswer::sized_bytes(std::uint64_t offset, std::size_t least, std::size_t most,
                                    const char* what) const {
  std::uint32_t size = 0;
  copy(offset, &size, sizeof size, what);
  if (size < least) {
    throw BadAnswer(std::string(what) + " has struct_size " + std::to_string(size) +
                    ", less than " + std::to_string(least));
  }
  return std::min<std::size_t>(size, most);
}

std::uint32_t FlatAnswer::checked_count(std::uint64_t offset, std::uint32_t count, std::size_t size,
                                        const char* what) const {
  const std::uint64_t at = offset - Segment::kAnswerOffset;
  const bool is_inside = offset >= Segment::kAnswerOffset && at <= bytes_.size();
  // Of none the offset may be anything.
  if (count > 0 && (!is_inside || count > (bytes_.size() - at) / size)) {
    throw BadAnswer(std::string(what) + ", " + std::to_string(count) +
                    " of them, lie outside of the answer");
  }
  return count;
}

std::string FlatAnswer::text(std::uint64_t offset, const char* what) const {
  // Whether the text begins inside; where it ends is looked for below.
  char first = 0;
  copy(offset, &first, 1, what);
  const std::size_t at = offset - Segment::kAnswerOffset;
  const auto* begin = reinterpret_cast<const char*>(bytes_.data()) + at;
  const std::size_t length = ::strnlen(begin, bytes_.size() - at);
  if (length == bytes_.size() - at) throw BadAnswer(std::string(what) + " has no end");
  // One text may be named a thousand times, and each is a copy.
  text_bytes_ += length;
  if (text_bytes_ > Segment::kAnswerBytes) {
    throw BadAnswer(std::string(what) + ": its texts together are longer than " +
                    std::to_string(Segment::kAnswerBytes) + " bytes");
  }
  return {begin, length};
}

std::vector<std::string> FlatAnswer::texts(std::uint64_t offset, std::uint32_t count,
                                           const char* what) const {
  std::vector<std::string> all;
  for (const std::uint64_t at : array<std::uint64_t>(offset, count, what)) {
    all.push_back(text(at, what));
  }
  return all;
}

DescribedTable::DescribedTable(const FlatAnswer& answer) {
  const auto description = answer.sized<ab_process_description>(
      answer.head().body, sizeof(ab_process_description), "the description");
  // First: another protocol may mean something else by all that follows.
  if (description.protocol != AB_PROCESS_PROTOCOL) {
    throw BadAnswer("it speaks protocol " + std::to_string(description.protocol) +
                    ", this avoidbench needs protocol " + std::to_string(AB_PROCESS_PROTOCOL));
  }
  table = answer.sized<ab_planner>(description.planner,
                                   offsetof(ab_planner, get_extension) + sizeof(void*),
                                   "the planner's table");
  table.name = kept(answer, table.name, "the planner's name");
  table.version = kept(answer, table.version, "the planner's version");
  table.summary = kept(answer, table.summary, "the planner's summary");
  // What the program has there are addresses of its own.
  table.create = nullptr;
  table.destroy = nullptr;
  table.reset = nullptr;
  table.plan = nullptr;
  table.get_extension = nullptr;
  read_parameters(answer);
  read_profiles(answer);
  if (description.files != 0) read_files(answer, description.files);
}

const char* DescribedTable::kept(const FlatAnswer& answer, const void* offset, const char* what) {
  // Whether it may be null is for table_problems() to say.
  if (offset_in(offset) == 0) return nullptr;
  texts_.push_back(std::make_unique<std::string>(answer.text(offset_in(offset), what)));
  return texts_.back()->c_str();
}

void DescribedTable::read_parameters(const FlatAnswer& answer) {
  constexpr const char* kWhat = "a parameter";
  // Before anything is allocated by a count that the program says.
  if (table.parameter_count > kMostTexts) throw BadAnswer("it has too many parameters");
  for (const std::uint64_t at : answer.array<std::uint64_t>(
           offset_in(table.parameters), table.parameter_count, "the parameters")) {
    ab_parameter parameter = answer.sized<ab_parameter>(at, sizeof(ab_parameter), kWhat);
    for (const char** text : {&parameter.name, &parameter.unit, &parameter.doc, &parameter.choices,
                              &parameter.preset_text}) {
      *text = kept(answer, *text, kWhat);
    }
    parameters_.push_back(parameter);
  }
  // Only now, when parameters_ moves no more.
  for (const ab_parameter& parameter : parameters_) parameter_pointers_.push_back(&parameter);
  table.parameters = parameter_pointers_.data();
}

void DescribedTable::read_profiles(const FlatAnswer& answer) {
  constexpr const char* kWhat = "a profile";
  if (table.profile_count > kMostTexts) throw BadAnswer("it has too many profiles");
  for (const std::uint64_t at : answer.array<std::uint64_t>(offset_in(table.profiles),
                                                            table.profile_count, "the profiles")) {
    ab_profile profile = answer.sized<ab_profile>(at, sizeof(ab_profile), kWhat);
    profile.choice = kept(answer, profile.choice, kWhat);
    profile.word = kept(answer, profile.word, kWhat);
    if (profile.number_count > kMostTexts) throw BadAnswer("a profile has too many numbers");
    numbers_.push_back(
        answer.array<ab_named_number>(offset_in(profile.numbers), profile.number_count, kWhat));
    for (ab_named_number& number : numbers_.back()) number.name = kept(answer, number.name, kWhat);
    profiles_.push_back(profile);
  }
  // As above: addresses are taken when nothing moves any more.
  for (std::size_t i = 0; i < profiles_.size(); ++i) {
    profiles_[i].numbers = numbers_[i].data();
    profile_pointers_.push_back(&profiles_[i]);
  }
  table.profiles = profile_pointers_.data();
}

void DescribedTable::read_files(const FlatAnswer& answer, std::uint64_t offset) {
  files_ = answer.sized<ab_files>(offset, sizeof(ab_files), "the files");
  if (files_.file_count > kMostTexts) throw BadAnswer("it names too many files");
  for (std::string& name : answer.texts(offset_in(files_.files), files_.file_count, "the files")) {
    texts_.push_back(std::make_unique<std::string>(std::move(name)));
    file_pointers_.push_back(texts_.back()->c_str());
  }
  files_.files = file_pointers_.data();
  has_files_ = true;
}

ab_command read_command(const FlatAnswer& answer, std::vector<ab_point>& points) {
  // The struct as ABI 1 first had it.
  constexpr std::size_t kLeast = offsetof(ab_command, horizon_s) + sizeof(double);
  auto command = answer.sized<ab_command>(answer.head().body, kLeast, "the command");
  // Null with a count is left to command_problem(), which names it.
  const bool has_points = offset_in(command.points) != 0;
  points = answer.array<ab_point>(offset_in(command.points), has_points ? command.point_count : 0,
                                  "the trajectory's points");
  command.points = has_points ? points.data() : nullptr;
  return command;
}

}  // namespace avoidbench
