// sensor.more_cameras: rigs of unlike cameras.
#include "config/sweep_fixture.hpp"
#include "sweep/key_maker.hpp"
#include "trial/contradictions.hpp"

namespace avoidbench {
namespace {

const std::string kRigHead = "sweep: a\nplanners: [tunable]\n";

class Rigs : public SweepFiles {};

TEST_F(Rigs, AnElementIsANameOrWhatDiffersFromOne) {
  const SensorSpec sensor =
      read(kRigHead +
           "sensor:\n  preset: stereo_sgm\n  more_cameras:\n    - d435_like\n"
           "    - {preset: oak_d_like, yaw_deg: 90, rate_hz: 15}\n    - {width_px: 64}\n")
          .base.sensor;
  EXPECT_EQ(sensor.name, "stereo_sgm");
  ASSERT_EQ(sensor.more_cameras.size(), 3U);
  EXPECT_EQ(sensor.more_cameras[0].name, "d435_like");
  EXPECT_EQ(sensor.more_cameras[0].delay_ms, 25.0);
  EXPECT_TRUE(std::holds_alternative<StereoSgmSpec>(sensor.more_cameras[1].method));
  EXPECT_EQ(sensor.more_cameras[1].mounting.yaw_deg, 90.0);
  EXPECT_EQ(sensor.more_cameras[1].rate_hz, 15.0);
  EXPECT_EQ(sensor.more_cameras[2].name, "depth_ideal");
  EXPECT_EQ(sensor.more_cameras[2].width_px, 64);
  EXPECT_EQ(rig_cameras(sensor).size(), 4U);
}

TEST_F(Rigs, CamerasMayComeFromFilesAlsoWithinAFile) {
  write("sensors/side.yaml", "preset: d435_like\nname: side\nyaw_deg: 90\n");
  write("sensors/both.yaml", "name: both\nmore_cameras: [side, d435_like]\n");
  const SensorSpec sensor = read(kRigHead + "sensor: both\n").base.sensor;
  ASSERT_EQ(sensor.more_cameras.size(), 2U);
  EXPECT_EQ(sensor.more_cameras[0].name, "side");
  EXPECT_EQ(sensor.more_cameras[0].mounting.yaw_deg, 90.0);
  EXPECT_EQ(sensor.more_cameras[0].width_px, 424);
  EXPECT_EQ(sensor.more_cameras[1].name, "d435_like");
}

TEST_F(Rigs, TheRigThatComesAlongIsGood) {
  const std::filesystem::path file =
      std::filesystem::path(AVOIDBENCH_SOURCE_DIR) / "configs/sensors/stereo_and_side.yaml";
  const SensorSpec sensor = read(kRigHead + "sensor: " + file.string() + "\n").base.sensor;
  EXPECT_EQ(sensor.name, "stereo_and_side");
  ASSERT_EQ(rig_cameras(sensor).size(), 2U);
  EXPECT_EQ(rig_cameras(sensor)[1].kind.name, "side");
}

TEST_F(Rigs, ProblemsOfACameraHaveTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"sensor: {more_cameras: [d435_lik]}",
       "s.yaml:3:25: sensor.more_cameras[0]: \"d435_lik\" is not a sensor (did you mean "
       "d435_like?); "
       "known: d435_like, depth_ideal, depth_noisy, oak_d_like, stereo_original, stereo_sgbm, "
       "stereo_sgm, surround"},
      {"sensor: {more_cameras: [{widht_px: 3}]}",
       "s.yaml:3:26: sensor.more_cameras[0].widht_px: unknown key for kind depth_ideal (did you "
       "mean width_px?)"},
      {"sensor: {more_cameras: [{width_px: 3}]}",
       "s.yaml:3:36: sensor.more_cameras[0].width_px: 3 is outside [8, 4096]"},
      {"sensor: {more_cameras: [{more_cameras: []}]}",
       "s.yaml:3:26: sensor.more_cameras[0].more_cameras: unknown key"},
      {"sensor: {more_cameras: [d435_like, {jitter_ms: 50}]}",
       "s.yaml:3:48: sensor.more_cameras[1].jitter_ms: 50 ms is not below the time between two "
       "images, 33.333333333333336 ms"},
      {"sensor: {more_cameras: [{preset: stereo_sgm, disparities: 50}]}",
       "s.yaml:3:59: sensor.more_cameras[0].disparities: 50 is not a multiple of 16; the next is "
       "64"},
      {"sensor: {more_cameras: [{rate_hz: 900, exposure_ms: 0}]}\nrates: {physics_hz: 500}",
       "s.yaml:3:35: sensor.more_cameras[0].rate_hz: 900 Hz is faster than rates.physics_hz, 500"},
      {"sensor: {more_cameras: [mid360_like]}",
       "s.yaml:3:25: sensor.more_cameras[0]: \"mid360_like\" is not a sensor"},
      {"sensor: {kind: none}", "s.yaml:3:9: sensor.lidars: a sensor of kind none has lidars"},
      {"sensor: {kind: none, lidars: [mid360_like]}",
       "s.yaml:3:9: sensor.name: reports would call these lidars 'depth_ideal', which is a camera: "
       "give the sensor a name"},
      {"sensor: {lidars: [mid360_lik]}",
       "s.yaml:3:19: sensor.lidars[0]: \"mid360_lik\" is not a sensor (did you mean mid360_like?); "
       "known: mid360_like, ouster_os0_32, velodyne_16"},
      {"sensor: {preset: mid360_like, rate_hz: 20}",
       "s.yaml:3:40: sensor.rate_hz: belongs to a camera, and a sensor of kind none has none; for "
       "a lidar it is given as in sensor: {preset: mid360_like, lidars: [{preset: mid360_like, "
       "rate_hz: …}]}"},
      {"sensor: {lidars: [{preset: mid360_like, rings: 4}]}",
       "s.yaml:3:41: sensor.lidars[0].rings: unknown key for kind lidar_pattern"},
      {"sensor: {lidars: [{min_range_m: 5, max_range_m: 5}]}",
       "s.yaml:3:33: sensor.lidars[0].min_range_m: 5 is not below max_range_m, 5"},
      {"sensor: {lidars: [{lowest_elevation_deg: 20}]}",
       "s.yaml:3:42: sensor.lidars[0].lowest_elevation_deg: 20 is not below highest_elevation_deg, "
       "15"},
  };
  for (const auto& [text, problem] : cases) {
    EXPECT_TRUE(problems(kRigHead + text).starts_with(problem)) << problems(kRigHead + text);
  }
}

TEST_F(Rigs, RatesAreRoundedToTicks) {
  const SweepSpec sweep = read(kRigHead + "sensor: {more_cameras: [{rate_hz: 7.7}]}\n");
  EXPECT_EQ(sweep.base.sensor.more_cameras[0].rate_hz, 36000.0 / 4675.0);
  ASSERT_EQ(sweep.warnings.size(), 1U);
  EXPECT_NE(sweep.warnings[0].find("s.yaml:3:35: sensor.more_cameras[0].rate_hz: 7.7 Hz is not"),
            std::string::npos)
      << sweep.warnings[0];
}

/// The problems of a sweep of these planners and this sensor.
class OneCameraPlanners : public SweepFiles {
 protected:
  std::string with(const std::string& planners, const std::string& sensor,
                   const std::string& more = "") const {
    return problems("sweep: a\nplanners: " + planners + "\nsensor: " + sensor + "\n" + more);
  }
};

TEST_F(OneCameraPlanners, AreRefusedARigUnlessTheSweepNamesTheirCamera) {
  EXPECT_EQ(with("[one_camera]", "depth_ideal"), "");
  EXPECT_EQ(with("[one_camera]", "mid360_like"),
            "s.yaml:2:12: planners[0]: one_camera can't fly with sensor 'mid360_like': it has no "
            "camera");
  EXPECT_EQ(with("[tunable, one_camera]", "surround"),
            "s.yaml:2:21: planners[1]: one_camera can't fly with sensor 'surround': it handles one "
            "camera and gets 4; name the one that it sees, as in {plugin: one_camera, camera: 0}, "
            "of 0 (yaw 0°), 1 (yaw 90°), 2 (yaw 180°), 3 (yaw -90°)");
  EXPECT_EQ(with("[one_camera]", "{more_mountings: [{pitch_deg: 90}]}"),
            "s.yaml:2:12: planners[0]: one_camera can't fly with sensor 'depth_ideal': it handles "
            "one camera and gets 2; name the one that it sees, as in {plugin: one_camera, camera: "
            "0}, of 0 (yaw 0°), 1 (yaw 0°, pitch 90°)");
  EXPECT_EQ(with("[{plugin: one_camera, camera: 3}]", "surround"), "");
  EXPECT_EQ(with("{plugin: one_camera, camera: 4}", "surround"),
            "s.yaml:2:11: planners: sensor 'surround' has no camera 4; it has 0 (yaw 0°), 1 (yaw "
            "90°), 2 (yaw 180°), 3 (yaw -90°)");
  // Of a sensor that is one value of an axis, too.
  EXPECT_NE(
      with("[one_camera]", "depth_ideal", "axes: {sensor.more_mountings: [[], [{yaw_deg: 90}]]}\n")
          .find("handles one camera and gets 2"),
      std::string::npos);
}

TEST_F(OneCameraPlanners, AreRefusedANarrowView) {
  EXPECT_EQ(with("[one_camera]", "oak_d_like"),
            "s.yaml:2:12: planners[0]: one_camera can't fly with sensor 'oak_d_like': it needs a "
            "view of 80° × 60° or more, and the camera has 72° × 48.8°");
  EXPECT_EQ(with("[one_camera]", "{fov_x_deg: 80}"), "");
  // Of a rig, only the camera that it sees.
  EXPECT_EQ(with("{plugin: one_camera, camera: 0}", "{more_cameras: [oak_d_like]}"), "");
  EXPECT_NE(with("{plugin: one_camera, camera: 1}", "{more_cameras: [oak_d_like]}"), "");
}

TEST_F(OneCameraPlanners, TheCameraIsPartOfTheKeyWhereItIsNamed) {
  const auto key = [&](const std::string& planner) {
    return trial_key(expand(read("sweep: a\nplanners: [" + planner + "]\n")).front().spec());
  };
  const std::string each = key("one_camera");
  EXPECT_EQ(key("{plugin: one_camera}"), each);
  EXPECT_NE(key("{plugin: one_camera, camera: 0}"), each);
}

TEST_F(OneCameraPlanners, AKeyOfAnotherKindIsAProblem) {
  EXPECT_NE(with("{plugin: one_camera, camera: front}", "surround").find("planners.camera: "),
            std::string::npos);
  EXPECT_NE(with("{plugin: tunable, camera: 0}", "surround").find("tunable sees no images"),
            std::string::npos);
}

}  // namespace
}  // namespace avoidbench
