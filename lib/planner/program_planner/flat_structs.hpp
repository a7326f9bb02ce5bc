#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "avoidbench/planner.h"
#include "program_planner/segment.hpp"

/// The structs of planner.h as they lie in the segment.
namespace avoidbench {

/// Append a struct with all that it points to; return its offset.
std::uint64_t write_flat(Segment& segment, const ab_setup& setup);
std::uint64_t write_flat(Segment& segment, const ab_mission& mission);
std::uint64_t write_flat(Segment& segment, const ab_observation& observation);

/// An answer that can't be parsed.
class BadAnswer : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An answer's bytes, copied out of the segment. All that reads from it throws BadAnswer where
/// something lies outside.
class FlatAnswer {
 public:
  explicit FlatAnswer(const std::vector<std::byte>& bytes);

  const ab_process_answer& head() const { return head_; }
  std::string text(std::uint64_t offset, const char* what) const;
  std::vector<std::string> texts(std::uint64_t offset, std::uint32_t count, const char* what) const;
  /// Copies what lies there, from its beginning.
  void copy(std::uint64_t offset, void* to, std::size_t count, const char* what) const;
  /// The same for a struct that begins with its struct_size: what is shorter is filled up by zeros,
  /// what is longer cut off.
  template <class Struct>
  Struct sized(std::uint64_t offset, std::size_t least, const char* what) const {
    Struct value{};
    copy(offset, &value, sized_bytes(offset, least, sizeof(Struct), what), what);
    value.struct_size = static_cast<std::uint32_t>(sizeof(Struct));
    return value;
  }
  template <class Element>
  std::vector<Element> array(std::uint64_t offset, std::uint32_t count, const char* what) const {
    std::vector<Element> elements(checked_count(offset, count, sizeof(Element), what));
    if (!elements.empty()) copy(offset, elements.data(), count * sizeof(Element), what);
    return elements;
  }

 private:
  std::size_t sized_bytes(std::uint64_t offset, std::size_t least, std::size_t most,
                          const char* what) const;
  std::uint32_t checked_count(std::uint64_t offset, std::uint32_t count, std::size_t size,
                              const char* what) const;

  const std::vector<std::byte>& bytes_;
  ab_process_answer head_{};
  mutable std::size_t text_bytes_ = 0;  ///< of all texts read; several may be one and the same
};

/// A planner's table out of a program's description, with all that it points to. The functions are
/// null. Stays at its address.
class DescribedTable {
 public:
  /// Throws BadAnswer.
  explicit DescribedTable(const FlatAnswer& answer);
  DescribedTable(const DescribedTable&) = delete;
  DescribedTable& operator=(const DescribedTable&) = delete;

  ab_planner table{};
  const ab_files* files() const { return has_files_ ? &files_ : nullptr; }

 private:
  /// A text of the answer, kept; null for offset 0.
  const char* kept(const FlatAnswer& answer, const void* offset, const char* what);
  void read_parameters(const FlatAnswer& answer);
  void read_profiles(const FlatAnswer& answer);
  void read_files(const FlatAnswer& answer, std::uint64_t offset);

  std::vector<std::unique_ptr<std::string>> texts_;
  std::vector<ab_parameter> parameters_;
  std::vector<const ab_parameter*> parameter_pointers_;
  std::vector<std::vector<ab_named_number>> numbers_;
  std::vector<ab_profile> profiles_;
  std::vector<const ab_profile*> profile_pointers_;
  std::vector<const char*> file_pointers_;
  ab_files files_{};
  bool has_files_ = false;
};

/// The command of a plan()'s answer; `points` get its points.
ab_command read_command(const FlatAnswer& answer, std::vector<ab_point>& points);

}  // namespace avoidbench
