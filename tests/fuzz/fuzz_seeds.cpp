// fuzz_seeds FOLDER: writes the first inputs of the fuzz targets: FOLDER/point_cloud and
// FOLDER/mesh, each kind of file as the tests write them; FOLDER/database, a small real one;
// FOLDER/database_edits, an edit of each kind; FOLDER/log, each kind of recorded flight;
// FOLDER/sweep, sweeps with every block.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "fuzz/read_database.hpp"
#include "support/log_files.hpp"
#include "support/map_files.hpp"
#include "support/sweeps_of_all_blocks.hpp"
#include "world/solids.hpp"

namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace avoidbench;
  if (argc != 2) {
    std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
    return 2;
  }
  const fs::path clouds = fs::path(argv[1]) / "point_cloud", meshes = fs::path(argv[1]) / "mesh";
  fs::create_directories(clouds);
  fs::create_directories(meshes);
  FilePoints points;
  for (int i = 0; i < 20; ++i) points.emplace_back(0.25 * i, 7.0 - i, 0.5 * (i % 3));
  for (const auto& [name, bytes] : test::all_clouds(points)) write(clouds / name, bytes);
  for (int format = 0; format <= 10; ++format) {
    write(clouds / ("format" + std::to_string(format) + ".las"),
          test::las(points, {.minor = 4, .format = format, .extra = 2, .records = 1}));
  }
  write(clouds / "small.bt", test::octree_at_origin("0.25", 1, test::octree_node("ofoo0fo0"), 6));
  write(clouds / "nodes.bt",
        test::octree_at_origin("0.1", 3,
                               test::octree_node("n00000on") + test::octree_node("ofofof00") +
                                   test::octree_node("0000000f"),
                               10));
  write(clouds / "full.ot", "# Octomap OcTree file\nid OcTree\nsize 1\nres 0.1\ndata\n");
  write(clouds / "a.e57", "ASTM-E57");

  Prototype box;
  add_box(box, {1, 2, 3}, {3, 5, 7}, Material::brick);
  const std::array<std::string, 5> kinds{"obj", "ply", "stl", "gltf", "glb"};
  for (const auto& [name, bytes] : test::all_meshes(box.mesh)) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {  // the target's first byte
      if (extension_of(name) == kinds[kind]) {
        write(meshes / name, static_cast<char>(kind) + bytes);
      }
    }
  }
  const fs::path sweeps = fs::path(argv[1]) / "sweep";
  fs::create_directories(sweeps);
  int count = 0;
  for (const std::string& text : test::sweeps_of_all_blocks()) {
    write(sweeps / ("sweep" + std::to_string(count++) + ".yaml"), text);
  }
  const fs::path logs = fs::path(argv[1]) / "log";
  fs::create_directories(logs);
  for (const auto& [name, bytes] : test::all_logs()) write(logs / name, bytes);
  fs::remove(logs / "log.db3");
  test::write_sample_db3(logs / "log.db3");
  const fs::path databases = fs::path(argv[1]) / "database";
  const fs::path edits = fs::path(argv[1]) / "database_edits";
  fs::create_directories(databases);
  fs::create_directories(edits);
  const fs::path sample = databases / "sample.db";
  fs::remove(sample);
  fuzz::write_sample_database(sample);
  std::ifstream file(sample, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  for (char command = 0; command < fuzz::kCommandCount; ++command) {
    content[80] = command;  // of the header, without meaning; the target takes the sum of all bytes
    write(databases / ("sample" + std::to_string(command) + ".db"), content);
  }
  for (char column = 0; column < 100; ++column) {
    for (char kind = 0; kind < 8; ++kind) {
      const auto first = static_cast<char>(
          fuzz::kCommandCount + (column + kind) % fuzz::kCommandCount);  // without digests
      const std::string bytes{first, 1, column, 7, kind, 5, 40, 3, '1', '}', '9', '-'};
      write(edits / (std::to_string(column) + "_" + std::to_string(kind)), bytes);
    }
  }
  return 0;
}
