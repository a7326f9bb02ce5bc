#include <gmock/gmock.h>

#include "bad_planners.hpp"
#include "base/math.hpp"
#include "conformance/conformance_flight.hpp"
#include "plugin/planner_table.hpp"

namespace avoidbench {
namespace {

/// 160 × 120 pixels with this focal length.
CameraSetup camera(double focal_px) {
  CameraSetup setup = conformance_setup().cameras.front();
  setup.fx_px = setup.fy_px = focal_px;
  return setup;
}

/// A sensor of these cameras and so many lidars.
PlannerSetup sensor(std::vector<CameraSetup> cameras, std::size_t lidars = 0) {
  PlannerSetup setup = conformance_setup();
  setup.cameras = std::move(cameras);
  setup.lidars.resize(lidars);
  return setup;
}

PlannerDescription planner(std::uint32_t needs, double least_x_deg = 0.0,
                           double least_y_deg = 0.0) {
  PlannerDescription description;
  description.needs = needs;
  description.least_fov_x_rad = least_x_deg * math::kDegree;
  description.least_fov_y_rad = least_y_deg * math::kDegree;
  return description;
}

TEST(CameraDemand, OneCameraIsNoRig) {
  const PlannerSetup one = sensor({camera(80.0)}), two = sensor({camera(80.0), camera(80.0)});
  const PlannerDescription single = planner(AB_INPUT_DEPTH | AB_INPUT_ONE_CAMERA);
  EXPECT_EQ(sensor_problem(single, one), "");
  EXPECT_EQ(sensor_problem(single, two), "it handles one camera and gets 2");
  EXPECT_EQ(sensor_problem(planner(AB_INPUT_COLOR), two), "");
  EXPECT_EQ(camera_demand(single), "one");
  EXPECT_EQ(camera_demand(planner(AB_INPUT_DEPTH)), "");
}

TEST(CameraDemand, EachCameraHasToBeWideEnough) {
  const PlannerDescription wide = planner(AB_INPUT_DEPTH, 90.0, 67.4);
  // 90° × 73.7°: with nothing to spare across.
  EXPECT_EQ(sensor_problem(wide, sensor({camera(80.0)})), "");
  EXPECT_EQ(sensor_problem(wide, sensor({camera(81.0)})),
            "it needs a view of 90° × 67.4° or more, and the camera has 89.3° × 73.1°");
  CameraSetup flat = camera(80.0);
  flat.height_px = 90;
  EXPECT_EQ(sensor_problem(wide, sensor({camera(80.0), flat})),
            "it needs a view of 90° × 67.4° or more, and camera 1 has 90° × 58.7°");
  // Without eyes it gets no camera.
  EXPECT_EQ(sensor_problem(planner(AB_INPUT_STATE, 90.0, 67.4), sensor({camera(81.0)})), "");
  EXPECT_EQ(camera_demand(planner(AB_INPUT_DEPTH | AB_INPUT_ONE_CAMERA, 90.0, 67.4)),
            "one, 90° × 67.4° or more");
}

/// Who sees images and points flies with a camera, a lidar, or both.
TEST(CameraDemand, ASensorHasWhatThePlannerSeesThrough) {
  const std::uint32_t both = AB_INPUT_DEPTH | AB_INPUT_POINTS;
  EXPECT_EQ(sensor_problem(planner(AB_INPUT_DEPTH), sensor({}, 1)), "it has no camera");
  EXPECT_EQ(sensor_problem(planner(AB_INPUT_POINTS), sensor({camera(80.0)})), "it has no lidar");
  EXPECT_EQ(sensor_problem(planner(both), sensor({})), "it has neither a camera nor a lidar");
  EXPECT_EQ(sensor_problem(planner(both), sensor({}, 1)), "");
  EXPECT_EQ(sensor_problem(planner(both), sensor({camera(80.0)})), "");
  EXPECT_EQ(sensor_problem(planner(AB_INPUT_STATE), sensor({})), "");
}

/// Whoever makes the instance, a sweep or not.
TEST(CameraDemand, NoInstanceIsMadeForOtherCameras) {
  const PlannerLibrary library = PlannerLibrary::load(bad_planner("one_wide_camera"));
  PlannerSetup setup = conformance_setup();
  EXPECT_NO_THROW(PlannerInstance(library, setup, {}));
  setup.cameras.push_back(setup.cameras.front());
  try {
    PlannerInstance(library, setup, {});
    ADD_FAILURE() << "made for two cameras";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "planner honest can't fly with this sensor: it handles one camera and gets 2");
  }
}

}  // namespace
}  // namespace avoidbench
