#pragma once

#include <cstdint>
#include <cstring>
#include <random>
#include <utility>
#include <vector>

#include "avoidbench/planner.h"

/// Inputs of random bits.
namespace avoidbench {

/// Bytes of all kinds, among them those of NaN and subnormal numbers.
class Noise {
 public:
  explicit Noise(unsigned seed) : draws_(seed) {}
  void fill(void* at, std::size_t count) {
    auto* bytes = static_cast<unsigned char*>(at);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<unsigned char>(draws_());
  }
  template <class Struct>
  Struct made() {
    Struct value{};
    fill(&value, sizeof value);
    value.struct_size = sizeof value;
    return value;
  }

 private:
  std::mt19937 draws_;
};

/// An observation with everything, of random bits.
struct Seen {
  Seen(unsigned seed, int depth_count, int width_px, int height_px) {
    Noise noise(seed);
    state = noise.made<ab_state>();
    const auto pixels = static_cast<std::size_t>(width_px * height_px);
    for (int i = 0; i < depth_count; ++i) {
      depths.push_back(noise.made<ab_depth_image>());
      depth_pixels.emplace_back(pixels);
      noise.fill(depth_pixels.back().data(), pixels * sizeof(float));
    }
    for (int i = 0; i < 5; ++i) {
      pictures.push_back(noise.made<ab_picture>());
      pictures.back().channels = i == 4 ? 3 : 1;
      picture_pixels.emplace_back(pixels * pictures.back().channels);
      noise.fill(picture_pixels.back().data(), picture_pixels.back().size());
    }
    for (std::size_t i = 0; i < depths.size(); ++i) {
      depths[i].width_px = width_px;
      depths[i].height_px = height_px;
      depths[i].depth_m = depth_pixels[i].data();
      depth_pointers.push_back(&depths[i]);
    }
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      pictures[i].width_px = width_px;
      pictures[i].height_px = height_px;
      pictures[i].pixels = picture_pixels[i].data();
    }
    for (std::size_t i = 0; i < 2; ++i) {
      pairs.push_back(noise.made<ab_stereo_pair>());
      pairs.back().left = &pictures[2 * i];
      pairs.back().right = &pictures[2 * i + 1];
    }
    for (const ab_stereo_pair& pair : pairs) pair_pointers.push_back(&pair);
    color_pointers.push_back(&pictures[4]);
    imu.resize(7);
    noise.fill(imu.data(), imu.size() * sizeof(ab_imu_sample));
    all.struct_size = sizeof all;
    all.state = &state;
    all.depth_count = static_cast<std::uint32_t>(depth_pointers.size());
    all.depth = depth_pointers.data();
    all.stereo_count = 2;
    all.stereo = pair_pointers.data();
    all.color_count = 1;
    all.color = color_pointers.data();
    all.imu_count = static_cast<std::uint32_t>(imu.size());
    all.imu = imu.data();
    noise.fill(&all.time_s, sizeof all.time_s);
    for (int i = 0; i < 4; ++i) past.push_back(noise.made<ab_state>());
    for (const ab_state& one : past) past_pointers.push_back(&one);
    all.state_count = static_cast<std::uint32_t>(past.size());
    all.states = past_pointers.data();
    tracks.resize(3);
    noise.fill(tracks.data(), tracks.size() * sizeof(ab_track));
    all.track_count = static_cast<std::uint32_t>(tracks.size());
    all.tracks = tracks.data();
    noise.fill(&reference, sizeof reference);
    // Of other seeds there is none.
    all.reference = seed % 2 == 1 ? &reference : nullptr;
    // One sweep, one that met nothing, one that met all.
    for (const auto& [point_count, miss_count] : {std::pair(5U, 3U), {0U, 7U}, {4U, 0U}}) {
      clouds.push_back(noise.made<ab_cloud>());
      clouds.back().point_count = point_count;
      clouds.back().miss_count = miss_count;
      points.emplace_back(point_count);
      noise.fill(points.back().data(), point_count * sizeof(ab_lidar_point));
      misses.emplace_back(3 * miss_count);
      noise.fill(misses.back().data(), misses.back().size() * sizeof(float));
    }
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      clouds[i].points = points[i].data();
      clouds[i].misses_lidar = misses[i].data();
      cloud_pointers.push_back(&clouds[i]);
    }
    all.cloud_count = static_cast<std::uint32_t>(cloud_pointers.size());
    all.clouds = cloud_pointers.data();
    noise.fill(&all.goal_index, sizeof all.goal_index);
    noise.fill(all.goal_world_m, sizeof all.goal_world_m);
    wanted = noise.made<ab_command>();
    wanted_points.resize(6);
    noise.fill(wanted_points.data(), wanted_points.size() * sizeof(ab_point));
    wanted.point_count = static_cast<std::uint32_t>(wanted_points.size());
    wanted.points = wanted_points.data();
    // Of other seeds the planner below has no plan.
    all.wanted = seed % 3 != 0 ? &wanted : nullptr;
  }
  Seen(const Seen&) = delete;
  /// Whether sweeps, tracks and goals have the same bits.
  bool is_as(const Seen& other) const {
    const auto same = [](const auto& a, const auto& b) {
      return a.size() == b.size() &&
             (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
    };
    bool is_same = same(tracks, other.tracks) && all.goal_index == other.all.goal_index;
    for (std::size_t i = 0; i < clouds.size(); ++i) {
      is_same = is_same && clouds[i].point_count == other.clouds[i].point_count &&
                same(points[i], other.points[i]) && same(misses[i], other.misses[i]);
    }
    return is_same;
  }
  Seen& operator=(const Seen&) = delete;

  ab_state state{};
  std::vector<ab_depth_image> depths;
  std::vector<std::vector<float>> depth_pixels;
  std::vector<ab_picture> pictures;
  std::vector<std::vector<std::uint8_t>> picture_pixels;
  std::vector<const ab_depth_image*> depth_pointers;
  std::vector<ab_stereo_pair> pairs;
  std::vector<const ab_stereo_pair*> pair_pointers;
  std::vector<const ab_picture*> color_pointers;
  std::vector<ab_imu_sample> imu;
  std::vector<ab_state> past;
  ab_point reference{};
  ab_command wanted{};
  std::vector<ab_point> wanted_points;
  std::vector<ab_track> tracks;
  std::vector<const ab_state*> past_pointers;
  std::vector<ab_cloud> clouds;
  std::vector<std::vector<ab_lidar_point>> points;
  std::vector<std::vector<float>> misses;
  std::vector<const ab_cloud*> cloud_pointers;
  ab_observation all{};
};

}  // namespace avoidbench
