#include "line_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace avoidbench {
namespace {

constexpr int kWidth = 760, kPanelHeight = 190;
constexpr int kLeft = 64, kRight = 20, kTop = 34, kBottom = 34, kFoot = 26;
constexpr Color kInk{40, 40, 40}, kGrid{225, 225, 225};
/// Okabe and Ito (2008): told apart by the colour-blind too.
constexpr std::array<Color, 6> kColors{Color{0, 114, 178}, Color{213, 94, 0},
                                       Color{0, 158, 115}, Color{204, 121, 167},
                                       Color{230, 159, 0}, Color{86, 180, 233}};

struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// A step of 1, 2 or 5 times a power of ten that divides the span in 3 to 8.
double tick_step(const Span& span) {
  const double rough = (span.high - span.low) / 5.0;
  double power = 1.0;
  while (power * 10.0 <= rough) power *= 10.0;
  while (power > rough) power /= 10.0;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10.0 * power;
}

std::string tick_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", std::abs(value) < 1e-12 ? 0.0 : value);
  return text;
}

Span widened(Span span) {
  if (!(span.high > span.low)) {
    span.low -= 0.5;
    span.high += 0.5;
  }
  const double step = tick_step(span);
  return {step * std::floor(span.low / step), step * std::ceil(span.high / step)};
}

/// Where a panel's values are in the picture.
struct Frame {
  Span x, y;
  int top_px = 0;

  Eigen::Vector2d at(const Eigen::Vector2d& point) const {
    const double bottom = top_px + kPanelHeight - kBottom;
    return {kLeft + (point.x() - x.low) / (x.high - x.low) * (kWidth - kLeft - kRight),
            bottom - (point.y() - y.low) / (y.high - y.low) * (kPanelHeight - kTop - kBottom)};
  }
};

void draw_axes(const Frame& frame, const std::string& title, Picture& picture) {
  const double y_step = tick_step(frame.y), x_step = tick_step(frame.x);
  for (int i = 0; frame.y.low + i * y_step <= frame.y.high + 0.01 * y_step; ++i) {
    const double y = frame.y.low + i * y_step;
    const Eigen::Vector2d left = frame.at({frame.x.low, y});
    draw_line(picture, {left, frame.at({frame.x.high, y})}, kGrid, 1);
    draw_text(picture, tick_text(y), 8, static_cast<int>(left.y()) + 5, kInk);
  }
  for (int i = 0; frame.x.low + i * x_step <= frame.x.high + 0.01 * x_step; ++i) {
    const double x = frame.x.low + i * x_step;
    const Eigen::Vector2d foot = frame.at({x, frame.y.low});
    draw_line(picture, {foot, frame.at({x, frame.y.high})}, kGrid, 1);
    draw_text(picture, tick_text(x), static_cast<int>(foot.x()) - 8,
              static_cast<int>(foot.y()) + 18, kInk);
  }
  draw_text(picture, title, kLeft, frame.top_px + 20, kInk);
}

void draw_legend(const std::vector<ChartLine>& lines, Picture& picture) {
  int x = kWidth - kRight;
  for (std::size_t i = lines.size(); i-- > 0;) {
    constexpr int kLetter_px = 9;
    x -= static_cast<int>(lines[i].label.size()) * kLetter_px + 36;
    const Color& color = kColors[i % kColors.size()];
    draw_line(picture, {{x + 0.0, 15.0}, {x + 22.0, 15.0}}, color, 3);
    draw_text(picture, lines[i].label, x + 28, 20, kInk);
  }
}

}  // namespace

Picture line_chart(const std::vector<ChartPanel>& panels, const std::string& x_label) {
  Picture picture = make_picture(kWidth, static_cast<int>(panels.size()) * kPanelHeight + kFoot);
  std::fill(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{255});
  Span x;
  for (const ChartPanel& panel : panels) {
    for (const ChartLine& line : panel.lines) {
      for (const Eigen::Vector2d& point : line.points) x.add(point.x());
    }
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Span y;
    for (const ChartLine& line : panels[i].lines) {
      for (const Eigen::Vector2d& point : line.points) y.add(point.y());
    }
    const Frame frame{widened(x), widened(y), static_cast<int>(i) * kPanelHeight};
    draw_axes(frame, panels[i].title, picture);
    for (std::size_t k = 0; k < panels[i].lines.size(); ++k) {
      std::vector<Eigen::Vector2d> places;
      for (const Eigen::Vector2d& point : panels[i].lines[k].points) {
        places.push_back(frame.at(point));
      }
      const Color& color = kColors[k % kColors.size()];
      draw_line(picture, places, color, 2);
      for (const Eigen::Vector2d& place : places) draw_disc(picture, place, 3.5, color);
    }
  }
  if (!panels.empty()) draw_legend(panels.front().lines, picture);
  draw_text(picture, x_label, kLeft, picture.height_px - 10, kInk);
  return picture;
}

}  // namespace avoidbench
