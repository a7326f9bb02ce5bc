#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "drawing/picture.hpp"

namespace avoidbench {

/// One line of a chart.
struct ChartLine {
  std::string label;
  std::vector<Eigen::Vector2d> points;  ///< x rising
};

/// A chart of its own scale along y.
struct ChartPanel {
  std::string title;  ///< with the unit
  std::vector<ChartLine> lines;
};

/// Panels one below the other over the same x axis. Lines of the same place in each panel have the
/// same colour; the legend is that of the first panel.
Picture line_chart(const std::vector<ChartPanel>& panels, const std::string& x_label);

}  // namespace avoidbench
