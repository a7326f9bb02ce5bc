#include "store/record_format.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/check.hpp"
#include "base/digest.hpp"
#include "base/math.hpp"
#include "store/stored_text.hpp"

namespace avoidbench {
namespace {

static_assert(std::endian::native == std::endian::little,
              "doubles are stored as they lie in memory");

using SampleNumbers = std::array<double, kSampleDoubles>;

/// The order of the numbers is that in schema.sql: it is the format.
SampleNumbers numbers(const Sample& s) {
  const auto& p = s.position_world;
  const auto& v = s.velocity_world;
  const auto& a = s.acceleration_world;
  const auto& q = s.q_world_body;
  const auto& w = s.rates_body_radps;
  const auto& r = s.reference_world;
  return {s.time_s, p.x(), p.y(), p.z(), v.x(),         v.y(),          v.z(), a.x(),
          a.y(),    a.z(), q.w(), q.x(), q.y(),         q.z(),          w.x(), w.y(),
          w.z(),    r.x(), r.y(), r.z(), s.clearance_m, s.rotor_power_w};
}

Sample sample(const SampleNumbers& n) {
  Sample s;
  s.time_s = n[0];
  s.position_world = {n[1], n[2], n[3]};
  s.velocity_world = {n[4], n[5], n[6]};
  s.acceleration_world = {n[7], n[8], n[9]};
  s.q_world_body = Eigen::Quaterniond(n[10], n[11], n[12], n[13]);
  s.rates_body_radps = {n[14], n[15], n[16]};
  s.reference_world = {n[17], n[18], n[19]};
  s.clearance_m = n[20];
  s.rotor_power_w = n[21];
  return s;
}

/// JSON has no NaN.
nlohmann::json json_number(double value) {
  return value == value ? nlohmann::json(value) : nlohmann::json(nullptr);
}

double number_of(const nlohmann::json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// By reference: another type throws, where get() would round a number.
std::int64_t whole(const nlohmann::json& json) { return json.get_ref<const std::int64_t&>(); }

/// How many letters from the beginning on are a number of JSON; 0: none.
std::size_t number_size(std::string_view text) {
  std::size_t at = 0;
  const auto take = [&](char c) {
    const bool is_there = at < text.size() && text[at] == c;
    at += is_there ? 1 : 0;
    return is_there;
  };
  const auto take_digits = [&] {
    const std::size_t from = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at > from;
  };
  take('-');
  if (!take('0') && !take_digits()) return 0;
  if (take('.') && !take_digits()) return 0;
  if (take('e') || take('E')) {
    if (!take('-')) take('+');
    if (!take_digits()) return 0;
  }
  return at;
}

/// Reads what plan_calls_json() writes, many times as fast as JSON of any kind can be read: a
/// flight has hundreds of calls.
class CallText {
 public:
  explicit CallText(std::string_view text) : rest_(text) {}

  /// Nothing where it is no text of that form.
  std::optional<std::vector<PlanCall>> read() {
    std::vector<PlanCall> calls;
    is_ours_ = take('[');
    while (is_ours_ && !take(']')) {
      if (!calls.empty()) expect(',');
      calls.push_back(call());
    }
    if (!is_ours_ || !rest_.empty()) return std::nullopt;
    return calls;
  }

 private:
  PlanCall call() {
    PlanCall call;
    expect('[');
    call.time_s = real();
    expect(',');
    call.cpu_time_s = real();
    expect(',');
    call.wall_time_s = real();
    expect(',');
    call.status = static_cast<std::int32_t>(number<std::int64_t>());
    expect(',');
    call.command_kind = static_cast<std::uint32_t>(number<std::int64_t>());
    call.latency_s = take(',') ? real() : std::numeric_limits<double>::quiet_NaN();
    expect(']');
    return call;
  }
  bool take(char c) {
    const bool is_next = rest_.starts_with(c);
    rest_.remove_prefix(is_next ? 1 : 0);
    return is_next;
  }
  void expect(char c) { is_ours_ = take(c) && is_ours_; }
  double real() {
    constexpr std::string_view kNone = "null";
    if (!rest_.starts_with(kNone)) return number<double>();
    rest_.remove_prefix(kNone.size());
    return std::numeric_limits<double>::quiet_NaN();
  }
  template <class T>
  T number() {
    T value{};
    const std::size_t size = number_size(rest_);
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + size, value);
    // Numbers that T does not hold, too, are left to JSON's own rules.
    is_ours_ = is_ours_ && error == std::errc() && end == rest_.data() + size;
    rest_.remove_prefix(size);
    return value;
  }

  std::string_view rest_;
  bool is_ours_ = true;
};

}  // namespace

std::vector<std::byte> sample_bytes(std::span<const Sample> samples) {
  std::vector<std::byte> bytes(samples.size() * sizeof(SampleNumbers));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const SampleNumbers row = numbers(samples[i]);
    std::memcpy(bytes.data() + i * sizeof row, row.data(), sizeof row);
  }
  return bytes;
}

std::vector<Sample> samples_from_bytes(std::span<const std::byte> bytes) {
  std::vector<Sample> samples(bytes.size() / sizeof(SampleNumbers));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SampleNumbers row{};
    std::memcpy(row.data(), bytes.data() + i * sizeof row, sizeof row);
    samples[i] = sample(row);
  }
  return samples;
}

std::vector<std::byte> packed_samples(std::span<const std::byte> bytes) {
  const std::size_t count = bytes.size() / sizeof(SampleNumbers);
  std::vector<std::byte> planes(count * sizeof(SampleNumbers));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < sizeof(SampleNumbers); ++k) {
      // Byte by byte of each number, all samples of it together: exponents and signs hardly change
      // along a flight and pack well.
      planes[k * count + i] = bytes[i * sizeof(SampleNumbers) + k];
    }
  }
  uLongf size = ::compressBound(planes.size());
  std::vector<std::byte> packed(size);
  // zlib's usual level; part of the format in that equal flights are equal bytes.
  constexpr int kLevel = 6;
  const int code =
      ::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(planes.data()), planes.size(), kLevel);
  AB_CHECK(code == Z_OK, code);
  packed.resize(size);
  return packed;
}

std::vector<std::byte> unpacked_samples(std::span<const std::byte> packed, std::size_t count) {
  // A corrupt count must not ask for all memory: zlib packs at most about 1032 to 1.
  constexpr std::size_t kMostRatio = 1100;
  if (count > (packed.size() + 1) * kMostRatio / sizeof(SampleNumbers)) return {};
  std::vector<std::byte> planes(count * sizeof(SampleNumbers)), bytes(planes.size());
  uLongf size = planes.size();
  const int code = ::uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (code != Z_OK || size != planes.size()) return {};
  // The eight bytes of a number at once.
  for (std::size_t k = 0; k < kSampleDoubles; ++k) {
    const std::byte* const plane = planes.data() + k * sizeof(double) * count;
    for (std::size_t i = 0; i < count; ++i) {
      const auto byte = [&](std::size_t place) {
        return std::to_integer<std::uint64_t>(plane[place * count + i]) << (8U * place);
      };
      // Without a loop: compilers leave a loop of eight as it is.
      const std::uint64_t number =
          byte(0) | byte(1) | byte(2) | byte(3) | byte(4) | byte(5) | byte(6) | byte(7);
      std::memcpy(bytes.data() + i * sizeof(SampleNumbers) + k * sizeof number, &number,
                  sizeof number);
    }
  }
  return bytes;
}

std::string plan_calls_json(std::span<const PlanCall> calls) {
  nlohmann::json rows = nlohmann::json::array();
  for (const PlanCall& call : calls) {
    nlohmann::json row = nlohmann::json::array();
    row.push_back(json_number(call.time_s));
    row.push_back(json_number(call.cpu_time_s));
    row.push_back(json_number(call.wall_time_s));
    row.push_back(call.status);
    row.push_back(call.command_kind);
    // Only of flights whose latency was measured: the others' texts stay as they were before there
    // was such.
    if (call.latency_s == call.latency_s) row.push_back(call.latency_s);
    rows.push_back(std::move(row));
  }
  return rows.dump();
}

std::vector<PlanCall> plan_calls_from_json(std::string_view json) {
  if (auto calls = CallText(json).read()) return *std::move(calls);
  // All else by the rules of JSON, which also tell what is wrong.
  std::vector<PlanCall> calls;
  for (const nlohmann::json& row : nlohmann::json::parse(json)) {
    calls.push_back({.time_s = number_of(row.at(0)),
                     .cpu_time_s = number_of(row.at(1)),
                     .wall_time_s = number_of(row.at(2)),
                     .status = static_cast<std::int32_t>(whole(row.at(3))),
                     .command_kind = static_cast<std::uint32_t>(whole(row.at(4))),
                     .latency_s = row.size() > 5 ? number_of(row.at(5)) : number_of(nullptr)});
  }
  return calls;
}

/// Without times, which the host measures: flown again, the digest is the same.
std::string plan_calls_digest(std::span<const PlanCall> calls) {
  Digest digest;
  for (const PlanCall& call : calls) {
    digest.add(call.time_s);
    digest.add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(call.status)));
    digest.add(std::uint64_t{call.command_kind});
  }
  return digest.hex();
}

std::string record_digest(const TrialRecord& record) {
  Digest digest;
  // What is no UTF-8 is stored otherwise: both have one digest.
  digest.add(text(record.outcome)).add(as_utf8(record.reason));
  // All NaNs are one: bits of NaN are not kept.
  digest.add(std::isnan(record.end_time_s) ? math::kNaN : record.end_time_s);
  digest.add_bytes(sample_bytes(record.samples)).add(plan_calls_digest(record.plan_calls));
  for (const Collision& collision : record.collisions) {
    digest.add(collision.time_s).add(collision.speed_mps).add(collision.kind);
    digest.add(static_cast<std::uint64_t>(collision.obstacle));
  }
  return digest.hex();
}

}  // namespace avoidbench
