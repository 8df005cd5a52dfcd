#include "castor/tools/chaos/chart.hpp"

#include "castor/base/duration.hpp"
#include "castor/base/markup.hpp"
#include "castor/base/text.hpp"
#include "castor/tools/chaos/recovery_times.hpp"
#include "castor/tools/chaos/rounded.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace castor::faults {

namespace {

constexpr double width = 960;
constexpr double row_height = 26;
constexpr double axis_height = 28;
constexpr double plot_height = 180;
constexpr double margin = 12;
/// For the names of the rows, and for the numbers beside a plot.
constexpr double names_width = 190;
constexpr double numbers_width = 64;
constexpr std::size_t longest_name = 26;
constexpr std::size_t most_bins = 30;
constexpr int time_ticks = 10;
constexpr int value_ticks = 6;

/// Where a value stands in a picture.
struct Scale {
  double most = 1;
  double from = 0;
  double to = 1;

  double operator()(double x) const { return from + (to - from) * std::min(x / most, 1.0); }
};

std::string opening(double height, std::string_view label) {
  return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", width,
                     height, escaped(label));
}

std::string text(double x, double y, std::string_view anchor, std::string_view content) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(content));
}

std::string line(double x1, double y1, double x2, double y2, std::string_view style) {
  return fmt::format(
    "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1, y1, x2,
    y2, style);
}

/// A bar that is seen even if it is very short.
std::string bar(double x1, double x2, double y, double height, std::string_view style,
                std::string_view title) {
  return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                     "class=\"{}\"><title>{}</title></rect>\n",
                     x1, y, std::max(x2 - x1, 2.0), height, style, escaped(title));
}

/// Seconds below a picture, and lines up from them.
std::string time_axis(const Scale& x, double top, double bottom) {
  std::string result;
  for (auto tick : round_ticks(x.most, time_ticks)) {
    result += line(x(tick), top, x(tick), bottom, "grid");
    result += text(x(tick), bottom + 16, "middle", fmt::format("{:g} s", tick));
  }
  return result;
}

/// Numbers beside a picture, and lines to the right of them.
std::string value_axis(const Scale& y) {
  std::string result;
  // What is counted is not cut in pieces.
  auto ticks = std::min(static_cast<int>(std::ceil(y.most)), value_ticks);
  for (auto tick : round_ticks(y.most, ticks)) {
    result += line(numbers_width, y(tick), width - margin, y(tick), "grid");
    result += text(numbers_width - 6, y(tick) + 4, "end", fmt::format("{:g}", tick));
  }
  return result;
}

Scale time_scale(const ChaosRun& run, double from) {
  return {std::max(in_seconds(run.duration), 1e-3), from, width - margin};
}

/// By name, in alphabetical order, those of outages that no fault aimed at too.
std::map<std::string, std::size_t> rows_of(const ChaosRun& run) {
  std::map<std::string, std::size_t> result;
  for (auto& x : run.faults)
    result[x.target];
  for (auto& x : run.outages)
    result[x.target];
  std::size_t row = 0;
  for (auto& [name, number] : result)
    number = row++;
  return result;
}

std::string outage_title(const Outage& x) {
  auto result = x.target + " down at " + rounded(x.down);
  if (!x.reason.empty())
    result += ": " + x.reason;
  if (x.up)
    result += ", back after " + rounded(*x.up - x.down);
  if (x.first_callback)
    result += ", working after " + rounded(*x.first_callback - x.down);
  if (x.escalated)
    result += ", given up after " + rounded(*x.escalated - x.down);
  if (!x.up && !x.escalated)
    result += ", never back";
  return result + " (bound " + rounded(x.bound) + ")";
}

/// In the lower half of a row.
std::string fault_mark(const FaultRecord& x, const Scale& time, double y) {
  auto title = fmt::format("{}: {}, {}", rounded(x.at), x.fault, to_string(x.state));
  if (!x.outcome.empty())
    title += " - " + x.outcome;
  std::string result;
  auto begin = time(in_seconds(x.at));
  auto happened = x.state == FaultState::happened;
  if (happened && x.until)
    result += bar(begin, time(in_seconds(*x.until)), y + row_height - 8, 4, "lasting", title);
  result +=
    fmt::format("<path d=\"M{0:.1f} {1:.1f}l-5 9h10z\" class=\"{2}\">"
                "<title>{3}</title></path>\n",
                begin, y + row_height - 11, happened ? "fault" : "fault undone", escaped(title));
  return result;
}

/// In the upper half of a row.
std::string outage_bar(const Outage& x, const Scale& time, double y, Timestamp end) {
  auto down = time(in_seconds(x.down));
  auto up = time(in_seconds(x.up.value_or(end)));
  auto result = bar(down, up, y + 3, 10, x.up ? "down" : "down forever", outage_title(x));
  if (x.up)
    result += line(up, y + 1, up, y + 15, "up");
  if (x.first_callback) {
    auto working = time(in_seconds(*x.first_callback));
    result += line(up, y + 8, working, y + 8, "up");
    result += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" class=\"works\"/>\n",
                          working, y + 8);
  }
  return result;
}

std::string limit_line(const Scale& x, Timestamp at, double top, double bottom,
                       const std::string& name) {
  auto where = x(in_seconds(at));
  return line(where, top, where, bottom, "limit") + text(where + 4, top + 10, "start", name);
}

} // namespace

std::vector<double> round_ticks(double most, int count) {
  if (!(most > 0))
    return {0};
  auto step = std::pow(10, std::floor(std::log10(most / count)));
  for (auto factor : {2.0, 2.5, 2.0})
    if (step * count < most * 0.999)
      step *= factor;
  std::vector<double> result;
  for (int i = 0; i * step <= most * 1.0001; ++i)
    result.push_back(i * step);
  return result;
}

std::string timeline_chart(const ChaosRun& run) {
  auto rows = rows_of(run);
  auto time = time_scale(run, names_width);
  auto bottom = margin + row_height * static_cast<double>(rows.size());
  auto result = opening(bottom + axis_height, "faults and outages over time");
  result += time_axis(time, margin, bottom);
  auto top_of = [&](const std::string& name) {
    return margin + row_height * static_cast<double>(rows.at(name));
  };
  for (auto& [name, row] : rows) {
    result +=
      line(margin, top_of(name) + row_height, width - margin, top_of(name) + row_height, "grid");
    result += text(names_width - 10, top_of(name) + 17, "end", shorten(name, longest_name));
  }
  for (auto& x : run.outages)
    result += outage_bar(x, time, top_of(x.target), run.duration);
  for (auto& x : run.faults)
    result += fault_mark(x, time, top_of(x.target));
  for (auto& x : run.violations)
    if (x.at) {
      auto where = time(in_seconds(*x.at));
      result += line(where, margin, where, bottom, "limit");
    }
  return result + "</svg>\n";
}

std::string recovery_chart(const ChaosRun& run) {
  auto times = recovery_times(run.outages);
  if (times.empty())
    return {};
  auto bins = histogram(times, most_bins);
  auto bound = std::ranges::min_element(run.outages, {}, &Outage::bound)->bound;
  // The bound is shown as long as that does not squeeze the rest.
  auto shows_bound = bound.count() > 0 && bound <= 3 * times.back();
  auto most_time = in_seconds(shows_bound ? std::max(bins.back().to, bound) : bins.back().to);
  auto most_count = std::ranges::max_element(bins, {}, &HistogramBin::count)->count;
  auto bottom = margin + plot_height;
  Scale x{most_time, numbers_width, width - margin - 40};
  Scale y{std::max(static_cast<double>(most_count), 1.0), bottom, margin + 14};
  auto result = opening(bottom + axis_height, "histogram of recovery times");
  result += value_axis(y);
  for (auto tick : round_ticks(most_time * 1000, time_ticks))
    result += text(x(tick / 1000), bottom + 16, "middle", fmt::format("{:g} ms", tick));
  for (auto& bin : bins) {
    if (bin.count == 0)
      continue;
    auto top = y(static_cast<double>(bin.count));
    result +=
      bar(x(in_seconds(bin.from)) + 1, x(in_seconds(bin.to)) - 1, top, bottom - top, "count",
          fmt::format("{} from {} to {}", bin.count, rounded(bin.from), rounded(bin.to)));
  }
  result += limit_line(x, *percentile(times, 50), margin, bottom, "p50");
  result += limit_line(x, *percentile(times, 99), margin + 12, bottom, "p99");
  if (shows_bound)
    result += limit_line(x, bound, margin, bottom, "bound");
  return result + "</svg>\n";
}

std::string resource_chart(const ChaosRun& run, std::uint64_t ResourceSample::*value, double unit,
                           std::string_view title) {
  double most = 0;
  for (auto& process : run.resources)
    for (auto& sample : process.samples)
      most = std::max(most, static_cast<double>(sample.*value) / unit);
  if (most == 0)
    return {};
  auto time = time_scale(run, numbers_width);
  auto bottom = margin + plot_height;
  Scale y{most * 1.05, bottom, margin};
  auto result = opening(bottom + axis_height, title);
  result += time_axis(time, margin, bottom) + value_axis(y);
  auto names = process_names(run);
  for (auto& process : run.resources) {
    auto i = std::find(names.begin(), names.end(), process.process) - names.begin();
    std::string points;
    for (auto& sample : process.samples)
      points += fmt::format("{:.1f},{:.1f} ", time(in_seconds(sample.at)),
                            y(static_cast<double>(sample.*value) / unit));
    result +=
      fmt::format("<polyline points=\"{}\" class=\"line c{}\"><title>{}</title>"
                  "</polyline>\n",
                  points, static_cast<std::size_t>(i) % chart_colours, escaped(process.process));
  }
  return result + "</svg>\n";
}

std::vector<std::string> process_names(const ChaosRun& run) {
  std::vector<std::string> result;
  for (auto& x : run.resources)
    if (std::find(result.begin(), result.end(), x.process) == result.end())
      result.push_back(x.process);
  return result;
}

} // namespace castor::faults
