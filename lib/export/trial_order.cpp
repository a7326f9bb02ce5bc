#include "export/trial_order.hpp"

#include <algorithm>
#include <numeric>

namespace avoidbench {
namespace {

/// NaN is none.
bool has_value(const TableValue& value) {
  const auto* number = std::get_if<double>(&value);
  return !std::holds_alternative<std::monostate>(value) &&
         (number == nullptr || *number == *number);
}

/// Whole numbers and others have one order.
bool is_less(const TableValue& a, const TableValue& b) {
  const auto* whole_a = std::get_if<std::int64_t>(&a);
  const auto* whole_b = std::get_if<std::int64_t>(&b);
  const auto* real_a = std::get_if<double>(&a);
  const auto* real_b = std::get_if<double>(&b);
  if (whole_a != nullptr && real_b != nullptr) return static_cast<double>(*whole_a) < *real_b;
  if (real_a != nullptr && whole_b != nullptr) return *real_a < static_cast<double>(*whole_b);
  // Of two texts, or by the kind of value where they have nothing in common.
  return a < b;
}

}  // namespace

std::vector<std::size_t> worst_first(const std::vector<TableValue>& values, Better better) {
  std::vector<std::size_t> places(values.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  // Stable: equal values stay in the order of the table. What has no value comes last, since
  // nothing is known of it.
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    if (!has_value(values[a]) || !has_value(values[b])) {
      return has_value(values[a]) && !has_value(values[b]);
    }
    return better == Better::more ? is_less(values[a], values[b]) : is_less(values[b], values[a]);
  });
  return places;
}

/// A field that is no metric is sorted as if more were better: from its least value up.
Better better_of(const std::string& field, const std::vector<MetricRow>& metrics) {
  const auto metric = std::find_if(metrics.begin(), metrics.end(),
                                   [&](const MetricRow& one) { return one.name == field; });
  return metric == metrics.end() ? Better::more : metric->better;
}

}  // namespace avoidbench
