#include "explain/paragraph.hpp"

#include <cmath>

#include "base/number_text.hpp"

namespace avoidbench {
namespace {

std::string meters(double m) { return fixed_digits(m, 2) + " m"; }
std::string at_s(double s) { return fixed_digits(s, 2) + " s"; }
std::string speed(double mps) { return fixed_digits(mps, 1) + " m/s"; }
std::string percent(double share) { return fixed_digits(100.0 * share, 0) + " %"; }

/// "from 3.20 s on", or "never".
std::string since(double s) { return std::isnan(s) ? "never" : "from " + at_s(s) + " on"; }

/// What the planner was shown.
std::string views(const Facts& f) {
  if (!(f.sweep_count > 0.0)) return "depth images";
  return f.sweep_count == f.depth_image_count ? "sweeps" : "depth images and sweeps";
}

std::string sight_sentences(const Facts& f) {
  std::string text = "The obstacle that it struck was in the field of view " + since(f.in_cone_s) +
                     ", unoccluded " + since(f.unoccluded_s) + ", and in range " +
                     since(f.in_range_s);
  if (!std::isnan(f.seen_way_m)) {
    text += ", when " + meters(f.seen_way_m) +
            " of way were left and reacting and braking needed " + meters(f.seen_need_m);
  }
  text += ". ";
  if (f.sight_input_count == 0.0) {
    text += "The planner takes no input that could show it. ";
  } else if (f.depth_image_count == 0.0) {
    text += "The planner was shown neither depth nor sweeps. ";
  } else if (!std::isnan(f.depth_image_count)) {
    text += "Of " + fixed_digits(f.depth_image_count, 0) + " " + views(f) + " " +
            fixed_digits(f.sensed_image_count, 0) + " showed it at its depth" +
            (std::isnan(f.sensed_s) ? "" : ", three of them by " + at_s(f.sensed_s)) +
            (std::isnan(f.longest_gap_s) ? "" : ", with gaps of up to " + at_s(f.longest_gap_s)) +
            (std::isnan(f.lately_s) ? ""
                                    : "; " + fixed_digits(f.sensed_lately_count, 0) + " did from " +
                                          at_s(f.lately_s) + " to the last chance") +
            ". ";
  }
  if (!std::isnan(f.mapped_share)) {
    text += "The planner's map had " + percent(f.mapped_share) + " of it at the last chance" +
            (std::isnan(f.mapped_s) ? " and a tenth never"
                                    : " and a tenth from " + at_s(f.mapped_s) + " on") +
            ". ";
  }
  return text;
}

std::string collision_sentences(const Facts& f) {
  std::string text = "The last chance to stop was at " + at_s(f.last_chance_s) + ": " +
                     meters(f.last_chance_way_m) + " before the contact at " +
                     speed(f.last_chance_speed_mps) + ", where reacting (" + at_s(f.reaction_s) +
                     ") and braking needed " + meters(f.last_chance_need_m) + ". ";
  text += sight_sentences(f);
  if (f.no_plan_share > 0.0) {
    text += "From the last chance on " + percent(f.no_plan_share) + " of the calls gave no plan. ";
  }
  if (!std::isnan(f.tracking_error_m)) {
    text +=
        "At the contact the vehicle was " + meters(f.tracking_error_m) +
        " from its commanded place; the commanded path of the last two seconds came to within " +
        meters(f.commanded_clearance_m) + " of a surface. ";
  }
  if (!std::isnan(f.obstacle_way_m)) {
    text += "The obstacle had moved " + meters(f.obstacle_way_m) +
            " since the call whose command was flown; had it stood still, the body would have "
            "passed at " +
            meters(f.still_clearance_m) + ". ";
  }
  if (f.wind_mps > 0.0) text += "The air moved at " + speed(f.wind_mps) + ". ";
  return text;
}

std::string timeout_sentences(const Facts& f) {
  std::string text = "It flew " + meters(f.flown_m) + " at " + speed(f.mean_speed_mps) +
                     " on average; the shortest path has " + meters(f.reference_length_m) + ". ";
  text += "It came nearest to the goal, " + meters(f.closest_m) + ", at " + at_s(f.closest_s) +
          ", and was first within 0.5 m of that at " + at_s(f.progress_s) +
          ". In the second half it stood still for " + percent(f.hover_share) + " of the time" +
          (f.late_no_plan_share > 0.0
               ? ", and " + percent(f.late_no_plan_share) + " of the calls gave no plan"
               : "") +
          ". ";
  if (f.return_count > 0.0) {
    text += "It came back " + fixed_digits(f.return_count, 0) +
            (f.return_count > 1.0 ? " times" : " time") + " to where it had been. ";
  }
  text += "The place in the goal's circle with the most clearance is " +
          meters(f.goal_clearance_m) + " from any surface. ";
  return text;
}

}  // namespace

std::string cause_text(Cause cause) {
  const CauseDef& def = cause_table()[static_cast<std::size_t>(cause)];
  return std::string(text(cause)) + ": " + std::string(def.doc);
}

std::string paragraph(const CauseFound& explanation, Outcome outcome, const std::string& reason) {
  const Facts& f = explanation.facts;
  std::string sentences = std::string(text(outcome)) + ": " + reason + ". ";
  if (!std::isnan(f.contact_s)) sentences += collision_sentences(f);
  if (!std::isnan(f.flown_m)) sentences += timeout_sentences(f);
  if (!std::isnan(f.commanded_outside_m)) {
    sentences += "Its commanded place was " + meters(std::abs(f.commanded_outside_m)) +
                 (f.commanded_outside_m > 0.0 ? " outside" : " inside") + " the map. ";
  }
  sentences.pop_back();
  return sentences;
}

double decisive_s(const CauseFound& explanation, double end_time_s) {
  const Facts& f = explanation.facts;
  if (!std::isnan(f.last_chance_s)) return f.last_chance_s;
  if (!std::isnan(f.progress_s)) return f.progress_s;
  return end_time_s;
}

}  // namespace avoidbench
