// Paths and digests of maps that come from files.
#include "base/digest.hpp"
#include "config/sweep_fixture.hpp"

namespace avoidbench {
namespace {

using MapFiles = SweepFiles;

std::string sweep_of(const std::string& map) {
  return "sweep: own\nplanners: [tunable]\nmaps:\n  generator: mesh\n" + map;
}

TEST_F(MapFiles, APathIsRelativeToTheSweepsFolderAndItsDigestIsFilledIn) {
  const std::filesystem::path obj = write("maps/a.obj", "v 0 0 0\n");
  const std::filesystem::path yaml = write("sweeps/s.yaml", sweep_of("  file: ../maps/a.obj\n"));
  const SweepSpec sweep = read_sweep(yaml, {});
  const auto& spec = std::get<MeshSpec>(sweep.base.map);
  EXPECT_EQ(spec.file, obj.string());
  EXPECT_EQ(spec.file_digest, file_digest(obj.string()));
  write("maps/a.obj", "v 1 0 0\n");
  EXPECT_NE(std::get<MeshSpec>(read_sweep(yaml, {}).base.map).file_digest, spec.file_digest);
}

TEST_F(MapFiles, SeveralFilesAreAnAxis) {
  write("a.obj", "v 0 0 0\n");
  write("b.obj", "v 1 0 0\n");
  const SweepSpec sweep = read(sweep_of("  file: [a.obj, b.obj]\n"));
  ASSERT_EQ(sweep.axes.size(), 1U);
  EXPECT_EQ(sweep.axes[0].values[0], (folder_ / "a.obj").string());
  EXPECT_EQ(sweep.axes[0].values[1], (folder_ / "b.obj").string());
  EXPECT_EQ(problems(sweep_of("  file: [a.obj, c.obj]\n")), "s.yaml:5:9: maps.file: no file c.obj");
  EXPECT_EQ(problems(sweep_of("  file: [a.obj, b.obj]\n  file_digest: 00\n")),
            "s.yaml:6:16: maps.file_digest: can't be that of several files");
}

TEST_F(MapFiles, WhatIsWrongIsReportedWithItsPlace) {
  const std::string digest = file_digest(write("a.obj", "v 0 0 0\n").string());
  EXPECT_EQ(problems(sweep_of("  file: none.obj\n")), "s.yaml:5:9: maps.file: no file none.obj");
  EXPECT_EQ(problems(sweep_of("  file: .\n")),
            "s.yaml:5:9: maps.file: is not a regular file: \n"
            "s.yaml:5:9: maps.file: '' is not one of obj, ply, stl, glb, gltf");
  EXPECT_EQ(problems(sweep_of("  file: a.obj\n  file_digest: 00\n")),
            "s.yaml:6:16: maps.file_digest: is not that of a.obj, " + digest);
  EXPECT_EQ(problems(sweep_of("  file: a.obj\n  file_digest: " + digest + "\n")), "");
  EXPECT_EQ(problems(sweep_of("  file: a.obj\n  seeds: [1, 2]\n")),
            "s.yaml:6:10: maps.seeds: a map from a file is the same for every seed; leave one");
  EXPECT_EQ(problems(sweep_of("  file: a.obj\n  up_axis: w\n")),
            "s.yaml:6:12: maps.up_axis: \"w\" is not one of z, y, x (did you mean z?)");
  EXPECT_EQ(problems(sweep_of("  file: a.obj\n  scale: 0\n")),
            "s.yaml:6:10: maps.scale: 0 is outside [1e-06, 1000000]");
  EXPECT_EQ(problems(sweep_of("  file: a.pcd\n")).substr(0, 23), "s.yaml:5:9: maps.file: ");
}

}  // namespace
}  // namespace avoidbench
