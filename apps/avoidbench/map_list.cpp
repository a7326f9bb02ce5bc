#include "map_list.hpp"

#include <cstdio>
#include <memory>

#include "base/input_error.hpp"
#include "maps/generators.hpp"
#include "metrics/environment.hpp"
#include "reference_table.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {
namespace {

struct ListOptions {
  bool fields = false;
  std::string suite;
  std::uint64_t count = 30;
  std::size_t positions = 3;
  TableOptions table;
};

std::string fixed(double value, int digits) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

template <std::size_t... index>
void add_generators(ReferenceTable& table, std::index_sequence<index...>) {
  (table.rows.push_back({std::string(std::variant_alternative_t<index, MapSpec>::kind),
                         std::string(std::variant_alternative_t<index, MapSpec>::doc)}),
   ...);
}

void list_generators(const ListOptions& options) {
  ReferenceTable table{{"generator", "summary"}, {}};
  add_generators(table, std::make_index_sequence<std::variant_size_v<MapSpec>>());
  write_table(table, options.table);
}

/// The suite's maps from 1 on, one row each.
template <class Spec>
void add_fields(const std::string& suite, const Spec& spec, const ListOptions& options,
                ReferenceTable& table) {
  const BodyMeasure body = body_measure(to_eigen(TrialSpec{}.vehicle.body_size_m));
  for (std::uint64_t number = 1; number <= options.count; ++number) {
    const AvoidbenchField field = make_avoidbench_field(field_suite(spec), number);
    const double gap = relative_gap_size(make_world(spec, number), body);
    std::string first;
    for (std::size_t i = 0; i < std::min(options.positions, field.positions_m.size()); ++i) {
      const Eigen::Vector2d place = field.positions_m[i].template cast<double>();
      first += (first.empty() ? "(" : " (") + fixed(place.x(), 3) + "," + fixed(place.y(), 3) + ")";
    }
    table.rows.push_back({suite, std::to_string(number),
                          fixed(static_cast<double>(field.radius_m), 4), fixed(gap, 3),
                          std::to_string(field.map_seed), std::to_string(field.positions_m.size()),
                          first});
  }
}

void list_fields(const ListOptions& options) {
  ReferenceTable table{{"suite", "map", "radius_m", "relative_gap_size", "map_seed", "obstacles",
                        "first_positions_m"},
                       {}};
  if (options.suite != "indoor") add_fields("outdoor", AvoidbenchForestSpec{}, options, table);
  if (options.suite != "outdoor") add_fields("indoor", AvoidbenchIndoorSpec{}, options, table);
  write_table(table, options.table);
}

void list(const ListOptions& options) {
  const std::vector<std::string> suites{"outdoor", "indoor"};
  if (!options.suite.empty() && options.suite != suites[0] && options.suite != suites[1]) {
    throw InputError("--suite " + options.suite + ": unknown" +
                     did_you_mean(options.suite, suites) + "; it is one of outdoor, indoor");
  }
  options.fields ? list_fields(options) : list_generators(options);
}

}  // namespace

void add_maps_list_command(CLI::App& maps) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* command = maps.add_subcommand(
      "list", "The generators; or the obstacle fields of the original AvoidBench's suites");
  CLI::Option* fields = command->add_flag(
      "--fields", options->fields,
      "Each map of the original's suites: Poisson radius, relative gap size, the original's map "
      "seed, obstacles in the whole field and the first of their positions in its own frame");
  command->add_option("--suite", options->suite, "outdoor or indoor (default: both)")
      ->needs(fields);
  command->add_option("--count", options->count, "Maps of a suite, from 1 on")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str()
      ->needs(fields);
  command->add_option("--positions", options->positions, "Positions of each map")
      ->check(CLI::Range(0, 100'000))
      ->capture_default_str()
      ->needs(fields);
  add_table_options(*command, options->table);
  command->footer(
      "Examples:\n"
      "  avoidbench maps list\n"
      "  avoidbench maps list --fields --suite outdoor --format csv --output fields.csv");
  command->callback([options] { list(*options); });
}

}  // namespace avoidbench
