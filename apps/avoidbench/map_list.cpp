#include "base/number_text.hpp"
#include "commands.hpp"
#include "maps/generators.hpp"
#include "metrics/environment.hpp"
#include "output.hpp"
#include "report/table_rows.hpp"
#include "trial/trial_spec.hpp"

namespace avoidbench {
namespace {

struct ListOptions {
  bool fields = false;
  std::string suite;
  std::uint64_t count = 30;
  std::size_t positions = 3;
  OutputOptions output;
};

template <std::size_t... index>
void add_generators(Table& table, std::index_sequence<index...>) {
  (table.rows.push_back(make_row(std::variant_alternative_t<index, MapSpec>::kind,
                                 std::variant_alternative_t<index, MapSpec>::doc)),
   ...);
}

void list_generators(const ListOptions& options) {
  Table table = make_list({"generator", "summary"});
  add_generators(table, std::make_index_sequence<std::variant_size_v<MapSpec>>());
  write_table(table, options.output);
}

/// The suite's maps from 1 on, one row each.
template <class Spec>
void add_fields(const std::string& suite, const Spec& spec, const ListOptions& options,
                Table& table) {
  const BodyMeasure body = body_measure(to_eigen(TrialSpec{}.vehicle.body_size_m));
  for (std::uint64_t number = 1; number <= options.count; ++number) {
    const AvoidbenchField field = make_avoidbench_field(field_suite(spec), number);
    const double gap = relative_gap_size(make_world(spec, number), body);
    std::string first;
    for (std::size_t i = 0; i < std::min(options.positions, field.positions_m.size()); ++i) {
      const Eigen::Vector2d place = field.positions_m[i].template cast<double>();
      first += (first.empty() ? "(" : " (") + fixed_digits(place.x(), 3) + "," +
               fixed_digits(place.y(), 3) + ")";
    }
    // The radius is a 32-bit float: no more digits than that has.
    table.rows.push_back(
        make_row(suite, number, fixed_digits(static_cast<double>(field.radius_m), 4),
                 fixed_digits(gap, 3), field.map_seed, field.positions_m.size(), first));
  }
}

void list_fields(const ListOptions& options) {
  Table table = make_list({"suite", "map", "radius_m", "relative_gap_size", "map_seed", "obstacles",
                           "first_positions_m"});
  if (options.suite != "indoor") add_fields("outdoor", AvoidbenchForestSpec{}, options, table);
  if (options.suite != "outdoor") add_fields("indoor", AvoidbenchIndoorSpec{}, options, table);
  write_table(table, options.output);
}

}  // namespace

void add_maps_list_command(CLI::App& maps) {
  const auto [command, options] = add_command<ListOptions>(
      maps, "list", "The generators; or the obstacle fields of the original AvoidBench's suites",
      [](const ListOptions& asked) { asked.fields ? list_fields(asked) : list_generators(asked); });
  CLI::Option* fields =
      command.add_flag("--fields", options.fields,
                       "Each map of the original's suites: Poisson radius, relative gap size, the "
                       "original's map seed, obstacles in the complete field, and the first "
                       "obstacle positions in the field's frame");
  add_choice(command, "--suite", options.suite, {"outdoor", "indoor"},
             "outdoor or indoor (default: both)")
      ->needs(fields);
  add_number(command, "--count", options.count, CLI::Range(1, 10'000), "Maps of a suite, from 1 on")
      ->needs(fields);
  add_number(command, "--positions", options.positions, CLI::Range(0, 100'000),
             "Positions of each map")
      ->needs(fields);
  add_output_options(command, options.output);
  command.footer(
      "Examples:\n"
      "  avoidbench maps list\n"
      "  avoidbench maps list --fields --suite outdoor --format csv --output fields.csv");
}

}  // namespace avoidbench
