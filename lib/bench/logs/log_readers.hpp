#pragma once

#include <filesystem>
#include <string_view>

#include "logs/byte_reader.hpp"
#include "logs/flight_builder.hpp"

/// The readers of each format. Each reads to the end of what the log has of poses and throws
/// InputError for damage, with its place. Those of a ByteReader throw CutOff where the file ends
/// early; what was read up to there is in the builder.
namespace avoidbench {

inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
inline constexpr std::string_view kUlogMagic = "ULog\x01\x12\x35";
inline constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};

void read_bag(ByteReader& in, FlightBuilder& flight);
void read_mcap(ByteReader& in, FlightBuilder& flight);
void read_ulog(ByteReader& in, FlightBuilder& flight);
/// TUM's lines, or those of EuRoC's CSV.
void read_text_path(ByteReader& in, FlightBuilder& flight);
void read_db3(const std::filesystem::path& file, FlightBuilder& flight);

/// Any of them except SQLite's, by the first bytes. A file that ends early gives a warning.
/// Throws InputError for other files, with what is known about them.
void read_log(ByteReader& in, FlightBuilder& flight);

}  // namespace avoidbench
